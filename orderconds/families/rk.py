"""Runge-Kutta methods: one condition a rooted tree, its elementary weight = 1/gamma (HLW III.1, Thm 1.5)."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import cached_property, lru_cache, partial
from typing import Any

from orderconds.conditions import OrderCondition
from orderconds.families.elementary_weights import elementary_weight
from orderconds.families.once import Once
from orderconds.formula import Formula
from orderconds.ring.protocol import Element, Ring
from orderconds.series.b_series import ElementaryWeights, runge_kutta_series
from orderconds.trees.levels import Tree, children, density, text
from orderconds.trees.rooted import rooted_trees


class RungeKuttaFamily:
    """Runge-Kutta methods for ordinary differential equations.

    >>> [str(condition) for condition in create().conditions(3)]
    ['sum_{i,j} b_i a_ij c_j = 1/6', 'sum_i b_i c_i^2 = 1/3']
    """

    name = "rk"
    trees = "rooted"
    formats: tuple[str, ...] = ("rk",)
    needs_nonzero_weights = False
    search_limit = 12

    def label(self) -> str:
        """Return ``rk``."""
        return self.name

    def conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the conditions of this order, one a rooted tree; they are independent (HLW III.1, Ex. 5)."""
        return _conditions(order)

    def all_conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the same conditions."""
        return _conditions(order)

    @cached_property
    def _once(self) -> Once[ElementaryWeights[Tree]]:
        return Once(lambda method, ring: runge_kutta_series(ring, method.A, method.b))

    def evaluate(self, method: Any, ring: Ring, conditions: Sequence[OrderCondition]) -> tuple[Element, ...]:
        """Return elementary weights; ``method`` has ``A`` and ``b`` over ``ring``."""
        weights = self._once(method, ring)
        return tuple(weights(condition.key) for condition in conditions)


def create() -> RungeKuttaFamily:
    """Return the family.

    >>> create().label()
    'rk'
    """
    return RungeKuttaFamily()


@lru_cache(maxsize=32)
def _conditions(order: int) -> tuple[OrderCondition, ...]:
    return tree_conditions(tuple(rooted_trees(order)))


def tree_conditions(trees: Sequence[Tree]) -> tuple[OrderCondition, ...]:
    r"""Return the conditions of some trees, weight = 1/gamma (HLW III.1, Theorem 1.5).

    >>> print(*tree_conditions([b"\0\1\1"]))
    sum_i b_i c_i^2 = 1/3
    """
    return tuple(
        OrderCondition("rk", len(tree), text(tree), partial(_weight, tree), Fraction(1, density(tree)), tree)
        for tree in trees
    )


def _weight(tree: Tree) -> Formula:
    return elementary_weight(tree, _branches, "b")


@lru_cache(maxsize=1 << 16)
def _branches(tree: Tree) -> tuple[tuple[int, Tree], ...]:
    return tuple((0, child) for child in children(tree))
