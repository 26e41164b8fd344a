"""Pseudorandom numbers that are computed by SHA-256 from a description of an object and from a name.

Some randomised proofs evaluate an object at random points or modulo a random prime. The random numbers depend
on the object, so nobody can choose the numbers first and then construct a wrong object that passes the test.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from hashlib import sha256

from flint import fmpz


class Draws:
    """Pseudorandom numbers. Each number is computed from a name and from the texts in ``described``. Equal
    names and equal texts give equal numbers.

    >>> draws = Draws("one file")
    >>> draws.number("x", 64) == Draws("one file").number("x", 64) != Draws("another").number("x", 64)
    True
    """

    def __init__(self, *described: str) -> None:
        self._digest = sha256("\0".join(described).encode()).digest()

    def number(self, name: str, bits: int) -> int:
        """Return the pseudorandom number with this name, uniformly distributed in 0, ..., 2^bits - 1."""
        blocks = -(-bits // 256)
        drawn = b"".join(
            sha256(self._digest + block.to_bytes(4, "big") + name.encode()).digest()
            for block in range(blocks)
        )
        return int.from_bytes(drawn, "big") >> (256 * blocks - bits)

    def primes(self, bits: int, avoided: Iterable[int] = ()) -> Iterator[int]:
        """Yield different primes of ``bits`` bits. Each prime is 3 modulo 4. Primes that divide a
        non-zero number in ``avoided`` are omitted.

        If a prime p is 3 modulo 4 and x is a square modulo p, then x^((p + 1)/4) is a square root of x.

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
