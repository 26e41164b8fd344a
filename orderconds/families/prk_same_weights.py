"""Partitioned Runge-Kutta methods with equal weights, b = bhat. The condition of a tree does not depend on
the colour of the root (HLW III.2.2)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import ClassVar, Self

from orderconds.conditions import OrderCondition
from orderconds.errors import InputError
from orderconds.families.elementary_weights import kept_branches, weight_condition, weight_conditions
from orderconds.families.prk import PartitionedFamily, as_pair
from orderconds.families.registry import register
from orderconds.ring.protocol import Element, Ring
from orderconds.series.b_series import ElementaryWeights
from orderconds.tableau.products import Method
from orderconds.tableau.record import Tableau
from orderconds.trees import directed
from orderconds.trees.directed import DirectedTree


@register
class SameWeightsFamily(PartitionedFamily):
    """Partitioned Runge-Kutta methods with equal weights, b = bhat.

    The example counts the conditions of orders 1 to 5.

    >>> [len(SameWeightsFamily().conditions(n)) for n in range(1, 6)]
    [1, 2, 7, 26, 107]
    """

    name = "prk_same_weights"
    description = (
        "Partitioned Runge-Kutta methods with b = bhat: the condition of a tree does not depend on the "
        "colour of the root (HLW III.2.2)."
    )
    trees = "directed-rooted"
    illustrates = ("directed-rooted",)
    implies: ClassVar[Mapping[str, str]] = {}

    def conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the conditions of the given order, one for each rooted tree with two kinds of edges. In the
        elementary weight, the two kinds of edges give the factors a_ij and ahat_ij."""
        return weight_conditions(self.name, directed.directed_rooted_trees(order), directed.text)

    def decisive_in_turn(self, order: int) -> Iterator[tuple[DirectedTree, Callable[[], OrderCondition]]]:
        """Yield a pair (tree, function) for each tree with ``order`` vertices. The function returns the
        condition of the tree."""
        for tree in directed.directed_rooted_trees_in_turn(order):
            yield tree, partial(weight_condition, self.name, tree, directed.text)

    @classmethod
    def claimable(cls, tableau: Tableau) -> Self | None:
        """Return None, because no tableau file should claim an order in this family. A claim in the family
        ``prk`` is sufficient, because a method has the same order in both families."""
        return None

    def require(self, method: Method, ring: Ring) -> None:
        """Raise :class:`~orderconds.errors.InputError` if the weights b and bhat differ, or if it is
        undecided whether b and bhat are equal."""
        pair = as_pair(method)
        for i, (x, y) in enumerate(zip(pair.b, pair.b_hat, strict=True), 1):
            if x is not y and ring.is_zero(x - y) is not True:
                raise InputError(
                    f"b_{i} = {ring.text(x)} and b_hat_{i} = {ring.text(y)}",
                    where=f"family {self.name}",
                    expected="the same weights in both tableaux",
                    hint="use the family 'prk'",
                )

    def evaluate(
        self, method: Method, ring: Ring, conditions: Sequence[OrderCondition]
    ) -> tuple[Element, ...]:
        """Return the elementary weights of a pair of tableaux, one for each element of ``conditions``."""
        pair = as_pair(method)
        weights = ElementaryWeights[DirectedTree](ring, (pair.A, pair.A_hat), pair.b, kept_branches)
        return tuple(weights(condition.key) for condition in conditions)
