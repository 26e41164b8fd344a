"""An arithmetic that estimates how rounding errors change a result.

A difference of equal numbers is rarely zero in floating-point arithmetic. To decide whether a computed number
is zero, one must know the size of the numbers that cancelled. A scalar of this arithmetic is therefore a
value with a size. If each operation has the relative error eps, the value has an error of about eps times the
size (first-order running error analysis: N. Higham, *Accuracy and Stability of Numerical Algorithms*, section
3.3). The size of a number that is exactly zero is zero.

A change of units multiplies a value and its size by the same factor. Therefore a decision does not depend on
the units of the numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from codegen.ir.domain import PreciseDomain, Scalar
from codegen.ir.number import Number

GUARD_DIGITS = 12
"""The number of decimal digits that are ignored in the decision whether a number x is zero.

Let s be an estimate of the size of the numbers that cancelled in the computation of x (:class:`Sized`), and
let ``digits`` be the number of decimal digits of the computation. Then x is zero up to rounding if
|x| <= s * 10^(GUARD_DIGITS - digits). The sizes are estimates, because the errors of matrix exponentials and
inverses are not known exactly. The factor 10^12 is a wide margin for these errors. With 40 digits, 28 digits
remain for the decision.
"""

FACTORS = 618034, 1000003
"""The numbers p and q in the factors t_k = 1 + (p k mod q)/q.

