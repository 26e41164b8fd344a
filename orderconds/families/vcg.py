"""Variational Crouch-Grossman methods: integrators on the cotangent bundle T*G of a Lie group G. A Butcher
tableau defines the method; each non-zero coefficient a_ij or b_i gives one exponential.

Equations (3.18) and (3.19) of Bogfjellmo and Marthinsen define the methods. Proposition 3.5.7 of the same
paper states the six conditions of order 3.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, ClassVar

from orderconds.families.action_family import ActionFamily
from orderconds.families.action_formula import ActionFormula, CrouchGrossmanFormula
from orderconds.families.base import expect, require_nonzero_weights
from orderconds.families.cg import symmetric_crouch_grossman
from orderconds.families.registry import register
from orderconds.ring.protocol import Ring
from orderconds.series.action import ActionSeries, CommutatorFreeSeries, crouch_grossman_rows
from orderconds.tableau.methods import RungeKutta
from orderconds.tableau.products import Method
from orderconds.tableau.record import Tableau
from orderconds.tableau.work import Work, crouch_grossman_work

if TYPE_CHECKING:
    import numpy as np

    from orderconds.ring.protocol import RandomRing


@register
class VariationalCrouchGrossman(ActionFamily):
    """The family ``vcg`` of variational Crouch-Grossman methods. A tableau (A, b) without zero weights
    defines a method.

    >>> [len(VariationalCrouchGrossman().conditions(n)) for n in (1, 2, 3)]
    [1, 1, 6]
    >>> for condition in VariationalCrouchGrossman().conditions(2):
    ...     print(condition.tree, ":", condition)
    o(o) : sum_i b_i c_i = 1/2
    """

    name = "vcg"
    description = (
        "Variational Crouch-Grossman methods on T*G: each non-zero coefficient of a Butcher tableau gives "
        "one exponential."
    )
    formats = ("rk",)
    illustrates = ("action",)
    implies: ClassVar[Mapping[str, str]] = {
        "cg": "if H is linear in p, the positions q are computed by the CG method for a vector field on G",
        "sprk": "on a vector space, which is a Lie group under addition, a VCG method is an SPRK method",
        "vcf": "VCG methods are VCF methods in which each exponential contains the velocity of one stage",
    }
    abelian = "sprk"
    unknowns = "rk"
    equal_abscissae = True
    principal_error_limit = 6

    def series(self, method: Method, ring: Ring) -> ActionSeries:
        """Return the action series of a tableau (A, b)."""
        tableau = expect(method, RungeKutta)
        require_nonzero_weights(self.label(), ring, tableau.b)
        return CommutatorFreeSeries(ring, crouch_grossman_rows(ring, tableau.A, tableau.b))

    def random_series(self, ring: RandomRing, generator: np.random.Generator, order: int) -> ActionSeries:
        """Return the action series of a method with a full matrix A and random coefficients in ``ring``."""
        stages = max(order - 1, 2)
        rows = [[ring.random(generator) for _ in range(stages)] for _ in range(stages + 1)]
        return CommutatorFreeSeries(ring, crouch_grossman_rows(ring, rows[:-1], rows[-1]))

    def formula(self) -> ActionFormula:
        """Return the object that writes the conditions as formulas. The formulas are sums over indices and
        contain the coefficients a, b and c of the method."""
        return CrouchGrossmanFormula()

    def is_symmetric(self, method: Method, ring: Ring) -> bool:
        """Return True if the exponentials of the method form a palindrome. Then the method is symmetric."""
        return symmetric_crouch_grossman(method, ring)

    def work(self, tableau: Tableau) -> Work | None:
        """Return the numbers of field evaluations and exponentials in one step, or None if unknown."""
        return crouch_grossman_work(tableau)
