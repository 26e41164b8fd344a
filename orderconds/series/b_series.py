"""Elementary weights of Runge-Kutta and partitioned Runge-Kutta methods: B-series over any ring (HLW III.1).

Each subtree has one vector over the stages, computed once: the product over its branches of
``sum_j a_ij tau_branch(j)``.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from functools import lru_cache
from typing import Generic, TypeVar

from orderconds.ring.protocol import Element, Ring
from orderconds.trees.levels import Tree, children

TreeT = TypeVar("TreeT", bound=Hashable)


class ElementaryWeights(Generic[TreeT]):
    """The numbers ``sum_i b_i tau_t(i)`` of a method, for trees of any encoding.

    ``matrices`` are s x s coefficient matrices, one for each kind of edge, over ``ring``; ``branches``
    gives the branches of a tree, each the kind of its edge and the subtree.

    >>> from orderconds.ring import QQ
    >>> from orderconds.trees.directed import branches
    >>> half = QQ.rational(1, 2)
    >>> pair = ElementaryWeights(QQ, ([[half]], [[QQ.zero]]), [QQ.one], branches)
    >>> str(pair(bytes((0, 2)))), str(pair(bytes((0, 3))))
    ('1/2', '0')
    """

    def __init__(
        self,
        ring: Ring,
        matrices: Sequence[Sequence[Sequence[Element]]],
        b: Sequence[Element],
        branches: Callable[[TreeT], Sequence[tuple[int, TreeT]]],
    ) -> None:
        self._ring, self._branches = ring, branches
        self._matrices = [[sparse(ring, row) for row in matrix] for matrix in matrices]
        self._b = sparse(ring, b)
        self._stages = len(b)
        self._vectors: dict[TreeT, tuple[Element, ...]] = {}
        self._sums: dict[tuple[int, TreeT], tuple[Element, ...]] = {}

    def __call__(self, tree: TreeT) -> Element:
        """Return the elementary weight of a tree."""
        return self._dot(self._b, self.stages(tree))

    def stages(self, tree: TreeT) -> tuple[Element, ...]:
        """Return tau_tree(i) for each stage i."""
        if tree not in self._vectors:
            vector = [self._ring.one] * self._stages
            for branch in self._branches(tree):
                vector = [x * y for x, y in zip(vector, self._summed(branch), strict=True)]
            self._vectors[tree] = tuple(vector)
        return self._vectors[tree]

    def _summed(self, branch: tuple[int, TreeT]) -> tuple[Element, ...]:
        if branch not in self._sums:
            kind, tree = branch
            vector = self.stages(tree)
            self._sums[branch] = tuple(self._dot(row, vector) for row in self._matrices[kind])
        return self._sums[branch]

    def _dot(self, row: Sequence[tuple[int, Element]], vector: Sequence[Element]) -> Element:
        return sum((weight * vector[j] for j, weight in row), self._ring.zero)


def runge_kutta_series(
    ring: Ring, A: Sequence[Sequence[Element]], b: Sequence[Element]
) -> ElementaryWeights[Tree]:
    r"""Return the elementary weights of a tableau on canonical rooted trees (HLW III.1, (1.18)).

    >>> from orderconds.ring import QQ
    >>> half = QQ.rational(1, 2)
    >>> str(runge_kutta_series(QQ, [[half]], [QQ.one])(b"\0\1\1"))
    '1/4'
    """
    return ElementaryWeights[Tree](ring, (A,), b, _uncoloured_branches)


@lru_cache(maxsize=1 << 16)
def _uncoloured_branches(tree: Tree) -> tuple[tuple[int, Tree], ...]:
    return tuple((0, child) for child in children(tree))


def sparse(ring: Ring, row: Sequence[Element]) -> tuple[tuple[int, Element], ...]:
    """Return the entries of a row that are not known to be zero, each with its place.

    >>> from orderconds.ring import QQ
    >>> [(place, str(x)) for place, x in sparse(QQ, [QQ.zero, QQ.one])]
    [(1, '1')]
    """
    return tuple((place, entry) for place, entry in enumerate(row) if ring.is_zero(entry) is not True)
