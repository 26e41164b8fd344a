"""Exact numbers in programs: an element together with its ring, hashable, rounded once by a printer.

Tableau coefficients stay exact (rational, algebraic) or certified (balls) until they are spelled; a
:class:`Number` is how programs carry them. Two numbers are equal when their rings give equal keys, so that
equal coefficients of a ball tableau (the same name in the file) are seen as equal although balls never
prove equality: their difference is 0 and their quotient 1, and a factor 1 widens no ball.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import Any

from orderconds.ring import QQ
from orderconds.ring.protocol import Element, Ring


@dataclass(frozen=True, eq=False)
class Number:
    """An exact or certified real number; rational values are kept over QQ whatever ring they came from."""

    ring: Ring = field(repr=False)
    element: Element = field(repr=False)

    @cached_property
    def key(self) -> tuple[Any, ...]:
        """What tells whether numbers are equal."""
        return tuple(self.ring.key(self.element))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Number) and self.key == other.key

    def __hash__(self) -> int:
        return hash(self.key)

    @classmethod
    def rational(cls, p: int, q: int = 1) -> Number:
        """Return p/q.

        >>> Number.rational(1, 2) + Number.rational(1, 2) == Number.rational(1)
        True
        """
        return cls(QQ, QQ.rational(p, q))

    @cached_property
    def is_zero(self) -> bool:
        """Whether this number is provably zero."""
        return self.ring.is_zero(self.element) is True

    @cached_property
    def is_one(self) -> bool:
        """Whether this number is provably one."""
        return self.ring.is_zero(self.element - 1) is True

    @cached_property
    def is_minus_one(self) -> bool:
        """Whether this number is provably minus one."""
        return self.ring.is_zero(self.element + 1) is True

    @property
    def is_rational(self) -> bool:
        """Whether this number is held as an element of QQ."""
        return self.ring is QQ

    def _join(self, other: Number) -> tuple[Ring, Element, Element]:
        if self.ring is other.ring:
            return self.ring, self.element, other.element
        if self.ring is QQ:
            return other.ring, other.ring.rational(int(self.element.p), int(self.element.q)), other.element
        if other.ring is QQ:
            ring = self.ring
            return ring, self.element, ring.rational(int(other.element.p), int(other.element.q))
        message = f"numbers of two fields meet: {self.ring.name} and {other.ring.name}"
        raise TypeError(message)

    def __add__(self, other: Number) -> Number:
        if self == -other:
            return Number.rational(0)
        ring, x, y = self._join(other)
        return Number(ring, x + y)

    def __sub__(self, other: Number) -> Number:
        if self == other:
            return Number.rational(0)
        ring, x, y = self._join(other)
        return Number(ring, x - y)

    def __mul__(self, other: Number) -> Number:
        if self.is_one or other.is_one:
            return other if self.is_one else self
        ring, x, y = self._join(other)
        return Number(ring, x * y)

    def __truediv__(self, other: Number) -> Number:
        if self == other:
            return Number.rational(1)
        ring, x, y = self._join(other)
        return Number(ring, x / y)

    def __neg__(self) -> Number:
        return Number(self.ring, -self.element)

    def __float__(self) -> float:
        return self._nearest

    @cached_property
    def _nearest(self) -> float:
        if self.is_rational:
            return float(self.fraction())
        return float(self.ring.approximate(self.element, 40))

    def fraction(self) -> Fraction:
        """Return the value of a rational number; a TypeError otherwise."""
        if not self.is_rational:
            message = f"{self.text()} is not held as a rational"
            raise TypeError(message)
        return Fraction(int(self.element.p), int(self.element.q))

    def text(self) -> str:
        """Spell this number exactly, or to 20 digits where it is only known as a ball."""
        return self.ring.text(self.element)
