"""Integer powers by repeated squaring, for elements of any ring. Negative powers require division."""

from __future__ import annotations

from typing import TypeVar

from orderconds.ring.protocol import Element

T = TypeVar("T")


def power(x: T, n: int, one: T) -> T:
    """Return x^n, where x^0 is ``one``. Raises ZeroDivisionError if n < 0 and x has no inverse.

    >>> power(3, 5, 1), power(2.0, -2, 1)
    (243, 0.25)
    """
    base: Element = x
    total: Element = one
    if n < 0:
        base, n = 1 / base, -n
    while n:
        if n & 1:
            total = total * base
        n >>= 1
        if n:
            base = base * base
    result: T = total
    return result
