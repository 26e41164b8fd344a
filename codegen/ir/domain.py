"""Domains: the number systems in which programs, groups and scenes are evaluated.

Every group operation is implemented once, for all domains: floats, mpmath numbers, truncated power series in
h, and expressions. Evaluation over expressions gives the formulas of emitted code. Scalars support the
arithmetic operators. The domain adds constants, named functions, the step h, and the test whether a
fixed-point iteration has converged.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import Any, Protocol, TypeAlias

from codegen.ir.elementary import ANGLE
from codegen.ir.expr import Expr, Space
from codegen.ir.number import Number
from codegen.ir.selection import Kink, selected, selects, sign_of_number
from codegen.ir.vector_calls import named
from orderconds.ring import PowerSeries
from orderconds.ring.protocol import Ring


class NotConverged(ArithmeticError):
    """Raised if an iteration reaches its limit of sweeps, or computes a number that is not finite."""


# Scalars are float, mpf, series or Expr. These types have the same operators but no common base class, so the
# type is not specified further.
Scalar: TypeAlias = Any
"""A number of one domain. Its type depends on the domain and is known only at run time."""

Value: TypeAlias = Any
"""A value of a variable: a scalar if the variable has the kind Real, otherwise a flat tuple of scalars."""

Values: TypeAlias = tuple[Value, ...]
"""The arguments or the results of an operation."""


class Domain(Protocol):
    """A number system: the creation of scalars and the evaluation of functions. ``h`` is the step size as a
    scalar.
    """

    h: Scalar

    def number(self, value: Number) -> Scalar:
        """Return an exact number as a scalar of this domain, rounded once."""

    def rational(self, p: int, q: int = 1) -> Scalar:
        """Return p/q in this domain."""

    def call(self, function: str, *args: Scalar) -> Scalar:
        """Return the value of a function of :data:`codegen.ir.expr.FUNCTIONS`."""

    def vector(self, function: str, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the results of a vector function (:mod:`codegen.ir.vector_function`)."""

    def settled(self, old: Sequence[Scalar], new: Sequence[Scalar], previous: Scalar) -> tuple[bool, Scalar]:
        """Return two values: True if an iteration has converged, and the size of its last change. The caller
        passes this size as ``previous`` in the next call."""


class Differenced(Domain, Protocol):
    """A domain in which Newton's method can use difference quotients in place of derivatives."""

    def increment(self, x: Scalar) -> Scalar:
        """Return the increment d for the difference quotient (f(x + d) - f(x))/d."""


def stumpff(k: int, z: float) -> float:
    """Return the Stumpff function c_k(z) = sum_j (-z)^j/(2j+k)! for k = 0, ..., 3, and positive or negative
    z.

    For large z the function oscillates, and the error is a few units in the last place of the amplitude. For
    z > 2^52 the result is NaN, as in emitted code.

    >>> stumpff(1, 0.0), stumpff(2, 0.0)
    (1.0, 0.5)
    """
    if z > 2.0**52:
        return math.nan
    if z < 0 and (k < 3 or z < -4):
        root = math.sqrt(-z)
        if k == 0:
            return math.cosh(root)
        if k == 2:
            ratio = math.sinh(root / 2) / (root / 2)
            return ratio * ratio / 2
        ratio = math.sinh(root) / root
        return ratio if k == 1 else (1 - ratio) / z
    if k == 0:
        return math.cos(math.sqrt(z))
    # The formula for c_3 contains sqrt z - sin sqrt z. This difference loses digits if the angle sqrt z is
    # below about 2, so the series is used for these angles.
    if z < (0.5 if k < 3 else 4.0):
        # Horner's rule begins with the highest power. For z < 4 the first omitted term is below 1e-27.
        total, j = 0.0, 14
        while j >= 0:
            total = 1.0 / math.factorial(2 * j + k) - z * total
            j -= 1
        return total
    root = math.sqrt(z)
    if k == 1:
        return math.sin(root) / root
    if k == 2:
        # 1 - cos s is computed as 2 sin^2(s/2), because 1 - cos s would lose digits by cancellation for small
        # s.
        half = math.sin(root / 2)
        return 2 * half * half / z
    return (root - math.sin(root)) / (z * root)


