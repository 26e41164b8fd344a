"""Balls with gradients: rigorous enclosures of the value and of the first derivatives of a formula.

The derivatives are computed by automatic differentiation in forward mode. The caller sets the precision in a
block ``with precision(bits)``.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from flint import arb, arb_mat, fmpq

from orderconds.ring.balls import Balls
from orderconds.ring.precision import working_bits
from orderconds.ring.protocol import Element


class Jets:
    """The ring whose elements enclose the value and the gradient of a function of ``width`` variables. For
    each variable, a ball of values is given (:meth:`variable`). The enclosures hold for all values in these
    balls.

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
        self.zero = Jet(arb(0), width)
        self.one = Jet(arb(1), width)

    def __repr__(self) -> str:
        return self.name

    def variable(self, place: int, value: arb) -> Jet:
        """Return the jet of the variable with index ``place``."""
        return Jet(value, self.width, arb_mat(1, self.width, [int(k == place) for k in range(self.width)]))

    def constant(self, value: arb) -> Jet:
        """Return a constant: a number with gradient zero."""
        return Jet(value, self.width)

    def rational(self, p: int, q: int = 1) -> Jet:
        """Return p/q."""
        return Jet(arb(fmpq(p, q)), self.width)

    def root(self, x: Jet, index: int) -> Jet:
        """Return the real ``index``-th root of x.

        Raises ValueError if the ball ``x.value`` contains zero. For an even ``index``, also raises ValueError
        if the ball contains a negative number.
        """
        negative = x.value < 0
        if not (x.value > 0 or (negative and index % 2)):
            raise ValueError(
                "cannot compute the n-th root of an interval: for even n, the interval must contain only "
                "positive numbers; for odd n, the interval must not contain zero"
            )
        value = -((-x.value).root(index)) if negative else x.value.root(index)
        return Jet(value, x.width, _scaled(x.slopes, value / (x.value * index)))

    def named_root(self, minpoly: Sequence[Fraction], near: Fraction, unit: Fraction, name: str) -> Jet:
        """Return the only real root of ``minpoly`` (ascending coefficients) in [near - unit, near + unit].

        Raises ValueError if the interval does not contain exactly one root.
        """
        return self.constant(Balls(working_bits()).named_root(minpoly, near, unit, name).value)

    def is_zero(self, x: Jet) -> bool | None:
        """Return True if the value and the gradient are exactly zero, and False if the enclosure of the value
        does not contain zero. Return None in all other cases."""
        if not x.value.contains(0):
            return False
        flat = x.slopes is None or all(g.is_zero() for g in x.gradient)
        return True if x.value.is_zero() and flat else None

    def text(self, x: Jet) -> str:
        """Return the ball ``x.value`` as text: the midpoint and the radius."""
        return str(x.value.str(15))

    def key(self, x: Jet) -> tuple[str, ...]:
        """Return the enclosures of the value and of the partial derivatives as texts."""
        return (str(x.value), *map(str, x.gradient))

    def approximate(self, x: Jet, digits: int = 20) -> str:
        """Return the midpoint of the enclosure of the value, as a decimal."""
        return str(x.value.mid().str(digits, radius=False))


class Jet:
    """Enclosures of the value and of the gradient of a function. All enclosures are balls of python-flint's
    type ``arb``.

    ``slopes`` is the gradient as a matrix of one row, or None for the zero gradient.
    """

    __slots__ = ("slopes", "value", "width")

    def __init__(self, value: arb, width: int, slopes: arb_mat | None = None) -> None:
        self.value, self.width, self.slopes = value, width, slopes

    @property
    def gradient(self) -> tuple[arb, ...]:
        """The partial derivatives with respect to all variables."""
        return (arb(0),) * self.width if self.slopes is None else tuple(self.slopes.entries())

    def __repr__(self) -> str:
        return f"Jet({self.value.str(12)})"

    def __add__(self, other: Element) -> Jet:
        if not isinstance(other, Jet):
            return Jet(self.value + other, self.width, self.slopes)
        return Jet(self.value + other.value, self.width, _added(self.slopes, other.slopes))

    __radd__ = __add__

    def __neg__(self) -> Jet:
        return Jet(-self.value, self.width, None if self.slopes is None else -self.slopes)

    def __sub__(self, other: Element) -> Jet:
        return self.__add__(-other)

    def __rsub__(self, other: Element) -> Jet:
        return (-self).__add__(other)

    def __mul__(self, other: Element) -> Jet:
        if not isinstance(other, Jet):
            return Jet(self.value * other, self.width, _scaled(self.slopes, other))
        x, y = self.value, other.value
        return Jet(x * y, self.width, _added(_scaled(self.slopes, y), _scaled(other.slopes, x)))

    __rmul__ = __mul__

    def reciprocal(self) -> Jet:
        """Return 1/x for this element x. Raises ZeroDivisionError if the enclosure of x contains zero."""
        if self.value.contains(0):
            raise ZeroDivisionError("division by a ball that contains zero")
        value = 1 / self.value
        return Jet(value, self.width, _scaled(self.slopes, -value * value))

    def __truediv__(self, other: Element) -> Jet:
        if not isinstance(other, Jet):
            return self.__mul__(1 / arb(other))
        return self.__mul__(other.reciprocal())

    def __rtruediv__(self, other: Element) -> Jet:
        return self.reciprocal().__mul__(other)

    def __pow__(self, n: int) -> Jet:
        base, n = (self, n) if n >= 0 else (self.reciprocal(), -n)
        result = Jet(arb(1), self.width)
        for _ in range(n):
            result = result * base
        return result


def _scaled(slopes: arb_mat | None, factor: Element) -> arb_mat | None:
    return None if slopes is None else slopes * factor


def _added(one: arb_mat | None, other: arb_mat | None) -> arb_mat | None:
    return other if one is None else one if other is None else one + other
