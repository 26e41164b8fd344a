"""Reference solutions of scenes to 28 digits, by Gragg-Bulirsch-Stoer extrapolation.

In the differential equation, the derivative of the state y is the action of the Lie algebra element f(y) on
y. The modified midpoint rule is applied to the coordinates of y. The results of the midpoint rule are
extrapolated in the squared step size (Hairer, Norsett and Wanner I, section II.9). The reference uses no
group exponential and no code of the tested integrators.
"""

from __future__ import annotations

import math
import sys
import time
from contextlib import suppress
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path

from flint import arb

from codegen.errors import SceneError
from codegen.ir.domain import PreciseDomain
from codegen.lab.ambient_field import ambient_field
from codegen.lab.measurement_cache import MeasurementCache, files_digest, user_cache
from codegen.lab.number_types import Evaluate, Scalar, Vector
from codegen.lab.piecewise_field import PiecewiseField, Sided
from codegen.lab.straight_line_field import velocity
from codegen.scene.problem import Problem
from orderconds.ring.precision import precision

DIGITS = 50
"""The number of decimal digits with which the initial state and the reference solution are stored.

The reference solution has fewer correct digits (see :data:`AGREEMENT`).
"""

BITS = 200
"""The working precision of the Arb arithmetic in bits (about 60 decimal digits)."""

RUNS = ((14, -33), (16, -36))
"""The settings of the two integrations: the number of columns of the extrapolation table, and the exponent e
of the tolerance 10^e.

The first integration only checks the second.
"""

AGREEMENT = 1e-28
"""The largest accepted difference (maximum norm) between the final states of the two integrations
:data:`RUNS`.

If the norm of the second final state is at least 1, the difference is divided by that norm.
"""

LEAST_STEP = 1e-6
"""The length of the shortest permitted step, as a fraction of the time span.

If the step-size control demands a shorter step, SceneError is raised.
"""

MOST_STEPS = 10_000
"""The largest number of extrapolation steps, including rejected steps.

If more steps are necessary, SceneError is raised.
"""

DIVERGES = "extrapolation does not converge; perhaps the field is not smooth near this time"
UNLIKE = (
    "the Taylor polynomial of the solution is not accurate even on very short intervals; "
    "perhaps the field has no power series near this time"
)
"""Two parts of error messages. Each part says why a reference solution cannot be computed.

- ``DIVERGES``: the error estimate of the extrapolation is too large.
- ``UNLIKE``: the result of the extrapolation differs from the value of the Taylor polynomial of the solution
  (:meth:`codegen.lab.piecewise_field.Sided.stopped`).
"""

MODULES = (
    __name__,
    "codegen.ir.smoothness",
    "codegen.lab.ambient_field",
    "codegen.lab.number_functions",
    "codegen.lab.piecewise_field",
    "codegen.lab.step_polynomial",
    "codegen.lab.straight_line_field",
)
"""The modules whose formulas and constants determine a reference solution.

A stored solution is used only if these modules have not changed since it was computed.
"""


@dataclass(frozen=True)
class Reference:
    """The reference solution of a scene: the state at the end of the time span.

    - ``scene``: the name of the scene.
    - ``state``: the coordinates as mpmath numbers of :data:`DIGITS` digits, in the order of the attribute
      ``symbols`` of the scene.
    - ``uncertainty``: the maximum norm of the difference of two solutions with different extrapolation
      orders.
    - ``kinks``: an entry for each point of the solution where the field is not smooth. The entry is the
      number of continuous derivatives of the field at the point, or -1 at a discontinuity.
    - ``sizes``: for each coordinate, the largest absolute value at the steps of the solution. A coordinate
      that is 0 at both ends of the time span can be large between them.
    - ``speeds``: for each coordinate, the largest absolute value of its velocity at the steps.
    - ``times``: the times of the points in ``kinks``.
    """

    scene: str
    state: Vector
    uncertainty: float
    kinks: tuple[int, ...] = ()
    sizes: tuple[float, ...] = ()
    speeds: tuple[float, ...] = ()
    times: tuple[float, ...] = ()

    def digits(self, count: int = 30) -> tuple[str, ...]:
        """Return the coordinates in ``state`` as decimal strings with ``count`` significant digits."""
        import mpmath

        return tuple(mpmath.nstr(x, count) for x in self.state)


@dataclass(frozen=True)
class _Stored:
    """A :class:`Reference` for the cache. The entries of ``state`` are decimal strings."""

    state: tuple[str, ...]
    uncertainty: float
    kinks: tuple[int, ...]
    sizes: tuple[float, ...]
    speeds: tuple[float, ...]
    times: tuple[float, ...]


