"""Domains: number types for the steps of integrators and the operations of Lie groups.

The numbers (scalars) of a domain are floats, mpmath numbers, truncated power series in the step size h, or
expressions. All scalars have the operators +, -, * and /. The domain supplies constants, named functions, h,
and a convergence test for iterations.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import Any, Protocol, TypeAlias

from codegen.ir.elementary import ANGLE
from codegen.ir.expr import Expr, Space
from codegen.ir.ieee import ieee
from codegen.ir.number import Number
from codegen.ir.selection import Kink, selected, selects, sign_of_number
from codegen.ir.vector_calls import named
from orderconds.ring import PowerSeries
from orderconds.ring.protocol import Ring


class NotConverged(ArithmeticError):
    """Raised if an iteration does not converge, or if it computes a number that is not finite."""


# The types of scalars (float, mpf, arb, series and Expr) have the same operators, but no common base class.
Scalar: TypeAlias = Any
"""A number (scalar) of a domain. The type of a scalar depends on the domain."""

Value: TypeAlias = Any
"""The value of a variable: a scalar for a real number, otherwise a flat tuple of scalars."""

Values: TypeAlias = tuple[Value, ...]
"""The arguments or the results of an operation."""


class Domain(Protocol):
    """An arithmetic for scalars, for example doubles. The scalar ``h`` is the step size."""

    h: Scalar

    def number(self, value: Number) -> Scalar:
        """Convert an exact number to a scalar of this domain."""

    def rational(self, p: int, q: int = 1) -> Scalar:
        """Return the rational number p/q as a scalar of this domain."""

    def call(self, function: str, *args: Scalar) -> Scalar:
        """Return the value of a scalar function at the arguments ``args``. The names of the functions are in
        :data:`codegen.ir.expr.FUNCTIONS`."""

    def vector(self, function: str, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the results of a vector function (:mod:`codegen.ir.vector_function`)."""

    def settled(self, old: Sequence[Scalar], new: Sequence[Scalar], previous: Scalar) -> tuple[bool, Scalar]:
        """Return the pair (converged, change) after a sweep. The sweep replaces the values ``old`` by
        ``new``. The change is the largest absolute difference of ``old`` and ``new``. ``previous`` is the
        change in the preceding sweep, or None in the first sweep.
        """


class Differenced(Domain, Protocol):
    """A domain in which Newton's method replaces derivatives by difference quotients."""

    def increment(self, x: Scalar, unknowns: Sequence[Scalar]) -> Scalar:
        """Return an increment d for the difference quotient (f(x + d) - f(x))/d. x is one of ``unknowns``."""


def stumpff(k: int, z: float) -> float:
    """Return the Stumpff function c_k(z) = sum_j (-z)^j/(2j+k)! for k = 0, ..., 3 and real z.

    For large z, the computed sine and cosine of sqrt z have errors of about 2^-53 sqrt z. For z > 2^52 the
    result is NaN.

    >>> stumpff(1, 0.0), stumpff(2, 0.0)
    (1.0, 0.5)
    """
    if z > 2.0**52:
        return math.nan
    # For z < 0 the trigonometric functions become hyperbolic, because cos(i x) = cosh x.
    if z < 0 and (k < 3 or z < -4):
        root = math.sqrt(-z)
        if k == 0:
            return ieee("cosh", root)
        if k == 2:
            # The identity cosh r - 1 = 2 sinh^2(r/2) avoids a cancellation for small r.
            ratio = ieee("sinh", root / 2) / (root / 2)
            return ratio * ratio / 2
        ratio = ieee("sinh", root) / root
        return ratio if k == 1 else (1 - ratio) / z
    if k == 0:
        return math.cos(math.sqrt(z))
    # For k = 3 the series is used up to z = 4. For small z, the closed formula c_3 = (s - sin s)/s^3 with
    # s = sqrt z loses digits by cancellation.
    if z < (0.5 if k < 3 else 4.0):
        # The first omitted term of the series is below 1e-27 for abs(z) <= 4.
        total, j = 0.0, 14
        # Horner's rule adds the small terms first, so their rounding errors remain negligible.
        while j >= 0:
            total = 1.0 / math.factorial(2 * j + k) - z * total
            j -= 1
        return total
    root = math.sqrt(z)
    if k == 1:
        return math.sin(root) / root
    if k == 2:
        # In c_2 = (1 - cos s)/s^2, the difference is computed as 2 sin^2(s/2), because the subtraction would
        # lose digits for small s.
        half = math.sin(root / 2)
        return 2 * half * half / z
    return (root - math.sin(root)) / (z * root)


