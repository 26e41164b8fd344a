"""Reference solutions of scenes to 28 digits, by Gragg-Bulirsch-Stoer extrapolation.

The modified midpoint rule is applied to y' = f(y).y in the coordinates of the state, and extrapolated in the
squared step size (Hairer, Norsett and Wanner I, section II.9). The reference uses no group exponential and no
code of a method. Therefore a comparison with the reference shows errors in exponentials and in methods. A
reference is accepted only if two runs of different order and tolerance agree. The distance between the two
final states is the stated uncertainty.
"""

from __future__ import annotations

import math
import time
from dataclasses import dataclass
from functools import partial

from flint import arb

from codegen.errors import SceneError
from codegen.ir.domain import PreciseDomain
from codegen.lab.ambient_field import ambient_field
from codegen.lab.measurement_cache import MeasurementCache, user_cache
from codegen.lab.number_types import Evaluate, Scalar, Vector
from codegen.lab.piecewise_field import PiecewiseField, Sided
from codegen.lab.straight_line_field import velocity
from codegen.scene.problem import Problem
from orderconds.ring.precision import precision

DIGITS = 50
"""Working precision in decimal digits. Extrapolation with 16 columns loses up to ten digits."""

BITS = 200
"""Working precision of the balls in bits: a few digits more than :data:`DIGITS`."""

RUNS = ((14, -33), (16, -36))
"""The number of columns of the extrapolation table and the decimal exponent of the tolerance, for two runs.

The second run gives the result, and the first run checks it.
"""

AGREEMENT = 1e-28
"""The largest accepted difference between the two runs, relative to the size of the state."""

LEAST_STEP = 1e-6
"""If steps become shorter than this fraction of the span, SceneError is raised, because the solution is
probably close to a singularity.
"""

MOST_STEPS = 10_000
"""Largest number of extrapolation steps. A scene that needs more steps is too stiff, or its span is too long.
"""


@dataclass(frozen=True)
class Reference:
    """The state of a scene at the end of its span.

    ``state`` contains mpmath numbers of :data:`DIGITS` digits in the order of ``scene.symbols``.
    ``uncertainty`` is the largest difference of a coordinate between two runs of different order and
    tolerance. A kink is a point of the solution at which the field is not smooth. For each kink, ``kinks``
    contains the number of continuous derivatives of the field, or -1 if the field jumps.
    """

    scene: str
    state: Vector
    uncertainty: float
    kinks: tuple[int, ...] = ()

    def digits(self, count: int = 30) -> tuple[str, ...]:
        """Return the state as decimal strings of ``count`` significant digits."""
        import mpmath

        return tuple(mpmath.nstr(x, count) for x in self.state)


@dataclass(frozen=True)
class _Stored:
    """A reference solution as the cache stores it: decimal strings, the uncertainty, and the kinks."""

    state: tuple[str, ...]
    uncertainty: float
    kinks: tuple[int, ...] = ()


def cached_reference(
    scene: Problem, cache: MeasurementCache | None = None, end: float = math.inf
) -> Reference:
    """Return the reference of a scene from the cache, or compute and store it.

    The default of ``cache`` is the cache of the current user. The computation must be finished at the time
    ``end`` of the clock ``time.monotonic``. The function raises the same errors as :func:`reference`.
    """

    def compute() -> _Stored:
        computed = reference(scene, end)
        return _Stored(computed.digits(DIGITS), computed.uncertainty, computed.kinks)

    stored = (cache or user_cache()).get(_key(scene), _Stored, compute)
    context = PreciseDomain(0, DIGITS).context
    return Reference(
        scene.name, tuple(map(context.mpf, stored.state)), stored.uncertainty, tuple(stored.kinks)
    )


def _key(scene: Problem) -> tuple[object, ...]:
    """Return the data that determine a reference solution: field, constants, initial state, span and
    settings.
    """
    field = velocity(scene)
    start = scene.initial(PreciseDomain(0, DIGITS))
    return (
        "reference",
        field.lines,
        field.results,
        [x.text() for x in field.constants],
        [str(x) for x in start],
        [str(x) for x in scene.span],
        (AGREEMENT, BITS, DIGITS, RUNS),
    )


