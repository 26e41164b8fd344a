"""Rigorous enclosures of real numbers by balls of the library Arb, with a fixed working precision.

A ball is an interval, given by a midpoint and a radius. The ball encloses the exact value of a number.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from flint import arb, fmpq, fmpz

from orderconds.ring.decimals import endpoints, rational_decimal, rational_float
from orderconds.ring.precision import precision
from orderconds.ring.protocol import Element
from orderconds.ring.roots import isolate


class Balls:
    """The ring of real balls with ``bits`` bits of precision. Two rings are equal if their ``bits`` are
    equal.

    >>> R = Balls(128)
    >>> third = R.rational(1, 3)
    >>> R.is_zero(third - third) is None, R.is_zero(third), R.is_zero(R.zero)
    (True, False, True)
    """

    def __init__(self, bits: int = 256) -> None:
        self.bits = bits
        self.name = f"balls({bits})"
        self.zero = Ball(arb(0), bits)
        self.one = Ball(arb(1), bits)

    def __repr__(self) -> str:
        return self.name

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Balls) and other.bits == self.bits

    def __hash__(self) -> int:
        return self.bits

    def rational(self, p: int, q: int = 1) -> Ball:
        """Return a ball around p/q. The radius is zero if p/q is a binary fraction of at most ``bits``
        bits."""
        with precision(self.bits):
            return Ball(arb(fmpq(p, q)), self.bits)

    def around(self, centre: fmpq, radius: fmpq | int = 0) -> Ball:
        """Return a ball that contains [centre - radius, centre + radius]."""
        with precision(self.bits):
            return Ball(arb(centre) + arb(0, arb(radius)), self.bits)

    def constant(self, value: Fraction, unit: Fraction = Fraction(0)) -> Ball:
        """Return a ball that contains the interval [value - unit, value + unit]."""
        centre, radius = (fmpq(x.numerator, x.denominator) for x in (value, unit))
        return self.around(centre, radius)

    def root(self, x: Ball, index: int) -> Ball:
        """Return the real ``index``-th root of x.

        If ``index`` is even, all numbers in the ball x must be nonnegative. If ``index`` is odd, the numbers
        must be all nonnegative or all negative. Otherwise ValueError is raised.
        """
        with precision(self.bits):
            if x.value >= 0:
                return Ball(x.value.root(index), self.bits)
            if index % 2 == 0:
                raise ValueError(
                    "cannot compute an even root of a number that is not proved to be nonnegative"
                )
            if x.value < 0:
                return Ball(-((-x.value).root(index)), self.bits)
        raise ValueError("cannot compute a root of a number whose sign is not proved")

    def named_root(self, minpoly: Sequence[Fraction], near: Fraction, unit: Fraction, name: str) -> Ball:
        """Return the only real root of ``minpoly`` in [near - unit, near + unit]. Raises ValueError if the
        interval does not contain exactly one root."""
        coefficients = [fmpq(c.numerator, c.denominator) for c in minpoly]
        centre, radius = (fmpq(x.numerator, x.denominator) for x in (near, unit))
        return Ball(isolate(coefficients, centre, radius)[1](self.bits), self.bits)

    def size(self, x: Ball) -> int:
        """Return a measure of the size of x: the larger of abs(e) and abs(f), where e is the binary exponent
        of the midpoint and f is the binary exponent of the radius."""
        return max(_magnitude(x.value.mid()), _magnitude(x.value.rad()))

    def enclose(self, x: arb) -> Ball:
        """Return the flint ball x as an element of this ring."""
        return Ball(x, self.bits)

    def is_zero(self, x: Ball) -> bool | None:
        """Return True if the ball is the exact number zero, and False if the ball does not contain zero.
        Return None if the ball contains zero and other numbers."""
        if not x.value.contains(0):
            return False
        return True if x.value.is_zero() else None

    def sign(self, x: Ball) -> int | None:
        """Return -1 if all numbers in the ball are negative, 1 if all are positive, and 0 if the ball is the
        exact number zero. Return None in all other cases."""
        if x.value.contains(0):
            return 0 if x.value.is_zero() else None
        return 1 if x.value > 0 else -1

    def text(self, x: Ball) -> str:
        """Return x as the text of a coefficient in a tableau file.

        A ball with radius zero is written exactly. Otherwise the decimal ends with ``~``, which means an
        error of at most one unit in the last digit.

        >>> R = Balls(64)
        >>> R.text(R.rational(-3, 8)), R.text(R.around(fmpq(81772, 100000), fmpq(1, 100000)))
        ('-0.375', '0.8177~')
        """
        low, high = endpoints(x.value)
        middle = (low + high) / 2
        if low == high:
            return rational_decimal(middle, 4 + int(middle.p).bit_length() + int(middle.q).bit_length())
        places = _supported_places(high - middle)
        unit = fmpq(10) ** -places
        figures = int((middle / unit).round())
        if places <= 0:
            return f"{figures}~*10^{-places}"
        sign, body = ("-" if figures < 0 else ""), str(fmpz(abs(figures))).rjust(places + 1, "0")
        return f"{sign}{body[:-places]}.{body[-places:]}~"

    def key(self, x: Ball) -> tuple[int, ...]:
        """Return the numerators and denominators of the exact end points of the ball."""
        low, high = endpoints(x.value)
        return int(low.p), int(low.q), int(high.p), int(high.q)

    def approximate(self, x: Ball, digits: int = 20) -> str:
        """Return the midpoint of the ball as a decimal with ``digits`` significant digits."""
        low, high = endpoints(x.value)
        return rational_decimal((low + high) / 2, digits)

    def nearest_float(self, x: Ball) -> float:
        """Return the double nearest to the midpoint."""
        low, high = endpoints(x.value)
        return rational_float((low + high) / 2)

    def radius(self, x: Ball, digits: int = 3) -> str:
        """Return the radius of the ball as a decimal with ``digits`` significant digits."""
        low, high = endpoints(x.value)
        return rational_decimal((high - low) / 2, digits)

    def ball(self, x: Ball, bits: int) -> arb:
        """Return the flint ball of x. ``bits`` is ignored, because the precision of this ring is fixed."""
        return x.value


class Enclosures:
    """The ring of real balls, whose elements have python-flint's type ``arb``.

    The caller sets the working precision in a block ``with precision(bits)``. Arithmetic is faster than in
    :class:`Balls`. Every operation gives the same ball as in :class:`Balls`, with one exception: division by
    a ball that contains zero returns a ball that is not finite.

    >>> with precision(128):
    ...     R = Enclosures(128)
    ...     third = R.rational(1, 3)
    >>> R.is_zero(R.zero), R.is_zero(third)
    (True, False)
    """

    def __init__(self, bits: int) -> None:
        self.bits = bits
        self.name = f"balls({bits})"
        self.zero = arb(0)
        self.one = arb(1)

    def rational(self, p: int, q: int = 1) -> arb:
        """Return a ball around p/q. The radius is zero if p/q can be represented at the working precision."""
        return arb(fmpq(p, q))

    def is_zero(self, x: arb) -> bool | None:
        """Return True if the ball is the exact number zero, and False if the ball does not contain zero.
        Return None if the ball contains zero and other numbers."""
        if x.is_zero():
            return True
        return None if x.contains(0) else False

    def text(self, x: arb) -> str:
        """Return x as the text of a coefficient in a tableau file, like :meth:`Balls.text`."""
        return Balls(self.bits).text(Ball(x, self.bits))

    def key(self, x: arb) -> tuple[int, ...]:
        """Return the numerators and denominators of the exact end points of the ball."""
        return Balls(self.bits).key(Ball(x, self.bits))

    def approximate(self, x: arb, digits: int = 20) -> str:
        """Return the midpoint of the ball as a decimal with ``digits`` significant digits."""
        return Balls(self.bits).approximate(Ball(x, self.bits), digits)


def _magnitude(x: arb) -> int:
    # abs(x) would be rounded to the working precision.
    mantissa, exponent = x.man_exp()
    return abs(int(abs(mantissa).bit_length()) + int(exponent))


def _supported_places(radius: fmpq) -> int:
    """Return the largest integer d with 10^-d >= 2 ``radius``.

    The midpoint of a ball, rounded to d decimal places, is then within 10^-d of each number in the ball.
    """
    # ``radius.p`` and ``radius.q`` stay flint integers, because ``str`` of a Python integer is limited to
    # 4300 digits.
    places = len(str(radius.q)) - len(str(radius.p))
    while fmpq(10) ** -places < 2 * radius:
        places -= 1
    return places


class Ball:
    """A real number enclosed by the flint ball ``value``. Arithmetic has a precision of ``bits`` binary
    digits."""

    __slots__ = ("bits", "value")

    def __init__(self, value: arb, bits: int) -> None:
        self.value = value
        self.bits = bits

    def __repr__(self) -> str:
        return f"Ball({self.value.str(12)})"

    def _other(self, other: object) -> Element:
        if isinstance(other, Ball):
            return other.value
        return other if isinstance(other, int | fmpq) else NotImplemented

    def __add__(self, other: object) -> Ball:
        if (y := self._other(other)) is NotImplemented:
            return NotImplemented
        with precision(self.bits):
            return Ball(self.value + y, self.bits)

    __radd__ = __add__

    def __sub__(self, other: object) -> Ball:
        if (y := self._other(other)) is NotImplemented:
            return NotImplemented
        with precision(self.bits):
            return Ball(self.value - y, self.bits)

    def __rsub__(self, other: object) -> Ball:
        if (y := self._other(other)) is NotImplemented:
            return NotImplemented
        with precision(self.bits):
            return Ball(y - self.value, self.bits)

    def __mul__(self, other: object) -> Ball:
        if (y := self._other(other)) is NotImplemented:
            return NotImplemented
        with precision(self.bits):
            return Ball(self.value * y, self.bits)

    __rmul__ = __mul__

    def __truediv__(self, other: object) -> Ball:
        if (y := self._other(other)) is NotImplemented:
            return NotImplemented
        with precision(self.bits):
            return _finite(self.value / y, self.bits)

    def __rtruediv__(self, other: object) -> Ball:
        if (y := self._other(other)) is NotImplemented:
            return NotImplemented
        with precision(self.bits):
            return _finite(y / self.value, self.bits)

    def __neg__(self) -> Ball:
        with precision(self.bits):
            return Ball(-self.value, self.bits)

    def __pow__(self, n: int) -> Ball:
        with precision(self.bits):
            return _finite(self.value**n, self.bits)

    def __eq__(self, other: object) -> bool:
        """Return True if two balls have the same end points. The two real numbers that the balls enclose may
        still differ."""
        return isinstance(other, Ball) and endpoints(self.value) == endpoints(other.value)

    def __hash__(self) -> int:
        return hash(Balls(self.bits).key(self))

    def __float__(self) -> float:
        return Balls(self.bits).nearest_float(self)


def _finite(x: arb, bits: int) -> Ball:
    """Return a finite flint ball as a :class:`Ball`. Raises ZeroDivisionError if the flint ball is not
    finite."""
    if not x.is_finite():
        raise ZeroDivisionError("division by a ball that contains zero")
    return Ball(x, bits)
