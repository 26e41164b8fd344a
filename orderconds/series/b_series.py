"""Elementary weights of Runge-Kutta and partitioned Runge-Kutta methods: B-series over any ring (HLW III.1).

Each subtree t has a vector tau_t over the stages: tau_t(i) is the product of ``sum_j a_ij tau_u(j)`` over the
branches u of t. HLW denotes Hairer, Lubich and Wanner, *Geometric Numerical Integration*.

For some methods with irrational coefficients, a polynomial p with rational coefficients represents the vector
tau_t: p(c_i) = tau_t(i) for each stage i with the abscissa c_i (:mod:`orderconds.ring.nodal`).
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from functools import lru_cache
from typing import Generic, Protocol, TypeVar

from orderconds.ring.nodal import Matrix, NodalAlgebra, nodal_algebra
from orderconds.ring.protocol import Element, Ring
from orderconds.trees.levels import Tree, children

TreeT = TypeVar("TreeT", bound=Hashable)


class StageAlgebra(Protocol):
    """The operations on vectors with one entry for each stage. Each implementation of this protocol chooses
    the representation of vectors."""

    one: Element
    """The vector whose entries are all one."""

    def multiply(self, x: Element, y: Element) -> Element:
        """Return the componentwise product of two vectors."""

    def apply(self, kind: int, x: Element) -> Element:
        """Return A x, where A is the matrix with index ``kind``."""

    def weigh(self, x: Element) -> Element:
        """Return the sum of b_i x_i over all stages i, where b_i are the weights of the method."""


class ElementaryWeights(Generic[TreeT]):
    """The elementary weights ``sum_i b_i tau_t(i)`` of a method, for trees t in an arbitrary encoding.

    The function ``branches`` returns the branches of a tree t as pairs (kind, u), where ``kind`` is an index,
    and u is a subtree. The number tau_t(i) is the product of ``sum_j matrices[kind][i][j] tau_u(j)`` over
    these pairs. Each matrix is an s x s matrix over ``ring``, where s is the number of stages.

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
        self._stages: StageAlgebra = nodal_algebra(ring, matrices, b) or StageVectors(ring, matrices, b)
        self._ring = ring
        self._rational = isinstance(self._stages, NodalAlgebra)
        self._vectors: dict[TreeT, Element] = {}
        self._sums: dict[tuple[int, TreeT], Element] = {}

    def __call__(self, tree: TreeT) -> Element:
        """Return the elementary weight of a tree."""
        weight = self._stages.weigh(self._vector(tree))
        return self._ring.rational(weight.p, weight.q) if self._rational else weight

    def _vector(self, tree: TreeT) -> Element:
        """Return the vector with the entry tau_t(i) for each stage i, where t is ``tree``. The class
        docstring defines tau_t(i)."""
        if tree not in self._vectors:
            vector = self._stages.one
            for branch in self._branches(tree):
                vector = self._stages.multiply(vector, self._summed(branch))
            self._vectors[tree] = vector
        return self._vectors[tree]

    def _summed(self, branch: tuple[int, TreeT]) -> Element:
        if branch not in self._sums:
            kind, tree = branch
            self._sums[branch] = self._stages.apply(kind, self._vector(tree))
        return self._sums[branch]


class StageVectors:
    """The operations on vectors with one entry for each stage. A vector is stored as a sequence of ring
    elements.

    >>> from orderconds.ring import QQ
    >>> half = QQ.rational(1, 2)
    >>> stages = StageVectors(QQ, ([[half]],), [QQ.one])
    >>> stages.weigh(stages.apply(0, stages.one))
    1/2
    """

    def __init__(self, ring: Ring, matrices: Sequence[Matrix], b: Sequence[Element]) -> None:
        self._matrices = [Sums([sparse(ring, row) for row in matrix], ring.zero) for matrix in matrices]
        self._b = Sums([sparse(ring, b)], ring.zero)
        self.one = (ring.one,) * len(b)

    def multiply(self, x: Sequence[Element], y: Sequence[Element]) -> tuple[Element, ...]:
        """Return the componentwise product of two vectors."""
        return tuple(p * q for p, q in zip(x, y, strict=True)) if x is not self.one else tuple(y)

    def apply(self, kind: int, x: Sequence[Element]) -> tuple[Element, ...]:
        """Return A x, where A is the matrix with index ``kind``."""
        return tuple(self._matrices[kind](x))

    def weigh(self, x: Sequence[Element]) -> Element:
        """Return the sum of b_i x_i over all stages i, where b_i are the weights of the method."""
        weight: Element = self._b(x)[0]
        return weight


class Sums:
    """The product of a sparse matrix and a vector. Each row of the matrix is a sequence of pairs
    (j, weight_j), where weight_j is the entry in column j.

    If several rows begin with the same pairs, the partial sum of these pairs is computed only once.

    >>> a, b = 2, 3
    >>> sums = Sums([((0, a),), ((0, a), (1, b)), ((0, a), (1, b), (2, 5))], 0)
    >>> sums([1, 10, 100]), len(sums)
    ([2, 32, 532], 3)
    """

    def __init__(self, rows: Sequence[Sequence[tuple[int, Element]]], zero: Element) -> None:
        self._zero = zero
        self._steps: list[tuple[int, int, Element]] = []
        """Triples (k, j, w) that define partial sums of the product of the matrix ``rows`` and a vector x.
        The first partial sum is s_0 = 0. For n = 1, 2, ..., the n-th triple defines s_n = s_k + w x_j, where
        k < n. Entry i of the product is s_n with n = ``_ends[i]``. The example in the class docstring has
        s_1 = a x_0, s_2 = s_1 + b x_1 and s_3 = s_2 + 5 x_2."""
        known: dict[tuple[int, int, int], int] = {}
        self._ends = []
        for row in rows:
            end = 0
            for place, weight in row:
                step = (end, place, id(weight))
                if step not in known:
                    self._steps.append((end, place, weight))
                    known[step] = len(self._steps)
                end = known[step]
            self._ends.append(end)

    def __len__(self) -> int:
        return len(self._ends)

    def __call__(self, x: Sequence[Element]) -> list[Element]:
        """Return a list with one sum for each row that was given to the constructor. A row contains pairs (j,
        weight_j), and the sum of the row is the sum of the products weight_j x_j over these pairs."""
        values = [self._zero]
        for before, place, weight in self._steps:
            values.append(values[before] + weight * x[place])
        return [values[end] for end in self._ends]


def runge_kutta_series(
    ring: Ring, A: Sequence[Sequence[Element]], b: Sequence[Element]
) -> ElementaryWeights[Tree]:
    r"""Return the elementary weights of the Runge-Kutta method (A, b). The result is a function that maps a
    canonical rooted tree to its elementary weight (Hairer, Lubich and Wanner, *Geometric Numerical
    Integration*, III.1, (1.18)).

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
    """Return the pairs (index, entry) of a row. Entries that are proved to be zero are omitted.

    >>> from orderconds.ring import QQ
    >>> [(place, str(x)) for place, x in sparse(QQ, [QQ.zero, QQ.one])]
    [(1, '1')]
    """
    return tuple((place, entry) for place, entry in enumerate(row) if ring.is_zero(entry) is not True)
