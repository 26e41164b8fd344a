"""Whole powers by squaring, for elements of any ring; negative ones where the ring divides."""

from __future__ import annotations

from typing import Any, TypeVar

T = TypeVar("T")


def power(x: T, n: int, one: T) -> T:
    """Return x^n; x^0 is ``one``. ZeroDivisionError where n < 0 and x is no unit.

    >>> power(3, 5, 1), power(2.0, -2, 1)
    (243, 0.25)
    """
    base: Any = x
    if n < 0:
        base, n = 1 / base, -n
    result: Any = one
    while n:
        if n & 1:
            result = result * base
        n >>= 1
        if n:
            base = base * base
    found: T = result
    return found