class _Peaks:
    """The largest absolute values of the coordinates and of their velocities at the steps of a solution."""

    def __init__(self, count: int) -> None:
        self.sizes = self.speeds = (0.0,) * count

    def add(self, field: Evaluate | Sided, y: Vector, t: Scalar) -> None:
        """Update ``sizes`` with the state ``y``, and ``speeds`` with the velocity ``field(y, t)``.

        If the velocity is not defined at (y, t), ``speeds`` does not change.
        """
        self.sizes = _larger(self.sizes, y)
        with suppress(ArithmeticError, ValueError):
            self.speeds = _larger(self.speeds, field(y, t))


def _larger(peaks: tuple[float, ...], values: Vector) -> tuple[float, ...]:
    sizes = [abs(float(x)) for x in values]
    return tuple(max(a, b) if math.isfinite(b) else a for a, b in zip(peaks, sizes, strict=True))


def cached_reference(
    scene: Problem, cache: MeasurementCache | None = None, end: float = math.inf
) -> Reference:
    """Return the reference solution of a scene from the cache, or compute and store the solution.

    The default of ``cache`` is the cache of the current user. :func:`reference` describes ``end`` and the
    exceptions.
    """

    def compute() -> _Stored:
        computed = reference(scene, end)
        more = computed.kinks, computed.sizes, computed.speeds, computed.times
        return _Stored(computed.digits(DIGITS), computed.uncertainty, *more)

    stored = (cache or user_cache()).get(_key(scene), _Stored, compute)
    context = PreciseDomain(0, DIGITS).context
    state = tuple(map(context.mpf, stored.state))
    more = stored.kinks, stored.sizes, stored.speeds, stored.times
    return Reference(scene.name, state, stored.uncertainty, *more)


def _key(scene: Problem) -> tuple[object, ...]:
    """Return the cache key: all data that determine the reference solution of a scene."""
    field = velocity(scene)
    start = scene.initial(PreciseDomain(0, DIGITS))
    return (
        "reference",
        field.lines,
        field.results,
        [x.text() for x in field.constants],
        [str(x) for x in start],
        [str(x) for x in scene.span],
        _digest(),
    )


@cache
def _digest() -> str:
    """Return a digest of the texts of :data:`MODULES`."""
    return files_digest(Path(str(sys.modules[name].__file__)) for name in MODULES)


def reference(scene: Problem, end: float = math.inf) -> Reference:
    """Compute the state of a scene at the end of its time span, and the uncertainty of the computed state.

    The uncertainty is the maximum norm of the difference of two solutions with different extrapolation
    orders. The computation must finish before the clock ``time.monotonic()`` reaches the deadline ``end``.
    Raises :class:`codegen.errors.SceneError` if the equation cannot be solved, if the two solutions do not
    agree to 28 digits, or if the deadline passes.
    """
    (checked, *_), (answer, events, peaks) = (
        _end(scene, columns, exponent, end) for columns, exponent in RUNS
    )
    size = max(1.0, *(float(abs(x)) for x in answer))
    gap = max(float(abs(a - b)) for a, b in zip(checked, answer, strict=True))
    if not gap <= AGREEMENT * size:
        raise SceneError(
            f"two reference solutions of different order differ by {gap:.1e}",
            where=scene.name,
            expected=f"agreement to {AGREEMENT:g}",
            hint="perhaps the field is not smooth; shorten the span, or remove discontinuities of the field",
        )
    kinks, times = tuple(k for k, _ in events), tuple(t for _, t in events)
    return Reference(scene.name, answer, gap, kinks, peaks.sizes, peaks.speeds, times)


def _end(
    scene: Problem, columns: int, exponent: int, finish: float
) -> tuple[Vector, tuple[tuple[int, float], ...], _Peaks]:
    """Return the final state, the kinks with their times, and the largest coordinates and velocities.

    A kink is a point of the solution where the field is not smooth. For each kink, there is a pair (k, time),
    where k is the number of continuous derivatives of the field at the kink, or -1 at a discontinuity.

    The tolerance is 10^``exponent``.
    Raises SceneError if ``time.monotonic()`` exceeds ``finish`` before the computation ends.
    """
    context = PreciseDomain(0, DIGITS)
    with precision(BITS):
        piecewise = PiecewiseField(scene)
        y = tuple(arb(context.context.nstr(x, DIGITS + 5)).mid() for x in scene.initial(context))
        smooth = None if piecewise.nodes else ambient_field(scene)
        peaks, field = _Peaks(len(y)), smooth or Sided(piecewise)
        final = _integrate(scene, field, y, columns, 10.0**exponent, finish, peaks)
        events = tuple(zip(field.kinks, field.times, strict=True)) if isinstance(field, Sided) else ()
        return tuple(context.context.mpf(x.str(DIGITS + 5, radius=False)) for x in final), events, peaks