def slope(k: int, z: float) -> float:
    """Return the derivative c_k'(z) of the Stumpff function c_k for k = 1, 2, 3 and real z.

    For z != 0, c_k' is (c_{k-1} - k c_k)/(2 z).

    >>> slope(2, 0.0) == -1 / 24, slope(3, 0.0) == -1 / 120
    (True, True)
    """
    if abs(z) > 1:
        # For small z this formula loses digits, because c_{k-1} and k c_k are both close to 1/(k-1)!.
        return (stumpff(k - 1, z) - k * stumpff(k, z)) / (2 * z)
    total = 0.0
    for j in range(12, 0, -1):
        total = -j / math.factorial(2 * j + k) - z * total
    return total


def curvature(k: int, z: float) -> float:
    """Return the second derivative c_k''(z) of the Stumpff function c_k for k = 2, 3 and z >= 0.

    For z != 0, c_k'' is (c_{k-2} - (2 k + 1) c_{k-1} + k (k + 2) c_k)/(2 z)^2.

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
    """The arithmetic of IEEE doubles. If ``patience`` fixed-point sweeps do not solve implicit equations,
    Newton's method is used. ``size`` is the largest absolute value of a coordinate of the state."""

    patience = 40
    size = 1.0

    def __init__(self, h: float) -> None:
        self.h = h

    def number(self, value: Number) -> float:
        """Return the double that is nearest to ``value``."""
        return float(value)

    def rational(self, p: int, q: int = 1) -> float:
        """Return the double that is nearest to p/q."""
        return float(Fraction(p, q))

    def call(self, function: str, *args: float) -> float:
        """Evaluate a function. As in C, an overflow gives an infinity, and a domain error gives NaN."""
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
        return ieee(function, *args)

    def vector(self, function: str, args: Sequence[float]) -> tuple[float, ...]:
        """Evaluate a vector function in doubles. Emitted code executes the same operations."""
        return named(function).in_doubles(args)

    def settled(self, old: Sequence[float], new: Sequence[float], previous: Scalar) -> tuple[bool, float]:
        """Return the pair (converged, change), see :meth:`Domain.settled`."""
        changes = [abs(a - b) for a, b in zip(old, new, strict=True)]
        change = max(changes)
        # Without this test, an iteration with a NaN could seem to converge, because ``max`` may skip a NaN.
        if not all(map(math.isfinite, changes)):
            raise NotConverged("a fixed-point iteration computed a number that is not finite")
        scale = max(map(abs, old), default=0.0)
        before = previous or 0.0
        # If the changes form a geometric sequence, the next change is change^2/before. The iteration has
        # converged if ``change`` is small and the next change is at most the rounding error 2^-53 * scale.
        if change <= 2.0**-48 * scale and change * change <= 2.0**-53 * scale * before:
            return True, change
        # Small changes that no longer decrease are rounding errors (:mod:`codegen.run.stopping`).
        small = change <= 2.0**-44 * scale or change * abs(self.h) <= 2.0**-47 * self.size
        return change == 0.0 or (0 < before <= change and small), change

    def increment(self, x: float, unknowns: Sequence[float]) -> float:
        """Return the increment for a difference quotient, see :meth:`Differenced.increment`."""
        # For forward differences, a good factor is 2^-26, about the square root of the unit roundoff 2^-53.
        scale = max(self.size / abs(self.h) if self.h else 1.0, *map(abs, unknowns)) or 1.0
        return math.ldexp(max(abs(x), min(1.0, scale)), -26)


