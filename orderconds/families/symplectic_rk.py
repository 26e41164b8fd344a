"""Symplectic Runge-Kutta methods. The coefficients satisfy b_i a_ij + b_j a_ji = b_i b_j for all i and j.

There is one condition for each free tree (a tree without a root). If an edge divides a free tree into two
equal halves, the condition of the tree follows from conditions of lower order (Sanz-Serna and Abia 1991; HLW
VI.7.1, Theorem 7.3).
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

from orderconds.conditions import OrderCondition
from orderconds.families.base import Family, expect
from orderconds.families.registry import register
from orderconds.families.relations import RootSwitching, with_relations
from orderconds.families.rk import RungeKuttaFamily, tree_conditions
from orderconds.families.sprk_separable import require_symplectic_pair
from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.methods import PartitionedRungeKutta, RungeKutta
from orderconds.tableau.products import Method
from orderconds.trees.free import essential_free_trees, moves
from orderconds.trees.levels import Tree, text
from orderconds.trees.rooted import rooted_trees

SWITCHING = RootSwitching(moves, lru_cache(maxsize=None)(essential_free_trees))
"""A function that expresses the elementary weight of a rooted tree as a polynomial in the elementary weights
of independent trees. The function :func:`orderconds.trees.free.essential_free_trees` returns the independent
trees."""


@register
class SymplecticFamily(Family):
    """Symplectic Runge-Kutta methods.

    >>> [len(SymplecticFamily().conditions(n)) for n in range(1, 8)]
    [1, 0, 1, 1, 3, 4, 11]
    """

    name = "symplectic_rk"
    description = (
        "Symplectic Runge-Kutta methods: b_i a_ij + b_j a_ji = b_i b_j. Each condition corresponds to a "
        "free tree."
    )
    formats = ("rk",)
    trees = "free"
    illustrates = ("free", "essential")
    search_limit = 12
    low_order = "rk"
    unknowns = "rk"
    symplectic = True

    def conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the independent conditions of the given order. A free tree gives no condition if it consists
        of two equal rooted trees and an edge between the two roots. Each other free tree gives one
        condition."""
        return _conditions(essential_free_trees(order))

    def all_conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the conditions of the given order, one for each rooted tree.

        The attribute ``relation`` of a dependent condition expresses the left-hand side as a polynomial in
        left-hand sides of independent conditions.
        """
        return with_relations(_conditions(tuple(rooted_trees(order))), SWITCHING, text)

    def require(self, method: Method, ring: Ring) -> None:
        """Raise :class:`~orderconds.errors.InputError` for a tableau that is not symplectic."""
        tableau = expect(method, RungeKutta)
        pair = PartitionedRungeKutta(tableau.A, tableau.b, tableau.A, tableau.b)
        require_symplectic_pair(self.name, pair, ring)

    def evaluate(
        self, method: Method, ring: Ring, conditions: Sequence[OrderCondition]
    ) -> tuple[Element, ...]:
        """Return the elementary weights of a tableau (A, b), one for each element of ``conditions``."""
        return RungeKuttaFamily().evaluate(method, ring, conditions)


def _conditions(trees: Sequence[Tree]) -> tuple[OrderCondition, ...]:
    return tree_conditions(trees, SymplecticFamily.name)
