"""Partitioned Runge-Kutta methods with b = bhat: the colour of the root does not matter (HLW III.2.2)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from orderconds.conditions import OrderCondition
from orderconds.errors import InputError
from orderconds.families.elementary_weights import kept_branches, weight_condition, weight_conditions
from orderconds.families.prk import PartitionedFamily
from orderconds.ring.protocol import Element, Ring
from orderconds.series.b_series import ElementaryWeights
from orderconds.trees import directed
from orderconds.trees.directed import DirectedTree


class SameWeightsFamily(PartitionedFamily):
    """Partitioned Runge-Kutta methods with b = bhat.

    >>> [len(create().conditions(n)) for n in range(1, 6)]
    [1, 2, 7, 26, 107]
    """

    name = "prk_same_weights"
    trees = "directed-rooted"

    def conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the conditions of this order, one a rooted tree with edges of two kinds."""
        return weight_conditions(self.name, directed.directed_rooted_trees(order), directed.text)

    def decisive_in_turn(self, order: int) -> Iterator[DirectedTree]:
        """Yield the trees of this order."""
        return directed.directed_rooted_trees_in_turn(order)

    def condition(self, tree: DirectedTree) -> OrderCondition:
        """Return the condition of a tree."""
        return weight_condition(self.name, tree, directed.text)

    def require(self, method: Any, ring: Ring) -> None:
        """Raise :class:`~orderconds.errors.InputError` unless b = bhat."""
        for i, (x, y) in enumerate(zip(method.b, getattr(method, "b_hat", method.b), strict=True), 1):
            if x is not y and ring.is_zero(x - y) is not True:
                raise InputError(
                    f"b_{i} = {ring.text(x)} and b_hat_{i} = {ring.text(y)}",
                    where=f"family {self.name}",
                    expected="the same weights in both parts",
                    hint="choose family prk",
                )

    def evaluate(self, method: Any, ring: Ring, conditions: Sequence[OrderCondition]) -> tuple[Element, ...]:
        """Return elementary weights; ``method`` has ``A``, ``b`` and perhaps ``A_hat``."""
        matrices = (method.A, getattr(method, "A_hat", method.A))
        weights = ElementaryWeights[DirectedTree](ring, matrices, method.b, kept_branches)
        return tuple(weights(condition.key) for condition in conditions)


def create() -> SameWeightsFamily:
    """Return the family.

    >>> create().label()
    'prk_same_weights'
    """
    return SameWeightsFamily()
