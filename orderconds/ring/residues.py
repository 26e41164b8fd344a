"""Vectors of residues modulo a prime, used to count independent order conditions.

A vector contains the values of one quantity in many random tableaux. The prime must be below 2^31, because
the product of two residues must fit in 64 bits.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from orderconds.ring.power import power
from orderconds.ring.protocol import Element

PRIMES = (2147483647, 2147483629)
"""The two largest primes below 2^31."""


class Residues:
    """The ring of vectors of residues modulo ``prime``, with componentwise arithmetic. The number of entries
    of each vector is ``samples``.

    >>> R = Residues(101, 2)
    >>> R.text(R.rational(1, 2) * 2 + R.one)
    '[2 2]'
    """

    def __init__(self, prime: int = PRIMES[0], samples: int = 1) -> None:
        if not 2 < prime < 2**31:
            raise ValueError(f"expected a prime from 3 to 2^31 - 1, found {prime}")
        self.prime, self.samples = prime, samples
        self.name = f"residues({prime})"
        self.zero = self.rational(0)
        self.one = self.rational(1)

    def __repr__(self) -> str:
        return self.name

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Residues) and (other.prime, other.samples) == (self.prime, self.samples)

    def __hash__(self) -> int:
        return hash((self.prime, self.samples))

    def rational(self, p: int, q: int = 1) -> Residue:
        """Return the vector with p/q in every entry. Raises ZeroDivisionError if ``self.prime`` divides q."""
        p, q = int(p) % self.prime, int(q) % self.prime
        if q == 0:
            raise ZeroDivisionError(f"the denominator of a fraction is divisible by the prime {self.prime}")
        value = p * pow(q, -1, self.prime) % self.prime
        return Residue(self, np.full(self.samples, value, dtype=np.int64))

    def element(self, values: NDArray[np.int64]) -> Residue:
        """Return the vector of the residues of ``values``, an array of shape (samples,)."""
        return Residue(self, np.asarray(values, dtype=np.int64) % self.prime)

    def random(self, generator: np.random.Generator) -> Residue:
        """Return a vector of independent, uniformly distributed residues."""
        return Residue(self, generator.integers(0, self.prime, self.samples, dtype=np.int64))

    def is_zero(self, x: Residue) -> bool:
        """Return True if all residues in x are zero."""
        return not x.values.any()

    def text(self, x: Residue) -> str:
        """Return the vector x as text."""
        return str(x.values)

    def key(self, x: Residue) -> tuple[int, ...]:
        """Return the residues as a tuple of integers, a hashable sort key."""
        return tuple(int(v) for v in x.values)

    def approximate(self, x: Residue, digits: int = 20) -> str:
        """Return ``text(x)``, because a residue has no decimal approximation. ``digits`` is not used."""
        return self.text(x)


class Residue:
    """A vector of residues, shape (samples,), with componentwise arithmetic."""

    __slots__ = ("ring", "values")
    # If the left operand is a NumPy scalar, this attribute lets Python call __radd__, __rmul__ and so on.
    __array_ufunc__ = None

    def __init__(self, ring: Residues, values: NDArray[np.int64]) -> None:
        self.ring, self.values = ring, values

    def __repr__(self) -> str:
        return f"Residue({self.values} mod {self.ring.prime})"

    def _values(self, other: Element) -> NDArray[np.int64] | int:
        return other.values if isinstance(other, Residue) else int(other) % self.ring.prime

    def _wrap(self, values: NDArray[np.int64]) -> Residue:
        return Residue(self.ring, values % self.ring.prime)

    def __add__(self, other: Element) -> Residue:
        return self._wrap(self.values + self._values(other))

    __radd__ = __add__

    def __sub__(self, other: Element) -> Residue:
        return self._wrap(self.values - self._values(other))

    def __rsub__(self, other: Element) -> Residue:
        return self._wrap(self._values(other) - self.values)

    def __neg__(self) -> Residue:
        return self._wrap(-self.values)

    def __mul__(self, other: Element) -> Residue:
        return self._wrap(self.values * self._values(other))

    __rmul__ = __mul__

    def reciprocal(self) -> Residue:
        """Return 1/x for each entry x, by Fermat's formula 1/x = x^(p-2) for the prime p. Raises
        ZeroDivisionError if an entry is zero."""
        if not self.values.all():
            raise ZeroDivisionError(f"a sample of the divisor is zero modulo {self.ring.prime}")
        result, square, n = self.ring.one, self, self.ring.prime - 2
        while n:
            if n & 1:
                result = result * square
            square, n = square * square, n >> 1
        return result

    def __truediv__(self, other: Element) -> Residue:
        divisor = other if isinstance(other, Residue) else self.ring.rational(other)
        return self * divisor.reciprocal()

    def __rtruediv__(self, other: Element) -> Residue:
        return self.reciprocal().__mul__(other)

    def __pow__(self, n: int) -> Residue:
        return power(self, n, self.ring.one)

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, Residue) and other.ring == self.ring and not (self.values - other.values).any()
        )

    def __hash__(self) -> int:
        return hash(self.ring.key(self))
