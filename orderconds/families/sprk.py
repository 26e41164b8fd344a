"""Symplectic partitioned Runge-Kutta methods: bhat = b and ahat_ij = b_j - b_j a_ji/b_i.

Conditions belong to free trees with directed edges, since b_i ahat_ij = b_i b_j - b_j a_ji lets the root move
across an edge at the price of products of conditions of lower order (Abia and Sanz-Serna 1993; HLW VI.7).
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property, lru_cache
from typing import Any

from orderconds.conditions import OrderCondition
from orderconds.families import require_nonzero_weights
from orderconds.families.elementary_weights import conjugate, kept_branches, weight_conditions
from orderconds.families.once import Once
from orderconds.families.relations import RootSwitching
from orderconds.ring.protocol import Element, Ring
from orderconds.series.b_series import ElementaryWeights
from orderconds.trees.directed import (
    DirectedTree,
    directed_free_trees,
    directed_rooted_trees,
    moves,
    text,
)

SWITCHING = RootSwitching(moves, lru_cache(maxsize=None)(directed_free_trees))
"""Every rooted tree's weight by those of free trees."""


class SymplecticPartitionedFamily:
    """Symplectic partitioned Runge-Kutta methods, given by (A, b) with non-zero weights.

    >>> [str(condition) for condition in create().conditions(3)]
    ['sum_i b_i c_i^2 = 1/3', 'sum_i b_i chat_i^2 = 1/3', 'sum_{i,j} b_i a_ij c_j = 1/6']
    """

    name = "sprk"
    trees = "directed"
    formats: tuple[str, ...] = ("rk",)
    search_limit = 8
    needs_nonzero_weights = True

    def label(self) -> str:
        """Return ``sprk``."""
        return self.name

    def conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the independent conditions of this order, one a free tree with directed edges."""
        return weight_conditions(self.name, directed_free_trees(order), text)

    def all_conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the conditions of all rooted trees with directed edges, with their relations."""
        return weight_conditions(self.name, directed_rooted_trees(order), text, switching=SWITCHING)

    def evaluate(self, method: Any, ring: Ring, conditions: Sequence[OrderCondition]) -> tuple[Element, ...]:
        """Return elementary weights; ``method`` has ``A`` and ``b`` over ``ring``, which can divide."""
        weights = self._once(method, ring)
        return tuple(weights(condition.key) for condition in conditions)

    @cached_property
    def _once(self) -> Once[ElementaryWeights[DirectedTree]]:
        return Once(self._weights)

    def _weights(self, method: Any, ring: Ring) -> ElementaryWeights[DirectedTree]:
        require_nonzero_weights(self.label(), ring, method.b)
        matrices = (method.A, conjugate(method.A, method.b))
        return ElementaryWeights[DirectedTree](ring, matrices, method.b, kept_branches)


def create() -> SymplecticPartitionedFamily:
    """Return the family.

    >>> create().label()
    'sprk'
    """
    return SymplecticPartitionedFamily()
