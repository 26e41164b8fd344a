"""Symplectic partitioned Runge-Kutta methods: bhat = b and ahat_ij = b_j - b_j a_ji/b_i. The tableau (a, b)
is applied to the positions q, and (ahat, bhat) is applied to the momenta p.

Each order condition belongs to a rooted tree with directed edges. An edge that points away from the root
gives a factor a_ij in the elementary weight. An edge that points towards the root gives a factor ahat_ij.

A free tree is a tree without a root. Choose an edge from a vertex i to a vertex j of a free tree. The choice
of i as the root, and the choice of j as the root, give two rooted trees. The edge gives the factor a_ij for
the root i, and the factor ahat_ji for the root j. Because b_i a_ij + b_j ahat_ji = b_i b_j, the elementary
weights of the two rooted trees add up to a product of elementary weights of smaller trees. Hence one
condition for each free tree is sufficient (Abia and Sanz-Serna 1993; HLW VI.7).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property, lru_cache
from typing import ClassVar, Self

from orderconds.conditions import OrderCondition
from orderconds.families.base import Family, expect, require_nonzero_weights
from orderconds.families.elementary_weights import conjugate, kept_branches, weight_conditions
from orderconds.families.memo import Memo
from orderconds.families.registry import register
from orderconds.families.relations import RootSwitching
from orderconds.families.rk import has_weights, symmetric_tableau
from orderconds.ring.protocol import Element, Ring
from orderconds.series.b_series import ElementaryWeights
from orderconds.tableau.method_properties import symplectic
from orderconds.tableau.methods import RungeKutta
from orderconds.tableau.products import Method
from orderconds.tableau.record import Tableau
from orderconds.tableau.simplifying import highest_assumptions
from orderconds.trees.directed import (
    DirectedTree,
    directed_free_trees,
    directed_rooted_trees,
    moves,
    text,
)

SWITCHING = RootSwitching(moves, lru_cache(maxsize=None)(directed_free_trees))
"""A function that expresses the elementary weight of a rooted tree as a polynomial in the elementary weights
of independent trees. For each free tree, the function ``directed_free_trees`` chooses a root. The resulting
rooted trees are the independent trees."""


@register
class SymplecticPartitionedFamily(Family):
    """Symplectic partitioned Runge-Kutta methods, given by a tableau (A, b) with non-zero weights.

    >>> [str(condition) for condition in SymplecticPartitionedFamily().conditions(3)]
    ['sum_i b_i c_i^2 = 1/3', 'sum_i b_i chat_i^2 = 1/3', 'sum_{i,j} b_i a_ij c_j = 1/6']
    """

    name = "sprk"
    description = "Symplectic partitioned Runge-Kutta methods: bhat = b and ahat_ij = b_j - b_j a_ji/b_i."
    formats = ("rk",)
    symbols: ClassVar[Mapping[str, str]] = {
        **Family.symbols,
        "ahat": r"$\hat{a}_{ij} = b_j - b_j a_{ji}/b_i$ are the tableau coefficients for the momenta",
    }
    trees = "directed"
    illustrates = ("directed",)
    needs_nonzero_weights = True
    over_rationals = True
    implies: ClassVar[Mapping[str, str]] = {
        "rk": "if H = p.f(q), the SPRK method computes q with the Runge-Kutta method (A, b)"
    }
    low_order = "rk"
    bounds_others = True
    unknowns = "rk"

    def conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the independent conditions of the given order, one for each free tree with directed
        edges."""
        return weight_conditions(self.name, directed_free_trees(order), text)

    def all_conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the conditions of the given order, one for each rooted tree with directed edges.

        The attribute ``relation`` of a dependent condition is a polynomial in left-hand sides of independent
        conditions.
        """
        return weight_conditions(self.name, directed_rooted_trees(order), text, switching=SWITCHING)

    def evaluate(
        self, method: Method, ring: Ring, conditions: Sequence[OrderCondition]
    ) -> tuple[Element, ...]:
        """Return the elementary weights of a tableau (A, b), one for each element of ``conditions``. The ring
        must support division.

        Raises :class:`~orderconds.errors.ZeroWeight` if a weight b_i is zero, or is an interval that contains
        zero.
        """
        weights = self._memo(method, ring)
        return tuple(weights(condition.key) for condition in conditions)

    @cached_property
    def _memo(self) -> Memo[ElementaryWeights[DirectedTree]]:
        return Memo(self._weights)

    def _weights(self, method: Method, ring: Ring) -> ElementaryWeights[DirectedTree]:
        A, b = expect(method, RungeKutta).A, expect(method, RungeKutta).b
        require_nonzero_weights(self.label(), ring, b)
        return ElementaryWeights[DirectedTree](ring, (A, conjugate(A, b)), b, kept_branches)

    @classmethod
    def claimable(cls, tableau: Tableau) -> Self | None:
        """Return this family for a Runge-Kutta tableau if all weights b_i are proved to be non-zero, and for
        a composition if all coefficients gamma_i are proved to be non-zero. Otherwise return None."""
        return cls() if has_weights(tableau, nonzero=True) else None

    def is_symmetric(self, method: Method, ring: Ring) -> bool:
        """Return True if the tableau (a, b) is proved to be symmetric."""
        return symmetric_tableau(method, ring)

    def order_of_tableau(self, method: Method, ring: Ring, orders: Mapping[str, int]) -> int:
        """Return a lower bound of the order of ``method`` in this family.

        ``orders["rk"]`` is the order p of the method in the family ``rk``. For a symplectic tableau, the
        bound is p.

        For all other tableaux, the bound is min(p, 2m + 1). Here m is the largest integer such that 2m <= p
        and (a, b) satisfies Butcher's simplifying assumptions C(m) and D(m). The tableau (ahat, bhat) for the
        momenta then also satisfies C(m) and D(m). By a theorem of Butcher, a tableau that satisfies B(p),
        C(m) and D(m) has at least the order min(p, 2m + 1). The theorem also holds for a pair of tableaux
        with the same weights. For Lobatto pairs, Jay (1996) proves the bound.

        >>> from orderconds.tableau.collocation import construct
        >>> radau = construct("radau2a", 3)
        >>> SymplecticPartitionedFamily().order_of_tableau(radau.method, radau.ring, {"rk": 5})
        5
        """
        p = orders.get("rk", 0)
        if not isinstance(method, RungeKutta) or not p:
            return 0
        if symplectic(method, ring) is True:
            return p
        return min(p, 2 * highest_assumptions(method, ring, p) + 1)
