"""Elementary weights of Runge-Kutta and partitioned Runge-Kutta methods: B-series over any ring (HLW III.1).

Each subtree has one vector over the stages, computed once: the product over its branches of
``sum_j a_ij tau_branch(j)``. Where nodes are the roots of one rational polynomial the vectors are polynomials
(:mod:`orderconds.series.nodal`).
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from functools import lru_cache
from typing import Any, Generic, TypeVar

from orderconds.ring.protocol import Element, Ring
from orderconds.series.nodal import Matrix, NodalAlgebra, nodal_algebra
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
        self._branches = branches
        self._stages: Any = nodal_algebra(ring, matrices, b) or StageVectors(ring, matrices, b)
        self._ring = ring
        self._rational = isinstance(self._stages, NodalAlgebra)
        self._vectors: dict[TreeT, Any] = {}
        self._sums: dict[tuple[int, TreeT], Any] = {}

    def __call__(self, tree: TreeT) -> Element:
        """Return the elementary weight of a tree."""
        found = self._stages.weigh(self._vector(tree))
        return self._ring.rational(found.p, found.q) if self._rational else found

    def _vector(self, tree: TreeT) -> Any:
        """Return tau_tree(i) for each stage i."""
        if tree not in self._vectors:
            vector = self._stages.one
            for branch in self._branches(tree):
                vector = self._stages.multiply(vector, self._summed(branch))
            self._vectors[tree] = vector
        return self._vectors[tree]

    def _summed(self, branch: tuple[int, TreeT]) -> Any:
        if branch not in self._sums:
            kind, tree = branch
            self._sums[branch] = self._stages.apply(kind, self._vector(tree))
        return self._sums[branch]


class StageVectors:
    """Vectors over the stages, one ring element each.

    >>> from orderconds.ring import QQ
    >>> half = QQ.rational(1, 2)
    >>> stages = StageVectors(QQ, ([[half]],), [QQ.one])
    >>> stages.weigh(stages.apply(0, stages.one))
    1/2
    """

    def __init__(self, ring: Ring, matrices: Sequence[Matrix], b: Sequence[Element]) -> None:
        self._zero = ring.zero
        self._matrices = [[sparse(ring, row) for row in matrix] for matrix in matrices]
        self._b = sparse(ring, b)
        self.one = (ring.one,) * len(b)

    def multiply(self, x: Sequence[Element], y: Sequence[Element]) -> tuple[Element, ...]:
        """Return the componentwise product."""
        return tuple(p * q for p, q in zip(x, y, strict=True)) if x is not self.one else tuple(y)

    def apply(self, kind: int, x: Sequence[Element]) -> tuple[Element, ...]:
        """Return A x, A the matrix of that number."""
        return tuple(self._dot(row, x) for row in self._matrices[kind])

    def weigh(self, x: Sequence[Element]) -> Element:
        """Return b.x."""
        return self._dot(self._b, x)

    def _dot(self, row: Sequence[tuple[int, Element]], x: Sequence[Element]) -> Element:
        return sum((weight * x[j] for j, weight in row), self._zero)


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
