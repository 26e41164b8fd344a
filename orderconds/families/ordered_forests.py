"""Families with one condition for each Lyndon word over ordered trees.

The Lie-Butcher series of a Lie group method has one coefficient for each word. The coefficients satisfy the
shuffle relations, so the coefficients of Lyndon words determine all other coefficients
(:mod:`orderconds.words.lyndon`). The letters are ordered trees, and larger trees come first.

Both sides of a condition are multiplied by the integer :func:`scale`, which removes denominators. For
example, the condition ``sum_i b_i c_i^2/2 = 1/6`` becomes ``sum_i b_i c_i^2 = 1/3``.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from functools import cached_property, lru_cache, partial
from math import factorial, prod

from orderconds.conditions import OrderCondition
from orderconds.families.base import Family
from orderconds.families.memo import Memo
from orderconds.families.relations import in_lyndon_words, with_relations
from orderconds.formula import Formula
from orderconds.ring.protocol import Element, Ring
from orderconds.series.lie_butcher import ForestSeries, exact_value
from orderconds.tableau.products import Method
from orderconds.trees.levels import Forest, branches, text, trees_of
from orderconds.trees.ordered import ordered_forests, ordered_trees
from orderconds.words.lyndon import lyndon_words


class OrderedForestFamily(Family):
    """A family of methods whose steps have Lie-Butcher series."""

    trees = "forests"
    search_limit = 7
    abelian = "rk"
    low_order = "rk"
    on_groups = True
    fixed_stages = True

    @abstractmethod
    def series(self, method: Method, ring: Ring) -> ForestSeries:
        """Return the Lie-Butcher series of one step of ``method``. The series maps an ordered forest to an
        element of ``ring``."""

    @abstractmethod
    def formula(self, forest: Forest) -> Formula:
        """Return an index sum: the left-hand side of the condition of a forest.

        The left-hand side is ``scale(forest)`` times the coefficient of the forest in the Lie-Butcher series.
        """

    def conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the conditions of the given order, one for each Lyndon word over ordered trees."""
        return self._of(lyndon_forests(order))

    def all_conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the conditions of the given order, one for each ordered forest. In each dependent condition,
        the attribute ``relation`` is set (:mod:`orderconds.families.relations`)."""
        return with_relations(
            self._of(tuple(ordered_forests(order))), lambda forest: in_lyndon_words(forest, scale), text
        )

    @cached_property
    def _memo(self) -> Memo[ForestSeries]:
        return Memo(self.series)

    def evaluate(
        self, method: Method, ring: Ring, conditions: Sequence[OrderCondition]
    ) -> tuple[Element, ...]:
        """Return the left-hand sides of ``conditions`` for ``method``. Each left-hand side is a coefficient
        of the Lie-Butcher series times the factor :func:`scale`."""
        series = self._memo(method, ring)
        return tuple(series(condition.key) * scale(condition.key) for condition in conditions)

    def _of(self, forests: Sequence[Forest]) -> tuple[OrderCondition, ...]:
        return tuple(
            OrderCondition(
                self.label(),
                len(forest),
                text(forest),
                partial(self.formula, forest),
                exact_value(forest) * scale(forest),
                forest,
            )
            for forest in forests
        )


@lru_cache(maxsize=1 << 16)
def scale(forest: Forest) -> int:
    r"""Return k! times the product of n! over all vertices. Here k is the number of trees in the forest, and
    n is the number of branches at the vertex.

    >>> scale(b"\0\1\1\0")
    4
    """
    below = trees_of(forest)
    return factorial(len(below)) * prod(scale(branches(tree)) for tree in below if len(tree) > 1)


@lru_cache(maxsize=32)
def lyndon_forests(order: int) -> tuple[Forest, ...]:
    """Return the Lyndon words over ordered trees, as forests. Each forest has ``order`` vertices in total.

    >>> [text(forest) for forest in lyndon_forests(3)]
    ['[[.]]', '[..]', '[.] .']
    """
    letters = [tree for vertices in range(order, 0, -1) for tree in ordered_trees(vertices)]
    return tuple(b"".join(word) for word in lyndon_words(letters, order, weigh=len))


def longest_word(forest: Forest) -> int:
    r"""Return the length of the longest word in a forest. The forest itself is a word, and the branches at
    each vertex form a word.

    >>> longest_word(b"\0\1\1\1\0")
    3
    """
    below = trees_of(forest)
    return max(len(below), *(longest_word(branches(tree)) for tree in below if len(tree) > 1), 0)
