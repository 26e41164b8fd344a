"""Variational commutator-free methods: each exponential may combine the velocities of several stages.

Let xi_j be the velocity of stage j, q0 the initial position, l the Lagrangian and h the step size. The
coefficients of a method are alpha_iJj and beta_Jj. The following formulas define the method:

- The position of stage i is ``Q_i = exp(X_im) ... exp(X_i1) q0``. The number m may depend on i.
- The exponents are ``X_iJ = h sum_j alpha_iJj xi_j`` for J = 1, ..., m.
- The position after the step is ``exp(Y_n) ... exp(Y_1) q0``.
- The exponents of the step are ``Y_J = h sum_j beta_Jj xi_j`` for J = 1, ..., n.
- The weight of stage i is ``b_i = sum_J beta_Ji``.
- The discrete Lagrangian is ``h sum_i b_i l(Q_i, xi_i)``.

Section 3.5 of Bogfjellmo and Marthinsen suggests this generalisation of the variational Crouch-Grossman
methods.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, ClassVar, Self

from orderconds.families.action_family import ActionFamily
from orderconds.families.action_formula import ActionFormula, CommutatorFreeFormula
from orderconds.families.base import all_nonzero, require_nonzero_weights
from orderconds.families.cf import EXPONENTIAL_SYMBOLS, exponentials
from orderconds.families.registry import register
from orderconds.ring.protocol import Ring
from orderconds.series.action import ActionSeries, CommutatorFreeSeries, crouch_grossman_rows
from orderconds.series.b_series import sparse
from orderconds.tableau.methods import CommutatorFree, RungeKutta
from orderconds.tableau.palindromes import symmetric_paths
from orderconds.tableau.products import Method
from orderconds.tableau.record import Tableau
from orderconds.tableau.work import Work, commutator_free_work

if TYPE_CHECKING:
    import numpy as np

    from orderconds.ring.protocol import RandomRing


@register
class VariationalCommutatorFree(ActionFamily):
    """Variational commutator-free methods on a Lie group.

    The independent conditions are computed from integrators with random coefficients. In these integrators,
    ``update`` is the number of exponentials in the update, and ``stage`` is the number of exponentials in
    each stage. The default values are large enough to find all independent conditions.

    >>> [len(VariationalCommutatorFree().conditions(n)) for n in (1, 2, 3, 4)]
    [1, 1, 6, 28]
    """

    name = "vcf"
    description = (
        "Variational commutator-free methods: each exponential may combine the velocities of several stages."
    )
    formats = ("cf", "rk")
    symbols = EXPONENTIAL_SYMBOLS
    implies: ClassVar[Mapping[str, str]] = {
        "cf": "if H is linear in p, the positions q are computed by the CF method for a vector field on G"
    }
    unknowns = "cf"
    equal_abscissae = True
    principal_error_limit = 6

    def __init__(self, update: int | None = None, stage: int | None = None) -> None:
        self.update, self.stage = update, stage

    def series(self, method: Method, ring: Ring) -> ActionSeries:
        """Return the action series of a commutator-free method. A tableau (A, b) is interpreted as a
        Crouch-Grossman method."""
        if isinstance(method, RungeKutta):
            require_nonzero_weights(self.label(), ring, method.b)
            return CommutatorFreeSeries(ring, crouch_grossman_rows(ring, method.A, method.b))
        weights = [sum(column, ring.zero) for column in zip(*exponentials(method)[-1], strict=True)]
        require_nonzero_weights(self.label(), ring, weights)
        return CommutatorFreeSeries(
            ring, [tuple(sparse(ring, row) for row in rows) for rows in exponentials(method)]
        )

    def random_series(self, ring: RandomRing, generator: np.random.Generator, order: int) -> ActionSeries:
        """Return the action series of a method with random coefficients in ``ring``. Each exponential of the
        method combines the velocities of all stages."""
        stages = max(order - 1, 2)
        numbers = [self.stage or max(2, order - 3)] * stages + [self.update or max(3, order - 2)]
        rows = [
            tuple(tuple((j, ring.random(generator)) for j in range(stages)) for _ in range(number))
            for number in numbers
        ]
        return CommutatorFreeSeries(ring, rows)

    def formula(self) -> ActionFormula:
        """Return the object that writes the conditions as formulas. The formulas are sums over indices and
        contain the coefficients alpha, beta, b and c of the method."""
        return CommutatorFreeFormula()

    @classmethod
    def claimable(cls, tableau: Tableau) -> Self | None:
        """Return this family if the method is commutator-free and all weights b_i are proved to be non-zero.
        Otherwise return None."""
        method, ring = tableau.method, tableau.ring
        if not isinstance(method, CommutatorFree):
            return None
        return cls() if all_nonzero(method.as_runge_kutta(ring).b, ring) else None

    def is_symmetric(self, method: Method, ring: Ring) -> bool:
        """Return True if the exponentials of a commutator-free method form a palindrome. Then the method is
        symmetric."""
        return isinstance(method, CommutatorFree) and symmetric_paths(method, ring) is True

    def work(self, tableau: Tableau) -> Work | None:
        """Return the numbers of field evaluations and exponentials in one step, or None if unknown."""
        return commutator_free_work(tableau)
