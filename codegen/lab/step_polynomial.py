"""Taylor polynomials of a solution, and the signs of functions along the solution during one step.

The signs are decided with interval arithmetic on subintervals of the step, so a short interval of time in
which a function is negative is not missed. The error of the Taylor polynomial itself is not enclosed. The
caller compares the polynomial with a more accurate state at the end of the step.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from flint import arb, arb_poly, arb_series, ctx

from codegen.ir.elementary import ANGLE, MATHEMATICAL
from codegen.lab.number_functions import Functions
from codegen.lab.number_types import Evaluate, Scalar, Vector

DEGREE = 32
"""The degree of the Taylor polynomials.

The extrapolation in :mod:`codegen.lab.reference` has order 28 or 32. At its step sizes, a polynomial of this
degree has about the same error.
"""

NEGLIGIBLE = 1e-30
"""A function f counts as non-negative on a step if f >= -NEGLIGIBLE * min(1, s), where s is a bound of |f|.

NEGLIGIBLE is about the largest error of the reference solution.
"""

ROUNDING = 1e-45
"""A value greater than -ROUNDING always counts as non-negative.

Arb computes with 60 digits. The result of a formula can have several digits less.
"""

MOST_INTERVALS = 2000
"""The largest number of subintervals of a step.

Near a double zero of a function, subintervals are bisected until the function on them is as small as
:data:`NEGLIGIBLE`. About 200 subintervals are needed for this.
"""


class Undecided(ArithmeticError):
    """Raised if the signs of functions during a step cannot be decided."""


@contextmanager
def _truncated(length: int) -> Iterator[None]:
    """Limit power series to ``length`` coefficients inside a ``with`` statement."""
    before = ctx.cap
    ctx.cap = length
    try:
        yield
    finally:
        ctx.cap = before


def _series(x: Scalar) -> arb_series:
    return x if isinstance(x, arb_series) else arb_series([x])


def _hyperbolic(sign: int) -> Callable[[Scalar], arb_series]:
    def value(x: Scalar) -> arb_series:
        power = _series(x).exp()
        return (power + sign / power) / 2

    return value


def _angle(y: Scalar, x: Scalar) -> arb_series:
    y, x = _series(y), _series(x)
    slope = (y.derivative() * x - x.derivative() * y) / (x * x + y * y)
    return slope.integral() + arb.atan2(y[0], x[0])


def _tanh(x: Scalar) -> arb_series:
    # tanh x = (1 - exp(-2x))/(1 + exp(-2x)). For x < 0, exp(-2x) could overflow, so -tanh(-x) is computed.
    z = _series(x)
    if z[0] < 0:
        return -_tanh(-z)
    power = (-2 * z).exp()
    return (1 - power) / (1 + power)


def _of_series(name: str) -> Callable[[Scalar], arb_series]:
    def value(x: Scalar) -> arb_series:
        z = _series(x)
        # For a constant, only the value is computed: sqrt(0) is 0, but sqrt has no power series about 0.
        return arb_series([getattr(z[0], name)()]) if z.length() <= 1 else getattr(z, name)()

    return value


SERIES: Functions = {
    **{name: _of_series(name) for name in MATHEMATICAL},
    "sinh": _hyperbolic(-1),
    "cosh": _hyperbolic(1),
    "tanh": _tanh,
    ANGLE: _angle,
}
"""The functions that formulas may call. The results are power series whose coefficients are intervals."""


class StepPolynomial:
    """The Taylor polynomial of the solution of y' = ``field``(y, t) with the state ``y`` at the time ``t``.

    ``field`` must accept power series. ArithmeticError is raised if the polynomial does not exist.
    """

    def __init__(self, field: Evaluate, y: Vector, t: Scalar) -> None:
        self.start = t
        rows = [[x] for x in y]
        with _truncated(DEGREE + 1):
            time = arb_series([t, 1])
            for n in range(DEGREE):
                # Each pass determines one more coefficient, by y' = f.
                slopes = field(tuple(arb_series(row, n + 1) for row in rows), time)
                for row, slope in zip(rows, slopes, strict=True):
                    row.append((_series(slope)[n] / (n + 1)).mid())
        if not all(x.is_finite() for row in rows for x in row):
            raise ArithmeticError("the solution has no Taylor polynomial")
        self.polynomials = tuple(arb_poly(row) for row in rows)

    def at(self, tau: Scalar) -> Vector:
        """Return the value of the polynomial at the time t + ``tau``."""
        return tuple(p(tau) for p in self.polynomials)

    def first_exit(self, values: Evaluate, series: Evaluate, length: Scalar) -> tuple[Scalar, Scalar] | None:
        """Find the first time at which one of several functions becomes negative along the solution.

        - ``values`` computes the functions from a state and a time. All numbers are Arb balls, which are
          numbers with error bounds.
        - ``series`` computes the same functions if the state and the time are power series.
        - ``length`` is the length of the step.

        Return None if all functions are non-negative from t to t + ``length``. Otherwise, return two numbers
        (a, b). From t to t + a, all functions are non-negative. At t + b, a function is negative. A function
        that becomes negative between t + a and t + b is monotone there, so it changes its sign only once.
        Raises :class:`Undecided` if the signs cannot be decided.
        """
        signs = _Signs(self, values, series, length)
        todo = [(arb(0), length)]
        for _ in range(MOST_INTERVALS):
            if not todo:
                return None
            a, b = todo.pop()
            leaves = signs.leaves(a, b)
            if leaves:
                return a, b
            if leaves is None:
                middle = ((a + b) / 2).mid()
                # ``todo`` is a stack, so the loop examines the first half before the second half.
                todo += [(middle, b), (a, middle)]
        raise Undecided(
            "the program cannot decide whether the solution reaches a point where the field is not smooth"
        )


class _Signs:
    """The signs of functions along a solution (see :meth:`StepPolynomial.first_exit`)."""

    def __init__(self, solution: StepPolynomial, values: Evaluate, series: Evaluate, length: Scalar) -> None:
        self.solution, self.values, self.series = solution, values, series
        self.count = len(values(solution.at(arb(0)), solution.start))
        whole = self._expansions(solution.polynomials, arb(0))
        sizes = [sum((abs(x) * length**k for k, x in enumerate(row)), arb(0)) for row in whole]
        # If a size is not finite, the comparison is false and the size 1 is used.
        self.sizes = [float(s.mid()) if s < 1 else 1.0 for s in sizes]
        self.limits = [max(ROUNDING, NEGLIGIBLE * s) for s in self.sizes]

    def leaves(self, a: Scalar, b: Scalar) -> bool | None:
        """Determine the signs of the functions on the subinterval from t + a to t + b.

        All functions must be non-negative at t + a. The result is one of the following:

        - True: two facts are proved. At least one function is negative at t + b. Each function that becomes
          negative on the subinterval is monotone there, and therefore changes its sign only once.
        - False: all functions are non-negative from t + a to t + b.
        - None: neither True nor False is proved, so the caller must bisect the subinterval.

        Raises :class:`Undecided` if a negative function is so small that its sign can be a rounding error.
        """
        solution, middle = self.solution, ((a + b) / 2).mid()
        around = arb(0, ((b - a) / 2).mid())
        shifted = tuple(p(arb_poly([middle, 1])) for p in solution.polynomials)
        box = tuple(p(around) for p in shifted)
        unknown = self._negative_possible(box, solution.start + middle + around)
        if not unknown:
            return False
        centre = self._expansions(shifted, middle)
        over = self._expansions(tuple(p(arb_poly([around, 1])) for p in shifted), middle + around)
        ends = self.values(solution.at(b), solution.start + b)
        negative = False
        for k in unknown:
            form = _taylor_form(centre[k], over[k])
            if form(around) >= -self.limits[k]:
                continue
            slope = form.derivative()(around)
            if not (slope > 0 or slope < 0):
                return None
            if ends[k] < -self.limits[k]:
                if self.sizes[k] < NEGLIGIBLE:
                    raise Undecided(
                        "the solution is too close to a point at which an operation changes its formula "
                        "(x = 0 for abs(x))"
                    )
                negative = True
            elif not ends[k] >= -self.limits[k]:
                # The error bound of the value at t + b is too large to determine the sign.
                return None
        return negative

    def _negative_possible(self, state: Vector, t: Scalar) -> list[int]:
        try:
            values = self.values(state, t)
        except (ArithmeticError, ValueError):
            # ``values`` fails if one function is undefined at a point in the balls of ``state``. The values
            # of all functions are then unknown, so all functions count as possibly negative.
            return list(range(self.count))
        return [k for k, x in enumerate(values) if not x >= -self.limits[k]]

    def _expansions(self, state: tuple[arb_poly, ...], tau: Scalar) -> list[list[arb]]:
        """Return Taylor coefficients of the functions that ``self.series`` computes, up to degree DEGREE.

        Let t be the time at the beginning of the step. Each function is expanded about the time t + ``tau``.
        The variable x of the expansion is the time since t + ``tau``. ``state`` contains the coordinates of
        the state as polynomials in x.
        """
        with _truncated(DEGREE + 1):
            try:
                rows = self.series(
                    tuple(arb_series(p.coeffs()) for p in state), arb_series([self.solution.start + tau, 1])
                )
                return [[_series(row)[k] for k in range(DEGREE + 1)] for row in rows]
            except (ArithmeticError, ValueError):
                return [[arb("nan")] * (DEGREE + 1)] * self.count


def _taylor_form(centre: list[arb], over: list[arb]) -> arb_poly:
    """Return a polynomial that encloses a function on a subinterval.

    ``centre`` contains the Taylor coefficients of the function at the centre of the subinterval. ``over``
    contains balls that enclose the Taylor coefficients at all points of the subinterval. By Taylor's theorem,
    the polynomial encloses the function if its last coefficient is taken from ``over`` and all other
    coefficients are taken from ``centre``.
    """
    return arb_poly([*centre[:-1], over[-1]])