def _integrate(
    scene: Problem,
    field: Evaluate | Sided,
    y: Vector,
    columns: int,
    tolerance: float,
    finish: float,
    peaks: _Peaks,
) -> Vector:
    """Return the state at the end of the time span, and add the states of all steps to ``peaks``.

    Raises SceneError if ``time.monotonic()`` exceeds ``finish`` before the computation ends.
    """
    t, end = (arb(x.numerator) / x.denominator for x in scene.span)
    whole = float(end - t)
    step = whole / 8
    reason = DIVERGES
    sided = field if isinstance(field, Sided) else None
    if sided is not None:
        sided.begin(y, t)
    for _ in range(MOST_STEPS):
        peaks.add(field, y, t)
        if step <= whole * LEAST_STEP:
            break
        _check_clock(scene, finish)
        left = (end - t).mid()
        last = arb(step) >= left
        length = left if last else arb(step)
        try:
            new, error = _extrapolate(field, y, t, length, columns)
        except ArithmeticError as failure:
            # A long trial step can produce a state at which the field is not defined.
            reason, step = str(failure), step / 5
            continue
        size = max(1.0, *(abs(float(x)) for x in new))
        if error <= tolerance * size:
            if sided is not None:
                stopped = sided.stopped(y, t, new, length, partial(_extrapolate, columns=columns))
                if stopped is not None:
                    t, y, step = stopped
                    if step < float(length):
                        reason = UNLIKE
                    continue
            t, y = (t + length).mid(), new
            if last:
                peaks.add(field, y, t)
                return y
        # The error estimate is proportional to step^p with p = 2 * columns - 1.
        else:
            reason = DIVERGES
        ratio = (tolerance * size / error) ** (1 / (2 * columns - 1)) if error else 4.0
        step = min(step, float(left)) * max(0.2, min(4.0, 0.9 * ratio))
    else:
        reason = f"more than {MOST_STEPS} steps of extrapolation"
    raise SceneError(
        f"no reference solution beyond t = {float(t):.6g}: {reason}",
        where=scene.name,
        expected="a field that is smooth and not stiff over the span",
        hint="choose a span that ends before this time",
    )


def _check_clock(scene: Problem, finish: float) -> None:
    """Raise SceneError if ``time.monotonic()`` exceeds ``finish``."""
    if time.monotonic() > finish:
        raise SceneError(
            "the reference solution takes too long",
            where=scene.name,
            expected="a reference solution within the time limit",
            hint="allow more time, or shorten the span",
        )


def _extrapolate(
    field: Evaluate | Sided, y: Vector, t: Scalar, step: Scalar, columns: int
) -> tuple[Vector, float]:
    """Return the extrapolated state after one step from ``y`` at time ``t``, and an estimate of its error.

    Raises ArithmeticError if the field cannot be evaluated at one of the intermediate states.
    """
    slope = field(y, t)
    row: list[Vector] = []
    for j in range(1, columns + 1):
        new = [_midpoint(field, y, slope, t, step, 2 * j)]
        for k in range(1, j):
            factor = arb((j - k) ** 2) / (j * j - (j - k) ** 2)
            better, worse = new[k - 1], row[k - 1]
            new.append(tuple(a + (a - b) * factor for a, b in zip(better, worse, strict=True)))
        row = new
    error = max(abs(float((a - b).mid())) for a, b in zip(row[-1], row[-2], strict=True))
    if not (math.isfinite(error) and all(x.is_finite() for x in row[-1])):
        raise ArithmeticError("a coordinate is not a finite real number")
    return tuple(x.mid() for x in row[-1]), error


def _midpoint(field: Evaluate | Sided, y: Vector, slope: Vector, t: Scalar, step: Scalar, n: int) -> Vector:
    """Return the state after ``n`` equal substeps of the modified midpoint rule.

    ``n`` must be even, because otherwise the error has no expansion in powers of the squared step size.
    """
    h = step / n
    twice = 2 * h
    old, new = y, tuple([a + h * b for a, b in zip(y, slope, strict=True)])
    for k in range(1, n):
        f = field(new, t + k * h)
        old, new = new, tuple([a + twice * b for a, b in zip(old, f, strict=True)])
    return new