def slope(k: int, z: float) -> float:
    """Return the derivative c_k'(z) of a Stumpff function for k = 1, 2, 3, and positive or negative z.

    The series is used for abs(z) up to 1, else the closed form (c_{k-1} - k c_k)/(2 z).

    >>> slope(2, 0.0) == -1 / 24, slope(3, 0.0) == -1 / 120
    (True, True)
    """
    if abs(z) > 1:
        # Both terms of the closed form tend to 1/(k-1)! as z tends to 0, so they would cancel for small z.
        return (stumpff(k - 1, z) - k * stumpff(k, z)) / (2 * z)
    total = 0.0
    for j in range(12, 0, -1):
        total = -j / math.factorial(2 * j + k) - z * total
    return total


def curvature(k: int, z: float) -> float:
    """Return the second derivative c_k''(z) of a Stumpff function for k = 2, 3 and z >= 0.

    The series is used for z up to 1, else (c_{k-2} - (2 k + 1) c_{k-1} + k (k + 2) c_k)/(2 z)^2.

    >>> curvature(2, 0.0) == 2 / 720
    True
    """
    if abs(z) > 1:
        last = k * (k + 2) * stumpff(k, z)
        return (stumpff(k - 2, z) - (2 * k + 1) * stumpff(k - 1, z) + last) / (4 * z * z)
    total = 0.0
    for j in range(12, 1, -1):
        total = j * (j - 1) / math.factorial(2 * j + k) - z * total
    return total


class FloatDomain:
    """IEEE double precision. If a fixed-point iteration has not converged after ``patience`` sweeps, Newton's
    method replaces it."""

    patience = 40

    def __init__(self, h: float) -> None:
        self.h = h

    def number(self, value: Number) -> float:
        """Return the nearest double."""
        return float(value)

    def rational(self, p: int, q: int = 1) -> float:
        """Return p/q, rounded once, as a double."""
        return float(Fraction(p, q))

    def call(self, function: str, *args: float) -> float:
        """Evaluate a function with the math library. Stumpff functions are evaluated by :func:`stumpff`."""
        if "stumpff" in function:
            return stumpff(int(function[-1]), args[0])
        if "slope" in function:
            return slope(int(function[-1]), args[0])
        if "curvature" in function:
            return curvature(int(function[-1]), args[0])
        if function == "quotient":
            return args[0] / args[1] if args[1] else 0.0
        if selects(function):
            return float(selected(self, function, args, sign_of_number))
        result: float = getattr(math, function)(*args)
        return result

    def vector(self, function: str, args: Sequence[float]) -> tuple[float, ...]:
        """Return the results of a vector function, with the operations of emitted code."""
        return named(function).in_doubles(args)

    def settled(self, old: Sequence[float], new: Sequence[float], previous: Scalar) -> tuple[bool, float]:
        """Return two values: True if the changes are at rounding level, and the size of the last change."""
        change = max(abs(a - b) for a, b in zip(old, new, strict=True))
        # Comparisons with a NaN are false, so without this test the iteration would continue up to its limit
        # of sweeps.
        if not math.isfinite(change):
            raise NotConverged("a fixed-point iteration computed a number that is not finite")
        # The change is compared with the largest unknown, because rounding errors in sums with large terms
        # also affect the small unknowns.
        scale = max(map(abs, old), default=0.0)
        before = previous or 0.0
        # The rate of convergence is about change/before, so the remaining error is about change^2/before.
        # This error must be below half a unit in the last place. The rate is computed from only two changes
        # and may be wrong, so the change itself must also be small.
        if change <= 2.0**-48 * scale and change * change <= 2.0**-53 * scale * before:
            return True, change
        # Small changes that no longer decrease are rounding errors. Large changes that no longer decrease are
        # a sign of divergence.
        return change == 0.0 or 0 < before <= change <= 2.0**-44 * max(1.0, scale), change

    def increment(self, x: float) -> float:
        """Return the increment d for the difference quotient (f(x + d) - f(x))/d."""
        # The square root of the rounding unit balances the rounding and the truncation error of a forward
        # difference.
        return math.ldexp(max(1.0, abs(x)), -26)


LARGEST_BITS = 16384
"""The largest binary exponent of an argument of a function in :class:`PreciseDomain`."""


