"""Numbers for the execution of emitted text: Taylor series in h with balls of 300 bits as coefficients.

A digit of the text enters as the double that a compiler reads, which is an exact dyadic number. So the
series of a step belongs to the digits that are printed, without rounding errors of double arithmetic.
Comparisons look at the value at h = 0. A pole at h = 0, as in a quotient by h^2, is a negative power.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TypeAlias

from flint import arb, arb_series, ctx, fmpq

from codegen.ir.number import Number
from orderconds.ring.precision import precision

BITS = 300
MARGIN = 5
"""Powers of h beyond the order: a quotient of two series that vanish at h = 0 loses as many."""
NOTHING = arb(2) ** -200
"""Coefficients below it are rounding errors of the balls."""
POLE = arb(2) ** -40
"""A pole at h = 0 with a smaller coefficient comes from the rounding of digits, and is dropped."""

Real: TypeAlias = "Taylor | float"


@contextmanager
def truncated(order: int) -> Iterator[None]:
    """Compute with series up to h^order, and some more powers, in this block."""
    before = ctx.cap
    ctx.cap = order + 1 + MARGIN
    try:
        with precision(BITS):
            yield
    finally:
        ctx.cap = before


def sweeps() -> int:
    """Return a number of sweeps after which no coefficient changes: each fixes one more power of h."""
    return int(ctx.cap) + 8


class Taylor:
    """h^``shift`` times a truncated series, ``shift`` <= 0; arithmetic with integers and doubles is exact."""

    __slots__ = ("series", "shift")

    def __init__(self, series: arb_series, shift: int = 0) -> None:
        # A pole whose coefficients vanish is no pole.
        while shift < 0 and abs(series[0]) < NOTHING:
            series, shift = _without(series, 1), shift + 1
        self.series, self.shift = _times_power(series, max(shift, 0)), min(shift, 0)

    @classmethod
    def of(cls, x: Real | arb) -> Taylor:
        """Return a constant."""
        return x if isinstance(x, Taylor) else cls(arb_series([x if isinstance(x, arb) else arb(x)]))

    @classmethod
    def step(cls) -> Taylor:
        """Return the series h."""
        return cls(arb_series([0, 1]))

    def coefficients(self) -> list[arb]:
        """Return all coefficients that are kept, from that of h^shift."""
        found = self.series.coeffs()
        return [*found, *[arb(0)] * (int(ctx.cap) - len(found))]

    def coefficient(self, power: int) -> arb:
        """Return the coefficient of a power of h."""
        return self.series[power - self.shift]

    def constant(self) -> arb:
        """Return the leading coefficient, at h = 0 if there is no pole; a rounding error is zero."""
        value = self.series[0]
        return arb(0) if abs(value) < NOTHING else value.mid()

    def raised(self, shift: int) -> arb_series:
        """Return the series that belongs to a lower power in front."""
        return _times_power(self.series, self.shift - shift)

    def __add__(self, other: Real) -> Taylor:
        other = Taylor.of(other)
        shift = min(self.shift, other.shift)
        return Taylor(self.raised(shift) + other.raised(shift), shift)

    __radd__ = __add__

    def __neg__(self) -> Taylor:
        return Taylor(-self.series, self.shift)

    def __pos__(self) -> Taylor:
        return self

    def __sub__(self, other: Real) -> Taylor:
        return self + -Taylor.of(other)

    def __rsub__(self, other: Real) -> Taylor:
        return Taylor.of(other) + -self

    def __mul__(self, other: Real) -> Taylor:
        other = Taylor.of(other)
        return Taylor(self.series * other.series, self.shift + other.shift)

    __rmul__ = __mul__

    def __truediv__(self, other: Real) -> Taylor:
        return _divided(self, Taylor.of(other))

    def __rtruediv__(self, other: Real) -> Taylor:
        return _divided(Taylor.of(other), self)

    def __pow__(self, n: int) -> Taylor:
        return math.prod([self] * n, start=Taylor.of(1)) if n >= 0 else Taylor.of(1) / self**-n

    def __abs__(self) -> Taylor:
        return -self if self < 0 else self

    def __lt__(self, other: Real) -> bool:
        return bool((self - other).constant() < 0)

    def __gt__(self, other: Real) -> bool:
        return bool((self - other).constant() > 0)

    def __le__(self, other: Real) -> bool:
        return not self > other

    def __ge__(self, other: Real) -> bool:
        return not self < other

    def __bool__(self) -> bool:
        return any(not abs(x) < NOTHING for x in self.coefficients())


def _times_power(series: arb_series, n: int) -> arb_series:
    return arb_series([*[arb(0)] * n, *series.coeffs()]) if n else series


def _without(series: arb_series, n: int) -> arb_series:
    return arb_series(series.coeffs()[n:])


def _divided(a: Taylor, b: Taylor) -> Taylor:
    power = next((k for k, x in enumerate(b.coefficients()) if not abs(x) < NOTHING), None)
    if power is None:
        raise ZeroDivisionError("division by a series that vanishes")
    kept = [arb(0) if k < power and abs(x) < POLE else x for k, x in enumerate(a.series.coeffs())]
    return Taylor(arb_series(kept) / _without(b.series, power), a.shift - b.shift - power)


def is_finite(x: Real) -> bool:
    """Return whether all coefficients are finite."""
    return all(c.is_finite() for c in Taylor.of(x).coefficients())


def _entire(first: int, z: Taylor, step: int) -> Taylor:
    """Return sum_j z^j/(step j + first)! to the working precision."""
    total = term = Taylor.of(arb(1) / math.factorial(first))
    n = first
    while any(not abs(x) < arb(2) ** -(BITS + 20) for x in term.coefficients()):
        term = term * z / math.prod(range(n + 1, n + step + 1))
        total, n = total + term, n + step
    return total


def stumpff(k: int, z: Real) -> Taylor:
    """Return c_k(z) = sum_j (-z)^j/(2j+k)!."""
    return _entire(k, -Taylor.of(z), 2)


def slope(k: int, z: Real) -> Taylor:
    """Return the derivative of c_k, which is (k c_{k+2} - c_{k+1})/2."""
    return (k * stumpff(k + 2, z) - stumpff(k + 1, z)) / 2


def curvature(k: int, z: Real) -> Taylor:
    """Return the second derivative of c_k."""
    return (k * (k + 2) * stumpff(k + 4, z) - (2 * k + 1) * stumpff(k + 3, z) + stumpff(k + 2, z)) / 4


def quotient(a: Real, b: Real) -> Taylor:
    """Return a/b, and 0 where b vanishes."""
    return Taylor.of(a) / b if Taylor.of(b) else Taylor.of(0)


def _of_series(name: str) -> Callable[[Real], Taylor]:
    return lambda x: Taylor(getattr(Taylor.of(x).series, name)())


ELEMENTARY: dict[str, Callable[[Real], Taylor]] = {
    name: _of_series(name) for name in ("sqrt", "sin", "cos", "exp", "log")
}


class TaylorDomain:
    """The domain of these series, for the interpreter and for the exact flow of a scene."""

    def __init__(self) -> None:
        self.h = Taylor.step()
        self.patience = 4 * sweeps()

    def number(self, value: Number) -> Taylor:
        """Return the exact number, enclosed to the working precision."""
        if value.is_rational:
            fraction = value.fraction()
            return self.rational(fraction.numerator, fraction.denominator)
        return Taylor.of(arb(value.ring.approximate(value.element, 100)))

    def rational(self, p: int, q: int = 1) -> Taylor:
        """Return p/q."""
        return Taylor.of(arb(fmpq(p, q)))

    def call(self, function: str, *args: Real) -> Taylor:
        """Return the value of a function."""
        if function in ELEMENTARY:
            return ELEMENTARY[function](args[0])
        if function == "quotient":
            return quotient(*args)
        if "curvature" in function:
            return curvature(int(function[-1]), args[0])
        return (slope if "slope" in function else stumpff)(int(function[-1]), args[0])

    def settled(self, old: Sequence[Taylor], new: Sequence[Taylor], previous: int | None) -> tuple[bool, int]:
        """Return whether the last change is a rounding error, and the number of sweeps so far."""
        kept = range(int(ctx.cap) - MARGIN)
        changes = (a - b for a, b in zip(old, new, strict=True))
        return all(abs(x.coefficient(k)) < NOTHING for x in changes for k in kept), 1 + (previous or 0)
