"""Symplectic partitioned Runge-Kutta methods: bhat = b and ahat_ij = b_j - b_j a_ji/b_i.

Conditions belong to free trees with directed edges, since b_i ahat_ij = b_i b_j - b_j a_ji lets the root move
across an edge at the price of products of conditions of lower order (Abia and Sanz-Serna 1993; HLW VI.7).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache, partial
from typing import Any

from orderconds.conditions import OrderCondition
from orderconds.families import require_nonzero_weights
from orderconds.formula import Formula, coefficient, fresh, index_sum, product
from orderconds.ring.protocol import Element, Ring
from orderconds.series.b_series import ElementaryWeights
from orderconds.trees.directed import (
    DirectedTree,
    branches,
    density,
    directed_free_trees,
    directed_rooted_trees,
    text,
)

ROW_SUMS = ("c", "chat")
MATRICES = ("a", "ahat")


class SymplecticPartitionedFamily:
    """Symplectic partitioned Runge-Kutta methods, given by (A, b) with non-zero weights.

    >>> [str(condition) for condition in create().conditions(3)]
    ['sum_i b_i c_i^2 = 1/3', 'sum_i b_i chat_i^2 = 1/3', 'sum_{i,j} b_i a_ij c_j = 1/6']
    """

    name = "sprk"
    formats: tuple[str, ...] = ("rk",)
    search_limit = 8
    needs_nonzero_weights = True

    def label(self) -> str:
        """Return ``sprk``."""
        return self.name

    def conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the independent conditions of this order, one a free tree with directed edges."""
        return _conditions(directed_free_trees(order))

    def all_conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the conditions of all rooted trees with directed edges."""
        return _conditions(directed_rooted_trees(order))

    def evaluate(self, method: Any, ring: Ring, conditions: Sequence[OrderCondition]) -> tuple[Element, ...]:
        """Return elementary weights; ``method`` has ``A`` and ``b`` over ``ring``, which can divide."""
        require_nonzero_weights(self.label(), ring, method.b)
        matrices = (method.A, conjugate(method.A, method.b))
        weights = ElementaryWeights[DirectedTree](ring, matrices, method.b, _branches)
        return tuple(weights(condition.key) for condition in conditions)


def create() -> SymplecticPartitionedFamily:
    """Return the family."""
    return SymplecticPartitionedFamily()


def conjugate(A: Sequence[Sequence[Element]], b: Sequence[Element]) -> list[list[Element]]:
    """Return ahat_ij = b_j - b_j a_ji/b_i, the matrix that makes (A, ahat, b, b) symplectic."""
    stages = range(len(b))
    return [[b[j] - b[j] * A[j][i] / b[i] for j in stages] for i in stages]


_branches = lru_cache(maxsize=1 << 16)(branches)


def _conditions(trees: Sequence[DirectedTree]) -> tuple[OrderCondition, ...]:
    return tuple(
        OrderCondition(
            "sprk", len(tree), text(tree), partial(_weight, tree), Fraction(1, density(tree)), tree
        )
        for tree in trees
    )


def _weight(tree: DirectedTree) -> Formula:
    i = fresh()
    return index_sum((i,), (), product(coefficient("b", i), _stage(tree, i)))


def _stage(tree: DirectedTree, i: str) -> Formula:
    # Leaves first, as people write: b_i c_i a_ij c_j.
    return product(*(_branch(*branch, i) for branch in sorted(branches(tree), key=lambda x: len(x[1]) > 1)))


def _branch(kind: int, child: DirectedTree, i: str) -> Formula:
    if len(child) == 1:
        return coefficient(ROW_SUMS[kind], i)
    j = fresh()
    return index_sum((j,), (), product(coefficient(MATRICES[kind], i, j), _stage(child, j)))