If argument k of a vector function has the size s_k (:class:`Sized`), a difference quotient changes this
argument by t_k s_k times the step. The number q is prime, so the factors of the first q arguments are
different. The quotient p/q is close to the golden ratio 0.618..., so the factors of neighbouring arguments
are not close together.
"""


@dataclass(frozen=True, slots=True)
class Sized:
    """A number with a size. Rounding errors change ``value`` by about ``size`` times the relative precision.

    ``size`` is not negative. Both numbers are mpmath numbers of one context. A plain number in an operation
    has its absolute value as size.
    """

    value: Scalar
    size: Scalar

    def __add__(self, other: Scalar) -> Sized:
        b = _sized(other)
        return Sized(self.value + b.value, self.size + b.size)

    __radd__ = __add__

    def __sub__(self, other: Scalar) -> Sized:
        b = _sized(other)
        # The sizes are added, so the size remains if the values cancel.
        return Sized(self.value - b.value, self.size + b.size)

    def __rsub__(self, other: Scalar) -> Sized:
        return _sized(other) - self

    def __mul__(self, other: Scalar) -> Sized:
        b = _sized(other)
        # Terms of second order are neglected.
        return Sized(self.value * b.value, abs(self.value) * b.size + self.size * abs(b.value))

    __rmul__ = __mul__

    def __truediv__(self, other: Scalar) -> Sized:
        b = _sized(other)
        value = self.value / b.value
        return Sized(value, (self.size + abs(value) * b.size) / abs(b.value))

    def __rtruediv__(self, other: Scalar) -> Sized:
        return _sized(other) / self

    def __neg__(self) -> Sized:
        return Sized(-self.value, self.size)

    def __abs__(self) -> Sized:
        return Sized(abs(self.value), self.size)


def _sized(x: Scalar) -> Sized:
    return x if isinstance(x, Sized) else Sized(x, abs(x))


class RoundingDomain:
    """The arithmetic of pairs (value, size) of mpmath numbers with ``digits`` decimal digits.

    A value has a rounding error of about eps * size, where eps is the relative precision (:class:`Sized`).
    The operations compute the same values and raise the same errors as the operations of
    :class:`codegen.ir.domain.PreciseDomain`.
    """

    def __init__(self, h: Scalar, digits: int = 50) -> None:
        self.plain = PreciseDomain(h, digits)
        self.context = self.plain.context
        self.h = _sized(self.plain.h)
        # With this increment, about half of the digits of the difference quotients in ``_moved`` are correct.
        self._shift = self.plain.rational(1, 10 ** (digits // 2))
        self._share = self.plain.rational(1, 10 ** (digits - GUARD_DIGITS))

    def scalar(self, x: Scalar) -> Sized:
        """Convert an mpmath number of any context to a scalar of this domain."""
        return _sized(self.context.mpf(x))

    def number(self, value: Number) -> Sized:
        """Return the number ``value``, rounded to the precision of this domain."""
        return _sized(self.plain.number(value))

    def rational(self, p: int, q: int = 1) -> Sized:
        """Return p/q, rounded to the precision of this domain."""
        return _sized(self.plain.rational(p, q))

    def rounding(self, x: Sized) -> Scalar:
        """Return a bound for the rounding errors of ``x``.

        If the absolute value of ``x`` is at most this bound, ``x`` is zero up to rounding
        (:data:`GUARD_DIGITS`).
        """
        return self._share * x.size

    def call(self, function: str, *args: Sized) -> Sized:
        """Return the value of a scalar function f, with its size (:class:`Sized`).

        The size is |f| + sum_i |df/dx_i| s_i, where s_i is the size of the argument x_i. A relative rounding
        error eps in each number changes f by about eps times the size.
        """
        values = [x.value for x in args]
        value = self.plain.call(function, *values)
        size = abs(value)
        for k, x in enumerate(args):
            # An argument of size 0 is exactly zero. It has no rounding error and adds nothing to ``size``.
            if x.size:

                def along(step: Scalar, k: int = k, x: Sized = x) -> tuple[Scalar, ...]:
                    return (
                        self.plain.call(function, *values[:k], x.value + step * x.size, *values[k + 1 :]),
                    )

                size = size + self._moved(along, (value,))[0]
        return Sized(value, size)

    def vector(self, function: str, args: Sequence[Sized]) -> tuple[Sized, ...]:
        """Return the results of a vector function, with their sizes (:class:`Sized`).

        The size of a result r is |r| + |q|, where q is a difference quotient that estimates the effect of the
        rounding errors of the arguments on r. In the difference quotient, all arguments change at the same
        time, because one difference quotient for each argument would be expensive. Argument k changes by its
        size times a factor that depends on k (:data:`FACTORS`). With equal factors, the changes of x and y
        could cancel in a result such as x - y.
        """
        values = [x.value for x in args]
        results = self.plain.vector(function, values)

        def along(step: Scalar) -> tuple[Scalar, ...]:
            multiplier, modulus = FACTORS
            factors = (step * (modulus + multiplier * k % modulus) / modulus for k in range(len(args)))
            return self.plain.vector(
                function, [x.value + t * x.size for x, t in zip(args, factors, strict=True)]
            )

        sizes = self._moved(along, results)
        return tuple(Sized(x, abs(x) + s) for x, s in zip(results, sizes, strict=True))

    def settled(self, old: Sequence[Sized], new: Sequence[Sized], previous: Scalar) -> tuple[bool, Scalar]:
        """Return the pair (converged, change), see :meth:`codegen.ir.domain.Domain.settled`."""
        return self.plain.settled([x.value for x in old], [x.value for x in new], previous)

    def _moved(self, along: Callable[[Scalar], tuple[Scalar, ...]], values: Sequence[Scalar]) -> list[Scalar]:
        """Estimate |f'(0)| for each component f of the function ``along``.

        ``values`` contains f(0) for each component f.
        """
        # At the edge of its domain, such as 1 for acos, a function has values on one side only.
        for step in (self._shift, -self._shift):
            try:
                moved = along(step)
            except (ArithmeticError, ValueError):
                continue
            if all(isinstance(x, self.context.mpf) and self.context.isfinite(x) for x in moved):
                return [abs(a - b) / self._shift for a, b in zip(moved, values, strict=True)]
        # Neither step gave finite real numbers, so there is no difference quotient. The numbers |f(0)| are
        # returned as rough estimates of |f'(0)|.
        return [abs(x) for x in values]
