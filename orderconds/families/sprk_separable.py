"""Symplectic partitioned Runge-Kutta methods for separable Hamiltonians H = T(p) + V(q).

The tableaux (a, b) and (ahat, bhat) form a symplectic pair if b_i ahat_ij + bhat_j a_ji = b_i bhat_j for all
i and j.

There is one condition for each rooted tree whose vertices have two colours, one for p and one for q.
Neighbouring vertices differ in colour, because H is separable. If two trees differ only in the choice of the
root, and if all conditions of lower order hold, the conditions of the two trees are equivalent. Hence one
condition for each free tree (a tree without a root) is sufficient (Abia and Sanz-Serna 1993; HLW VI.7.2).
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Self

from orderconds.conditions import OrderCondition
from orderconds.errors import InputError
from orderconds.families.base import Family, expect, require_nonzero_weights
from orderconds.families.elementary_weights import conjugate, weight_conditions
from orderconds.families.prk import rooted_weight, rooted_weights
from orderconds.families.registry import register
from orderconds.families.relations import RootSwitching
from orderconds.families.rk import symmetric_tableau
from orderconds.families.stage_form import StageForm, tableau_form
from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.method_properties import symplectic_pair
from orderconds.tableau.methods import PartitionedRungeKutta, RungeKutta
from orderconds.tableau.products import Method
from orderconds.tableau.record import Tableau
from orderconds.trees.bicoloured import alternating, alternating_free_trees, moves, text
from orderconds.trees.rooted import rooted_trees

SWITCHING = RootSwitching(moves, lru_cache(maxsize=None)(alternating_free_trees))
"""A function that expresses the elementary weight of a rooted tree as a polynomial in the elementary weights
of independent trees. For each free tree, the function ``alternating_free_trees`` chooses a root. The
resulting rooted trees are the independent trees."""


@register
class SeparableFamily(Family):
    """The family of symplectic pairs of tableaux (A, b) and (A_hat, b_hat). If only one tableau (A, b) is
    given, the second tableau is its symplectic conjugate, with b_hat = b.

    >>> [len(SeparableFamily().conditions(n)) for n in range(1, 9)]
    [2, 1, 2, 3, 6, 10, 22, 42]
    >>> [str(condition) for condition in SeparableFamily().conditions(3)]
    ['sum_i b_i chat_i^2 = 1/3', 'sum_i bhat_i c_i^2 = 1/3']
    """

    name = "sprk_separable"
    description = "Symplectic partitioned Runge-Kutta methods for separable Hamiltonians H = T(p) + V(q)."
    formats = ("rk", "prk")
    trees = "alternating"
    illustrates = ("alternating",)
    search_limit = 10

    def conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the independent conditions of the given order, one for each free tree with alternating
        colours."""
        return weight_conditions(self.name, alternating_free_trees(order), text, rooted_weight)

    def all_conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the conditions of the given order, one for each rooted tree with alternating colours.

        The attribute ``relation`` of a dependent condition is a polynomial in left-hand sides of independent
        conditions.
        """
        trees = [alternating(colour, tree) for colour in (0, 1) for tree in rooted_trees(order)]
        return weight_conditions(self.name, trees, text, rooted_weight, SWITCHING)

    def require(self, method: Method, ring: Ring) -> None:
        """Raise :class:`~orderconds.errors.InputError` for a pair of tableaux that is not symplectic."""
        if isinstance(method, PartitionedRungeKutta):
            require_symplectic_pair(self.name, method, ring)

    def evaluate(
        self, method: Method, ring: Ring, conditions: Sequence[OrderCondition]
    ) -> tuple[Element, ...]:
        """Return the elementary weights of a pair of tableaux, or of a single tableau (A, b) and its
        symplectic conjugate.

        Raises :class:`~orderconds.errors.ZeroWeight` for a single tableau with a weight b_i = 0, because the
        coefficients of the conjugate are quotients with the denominators b_i.
        """
        if isinstance(method, PartitionedRungeKutta):
            return rooted_weights(method, ring, conditions)
        A, b = expect(method, RungeKutta).A, expect(method, RungeKutta).b
        require_nonzero_weights(self.name, ring, b)
        A_hat = tuple(map(tuple, conjugate(A, b)))
        return rooted_weights(PartitionedRungeKutta(A, b, A_hat, b), ring, conditions)

    @classmethod
    def claimable(cls, tableau: Tableau) -> Self | None:
        """Return this family if ``tableau`` is a pair that is proved to be symplectic. Otherwise return
        None."""
        method = tableau.method
        pair = isinstance(method, PartitionedRungeKutta) and symplectic_pair(method, tableau.ring)
        return cls() if pair else None

    def is_symmetric(self, method: Method, ring: Ring) -> bool:
        """Return True if ``method`` is a pair and both tableaux are proved to be symmetric."""
        return isinstance(method, PartitionedRungeKutta) and symmetric_tableau(method, ring)

    def in_stages(self, stages: int, *, explicit: bool = False) -> StageForm:
        """Return the unknown coefficients of a tableau (A, b) with ``stages`` stages."""
        return tableau_form(stages, explicit, divides=True)


def require_symplectic_pair(label: str, method: PartitionedRungeKutta, ring: Ring) -> None:
    """Raise :class:`~orderconds.errors.InputError` unless b_i ahat_ij + bhat_j a_ji = b_i bhat_j for all i
    and j.

    If the coefficients are intervals, the error is raised only if one of the equations is proved to be false.

    >>> from orderconds.ring import QQ
    >>> from orderconds.tableau import Tableau, find
    >>> require_symplectic_pair("prk", Tableau.load(find("ruth3_pair")).method, QQ)
    """
    for i, row in enumerate(method.A_hat):
        for j, x in enumerate(row):
            defect = method.b[i] * x + method.b_hat[j] * method.A[j][i] - method.b[i] * method.b_hat[j]
            if ring.is_zero(defect) is False:
                raise InputError(
                    f"b_{i + 1} ahat_{i + 1}{j + 1} + bhat_{j + 1} a_{j + 1}{i + 1} differs from "
                    f"b_{i + 1} bhat_{j + 1} by {ring.approximate(defect, 6)}",
                    where=f"family {label}",
                    expected="a symplectic method",
                    hint="use the family 'rk' or 'prk'",
                )
