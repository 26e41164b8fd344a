"""What the families on rooted trees share: elementary weights as index sums, and conditions made of them.

A tree with directed edges or coloured vertices has edges of two kinds, which stand for a_ij and ahat_ij.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import lru_cache, partial

from orderconds.conditions import OrderCondition
from orderconds.families.relations import RootSwitching, with_relations
from orderconds.formula import Formula, coefficient, fresh, index_sum, product
from orderconds.ring.protocol import Element
from orderconds.trees.directed import DirectedTree, branches, density

ROW_SUMS = ("c", "chat")
MATRICES = ("a", "ahat")
WEIGHTS = ("b", "bhat")

kept_branches = lru_cache(maxsize=1 << 16)(branches)
"""The branches of a tree, remembered."""


def conjugate(A: Sequence[Sequence[Element]], b: Sequence[Element]) -> list[list[Element]]:
    """Return ahat_ij = b_j - b_j a_ji/b_i, the matrix that makes (A, ahat, b, b) symplectic (HLW VI.4)."""
    stages = range(len(b))
    return [[b[j] - b[j] * A[j][i] / b[i] for j in stages] for i in stages]


def weight(tree: DirectedTree, weights: str = "b") -> Formula:
    r"""Return sum_i b_i tau_tree(i) as an index sum; ``weights`` names the weights at the root.

    >>> from orderconds.formula import named
    >>> named(weight(b"\0\2\3")).text()
    'sum_i b_i c_i chat_i'
    """
    i = fresh()
    return index_sum((i,), (), product(coefficient(weights, i), _stage(tree, i)))


def weight_conditions(
    family: str,
    trees: Sequence[DirectedTree],
    text: Callable[[DirectedTree], str],
    formula: Callable[[DirectedTree], Formula] = weight,
    switching: RootSwitching | None = None,
) -> tuple[OrderCondition, ...]:
    """Return the condition ``weight = 1/gamma`` of each tree, with its relation where the root may move."""
    found = [
        OrderCondition(
            family, len(tree), text(tree), partial(formula, tree), Fraction(1, density(tree)), tree
        )
        for tree in trees
    ]
    return tuple(found) if switching is None else with_relations(found, switching, text)


def _stage(tree: DirectedTree, i: str) -> Formula:
    # Leaves first, as people write: b_i c_i a_ij c_j.
    return product(*(_branch(*branch, i) for branch in sorted(branches(tree), key=lambda x: len(x[1]) > 1)))


def _branch(kind: int, child: DirectedTree, i: str) -> Formula:
    if len(child) == 1:
        return coefficient(ROW_SUMS[kind], i)
    j = fresh()
    return index_sum((j,), (), product(coefficient(MATRICES[kind], i, j), _stage(child, j)))