class PreciseDomain:
    """mpmath numbers with a given number of decimal digits. Each domain has its own mpmath context.
    OverflowError is raised if an argument of a function is 2^:data:`LARGEST_BITS` or more. mpmath numbers do
    not overflow. Without this bound, a divergent iteration would compute the sine of a number with millions
    of digits."""

    def __init__(self, h: Scalar, digits: int = 50) -> None:
        import mpmath

        # mpmath's global context is not changed, because its precision belongs to the caller.
        self.context = mpmath.mp.clone()
        self.context.dps = digits
        self.digits = digits
        self.h = (
            self.context.mpf(h) if not isinstance(h, Fraction) else self.rational(h.numerator, h.denominator)
        )
        # After this number of sweeps without convergence, Newton's method replaces a fixed-point iteration.
        self.patience = 3 * digits

    def number(self, value: Number) -> Scalar:
        """Return the number rounded to this domain's precision."""
        if value.is_rational:
            fraction = value.fraction()
            return self.rational(fraction.numerator, fraction.denominator)
        # Five guard digits make the result as accurate as a single rounding.
        return self.context.mpf(value.ring.approximate(value.element, self.digits + 5))

    def rational(self, p: int, q: int = 1) -> Scalar:
        """Return p/q rounded once."""
        return self.context.mpf(p) / q

    def call(self, function: str, *args: Scalar) -> Scalar:
        """Evaluate a function with mpmath. Stumpff functions use their series for arguments up to 1."""
        if function == "quotient":
            return args[0] / args[1] if args[1] else args[0] * 0
        if selects(function):
            return selected(self, function, args, sign_of_number)
        if any(self.context.mag(x) > LARGEST_BITS for x in args):
            raise OverflowError(f"an argument of {function} exceeds 2^{LARGEST_BITS}")
        if "slope" in function:
            return self._slope(int(function[-1]), args[0])
        if "curvature" in function:
            return self._curvature(int(function[-1]), args[0])
        if "stumpff" not in function:
            return getattr(self.context, function)(*args)
        k, z = int(function[-1]), args[0]
        if z > 1:
            # For z > 1 the closed forms lose at most three bits by cancellation.
            root = self.context.sqrt(z)
            sine = self.context.sin(root)
            closed = (self.context.cos(root), sine / root, 2 * (self.context.sin(root / 2) / root) ** 2)
            return closed[k] if k < 3 else (root - sine) / (root * z)
        total, j = self.context.mpf(0), 0
        term = self.context.mpf(1) / math.factorial(k)
        # Terms below eps/1024, where eps is the rounding unit, are too small to change the sum.
        while abs(term) > self.context.eps / 1024:
            total += term
            j += 1
            term = -term * z / ((2 * j + k) * (2 * j + k - 1))
        return total

    def vector(self, function: str, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the results of a vector function."""
        return named(function).in_digits(self.context, self.digits, args)

    def _slope(self, k: int, z: Scalar) -> Scalar:
        """Return the derivative c_k'(z) of the Stumpff function c_k. The series is used for abs(z) up to 1,
        else a formula in c_{k-1} and c_k."""
        if abs(z) > 1:
            return (self.call(f"stumpff{k - 1}", z) - k * self.call(f"stumpff{k}", z)) / (2 * z)
        total, j = self.context.mpf(0), 1
        term = -self.context.mpf(1) / math.factorial(k + 2)
        while abs(term) > self.context.eps / 1024:
            total += term
            j += 1
            term = -term * z * j / ((j - 1) * (2 * j + k) * (2 * j + k - 1))
        return total

    def _curvature(self, k: int, z: Scalar) -> Scalar:
        """Return the second derivative c_k''(z) of the Stumpff function c_k. The series is used for abs(z) up
        to 1, else a formula in c_{k-2}, c_{k-1} and c_k."""
        if abs(z) > 1:
            a, b, c = (self.call(f"stumpff{i}", z) for i in (k - 2, k - 1, k))
            return (a - (2 * k + 1) * b + k * (k + 2) * c) / (4 * z * z)
        total, j = self.context.mpf(0), 2
        term = 2 * self.context.mpf(1) / math.factorial(k + 4)
        while abs(term) > self.context.eps / 1024:
            total += term
            j += 1
            term = -term * z * j / ((j - 2) * (2 * j + k) * (2 * j + k - 1))
        return total

    def settled(self, old: Sequence[Scalar], new: Sequence[Scalar], previous: Scalar) -> tuple[bool, Scalar]:
        """Return two values: True if an iteration has converged, and the size of the last change. The
        iteration has converged if the changes are within 2^12 rounding units and no longer decrease."""
        change = max(abs(a - b) for a, b in zip(old, new, strict=True))
        small = change <= 4096 * self.context.eps * max(1, *(abs(a) for a in old))
        # A small change is not sufficient, because the next sweep may give further correct digits. Therefore
        # the changes must also have stopped decreasing.
        return small and (change == 0 or (previous is not None and change >= previous)), change

    def increment(self, x: Scalar) -> Scalar:
        """Return the increment d for the difference quotient (f(x + d) - f(x))/d."""
        return self.context.sqrt(self.context.eps) * max(1, abs(x))


class SeriesDomain:
    """Power series in h over an exact ring, truncated beyond h^order. Local errors are computed exactly in
    this domain."""

    def __init__(self, base: Ring, order: int) -> None:
        self.base, self.order = base, order
        # The coefficients are exact. If all terms of a local error up to h^p are zero, the order p is proved.
        self.ring = PowerSeries(base, order)
        self.h = self.ring.h

    def number(self, value: Number) -> Scalar:
        """Return the constant series of a number of the base field."""
        if value.ring is self.base:
            return self.ring.constant(value.element)
        fraction = value.fraction()
        return self.ring.rational(fraction.numerator, fraction.denominator)

    def rational(self, p: int, q: int = 1) -> Scalar:
        """Return the constant series p/q."""
        return self.ring.rational(p, q)

    def call(self, function: str, *args: Scalar) -> Scalar:
        """Return the value of a function at a series. ArithmeticError is raised if the coefficients of the
        value cannot be computed exactly. Sine, cosine, exponential and similar functions require a series
        without constant term. The function ``quotient`` divides two series. If the divisor begins with h^v,
        the last v coefficients of the quotient are unknown and set to zero.
        """
        z = args[0]
        if function == "quotient":
            return self._quotient(z, args[1])
        if selects(function):
            return selected(self, function, args, self._sign)
        if function == ANGLE:
            return self._angle(z, args[1])
        one = self.ring.one
        starts = {
            "sin": (1, 2, z),
            "cos": (0, 2, one),
            "exp": (0, 1, one),
            "sinh": (1, 2, z),
            "cosh": (0, 2, one),
        }
        # sin, cos and exp of a non-zero algebraic number are transcendental, so no base field contains them.
        if self.base.is_zero(z.coefficients[0]) is not True:
            raise ArithmeticError(f"{function} of a series with a constant term cannot be computed exactly")
        if "slope" in function:
            k = int(function[-1])
            # c_k' = (k c_{k+2} - c_{k+1})/2. The series of c_k below are valid for every k, also for k > 3.
            c, d = (self.call(f"stumpff{k + i}", z) for i in (2, 1))
            return (k * c - d) * self.ring.rational(1, 2)
        if "curvature" in function:
            k = int(function[-1])
            # The formula for c_k'' follows from the rule for c_k', applied twice.
            c, d, e = (self.call(f"stumpff{k + i}", z) for i in (4, 3, 2))
            return (k * (k + 2) * c - (2 * k + 1) * d + e) * self.ring.rational(1, 4)
        if "stumpff" in function:
            k = int(function[-1])
            return self._sum(k, 2, self.ring.rational(1, math.factorial(k)), z)
        if function in ("tan", "tanh"):
            sine, cosine = ("sin", "cos") if function == "tan" else ("sinh", "cosh")
            return self.call(sine, z) / self.call(cosine, z)
        if function in ("atan", "asin"):
            return self._arc(function, z)
        if function not in starts:
            raise ArithmeticError(f"the function {function} has no rule for exact power series")
        k, step, first = starts[function]
        # The signs in ``_sum`` alternate, as for sin and cos. For exp, sinh and cosh the argument is negated,
        # so all signs are equal.
        power = z * z if step == 2 else z
        return self._sum(k, step, first, power if function in ("sin", "cos") else -power)

    def _sign(self, z: Scalar) -> int:
        """Return the sign of a series for small h. :class:`Kink` is raised if the series is zero at h = 0."""
        start = z.coefficients[0]
        if self.base.is_zero(start) is not False:
            raise Kink("the field is not smooth at the initial state")
        return -1 if self.base.approximate(start).startswith("-") else 1

    def _angle(self, y: Scalar, x: Scalar) -> Scalar:
        """Return atan2(y, x) if (x, y) is on the positive x-axis at h = 0. Otherwise ArithmeticError is
        raised, because the angle at h = 0 is not an algebraic number."""
        if self.base.is_zero(y.coefficients[0]) is not True or self._sign(x) < 0:
            raise ArithmeticError("atan2 is exact only at a point of the positive x-axis")
        return self._arc("atan", y / x)

    def vector(self, function: str, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the results of a vector function, exactly."""
        return named(function).over_series(self.ring, args)

    def _arc(self, function: str, z: Scalar) -> Scalar:
        """Return atan z or asin z by its Taylor series.

        Term j of atan z is (-1)^j z^(2j+1)/(2j+1). Term j of asin z is binom(2j, j)/4^j z^(2j+1)/(2j+1).
        """
        total, power = self.ring.zero, z
        for j in range(self.order // 2 + 1):
            factor = Fraction((-1) ** j) if function == "atan" else Fraction(math.comb(2 * j, j), 4**j)
            factor /= 2 * j + 1
            total = total + power * self.ring.rational(factor.numerator, factor.denominator)
            power = power * z * z
        return total

    def _quotient(self, a: Scalar, b: Scalar) -> Scalar:
        """Return a/b, or 0 if all coefficients of b are zero. ArithmeticError is raised if the series a
        begins with a lower power of h than b."""
        # Both series may vanish at h = 0. Their quotient may still have a limit at h = 0.
        power = self.ring.valuation(b)
        if power > self.order:
            return self.ring.zero
        if self.ring.valuation(a) < power:
            raise ArithmeticError("a quotient of power series has a pole at h = 0")
        # Both series are divided by h^power, so the divisor becomes invertible.
        shifted = (self.ring.from_coefficients(x.coefficients[power:]) for x in (a, b))
        return next(shifted) / next(shifted)

    def _sum(self, k: int, step: int, first: Scalar, z: Scalar) -> Scalar:
        """Return the sum of ``first`` (-z)^j k!/(``step`` j + k)! over all j >= 0."""
        total, term, j = first, first, 0
        while True:
            j += 1
            # The divisor is the ratio of successive factorials, so no large factorials are computed.
            divisor = math.prod(range(step * (j - 1) + k + 1, step * j + k + 1))
            term = -(term * z) * self.ring.rational(1, divisor)
            # z has no constant term, so the terms begin with higher and higher powers of h. The loop ends
            # when the whole term is truncated.
            if self.ring.is_zero(term):
                return total
            total = total + term

    def settled(self, old: Sequence[Scalar], new: Sequence[Scalar], previous: Scalar) -> tuple[bool, Scalar]:
        """Return two values: True if no unknown has changed, and None in place of the size of the change."""
        # Each sweep multiplies the error by O(h) and thus gives one more coefficient, so order + 1 sweeps
        # suffice.
        return all(self.ring.is_zero(a - b) for a, b in zip(old, new, strict=True)), None


class ExprDomain:
    """Expressions of one space. The step size ``h`` is a symbol. Iterations are not executed in this domain,
    but become loops of the emitted code."""

    def __init__(self, space: Space | None = None) -> None:
        self.space = space if space is not None else Space()
        self.h = self.space.sym("h")
        # The table of samples is indexed by the node numbers of times, because equal times are the same node.
        self.samples: dict[int, tuple[Expr, dict[str, Expr]]] = {}

    def number(self, value: Number) -> Expr:
        """Return a constant."""
        return self.space.const(value)

    def rational(self, p: int, q: int = 1) -> Expr:
        """Return the constant p/q."""
        return self.space.const(Number.rational(p, q))

    def call(self, function: str, *args: Expr) -> Expr:
        """Return a call node."""
        return self.space.call(function, *args)

    def vector(self, function: str, args: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the results of a vector function as expressions. If the function has no expanded form for
        these arguments, each result is a call node."""
        expanded = named(function).expanded(args)
        return self.space.vector(function, args) if expanded is None else expanded

    def sample(self, names: Sequence[str], t: Expr) -> dict[str, Expr]:
        """Return symbols for run-time inputs at a time. Equal times give the same symbols."""
        # Stages at the same time use the same sample, so the inputs are evaluated only once at each time.
        if t.id not in self.samples:
            k = len(self.samples) + 1
            self.samples[t.id] = t, {name: self.space.sym(f"{name}_at{k}") for name in names}
        return self.samples[t.id][1]

    def settled(self, old: Sequence[Scalar], new: Sequence[Scalar], previous: Scalar) -> tuple[bool, Scalar]:
        """Raise :class:`NotConverged`, because expressions have no values to compare."""
        raise NotConverged("an iteration over expressions has no numbers to compare")
