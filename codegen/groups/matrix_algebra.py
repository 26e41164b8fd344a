"""Lie algebras of matrices. The basis matrices have rational entries. The dual basis and the structure
constants are computed by sparse arithmetic.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, cached_property

from codegen.errors import SceneError
from codegen.groups.linear_algebra import rational_inverse

Sparse = tuple[tuple[int, Fraction], ...]
"""The non-zero entries of a matrix or vector: pairs of an index and a value, sorted by index. The entries of
a matrix are numbered row by row.
"""


@dataclass(frozen=True)
class MatrixAlgebra:
    """A vector space of n x n matrices that is closed under [A, B] = AB - BA.

    - ``basis`` contains the basis matrices e_0, e_1, ...
    - ``dual`` contains the dual basis, whose matrices are in the same vector space. Coordinate i of a matrix
      A is sum_jk D_jk A_jk, where D is the matrix ``dual[i]``.
    - ``constants`` are the non-zero structure constants (i, j, k, c): c is the component of [e_i, e_j] along
      e_k.
    """

    n: int
    basis: tuple[Sparse, ...]
    dual: tuple[Sparse, ...]
    constants: tuple[tuple[int, int, int, Fraction], ...]

    @cached_property
    def places(self) -> tuple[Sparse, ...]:
        """For each position (row by row), the non-zero entries of the basis matrices at this position.

        A pair (i, x) means that basis matrix i has the entry x.
        """
        return _by_place(self.basis, self.n**2)

    @cached_property
    def dual_places(self) -> tuple[Sparse, ...]:
        """The non-zero entries of the dual basis matrices, grouped by position.

        A position is a pair (row, column) of an n x n matrix. The result contains one tuple for each of the
        n^2 positions. The positions are ordered row by row. A pair (i, x) in a tuple means that matrix i of
        the dual basis has the entry x at the position of the tuple.
        """
        return _by_place(self.dual, self.n**2)

    @cached_property
    def nilpotency(self) -> int:
        """A number k such that every product of k matrices of the algebra is zero, or 0 if no k is found.

        The search uses only the positions of the non-zero entries of the basis matrices.
        """
        n = self.n
        follows = {(p // n, p % n) for matrix in self.basis for p, _ in matrix}
        paths, k = {(i, i) for i in range(n)}, 0
        while paths and k <= n:
            paths, k = {(i, m) for i, j in paths for r, m in follows if j == r}, k + 1
        return 0 if paths else k


@cache
def matrix_algebra(name: str, n: int, basis: tuple[Sparse, ...]) -> MatrixAlgebra:
    """Return the algebra with the given basis. ``name`` is the name of the group in error messages.

    :class:`codegen.errors.SceneError` is raised if the matrices are not a basis of a Lie algebra.
    """
    # The result is cached, because a command can construct one group several times.
    dual = _dual(name, basis)
    finder = _Coordinates(name, basis, dual, n)
    constants: list[tuple[int, int, int, Fraction]] = []
    rows = [_rows(matrix, n) for matrix in basis]
    for i, a in enumerate(rows):
        for j, b in enumerate(rows[:i]):
            for k, c in finder.of(_commutator(a, b, n)):
                constants += [(i, j, k, c), (j, i, k, -c)]
    return MatrixAlgebra(n, basis, dual, tuple(sorted(constants)))


def sparse(entries: Iterable[Fraction | int]) -> Sparse:
    """Return the non-zero entries of a list, each with its index.

    >>> sparse([0, 2])
    ((1, Fraction(2, 1)),)
    """
    return tuple((k, Fraction(x)) for k, x in enumerate(entries) if x)


def _by_place(matrices: Sequence[Sparse], size: int) -> tuple[Sparse, ...]:
    places: list[list[tuple[int, Fraction]]] = [[] for _ in range(size)]
    for i, matrix in enumerate(matrices):
        for place, x in matrix:
            places[place].append((i, x))
    return tuple(map(tuple, places))


def _rows(matrix: Sparse, n: int) -> dict[int, list[tuple[int, Fraction]]]:
    rows: dict[int, list[tuple[int, Fraction]]] = {}
    for place, x in matrix:
        rows.setdefault(place // n, []).append((place % n, x))
    return rows


def _commutator(
    a: dict[int, list[tuple[int, Fraction]]], b: dict[int, list[tuple[int, Fraction]]], n: int
) -> dict[int, Fraction]:
    total: dict[int, Fraction] = {}
    for left, right, sign in ((a, b, 1), (b, a, -1)):
        for i, row in left.items():
            for k, x in row:
                for j, y in right.get(k, ()):
                    total[n * i + j] = total.get(n * i + j, Fraction(0)) + sign * x * y
    return {place: x for place, x in total.items() if x}


def _dual(name: str, basis: Sequence[Sparse]) -> tuple[Sparse, ...]:
    """Return the dual basis. SceneError is raised if the basis is linearly dependent."""
    gram: list[dict[int, Fraction]] = [{} for _ in basis]
    places: dict[int, list[tuple[int, Fraction]]] = {}
    for i, matrix in enumerate(basis):
        for place, x in matrix:
            places.setdefault(place, []).append((i, x))
    for entries in places.values():
        for i, x in entries:
            for j, y in entries:
                gram[i][j] = gram[i].get(j, Fraction(0)) + x * y
    dual: list[Sparse] = [()] * len(basis)
    # After a permutation of the basis, the Gram matrix is block diagonal with one block for each component.
    for component in _components(gram):
        inverse = rational_inverse([[gram[i].get(j, Fraction(0)) for j in component] for i in component])
        if inverse is None or not all(basis[i] for i in component):
            raise SceneError(
                "the basis is linearly dependent", where=name, expected="linearly independent matrices"
            )
        for i, row in zip(component, inverse, strict=True):
            total: dict[int, Fraction] = {}
            for j, weight in zip(component, row, strict=True):
                for place, x in basis[j]:
                    total[place] = total.get(place, Fraction(0)) + weight * x
            dual[i] = tuple(sorted((place, x) for place, x in total.items() if x))
    return tuple(dual)


def _components(gram: Sequence[dict[int, Fraction]]) -> list[list[int]]:
    """Return the components of the graph that has an edge for each non-zero entry of the Gram matrix."""
    components: list[list[int]] = []
    seen: set[int] = set()
    for start in range(len(gram)):
        if start in seen:
            continue
        seen.add(start)
        component, waiting = [start], [start]
        while waiting:
            fresh = [j for j, x in gram[waiting.pop()].items() if x and j not in seen]
            seen.update(fresh)
            component += fresh
            waiting += fresh
        components.append(sorted(component))
    return components


class _Coordinates:
    """Computes the coordinates of a matrix with respect to a basis."""

    def __init__(self, name: str, basis: Sequence[Sparse], dual: Sequence[Sparse], n: int) -> None:
        self.name, self.basis = name, basis
        self.places = _by_place(dual, n * n)

    def of(self, matrix: dict[int, Fraction]) -> list[tuple[int, Fraction]]:
        """Return the non-zero coordinates of a matrix, each with its index. SceneError is raised if the
        matrix is not a linear combination of the basis matrices.
        """
        x: dict[int, Fraction] = {}
        for place, value in matrix.items():
            for i, weight in self.places[place]:
                x[i] = x.get(i, Fraction(0)) + weight * value
        rest = dict(matrix)
        for i, c in x.items():
            for place, value in self.basis[i]:
                rest[place] = rest.get(place, Fraction(0)) - c * value
        if any(rest.values()):
            raise SceneError(
                "the bracket [A, B] = AB - BA of two basis matrices is not a linear combination of the "
                "basis matrices",
                where=self.name,
                expected="the basis of a Lie algebra",
                hint="add the matrix [A, B] to the basis",
            )
        return [(i, c) for i, c in sorted(x.items()) if c]