LARGEST_BITS = 16384
"""In :class:`PreciseDomain`, arguments of functions must have absolute values below 2^LARGEST_BITS."""


class PreciseDomain:
    """The arithmetic of mpmath numbers with ``digits`` decimal digits.

    If an argument of a function has an absolute value of at least 2^LARGEST_BITS, OverflowError is raised.
    """

    def __init__(self, h: Scalar, digits: int = 50) -> None:
        import mpmath

        # The global context of mpmath is not changed, because other code may use it.
        self.context = mpmath.mp.clone()
        self.context.dps = digits
        self.digits = digits
        self.h = (
            self.context.mpf(h) if not isinstance(h, Fraction) else self.rational(h.numerator, h.denominator)
        )
        # After this number of sweeps without convergence, Newton's method replaces a fixed-point iteration.
        self.patience = 3 * digits

    def number(self, value: Number) -> Scalar:
        """Return the number ``value``, rounded to the precision of this domain."""
        if value.is_rational:
            fraction = value.fraction()
            return self.rational(fraction.numerator, fraction.denominator)
        # The decimal text has five more digits than the result, so the error of the text is negligible.
        return self.context.mpf(value.ring.approximate(value.element, self.digits + 5))

    def rational(self, p: int, q: int = 1) -> Scalar:
        """Return p/q, rounded to the precision of this domain."""
        return self.context.mpf(p) / q

    def call(self, function: str, *args: Scalar) -> Scalar:
        """Evaluate a function with mpmath. A Stumpff function c_k(z) is computed by its power series for
        z <= 1, and by a closed formula for z > 1."""
        if function == "quotient":
            return args[0] / args[1] if args[1] else args[0] * 0
        if selects(function):
            return selected(self, function, args, sign_of_number)
        # For an argument above 2^LARGEST_BITS, the sine would need more than ``LARGEST_BITS`` bits of pi.
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
        # Terms below eps/1024 do not change the digits of the sum.
        while abs(term) > self.context.eps / 1024:
            total += term
            j += 1
            term = -term * z / ((2 * j + k) * (2 * j + k - 1))
        return total

    def vector(self, function: str, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the results of a vector function for mpmath numbers."""
        return named(function).in_digits(self.context, self.digits, args)

    def _slope(self, k: int, z: Scalar) -> Scalar:
        """Return the derivative c_k'(z) of the Stumpff function c_k."""
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
        """Return the second derivative c_k''(z) of the Stumpff function c_k."""
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
        """Return the pair (converged, change) after a sweep, which replaces the values ``old`` by ``new``.
        ``change`` is the largest absolute entry of ``new`` - ``old``, and ``previous`` is the change in the
        preceding sweep. If ``change`` is zero, ``converged`` is true. It is also true if ``change`` has the
        size of rounding errors and no longer decreases (``change`` >= ``previous``).
        """
        change = max(abs(a - b) for a, b in zip(old, new, strict=True))
        small = change <= 4096 * self.context.eps * max(1, *(abs(a) for a in old))
        # While the change decreases from sweep to sweep, a further sweep gives more correct digits.
        return small and (change == 0 or (previous is not None and change >= previous)), change

    def increment(self, x: Scalar, unknowns: Sequence[Scalar]) -> Scalar:
        """Return the increment for a difference quotient, see :meth:`Differenced.increment`."""
        # Without the factor max(1, abs(x)), the sum x + d would be rounded to x for large x.
        return self.context.sqrt(self.context.eps) * max(1, abs(x))


class SeriesDomain:
    """The arithmetic of power series in the step size h over an exact ring ``base``. Powers above h^``order``
    are truncated.
    """

    def __init__(self, base: Ring, order: int) -> None:
        self.base, self.order = base, order
        self.ring = PowerSeries(base, order)
        self.h = self.ring.h

    def number(self, value: Number) -> Scalar:
        """Return a constant series. The number ``value`` must be rational or an element of ``base``."""
        if value.ring is self.base:
            return self.ring.constant(value.element)
        fraction = value.fraction()
        return self.ring.rational(fraction.numerator, fraction.denominator)

    def rational(self, p: int, q: int = 1) -> Scalar:
        """Return the rational number p/q as a constant series."""
        return self.ring.rational(p, q)

    def call(self, function: str, *args: Scalar) -> Scalar:
        """Apply ``function`` to the power series ``args``. If the result cannot be computed exactly,
        ArithmeticError is raised. The function ``quotient`` is an exception: if the divisor begins with the
        power h^v, the last v coefficients of the quotient can be wrong, because ``args`` are truncated.
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
        # sin, cos and exp of a non-zero algebraic number are transcendental, so they are not in the field
        # ``base``.
        if self.base.is_zero(z.coefficients[0]) is not True:
            raise ArithmeticError(f"{function} of a series with a constant term cannot be computed exactly")
        if "slope" in function:
            k = int(function[-1])
            # This is the formula c_k' = (k c_{k+2} - c_{k+1})/2.
            c, d = (self.call(f"stumpff{k + i}", z) for i in (2, 1))
            return (k * c - d) * self.ring.rational(1, 2)
        if "curvature" in function:
            k = int(function[-1])
            # The rule c_k' = (k c_{k+2} - c_{k+1})/2, applied twice, gives this formula for c_k''.
            c, d, e = (self.call(f"stumpff{k + i}", z) for i in (4, 3, 2))
            return (k * (k + 2) * c - (2 * k + 1) * d + e) * self.ring.rational(1, 4)
        if "stumpff" in function:
            k = int(function[-1])
            return self._sum(k, 2, self.ring.rational(1, math.factorial(k)), z)
        if function in ("tan", "tanh"):
            sine, cosine = ("sin", "cos") if function == "tan" else ("sinh", "cosh")
            # The cosine is 1 at zero, so its series is invertible.
            return self.call(sine, z) / self.call(cosine, z)
        if function in ("atan", "asin"):
            return self._arc(function, z)
        if function not in starts:
            raise ArithmeticError(f"the function {function} cannot be computed for exact power series")
        k, step, first = starts[function]
        # ``_sum`` computes a series with alternating signs, so ``power`` is negated for exp, sinh and cosh.
        power = z * z if step == 2 else z
        return self._sum(k, step, first, power if function in ("sin", "cos") else -power)

    def _sign(self, z: Scalar) -> int:
        """Return the sign (1 or -1) of the constant term of a series. If the constant term is zero,
        :class:`Kink` is raised."""
        start = z.coefficients[0]
        if self.base.is_zero(start) is not False:
            raise Kink("the vector field is not smooth at the initial state")
        return -1 if self.base.approximate(start).startswith("-") else 1

    def _angle(self, y: Scalar, x: Scalar) -> Scalar:
        """Return the series atan2(y, x). If the point (x, y) is not on the positive x-axis at h = 0,
        ArithmeticError is raised.
        """
        if self.base.is_zero(y.coefficients[0]) is not True or self._sign(x) < 0:
            raise ArithmeticError("atan2(y, x) is exact only if (x, y) is on the positive x-axis at h = 0")
        return self._arc("atan", y / x)

    def vector(self, function: str, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the results of a vector function. ``args`` and the results are power series."""
        return named(function).over_series(self.ring, args)

    def _arc(self, function: str, z: Scalar) -> Scalar:
        """Return atan z or asin z by its Taylor series.

        Term j is z^(2j+1)/(2j+1), multiplied by (-1)^j for atan and by binom(2j, j)/4^j for asin."""
        total, power = self.ring.zero, z
        # Term j contains no power of h below h^(2 j + 1), because z has no constant term.
        for j in range(self.order // 2 + 1):
            factor = Fraction((-1) ** j) if function == "atan" else Fraction(math.comb(2 * j, j), 4**j)
            factor /= 2 * j + 1
            total = total + power * self.ring.rational(factor.numerator, factor.denominator)
            power = power * z * z
        return total

    def _quotient(self, a: Scalar, b: Scalar) -> Scalar:
        """Return quotient(a, b). By definition, quotient(a, b) is a/b for b != 0, and 0 for b = 0. If a/b has
        a pole at h = 0, ArithmeticError is raised."""
        # ``power`` is the exponent of the lowest power of h in b.
        power = self.ring.valuation(b)
        if power > self.order:
            return self.ring.zero
        if self.ring.valuation(a) < power:
            raise ArithmeticError("a quotient of power series has a pole at h = 0")
        # After the division by h^power, the divisor has a constant term, so it is invertible.
        shifted = (self.ring.from_coefficients(x.coefficients[power:]) for x in (a, b))
        return next(shifted) / next(shifted)

    def _sum(self, k: int, step: int, first: Scalar, z: Scalar) -> Scalar:
        """Return the sum of the terms ``first`` * (-z)^j * k!/(``step`` * j + k)! for j = 0, 1, ..."""
        total, term, j = first, first, 0
        while True:
            j += 1
            # The next term is the current term, multiplied by -z and divided by ``divisor``.
            divisor = math.prod(range(step * (j - 1) + k + 1, step * j + k + 1))
            term = -(term * z) * self.ring.rational(1, divisor)
            # z has no constant term, and ``ring`` truncates all series. So z^j is zero for large j.
            if self.ring.is_zero(term):
                return total
            total = total + term

    def settled(self, old: Sequence[Scalar], new: Sequence[Scalar], previous: Scalar) -> tuple[bool, Scalar]:
        """Return (True, None) if ``old`` and ``new`` are equal, otherwise (False, None)."""
        return all(self.ring.is_zero(a - b) for a, b in zip(old, new, strict=True)), None


class ExprDomain:
    """The arithmetic of symbolic expressions. The step size ``h`` is a symbol. Iterations cannot be
    executed: :meth:`settled` raises :class:`NotConverged`.
    """

    def __init__(self, space: Space | None = None) -> None:
        self.space = space if space is not None else Space()
        self.h = self.space.sym("h")
        # For a time t, ``samples[t.id]`` contains t and the symbols for function values at t.
        self.samples: dict[int, tuple[Expr, dict[str, Expr]]] = {}

    def number(self, value: Number) -> Expr:
        """Return the number ``value`` as a constant expression."""
        return self.space.const(value)

    def rational(self, p: int, q: int = 1) -> Expr:
        """Return the rational number p/q as a constant expression."""
        return self.space.const(Number.rational(p, q))

    def call(self, function: str, *args: Expr) -> Expr:
        """Return the expression function(args)."""
        return self.space.call(function, *args)

    def vector(self, function: str, args: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the results of a vector function as expressions. If no simpler expressions are known, the
        results are calls of the function."""
        expanded = named(function).expanded(args)
        return self.space.vector(function, args) if expanded is None else expanded

    def sample(self, names: Sequence[str], t: Expr) -> dict[str, Expr]:
        """Return a dictionary with one symbol for each name of a function in ``names``. The symbol denotes
        the value of the function at the time t.
        """
        # For equal times, all calls must return the same symbols.
        if t.id not in self.samples:
            k = len(self.samples) + 1
            self.samples[t.id] = t, {name: self.space.sym(f"{name}_at{k}") for name in names}
        return self.samples[t.id][1]

    def settled(self, old: Sequence[Scalar], new: Sequence[Scalar], previous: Scalar) -> tuple[bool, Scalar]:
        """Raise :class:`NotConverged`, because expressions cannot be compared."""
        raise NotConverged("the values of an iteration are expressions, so they cannot be compared")
