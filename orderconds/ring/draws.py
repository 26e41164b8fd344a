"""Pseudorandom numbers, computed with the hash function SHA-256.

The random numbers for randomised proofs are computed from a description of the coefficients in the tableau
file. Fixed numbers would be unsafe: somebody who knows the numbers could choose coefficients for which a
false identity passes the test.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from hashlib import sha256

from flint import fmpz


class Draws:
    """A generator of pseudorandom numbers. The texts that are passed to the constructor are the seed. Each
    pseudorandom number is computed from the seed, a name and a number of bits.

    >>> draws = Draws("one file")
    >>> draws.number("x", 64) == Draws("one file").number("x", 64) != Draws("another").number("x", 64)
    True
    """

    def __init__(self, *described: str) -> None:
        self._digest = sha256("\0".join(described).encode()).digest()

    def number(self, name: str, bits: int) -> int:
        """Return the pseudorandom integer for ``name``. All integers from 0 to 2^bits - 1 are equally
        probable."""
        blocks = -(-bits // 256)
        drawn = b"".join(
            sha256(self._digest + block.to_bytes(4, "big") + name.encode()).digest()
            for block in range(blocks)
        )
        return int.from_bytes(drawn, "big") >> (256 * blocks - bits)

    def primes(self, bits: int, avoided: Iterable[int] = ()) -> Iterator[int]:
        """Yield different primes p that have ``bits`` binary digits and are congruent to 3 modulo 4.

        Modulo such a prime, each square x has the square root x^((p + 1)/4). Primes that divide a non-zero
        number in ``avoided`` are skipped.

        >>> next(Draws("one file").primes(61)).bit_length()
        61
        """
        nonzero = [x for x in set(avoided) if x]
        seen = set[int]()
        place = 0
        while True:
            n = self.number(f"prime {place}", bits) | 1 << (bits - 1) | 3
            place += 1
            if n not in seen and fmpz(n).is_prime() and all(x % n for x in nonzero):
                seen.add(n)
                yield n
