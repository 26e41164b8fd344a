"""Balls with gradients: values and first derivatives of any formula, enclosed together.

Automatic differentiation in forward mode. The precision is that of the caller, who computes inside ``with
precision(bits)``; what flint encloses is then rigorous for the value and for every partial derivative.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from flint import arb, fmpq

from orderconds.ring.balls import Balls
from orderconds.ring.precision import working_bits

ZERO = arb(0)
"""The slope along a variable that has not entered: no arithmetic is done with this very object."""


class Jets:
    """The ring of functions of ``width`` variables near a point or on a box, to first order.

    >>> from orderconds.ring.precision import precision
    >>> with precision(64):
    ...     R = Jets(2)
    ...     x, y = R.variable(0, arb(3)), R.variable(1, arb(5))
    ...     z = x * x * y
    >>> z.value == 45, [g == k for g, k in zip(z.gradient, (30, 9))]
    (True, [True, True])
    """

    def __init__(self, width: int) -> None:
        self.width = width
        self.name = f"jets({width})"
        self._flat = (ZERO,) * width
        self.zero = Jet(arb(0), self._flat)
        self.one = Jet(arb(1), self._flat)

    def __repr__(self) -> str:
        return self.name

    def variable(self, place: int, value: arb) -> Jet:
        """Return the variable of that place, enclosed by ``value``."""
        gradient = [ZERO] * self.width
        gradient[place] = arb(1)
        return Jet(value, tuple(gradient))

    def constant(self, value: arb) -> Jet:
        """Return a number that does not vary."""
        return Jet(value, self._flat)

    def rational(self, p: int, q: int = 1) -> Jet:
        """Return p/q."""
        return Jet(arb(fmpq(p, q)), self._flat)

    def root(self, x: Jet, index: int) -> Jet:
        """Return the real root; ValueError where x may be zero, or negative with an even index."""
        negative = x.value < 0
        if not (x.value > 0 or (negative and index % 2)):
            raise ValueError("a root of a number whose sign is not known")
        value = -((-x.value).root(index)) if negative else x.value.root(index)
        slope = value / (x.value * index)
        return Jet(value, tuple([g if g is ZERO else slope * g for g in x.gradient]))

    def named_root(self, minpoly: Sequence[Fraction], near: Fraction, unit: Fraction, name: str) -> Jet:
        """Return the one real root of ``minpoly`` within ``unit`` of ``near``, a constant."""
        return self.constant(Balls(working_bits()).named_root(minpoly, near, unit, name).value)

    def is_zero(self, x: Jet) -> bool | None:
        """Return True for the constant zero, False where zero lies outside, else None."""
        if not x.value.contains(0):
            return False
        return True if x.value.is_zero() and all(g.is_zero() for g in x.gradient) else None

    def text(self, x: Jet) -> str:
        """Spell the value with what is known of it."""
        return str(x.value.str(15))

    def key(self, x: Jet) -> tuple[str, ...]:
        """Return the enclosures as text."""
        return (str(x.value), *map(str, x.gradient))

    def approximate(self, x: Jet, digits: int = 20) -> str:
        """Return the midpoint of the value."""
        return str(x.value.mid().str(digits, radius=False))


class Jet:
    """A value and its gradient, all flint balls."""

    __slots__ = ("gradient", "value")

    def __init__(self, value: arb, gradient: tuple[arb, ...]) -> None:
        self.value, self.gradient = value, gradient

    def __repr__(self) -> str:
        return f"Jet({self.value.str(12)})"

    def __add__(self, other: Any) -> Jet:
        if not isinstance(other, Jet):
            return Jet(self.value + other, self.gradient)
        return Jet(
            self.value + other.value,
            tuple(
                [
                    h if g is ZERO else g if h is ZERO else g + h
                    for g, h in zip(self.gradient, other.gradient, strict=True)
                ]
            ),
        )

    __radd__ = __add__

    def __neg__(self) -> Jet:
        return Jet(-self.value, tuple([g if g is ZERO else -g for g in self.gradient]))

    def __sub__(self, other: Any) -> Jet:
        return self.__add__(-other)

    def __rsub__(self, other: Any) -> Jet:
        return (-self).__add__(other)

    def __mul__(self, other: Any) -> Jet:
        if not isinstance(other, Jet):
            return Jet(self.value * other, tuple([g if g is ZERO else g * other for g in self.gradient]))
        x, y = self.value, other.value
        return Jet(
            x * y,
            tuple(
                [
                    (h if h is ZERO else x * h) if g is ZERO else g * y if h is ZERO else g * y + x * h
                    for g, h in zip(self.gradient, other.gradient, strict=True)
                ]
            ),
        )

    __rmul__ = __mul__

    def reciprocal(self) -> Jet:
        """Return 1/x; ZeroDivisionError where x may be zero."""
        if self.value.contains(0):
            raise ZeroDivisionError("division by a ball that contains zero")
        value = 1 / self.value
        slope = -value * value
        return Jet(value, tuple([g if g is ZERO else slope * g for g in self.gradient]))

    def __truediv__(self, other: Any) -> Jet:
        if not isinstance(other, Jet):
            return self.__mul__(1 / arb(other))
        return self.__mul__(other.reciprocal())

    def __rtruediv__(self, other: Any) -> Jet:
        return self.reciprocal().__mul__(other)

    def __pow__(self, n: int) -> Jet:
        base, n = (self, n) if n >= 0 else (self.reciprocal(), -n)
        result = Jet(arb(1), (ZERO,) * len(self.gradient))
        for _ in range(n):
            result = result * base
        return result
