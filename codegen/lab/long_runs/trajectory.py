"""The record of a long run: states at equally spaced times, and deviations of conserved quantities.

The stored states are called samples. For each interval between two samples, only a summary of the deviations
is stored (:class:`Series`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

import numpy

from codegen.integrator import Integrator, StepFailed
from codegen.ir.expr import Expr
from codegen.lab.invariants import MANIFOLD, expressions, magnitudes
from codegen.lab.number_functions import of_arrays
from codegen.lab.number_types import Evaluate
from codegen.lab.straight_line_field import straight_line
from codegen.scene.problem import Problem

SAMPLES = 1000
CANCELLED = 1e-2
"""The terms x_i of a quantity cancel if abs(sum x_i) <= CANCELLED * sum abs(x_i)."""

CHUNK = 100_000
"""A long run is divided into chunks of about CHUNK steps to save memory."""

ArrayFunction: TypeAlias = Callable[[numpy.ndarray, numpy.ndarray], numpy.ndarray]
"""A function that evaluates a quantity at many states.

The first argument has one row for each coordinate and one column for each state. The second argument contains
the times of the states. The result has one row for each component, and one column for each state.
"""

FUNCTIONS = of_arrays(numpy)


@dataclass
class Series:
    """The mean and the extreme deviations of one conserved quantity in each interval of a run.

    Each interval lies between two consecutive samples. The deviation of an invariant is its value minus its
    initial value ``start``. The deviation from the manifold is the largest absolute residual of the equations
    that define the manifold.

    - ``deviations``: the mean deviation in each interval.
    - ``peaks``: the largest absolute deviation in each interval.
    - ``lows``: the smallest absolute deviation in each interval, or zero if the deviation changes sign.
    """

    start: float
    deviations: list[float] = field(default_factory=list)
    peaks: list[float] = field(default_factory=list)
    lows: list[float] = field(default_factory=list)

    def append(self, values: numpy.ndarray) -> None:
        """Append one number to each of the lists ``deviations``, ``peaks`` and ``lows``.

        ``values`` contains the deviation after each step of an interval. The mean of ``values`` is appended
        to ``deviations``, the largest absolute value to ``peaks``, and the smallest absolute value to
        ``lows``. If the deviation changes sign, zero is appended to ``lows`` instead.
        """
        absolute = numpy.abs(values)
        crosses = values.min() < 0.0 < values.max()
        with numpy.errstate(all="ignore"):  # The sum may overflow.
            self.deviations.append(float(values.mean()))
        self.peaks.append(float(absolute.max()))
        self.lows.append(0.0 if crosses else float(absolute.min()))

    def relative(self, scale: float) -> tuple[list[float], list[float], list[float]]:
        """Return ``deviations``, ``peaks`` and ``lows``, divided by ``scale``."""
        rows = (self.deviations, self.peaks, self.lows)
        deviations, peaks, lows = ([x / scale for x in row] for row in rows)
        return deviations, peaks, lows


@dataclass
class Trajectory:
    """The record of a run.

    - ``times``, ``states``: the times and the states of the samples.
    - ``series``: the deviations of each conserved quantity.
    - ``steps``: the number of completed steps of the run.
    - ``failure``: the message of a failed step, or ''.
    - ``counts``: for each sample, the number of steps since the beginning of the run.
    - ``scales``: for each quantity, the number by which its deviations are divided (:func:`scale`).
    - ``magnitudes``: for each quantity, the sum of the absolute values of its terms (:func:`scale`).
    """

    times: list[float]
    states: list[list[float]]
    series: dict[str, Series]
    steps: int = 0
    failure: str = ""
    counts: list[int] = field(default_factory=lambda: [0])
    scales: dict[str, float] = field(default_factory=dict)
    magnitudes: dict[str, float] = field(default_factory=dict)


def record(
    scene: Problem, integrator: Integrator, initial: Sequence[float], h: float, steps: int, first: float
) -> Trajectory:
    """Make ``steps`` steps of size ``h`` from the time ``first``, and return the record of the run.

    If a step fails, the record ends with the state before this step.
    """
    stride = max(steps // SAMPLES, 1)
    chunk = stride * max(CHUNK // stride, 1)
    evaluate = array_functions(scene)
    state = numpy.array(initial, dtype=float)
    start = {name: f(state[:, None], numpy.array([first]))[:, 0] for name, f in evaluate.items()}
    series = {name: Series(0.0 if name == MANIFOLD else float(x[0])) for name, x in start.items()}
    trajectory = Trajectory([first], [list(initial)], series)
    while trajectory.steps < steps and not trajectory.failure:
        count = min(chunk, steps - trajectory.steps)
        t = first + h * trajectory.steps
        try:
            rows = integrator.trajectory(state, h, count, 1, t)
        except StepFailed as failed:
            trajectory.failure = f"step {trajectory.steps + failed.step + 1}: {failed.reason}"
            count = failed.step
            rows = integrator.trajectory(state, h, count, 1, t)
        _append(trajectory, rows, first, h, stride, evaluate)
        state = rows[-1]
    trajectory.magnitudes = _magnitudes(scene, trajectory)
    trajectory.scales = {
        name: scale(s.start, trajectory.magnitudes[name]) for name, s in trajectory.series.items()
    }
    return trajectory


def scale(start: float, magnitude: float) -> float:
    """Return the size of a conserved quantity. Deviations of the quantity are divided by this size.

    ``start`` is the initial value of the quantity, and ``magnitude`` is the sum of the absolute values of its
    terms. If ``start`` and ``magnitude`` are zero, the size is 1. Otherwise the size is ``magnitude`` if the
    terms cancel (:data:`CANCELLED`), and ``abs(start)`` if the terms do not cancel.

    >>> scale(-2.0, 3.0), scale(1e-12, 3.0), scale(0.0, 0.0)
    (2.0, 3.0, 1.0)
    """
    return abs(start) if abs(start) > CANCELLED * magnitude else magnitude or 1.0


def _magnitudes(scene: Problem, trajectory: Trajectory) -> dict[str, float]:
    """For each conserved quantity, return the sum of the absolute values of its terms at the initial state.

    If this sum is zero, the largest sum in the first tenth of the samples is returned instead.
    """
    count = max(len(trajectory.states) // 10, 1)
    states, times = numpy.array(trajectory.states[:count]).T, numpy.array(trajectory.times[:count])
    sizes = {MANIFOLD: 1.0}
    for name, evaluate in array_functions(scene, magnitudes(scene)).items():
        values = evaluate(states, times)[0]
        sizes[name] = float(values[0] or values[numpy.isfinite(values)].max())
    return sizes


def array_functions(
    scene: Problem, kept: Mapping[str, tuple[Expr, ...]] | None = None, swept: Sequence[str] = ()
) -> dict[str, ArrayFunction]:
    """Return a dictionary from the names of quantities to functions that evaluate them at many states.

    ``kept`` maps the name of each quantity to its expressions. By default, the quantities are the conserved
    quantities of the scene. The functions return infinity in place of values that are not finite.

    The arguments of each function are an array y and an array of times. Each column of y contains the
    coordinates of a state, followed by the values of the parameters ``swept``.
    """
    symbols = (*scene.symbols, *swept)

    def vectorised(f: Evaluate) -> ArrayFunction:
        def evaluate(y: numpy.ndarray, t: numpy.ndarray) -> numpy.ndarray:
            with numpy.errstate(all="ignore"):
                values = numpy.array([numpy.broadcast_to(x, t.shape) for x in f(y, t)], dtype=float)
            return numpy.where(numpy.isfinite(values), values, math.inf)

        return evaluate

    return {
        name: vectorised(straight_line(scene.name, symbols, exprs).python(float, FUNCTIONS))
        for name, exprs in (expressions(scene) if kept is None else kept).items()
    }


def _append(
    trajectory: Trajectory,
    rows: numpy.ndarray,
    first: float,
    h: float,
    stride: int,
    evaluate: Mapping[str, ArrayFunction],
) -> None:
    """Append the samples of a chunk of steps to the record of a run.

    The first row of ``rows`` is the last state of the previous chunk. Every ``stride``-th state and the last
    state of the chunk become samples.
    """
    count = len(rows) - 1
    if not count:
        return
    times = first + h * (trajectory.steps + numpy.arange(1, count + 1))
    ends = [*range(stride, count, stride), count]
    starts = [0, *ends[:-1]]
    for name, series in trajectory.series.items():
        values = evaluate[name](rows[1:].T, times)
        signed = numpy.abs(values).max(axis=0) if name == MANIFOLD else values[0] - series.start
        for a, b in zip(starts, ends, strict=True):
            series.append(signed[a:b])
    trajectory.times += [float(times[end - 1]) for end in ends]
    trajectory.states += [rows[end].tolist() for end in ends]
    trajectory.counts += [trajectory.steps + end for end in ends]
    trajectory.steps += count
