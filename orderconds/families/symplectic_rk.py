"""Symplectic Runge-Kutta methods, b_i a_ij + b_j a_ji = b_i b_j: conditions belong to free trees.

Of the free trees those that an edge parts in two equal halves are superfluous (Sanz-Serna and Abia 1991; HLW
VI.7.1, Theorem 7.3).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from types import SimpleNamespace
from typing import Any

from orderconds.conditions import OrderCondition
from orderconds.families import rk
from orderconds.families.relations import RootSwitching, with_relations
from orderconds.families.sprk_separable import require_symplectic_pair
from orderconds.ring.protocol import Element, Ring
from orderconds.trees.free import essential_free_trees, moves
from orderconds.trees.levels import Tree, text
from orderconds.trees.rooted import rooted_trees

SWITCHING = RootSwitching(moves, lru_cache(maxsize=None)(essential_free_trees))
"""Every rooted tree's weight by those of essential free trees."""


class SymplecticFamily:
    """Symplectic Runge-Kutta methods.

    >>> [len(create().conditions(n)) for n in range(1, 8)]
    [1, 0, 1, 1, 3, 4, 11]
    """

    name = "symplectic_rk"
    trees = "free"
    formats: tuple[str, ...] = ("rk",)
    search_limit = 12
    needs_nonzero_weights = False

    def label(self) -> str:
        """Return the family's name."""
        return self.name

    def conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the independent conditions of this order, one a free tree that is not superfluous."""
        return _conditions(essential_free_trees(order))

    def all_conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the conditions of all rooted trees, dependent ones with their relations."""
        return with_relations(_conditions(tuple(rooted_trees(order))), SWITCHING, text)

    def require(self, method: Any, ring: Ring) -> None:
        """Raise :class:`~orderconds.errors.InputError` unless b_i a_ij + b_j a_ji = b_i b_j."""
        pair = SimpleNamespace(A=method.A, b=method.b, A_hat=method.A, b_hat=method.b)
        require_symplectic_pair(self.name, pair, ring)

    def evaluate(self, method: Any, ring: Ring, conditions: Sequence[OrderCondition]) -> tuple[Element, ...]:
        """Return elementary weights; ``method`` has ``A`` and ``b`` over ``ring``."""
        return rk.create().evaluate(method, ring, conditions)


def create() -> SymplecticFamily:
    """Return the family.

    >>> create().label()
    'symplectic_rk'
    """
    return SymplecticFamily()


def _conditions(trees: Sequence[Tree]) -> tuple[OrderCondition, ...]:
    return tuple(replace(c, family="symplectic_rk") for c in rk.tree_conditions(trees))
