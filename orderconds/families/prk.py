"""Partitioned Runge-Kutta methods: one condition a rooted tree with vertices of two colours (HLW III.2.2).

A single tableau is read as the pair of it with itself.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from orderconds.conditions import OrderCondition
from orderconds.families.elementary_weights import (
    WEIGHTS,
    kept_branches,
    weight,
    weight_condition,
    weight_conditions,
)
from orderconds.formula import Formula
from orderconds.ring.protocol import Element, Ring
from orderconds.series.b_series import ElementaryWeights
from orderconds.trees import bicoloured
from orderconds.trees.bicoloured import BicolouredTree
from orderconds.trees.directed import DirectedTree


class PartitionedFamily:
    """Partitioned Runge-Kutta methods (A, b), (A_hat, b_hat).

    >>> [len(create().conditions(n)) for n in range(1, 6)]
    [2, 4, 14, 52, 214]
    >>> [str(condition) for condition in create().conditions(2)][1:3]
    ['sum_i b_i chat_i = 1/2', 'sum_i bhat_i c_i = 1/2']
    """

    name = "prk"
    trees = "bicoloured"
    formats: tuple[str, ...] = ("prk", "rk")
    search_limit = 7
    needs_nonzero_weights = False

    def label(self) -> str:
        """Return the family's name."""
        return self.name

    def conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the conditions of this order; all are independent (HLW III.2, Theorem 2.5)."""
        trees = tuple(bicoloured.bicoloured_rooted_trees(order))
        return weight_conditions(self.name, trees, bicoloured.text, rooted_weight)

    def all_conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the same conditions."""
        return self.conditions(order)

    def decisive_in_turn(self, order: int) -> Iterator[BicolouredTree]:
        """Yield the trees of this order."""
        return bicoloured.bicoloured_rooted_trees(order)

    def condition(self, tree: BicolouredTree) -> OrderCondition:
        """Return the condition of a tree."""
        return weight_condition(self.name, tree, bicoloured.text, rooted_weight)

    def evaluate(self, method: Any, ring: Ring, conditions: Sequence[OrderCondition]) -> tuple[Element, ...]:
        """Return elementary weights; ``method`` has ``A``, ``b`` and perhaps ``A_hat``, ``b_hat``."""
        return rooted_weights(method, ring, conditions)


def create() -> PartitionedFamily:
    """Return the family of general pairs.

    >>> create().label()
    'prk'
    """
    return PartitionedFamily()


def rooted_weight(tree: BicolouredTree) -> Formula:
    r"""Return a coloured tree's elementary weight as an index sum, the root's colour choosing b or bhat.

    >>> from orderconds.formula import named
    >>> named(rooted_weight(b"\1\2")).text()
    'sum_i bhat_i c_i'
    """
    return weight(bicoloured.coloured(0, tree), WEIGHTS[tree[0]])


def rooted_weights(method: Any, ring: Ring, conditions: Sequence[OrderCondition]) -> tuple[Element, ...]:
    """Return the elementary weights of a pair of tableaux on the coloured trees of ``conditions``.

    >>> from orderconds.ring import QQ
    >>> from orderconds.tableau import Tableau, find
    >>> verlet = Tableau.load(find("stormer_verlet")).method
    >>> [str(x) for x in rooted_weights(verlet, QQ, create().conditions(2))]
    ['1/2', '1/2', '1/2', '1/2']
    """
    matrices = (method.A, getattr(method, "A_hat", method.A))
    pair = [
        ElementaryWeights[DirectedTree](ring, matrices, b, kept_branches)
        for b in (method.b, getattr(method, "b_hat", method.b))
    ]
    return tuple(pair[c.key[0]](bicoloured.coloured(0, c.key)) for c in conditions)
