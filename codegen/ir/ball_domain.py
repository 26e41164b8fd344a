"""An arithmetic with many digits, based on Arb balls.

An operation is about six times faster than in :class:`codegen.ir.domain.PreciseDomain`.

A step program consists of operations such as exp and Ad. After each operation, each ball in the result is
replaced by its midpoint. Hence the results have no rigorous error bounds.

The working precision of balls is a global variable of python-flint. Code that uses this domain therefore runs
inside ``with domain.precision():``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

from flint import arb, arb_mat

from codegen.ir.domain import LARGEST_BITS, NotConverged, Scalar, Value
from codegen.ir.exponential_action import ExponentialAction
from codegen.ir.matrix_balls import ball, block_matrix, exponent_of, exponential, midpoint
from codegen.ir.matrix_functions import MatrixExponential, MatrixInverse
from codegen.ir.matrix_product import BilinearFunction
from codegen.ir.number import Number
from codegen.ir.selection import selected, selects, sign_of_number
from codegen.ir.unitary_exponential import (
    GENERAL,
    SpecialUnitaryExponential,
    embedded,
    first_columns,
)
from codegen.ir.vector_calls import vector_function
from orderconds.ring.precision import precision

if TYPE_CHECKING:
    import mpmath

BITS_PER_DIGIT = math.log2(10)

GUARD = 32
"""The number of guard bits, that is, of bits beyond the requested precision."""


class BallDomain:
    """An arithmetic with ``digits`` decimal digits. The scalars are Arb balls, but only their midpoints are
    used.

    The step size ``h`` is an mpmath number, a float or a Fraction. Let n be
    :data:`codegen.ir.domain.LARGEST_BITS`. If an argument of a function such as exp has an absolute value of
    2^n or more, OverflowError is raised.
    """

    def __init__(self, h: Scalar, digits: int = 50) -> None:
        self.digits = digits
        self.bits = math.ceil(digits * BITS_PER_DIGIT) + GUARD
        with self.precision():
            # ``eps`` is the requested precision, about 10^-``digits``.
            self.eps = arb((1, GUARD - self.bits))
            self.h = self.scalar(h)
        # If a fixed-point method has not converged after this number of iterations, Newton's method is used.
        self.patience = 3 * digits

    def precision(self) -> precision:
        """Return the context manager that sets the working precision of this domain."""
        return precision(self.bits)

    def scalar(self, x: Scalar) -> arb:
        """Convert a float, an mpmath number or a Fraction to a scalar. Only a Fraction is rounded."""
        if isinstance(x, Fraction):
            return self.rational(x.numerator, x.denominator)
        if isinstance(x, int | float):
            return arb(x)
        return ball(x)

    def mpf(self, x: arb, context: mpmath.ctx_mp.MPContext) -> mpmath.mpf:
        """Convert a scalar of this domain to an mpmath number of the mpmath context ``context``."""
        return midpoint(x, context)

    def number(self, value: Number) -> arb:
        """Return the number ``value``, rounded to the working precision."""
        if value.is_rational:
            fraction = value.fraction()
            return self.rational(fraction.numerator, fraction.denominator)
        # With 16 extra bits, the conversion error is negligible at the working precision.
        with precision(self.bits + 16):
            # A number with b bits has only about 0.301 b digits, so the text with b/3 + 5 digits is accurate.
            enclosure = arb(value.ring.approximate(value.element, self.bits // 3 + 5))
        return enclosure.mid()

    def rational(self, p: int, q: int = 1) -> arb:
        """Return p/q, rounded to the working precision."""
        return (arb(p) / q).mid()

    def call(self, function: str, *args: arb) -> arb:
        """Return the value of a scalar function at ``args``.

        ValueError is raised if the function has no real value there, for example for the square root of a
        negative number.
        """
        z = args[0].mid()
        # Diverging iterations produce infinite or undefined arguments.
        if not z.is_finite():
            raise NotConverged(f"the argument of {function} is not a finite number")
        if function == "quotient":
            return args[0] / args[1] if args[1].mid() != 0 else args[0] * 0
        if selects(function):
            # The centres are compared, because a ball around zero has no sign.
            centres = tuple(x.mid() for x in args)
            value = selected(self, function, centres, lambda x: sign_of_number(x.mid()))
            return value.mid()
        # Beyond this size, the sine needs thousands of additional bits for the argument reduction.
        if any(exponent_of(x) > LARGEST_BITS for x in args):
            raise OverflowError(f"an argument of {function} exceeds 2^{LARGEST_BITS}")
        if "slope" in function:
            return self._slope(int(function[-1]), z)
        if "curvature" in function:
            return self._curvature(int(function[-1]), z)
        if "stumpff" in function:
            return self._stumpff(int(function[-1]), z)
        value = getattr(arb, function)(*(x.mid() for x in args)).mid()
        # If the function has no real value, Arb returns a NaN and raises no exception.
        if not value.is_finite():
            raise ValueError(f"{function} of {z.str(10, radius=False)} is not a finite real number")
        return value

    def vector(self, function: str, args: Sequence[arb]) -> tuple[arb, ...]:
        """Return the results of a vector function.

        ZeroDivisionError is raised for the inverse of a singular matrix. OverflowError is raised if the
        exponential of a matrix cannot be computed (:func:`codegen.ir.matrix_balls.exponential`).
        """
        called, numbers = vector_function(function), [x.mid() for x in args]
        if isinstance(called, MatrixExponential):
            return exponential(called.n, called.level, self.bits, numbers)
        if isinstance(called, ExponentialAction):
            # This domain computes exp(A) y from the matrix exp(A).
            entries = called.matrix(numbers, arb(0))
            rows = self.vector(f"expm{called.n}", entries)
            y = numbers[-called.n :]
            lines = (rows[called.n * i : called.n * i + called.n] for i in range(called.n))
            with precision(2 * self.bits):
                # The sums need more bits than ``self.bits``, because their terms may cancel.
                sums = [sum((a * x for a, x in zip(line, y, strict=True)), arb(0)) for line in lines]
            return tuple(x.mid() for x in sums)
        if isinstance(called, MatrixInverse):
            with precision(2 * self.bits):
                # Let b be ``self.bits``. If the condition number of the matrix is 2^b, the inverse loses
                # about b bits. Therefore the inverse is computed with 2 b bits.
                inverse = arb_mat(block_matrix(called.n, 0, numbers)).inv().tolist()
            return tuple(x.mid() for row in inverse for x in row)
        if isinstance(called, SpecialUnitaryExponential):
            # A complex 3 x 3 matrix is represented by a real 6 x 6 matrix.
            return first_columns(self.vector(GENERAL.name, embedded(numbers, arb(0))))
        if isinstance(called, BilinearFunction):
            return tuple(x.mid() for x in called.arithmetic(numbers))
        raise ValueError(f"unknown vector function {function}")

    def _stumpff(self, k: int, z: arb) -> arb:
        """Return the Stumpff function c_k(z) = sum_j (-z)^j/(2j + k)!."""
        if z > 1:
            # For z > 1 the closed forms lose at most three bits by cancellation.
            root = z.sqrt()
            if k == 0:
                return root.cos()
            if k == 2:
                # The identity 1 - cos s = 2 sin^2(s/2) avoids the difference of nearly equal numbers.
                return 2 * ((root / 2).sin() / root) ** 2
            # With s = sqrt z, c_1 is sin(s)/s, and c_3 is (s - sin s)/s^3.
            sine = root.sin()
            return sine / root if k == 1 else (root - sine) / (root * z)
        # For z <= 1 the series loses almost no digits by cancellation.
        total, j, term = arb(0), 0, arb(1) / math.factorial(k)
        # The pair (1, n) of mantissa and exponent denotes the number 2^n.
        limit = arb((1, -self.bits - 10))
        while abs(term.mid()) > limit:
            total += term
            j += 1
            # Term j is (-z)^j/(2 j + k)!, and term j - 1 has the divisor (2 j + k - 2)!.
            term = -term * z / ((2 * j + k) * (2 * j + k - 1))
        return total

    def _slope(self, k: int, z: arb) -> arb:
        """Return the derivative c_k'(z) of the Stumpff function c_k."""
        if abs(z) > 1:
            # For small z, c_{k-1} and k c_k are both close to 1/(k-1)!, and their difference would lose
            # digits.
            return (self._stumpff(k - 1, z) - k * self._stumpff(k, z)) / (2 * z)
        # The term (-z)^j/(2j+k)! of c_k has the derivative 0 for j = 0, so the sum begins with j = 1.
        total, j, term = arb(0), 1, -arb(1) / math.factorial(k + 2)
        limit = arb((1, -self.bits - 10))
        while abs(term.mid()) > limit:
            total += term
            j += 1
            # Term j of c_k'(z) is (-1)^j j z^(j - 1)/(2 j + k)!.
            term = -term * z * j / ((j - 1) * (2 * j + k) * (2 * j + k - 1))
        return total

    def _curvature(self, k: int, z: arb) -> arb:
        """Return the second derivative c_k''(z) of the Stumpff function c_k."""
        # For small z the three terms of this formula nearly cancel.
        if abs(z) > 1:
            a, b, c = (self._stumpff(i, z) for i in (k - 2, k - 1, k))
            return (a - (2 * k + 1) * b + k * (k + 2) * c) / (4 * z * z)
        # The terms (-z)^j/(2j+k)! of c_k have the second derivative 0 for j = 0 and j = 1.
        total, j, term = arb(0), 2, 2 * arb(1) / math.factorial(k + 4)
        limit = arb((1, -self.bits - 10))
        while abs(term.mid()) > limit:
            total += term
            j += 1
            term = -term * z * j / ((j - 2) * (2 * j + k) * (2 * j + k - 1))
        return total

    def computed(self, name: str, value: Value) -> Value:
        """Return ``value``, the result of an operation, with each ball replaced by its midpoint."""
        return tuple(x.mid() for x in value) if isinstance(value, tuple) else value.mid()

    def settled(self, old: Sequence[arb], new: Sequence[arb], previous: Scalar) -> tuple[bool, arb]:
        """Return the pair (converged, change) after an iteration from the values ``old`` to ``new``.

        ``change`` is the largest absolute difference between ``old`` and ``new``. ``previous`` is the change
        in the previous iteration, or None in the first iteration. The values have converged if the change is
        zero, or if both conditions hold:

        - The change is at most 2^12 eps max(1, m). Here m is the largest absolute value in ``old``, and eps
          is about 10^-``digits``.
        - The change no longer decreases: it is at least ``previous``.
        """
        change = max(abs((a - b).mid()) for a, b in zip(old, new, strict=True))
        # Without this test, an iteration with a NaN could continue, because comparisons with a NaN are false.
        if not all(x.is_finite() for x in new):
            raise NotConverged("an iteration computed a number that is not finite")
        # The factor 4096 = 2^12 allows for the accumulated rounding errors of an iteration.
        small = change <= 4096 * self.eps * max(arb(1), *(abs(a.mid()) for a in old))
        return small and (change == 0 or (previous is not None and change >= previous)), change

    def increment(self, x: arb, unknowns: Sequence[arb]) -> arb:
        """Return an increment d for an accurate difference quotient (f(x + d) - f(x))/d.

        The function f is smooth.
        """
        # For abs(x) <= 1, the increment is d = sqrt(eps). The difference quotient has a rounding error of
        # about eps/d and a truncation error of about d. The two errors are equal for d = sqrt(eps).
        return (self.eps.sqrt() * max(arb(1), abs(x.mid()))).mid()
