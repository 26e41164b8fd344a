"""Vectors of residues modulo a prime p, without NumPy, because the import of NumPy is slow.

The residues in a vector are called samples. A polynomial over Z/p of degree below n represents a vector of n
samples: sample k is the value of the polynomial at the point k. The map from vectors to polynomials is linear
and invertible.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from operator import mul
from random import Random

from flint import nmod_mat, nmod_poly

from orderconds.ring.power import power
from orderconds.ring.protocol import Element


class Samples:
    """The ring of vectors of ``count`` residues (samples) modulo ``prime``, with componentwise arithmetic.
    The samples are the values of a polynomial at the points 0, ..., ``count`` - 1. The prime must be larger
    than ``count``. Therefore the points are distinct modulo the prime.

    >>> R = Samples(101, 2)
    >>> x = R.element([3, 5])
    >>> R.text(x * x - 2 / (R.one * 2))
    '[8, 24]'
    """

    def __init__(self, prime: int, count: int) -> None:
        if not 0 < count < prime:
            raise ValueError(f"the prime {prime} must be larger than the number of samples, {count}")
        self.prime, self.count = prime, count
        self.name = f"samples({prime})"
        self.modulus = reduce(mul, [nmod_poly([-k, 1], prime) for k in range(count)])
        self.zero, self.one = self.rational(0), self.rational(1)

    def rational(self, p: int, q: int = 1) -> Sample:
        """Return the vector with p/q in every entry. Raises ValueError if ``self.prime`` divides q."""
        return Sample(self, nmod_poly([int(p) * pow(int(q), -1, self.prime)], self.prime))

    def element(self, values: Sequence[int]) -> Sample:
        """Return the vector with the entries ``values[k]`` modulo ``self.prime``. The list ``values`` has
        ``self.count`` entries."""
        total = nmod_poly([0], self.prime)
        for k, value in enumerate(values):
            other = self.modulus // nmod_poly([-k, 1], self.prime)
            total = total + other * (value * pow(int(other(k)), -1, self.prime))
        return Sample(self, total)

    def random(self, generator: Random) -> Sample:
        """Return a vector of independent, uniformly distributed residues."""
        return Sample(
            self, nmod_poly([generator.randrange(self.prime) for _ in range(self.count)], self.prime)
        )

    def is_zero(self, x: Sample) -> bool:
        """Return True if all entries of the vector x are zero."""
        return bool(x.polynomial.is_zero())

    def constant(self, x: Sample) -> int | None:
        """Return the common value of all samples, or None if the samples differ."""
        return int(x.polynomial[0]) if x.polynomial.degree() <= 0 else None

    def coordinates(self, x: Sample) -> list[int]:
        """Return the coefficients of the polynomial that represents x, by ascending powers. The list contains
        ``self.count`` coefficients. The last coefficients may be zero."""
        coefficients = [int(c) for c in x.polynomial.coeffs()]
        return coefficients + [0] * (self.count - len(coefficients))

    def text(self, x: Sample) -> str:
        """Return the samples as text."""
        return str([int(x.polynomial(k)) for k in range(self.count)])

    def key(self, x: Sample) -> tuple[int, ...]:
        """Return a hashable sort key: the coefficients of the polynomial that represents x."""
        return tuple(self.coordinates(x))

    def approximate(self, x: Sample, digits: int = 20) -> str:
        """Return ``text(x)``, because a residue has no decimal approximation. ``digits`` is not used."""
        return self.text(x)


class Sample:
    """An element of the ring :class:`Samples`: a vector of residues modulo ``ring.prime``, with componentwise
    arithmetic."""

    __slots__ = ("polynomial", "ring")

    def __init__(self, ring: Samples, polynomial: nmod_poly) -> None:
        self.ring, self.polynomial = ring, polynomial

    def __repr__(self) -> str:
        return f"Sample({self.ring.text(self)} mod {self.ring.prime})"

    def __add__(self, other: Element) -> Sample:
        return Sample(self.ring, self.polynomial + _plain(other))

    __radd__ = __add__

    def __sub__(self, other: Element) -> Sample:
        return Sample(self.ring, self.polynomial - _plain(other))

    def __rsub__(self, other: Element) -> Sample:
        return Sample(self.ring, _plain(other) - self.polynomial)

    def __neg__(self) -> Sample:
        return Sample(self.ring, -self.polynomial)

    def __mul__(self, other: Element) -> Sample:
        product = self.polynomial * _plain(other)
        return Sample(
            self.ring, product if product.degree() < self.ring.count else product % self.ring.modulus
        )

    __rmul__ = __mul__

    def reciprocal(self) -> Sample:
        """Return 1/x for this vector x. Raises ZeroDivisionError if a sample of x is zero."""
        common, inverse, _ = self.polynomial.xgcd(self.ring.modulus)
        if common.degree() != 0:
            raise ZeroDivisionError(f"a sample of the divisor is zero modulo {self.ring.prime}")
        return Sample(self.ring, inverse)

    def __truediv__(self, other: Element) -> Sample:
        divisor = other if isinstance(other, Sample) else self.ring.rational(other)
        return self * divisor.reciprocal()

    def __rtruediv__(self, other: Element) -> Sample:
        return self.reciprocal().__mul__(other)

    def __pow__(self, n: int) -> Sample:
        return power(self, n, self.ring.one)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Sample) and bool(self.polynomial == other.polynomial)

    def __hash__(self) -> int:
        return hash(self.ring.key(self))


def _plain(x: Element) -> Element:
    return x.polynomial if isinstance(x, Sample) else int(x)


def echelon(
    columns: Sequence[Sequence[int]], prime: int
) -> tuple[tuple[int, ...], dict[int, dict[int, int]]]:
    """Return the indices of the pivot columns of a matrix modulo ``prime``, and the other columns as linear
    combinations of the pivot columns.

    A pivot column is not a linear combination of the columns to its left. The second result has the form
    {column: {pivot column: coefficient}}, where columns are denoted by their indices.

    >>> echelon([[1, 1], [2, 2], [1, 3], [4, 6]], 101)
    ((0, 2), {1: {0: 2}, 3: {0: 3, 2: 1}})
    """
    if not columns:
        return (), {}
    height = len(columns[0])
    matrix = nmod_mat(height, len(columns), [column[i] for i in range(height) for column in columns], prime)
    reduced, rank = matrix.rref()
    pivots: list[int] = []
    dependent: dict[int, dict[int, int]] = {}
    for column in range(len(columns)):
        if len(pivots) < rank and int(reduced[len(pivots), column]):
            pivots.append(column)
        else:
            entries = ((pivot, int(reduced[row, column])) for row, pivot in enumerate(pivots))
            dependent[column] = {pivot: value for pivot, value in entries if value}
    return tuple(pivots), dependent
