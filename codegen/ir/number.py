"""Constants, such as the coefficients of a Butcher tableau. Each constant is an element of a ring.

Rational and algebraic numbers are stored exactly. Each other number is stored as a ball (an interval that
contains the number).

Two balls with equal end points are treated as the same number (:attr:`Number.key`). The difference of two
equal numbers is exactly 0. The quotient of two equal non-zero numbers is exactly 1.
"""

from __future__ import annotations

import re
import sys
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property

from orderconds.ring import QQ
from orderconds.ring.protocol import Element, Ring

# Without limits on the number of digits, ``Fraction("1e999999999")`` would build an integer with a billion
# digits.
_TYPED = re.compile(r"[+-]?(\d{1,99}/\d{1,99}|(\d{1,99}\.?\d{0,99}|\.\d{1,99})([eE][+-]?\d{1,3})?)", re.ASCII)
_SMALLEST, _LARGEST = Fraction(sys.float_info.min), Fraction(sys.float_info.max)


def is_normal(value: Fraction) -> bool:
    """Return True if ``value`` is zero or its absolute value is in the range of normal doubles.

    If such a value is rounded to a double, the relative error is at most 2^-53.

    >>> [is_normal(Fraction(10) ** n) for n in (-308, -307, 308, 309)]
    [False, True, True, False]
    """
    # A denormal double has fewer than 53 bits, so its relative rounding error may be larger than 2^-53.
    return not value or _SMALLEST <= abs(value) <= _LARGEST


@dataclass(frozen=True, eq=False)
class Number:
    """A real number, given exactly or by a ball (an interval that contains it).

    ``ring`` is the ring of ``element``, for example QQ (the rational numbers).
    """

    ring: Ring = field(repr=False)
    element: Element = field(repr=False)

    @cached_property
    def key(self) -> tuple[object, ...]:
        """Two numbers are equal (``==``) if their keys are equal."""
        # The key of a ball consists of its exact end points, so balls with equal end points compare equal.
        return tuple(self.ring.key(self.element))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Number) and self.key == other.key

    def __hash__(self) -> int:
        return hash(self.key)

    @classmethod
    def rational(cls, p: int, q: int = 1) -> Number:
        """Return the rational number p/q.

        >>> Number.rational(1, 2) + Number.rational(1, 2) == Number.rational(1)
        True
        """
        return cls(QQ, QQ.rational(p, q))

    @classmethod
    def read(cls, text: str) -> Number:
        """Return the number that a user typed as ``text``, for example ``1/2`` or ``0.25``.

        ValueError is raised if the text is not a rational number, or if :func:`is_normal` is False for this
        number.

        >>> Number.read("-3e-2") == Number.rational(-3, 100)
        True
        """
        try:
            # ``Fraction`` converts the text "0.1" to 1/10 exactly.
            value = Fraction(text) if _TYPED.fullmatch(text) else None
        except ZeroDivisionError:
            # The text ``1/0`` matches the pattern but is not a number.
            value = None
        if value is None or not is_normal(value):
            expected = "0 or a rational number such as 1/2, with absolute value between 1e-307 and 1e308"
            raise ValueError(expected)
        return cls.rational(*value.as_integer_ratio())

    @cached_property
    def is_zero(self) -> bool:
        """True if this number is provably zero."""
        # The ring returns None if it cannot decide whether a number is zero.
        return self.ring.is_zero(self.element) is True

    @cached_property
    def is_one(self) -> bool:
        """True if this number is provably one."""
        return self.ring.is_zero(self.element - 1) is True

    @cached_property
    def is_minus_one(self) -> bool:
        """True if this number is provably minus one."""
        return self.ring.is_zero(self.element + 1) is True

    @property
    def is_rational(self) -> bool:
        """True if this number is stored as an element of QQ, the ring of rational numbers."""
        return self.ring is QQ

    def _join(self, other: Number) -> tuple[Ring, Element, Element]:
        if self.ring is other.ring:
            return self.ring, self.element, other.element
        # If the rings differ, one ring must be QQ (the rational numbers).
        if self.ring is QQ:
            # Every ring here contains the rational numbers, so a rational operand can be converted.
            return other.ring, other.ring.rational(int(self.element.p), int(self.element.q)), other.element
        if other.ring is QQ:
            ring = self.ring
            return ring, self.element, ring.rational(int(other.element.p), int(other.element.q))
        names = f"{self.ring.name} and {other.ring.name}"
        raise TypeError(f"numbers of two different rings cannot be combined: {names}")

    def __add__(self, other: Number) -> Number:
        # This separate case for rational numbers saves time.
        if self.ring is other.ring is QQ:
            return Number(QQ, self.element + other.element)
        # This case is treated separately, because the sum of two balls would not be exactly 0.
        if self == -other:
            return Number.rational(0)
        ring, x, y = self._join(other)
        return Number(ring, x + y)

    def __sub__(self, other: Number) -> Number:
        if self.ring is other.ring is QQ:
            return Number(QQ, self.element - other.element)
        # The difference of two equal balls would be a ball around 0, not exactly 0.
        if self == other:
            return Number.rational(0)
        ring, x, y = self._join(other)
        return Number(ring, x - y)

    def __mul__(self, other: Number) -> Number:
        if self.ring is other.ring is QQ:
            return Number(QQ, self.element * other.element)
        # A multiplication by 1 in ball arithmetic could make the ball of the other factor wider.
        if self.is_one or other.is_one:
            return other if self.is_one else self
        ring, x, y = self._join(other)
        return Number(ring, x * y)

    def __truediv__(self, other: Number) -> Number:
        # In ball arithmetic, x/x would be an interval around 1 and not exactly 1.
        if self == other and not other.is_zero:
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
        # A double has about 16 digits, so an approximation with 40 digits is accurate enough.
        return float(self.ring.approximate(self.element, 40))

    def fraction(self) -> Fraction:
        """Return this number as a Fraction. TypeError is raised if :attr:`is_rational` is False."""
        if not self.is_rational:
            message = f"the number {self.text()} is not stored as a rational number"
            raise TypeError(message)
        return Fraction(int(self.element.p), int(self.element.q))

    def text(self) -> str:
        """Return this number as exact text, or as a rounded decimal if the number is given by a ball."""
        return self.ring.text(self.element)
