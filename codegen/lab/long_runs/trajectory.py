"""The record of a long run: conserved quantities at every step, and states at evenly spaced samples.

Quantities are evaluated on arrays of states, one chunk of steps after another. The largest deviation is over
all steps, although only the samples are stored.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

import numpy

from codegen.lab.invariants import MANIFOLD, expressions
from codegen.lab.number_types import Evaluate
from codegen.lab.straight_line_field import straight_line
from codegen.loader import Integrator, StepFailed
from codegen.scene.problem import Problem

SAMPLES = 1000
CHUNK = 100_000
"""Number of steps whose states are in memory at the same time."""

ArrayFunction: TypeAlias = Callable[[numpy.ndarray, numpy.ndarray], numpy.ndarray]
"""A function of two arrays: states, with one coordinate in each row, and times. It returns rows of values."""

FUNCTIONS = {name: getattr(numpy, name) for name in ("sqrt", "sin", "cos", "exp", "log")}


@dataclass
class Series:
    """One quantity: signed deviations at the samples, and peaks, the largest deviations between samples.

    Deviations are differences from ``start``: the initial value of an invariant, or zero for the manifold
    equations.
    """

    start: float
    deviations: list[float] = field(default_factory=list)
    peaks: list[float] = field(default_factory=list)

    def relative(self) -> tuple[list[float], list[float]]:
        """Return deviations and peaks relative to the initial value.

        If the initial value is zero, they are divided by the largest peak, or by one if this peak is smaller.
        """
        finite = (x for x in self.peaks if math.isfinite(x))
        scale = abs(self.start) or max(1.0, *finite, 1.0)
        return [x / scale for x in self.deviations], [x / scale for x in self.peaks]


@dataclass
class Trajectory:
    """Times, states and numbers of steps at the samples, the quantities, and the message of a failed step."""

    times: list[float]
    states: list[list[float]]
    series: dict[str, Series]
    steps: int = 0
    failure: str = ""
    counts: list[int] = field(default_factory=lambda: [0])


def record(
    scene: Problem, integrator: Integrator, initial: Sequence[float], h: float, steps: int, first: float
) -> Trajectory:
    """Run ``steps`` steps from time ``first`` and record the conserved quantities of a scene."""
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
    return trajectory


def array_functions(scene: Problem) -> dict[str, ArrayFunction]:
    """Return each conserved quantity as a function of arrays; values that are not finite become infinite."""

    def vectorised(f: Evaluate) -> ArrayFunction:
        def evaluate(y: numpy.ndarray, t: numpy.ndarray) -> numpy.ndarray:
            with numpy.errstate(all="ignore"):
                values = numpy.array([numpy.broadcast_to(x, t.shape) for x in f(y, t)], dtype=float)
            return numpy.where(numpy.isfinite(values), values, math.inf)

        return evaluate

    kept = expressions(scene)
    return {
        name: vectorised(straight_line(scene, exprs).python(float, FUNCTIONS)) for name, exprs in kept.items()
    }


def _append(
    trajectory: Trajectory,
    rows: numpy.ndarray,
    first: float,
    h: float,
    stride: int,
    evaluate: Mapping[str, ArrayFunction],
) -> None:
    """Append the samples of a chunk; the first of ``rows`` is the last state of the previous chunk."""
    count = len(rows) - 1
    if not count:
        return
    times = first + h * (trajectory.steps + numpy.arange(1, count + 1))
    ends = [*range(stride, count, stride), count]
    starts = [0, *ends[:-1]]
    for name, series in trajectory.series.items():
        values = evaluate[name](rows[1:].T, times)
        signed = numpy.abs(values).max(axis=0) if name == MANIFOLD else values[0] - series.start
        series.deviations += [float(signed[end - 1]) for end in ends]
        series.peaks += [float(numpy.abs(signed[a:b]).max()) for a, b in zip(starts, ends, strict=True)]
    trajectory.times += [float(times[end - 1]) for end in ends]
    trajectory.states += [rows[end].tolist() for end in ends]
    trajectory.counts += [trajectory.steps + end for end in ends]
    trajectory.steps += count