def reference(scene: Problem, end: float = math.inf) -> Reference:
    """Return the reference of a scene at the end of its span, with its measured uncertainty.

    Raises :class:`codegen.errors.SceneError` if the equations cannot be evaluated along the solution, or if
    the two runs do not agree to 28 digits. SceneError is also raised if the computation is not finished at
    the time ``end`` of the clock ``time.monotonic``.
    """
    (checked, _), (answer, kinks) = (_end(scene, columns, exponent, end) for columns, exponent in RUNS)
    size = max(1.0, *(float(abs(x)) for x in answer))
    gap = max(float(abs(a - b)) for a, b in zip(checked, answer, strict=True))
    if not gap <= AGREEMENT * size:
        raise SceneError(
            f"two reference solutions of different order differ by {gap:.1e}",
            where=scene.name,
            expected=f"agreement to {AGREEMENT:g}",
            hint="shorten the span, or remove discontinuities of the field",
        )
    return Reference(scene.name, answer, gap, kinks)


def _end(scene: Problem, columns: int, exponent: int, finish: float) -> tuple[Vector, tuple[int, ...]]:
    """Return the final state and the kinks (:class:`Reference`) of one run with step-size control.

    The run must end before the time ``finish`` of the clock ``time.monotonic``.
    """
    context = PreciseDomain(0, DIGITS)
    with precision(BITS):
        piecewise = PiecewiseField(scene)
        y = tuple(arb(context.context.nstr(x, DIGITS + 5)).mid() for x in scene.initial(context))
        smooth = None if piecewise.nodes else ambient_field(scene)
        final, kinks = _integrate(scene, smooth or Sided(piecewise), y, columns, 10.0**exponent, finish)
        return tuple(context.context.mpf(x.str(DIGITS + 5, radius=False)) for x in final), kinks


def _integrate(
    scene: Problem, field: Evaluate | Sided, y: Vector, columns: int, tolerance: float, finish: float
) -> tuple[Vector, tuple[int, ...]]:
    """Return the state at the end of the span, and the kinks (:class:`Reference`).

    The coordinates are balls of radius zero. The run must end before the time ``finish`` of
    ``time.monotonic``.
    """
    t, end = (arb(x.numerator) / x.denominator for x in scene.span)
    whole = float(end - t)
    step = whole / 8
    reason = "extrapolation does not converge"
    sided = field if isinstance(field, Sided) else None
    if sided is not None:
        sided.begin(y, t, whole * LEAST_STEP)
    for _ in range(MOST_STEPS):
        if step <= whole * LEAST_STEP:
            break
        if time.monotonic() > finish:
            raise SceneError(
                "the reference solution takes too long",
                where=scene.name,
                expected="a reference solution within the time limit",
                hint="allow more time, or shorten the span",
            )
        left = (end - t).mid()
        last = arb(step) >= left
        length = left if last else arb(step)
        try:
            new, error = _extrapolate(field, y, t, length, columns)
        except (
            ArithmeticError
        ) as failure:  # The states of a long trial step may be outside the domain of the field.
            reason, step = str(failure), step / 5
            continue
        size = max(1.0, *(abs(float(x)) for x in new))
        if error <= tolerance * size:
            if sided is not None and sided.leaves(y, t, new, length):
                step = float(length)
                moved = sided.cross(y, t, length, partial(_extrapolate, columns=columns))
                if moved is None:
                    step /= 2
                else:
                    t, y = moved
                continue
            t, y = (t + step).mid(), new
            if last:
                return y, () if sided is None else tuple(sided.kinks)
        # The error estimate is proportional to step^(2 columns - 1), so the factor for the step is a root.
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


def _extrapolate(
    field: Evaluate | Sided, y: Vector, t: Scalar, step: Scalar, columns: int
) -> tuple[Vector, float]:
    """Return the extrapolated state after one step, and an estimate of its error.

    The state is the last entry of the extrapolation table. The error estimate is the distance between the
    last entry and the previous entry of the same row. Raises ArithmeticError if the field cannot be evaluated
    at some stage.
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
    """Return the state after n substeps of the explicit midpoint rule. The first substep is an Euler step.

    The number n is even.
    """
    h = step / n
    twice = 2 * h
    old, new = y, tuple([a + h * b for a, b in zip(y, slope, strict=True)])
    for k in range(1, n):
        f = field(new, t + k * h)
        old, new = new, tuple([a + twice * b for a, b in zip(old, f, strict=True)])
    return new
