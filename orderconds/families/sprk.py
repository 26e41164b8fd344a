"""Symplectic partitioned Runge-Kutta methods: bhat = b and ahat_ij = b_j - b_j a_ji/b_i. The tableau (a, b)
is applied to the positions q, and (ahat, bhat) is applied to the momenta p.

If the root of a tree moves along one edge, the relation b_i ahat_ij = b_i b_j - b_j a_ji connects the old and
the new elementary weight. The sum of the two weights is a product of weights of smaller trees. Therefore one
condition for each free tree with directed edges suffices (Abia and Sanz-Serna 1993; HLW VI.7).
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
"""A function that returns the elementary weight of a rooted tree as a polynomial in the elementary weights of
free trees."""


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
        "rk": "for H = p.f(q), the positions q are computed by the Runge-Kutta method for q' = f(q)"
    }
    low_order = "rk"
    bounds_others = True
    unknowns = "rk"

    def conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the independent conditions of the given order, one for each free tree with directed
        edges."""
        return weight_conditions(self.name, directed_free_trees(order), text)

    def all_conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the conditions of the given order, one for each rooted tree with directed edges. Each
        dependent condition stores its relation to the independent conditions."""
        return weight_conditions(self.name, directed_rooted_trees(order), text, switching=SWITCHING)

    def evaluate(
        self, method: Method, ring: Ring, conditions: Sequence[OrderCondition]
    ) -> tuple[Element, ...]:
        """Return the elementary weights of a tableau (A, b), one for each element of ``conditions``. The ring
        needs division, because the formulas divide by b_i.

        Raises :class:`~orderconds.errors.ZeroWeight` if one of the weights b_i is or may be zero.
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
        """Return this family for a tableau (A, b) without zero weights, else None.

        The file of such a tableau should state the order of the method in this family.
        """
        return cls() if has_weights(tableau, nonzero=True) else None

    def is_symmetric(self, method: Method, ring: Ring) -> bool:
        """Return True if the tableau is proved to be symmetric. The conjugate (ahat, b) is then also
        symmetric."""
        return symmetric_tableau(method, ring)

    def order_of_tableau(self, method: Method, ring: Ring, orders: Mapping[str, int]) -> int:
        """Return a lower bound of the order in this family.

        Let p be the order in the family ``rk``. If ahat_ij = a_ij, the bound is p. If Butcher's simplifying
        assumptions B(2m), C(m) and D(m) hold for a_ij, then C(m) and D(m) also hold for ahat_ij. In this case
        the bound is min(p, 2m + 1), by the proof of Butcher's theorem (Jay 1996, for Lobatto pairs).

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
