"""Measures conserved quantities, symplecticity, reversibility and rounding errors in runs of many steps.

The conserved quantities are the invariants of the scene and the expressions that are zero on its manifold.
The deviation of a quantity is divided by the size of the quantity. To test reversibility, the method runs to
the end with the step size h, and back with the step size -h.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, replace

from codegen.emitter import Compiled
from codegen.integrator import StepFailed
from codegen.lab.distance import distance
from codegen.lab.long_runs.drift import FEWEST, LEVEL, Drift, fit
from codegen.lab.long_runs.rounding_growth import (
    EXACT,
    Growth,
    changes_of_a_step,
    rounding_growth,
)
from codegen.lab.long_runs.symplecticity import largest_defect
from codegen.lab.long_runs.trajectory import Trajectory, record
from codegen.lab.orders.step_sizes import rounding as rounding_bound
from codegen.lab.runner import Emitted

ROUNDING_STEPS = 20_000
"""The largest number of steps of a run that measures the growth of rounding errors."""


EPSILON = 2.0**-52
UNSTABLE = 1000.0
"""A factor in the bound for deviations that rounding errors can cause.

After n steps of a method that conserves a quantity exactly, this bound is UNSTABLE * n * EPSILON times the
magnitude of the quantity. EPSILON is the machine epsilon of doubles.
"""


@dataclass(frozen=True)
class Kept:
    """The relative deviations of one conserved quantity in a run, and its drift.

    ``times`` are the times of the samples, measured from the start of the run. For each sample,
    ``deviations`` contains the mean deviation in the steps since the previous sample, and ``peaks`` contains
    the largest absolute deviation in these steps.
    """

    name: str
    times: tuple[float, ...]
    deviations: tuple[float, ...]
    peaks: tuple[float, ...]
    drift: Drift


@dataclass(frozen=True)
class LongRun:
    """The results of a run of ``steps`` steps of size ``h``.

    - ``kept``: the results for each conserved quantity, or () if the run has too few samples.
    - ``reversals``: two pairs (n, d), or () if not measured. After n steps forward and n steps back, d is the
      distance from the initial state. The number n is about a hundredth of ``steps`` in the first pair, and
      ``steps`` in the second.
    - ``symplectic``: the largest symplectic defect of three steps, or None if it was not measured.
    - ``failure``: the message of a step that failed, or ''. The results describe the steps before the
      failure.
    - ``rounding``: the growth of rounding errors in the quantities that the method conserves exactly.
    - ``unmeasured``: for a Hamiltonian scene, the reason why ``symplectic`` could not be measured, or ''.
    """

    scene: str
    method: str
    h: float
    steps: int
    kept: tuple[Kept, ...]
    reversals: tuple[tuple[int, float], ...]
    symplectic: float | None
    failure: str = ""
    rounding: tuple[Growth, ...] = ()
    unmeasured: str = ""

    def as_json(self) -> dict[str, object]:
        """Return plain data for JSON, without the samples. Numbers that are not finite become None."""
        return {
            "scene": self.scene,
            "method": self.method,
            "h": self.h,
            "steps": self.steps,
            "kept": [{"name": k.name, **k.drift.as_json()} for k in self.kept],
            "reversals": [
                {"steps": n, "distance": x if math.isfinite(x) else None} for n, x in self.reversals
            ],
            "symplectic_defect": self.symplectic,
            "symplectic_not_measured": self.unmeasured,
            "failure": self.failure,
            "rounding": [g.as_json() for g in self.rounding],
        }


def long_run(
    compiled: Compiled, h: float, steps: int, *, back: bool = True, rounding: bool = False
) -> LongRun:
    """Run emitted code from the initial state of the scene over many steps.

    If ``back`` is True, the method then integrates back to the initial time. If ``rounding`` is True, the
    growth of rounding errors is measured (:mod:`codegen.lab.long_runs.rounding_growth`).
    """
    scene, runner = compiled.scene, Emitted(compiled)
    first = float(scene.span[0])
    trajectory = record(scene, runner.integrator, runner.initial, h, steps, first)
    failure = trajectory.failure
    reversals: tuple[tuple[int, float], ...] = ()
    if back and not failure:
        try:
            reversals = _reversals(runner, trajectory, h)
        except StepFailed as failed:
            failure = f"in the run back to the start, {failed}"
    symplectic, unmeasured = None, ""
    if scene.is_hamiltonian:
        try:
            symplectic = largest_defect(compiled, runner, trajectory, h)
        except (ArithmeticError, ValueError) as reason:
            unmeasured = str(reason)
    growth: tuple[Growth, ...] = ()
    if rounding and not failure:
        growth = rounding_growth(compiled, h, min(steps, ROUNDING_STEPS))

    def early(count: int) -> Trajectory:
        return record(scene, runner.integrator, runner.initial, h, count, first)

    changes = {} if failure else changes_of_a_step(compiled, runner, h)
    conserved = [name for name, x in changes.items() if x <= EXACT * trajectory.scales[name]]
    # The factor allows rounding errors in the length of the run.
    brief = abs(h) * trajectory.steps < (1 - 1e-9) * abs(float(scene.span[1] - scene.span[0]))
    kept = tuple(
        replace(k, drift=replace(k.drift, brief=brief)) for k in _kept(trajectory, conserved, changes, early)
    )
    return LongRun(
        scene.name,
        compiled.method.label,
        h,
        trajectory.steps,
        kept,
        reversals,
        symplectic,
        failure,
        growth,
        unmeasured,
    )


def _reversals(runner: Emitted, trajectory: Trajectory, h: float) -> tuple[tuple[int, float], ...]:
    """For two samples of the trajectory, run from the sample back to the initial time.

    Return a pair (n, d) for each sample. The run from the initial state to the sample had n steps, and the
    run back has n steps, too. The number d is the distance of its final state from the initial state.
    """
    reversals = []
    for k in (len(trajectory.counts) // 100, len(trajectory.counts) - 1):
        n = trajectory.counts[k]
        end = runner.integrator.run(trajectory.states[k], -h, n, trajectory.times[k])
        reversals.append((n, distance(runner.compiled.scene, end, runner.initial)))
    return tuple(reversals)


def _kept(
    trajectory: Trajectory,
    conserved: Collection[str],
    changes: Mapping[str, float],
    early: Callable[[int], Trajectory],
) -> tuple[Kept, ...]:
    """Return the deviations and the drift of each conserved quantity.

    ``changes`` maps the name of a quantity to its largest change c in one step. The step is computed with
    many digits, so c is caused by the method and not by rounding errors. Let e be EPSILON times the size of
    the quantity. The number e is about one rounding error in double precision. If c > e/10, c is not
    negligible beside e, so all deviations are attributed to the method. If c <= e/10, small deviations are
    attributed to rounding errors. ``early(n)`` returns a trajectory of the first n steps with dense samples.
    """
    elapsed = [t - trajectory.times[0] for t in trajectory.times[1:]]
    if len(elapsed) < FEWEST:
        return ()
    kept = []
    for name, series in trajectory.series.items():
        scale = trajectory.scales[name]
        deviations, peaks, lows = series.relative(scale)
        whole = trajectory.steps * EPSILON
        truncation = trajectory.steps * changes.get(name, math.inf) / scale
        bound = rounding_bound(trajectory.steps, EPSILON, 1.0) * max(1.0, trajectory.magnitudes[name] / scale)
        if name in conserved:
            bound *= UNSTABLE
        elif truncation > whole / 10:
            bound = 0.0
        drift = fit(elapsed, deviations, peaks, bound, lows)
        if drift.largest <= bound:
            drift = replace(drift, until=None)
        elif drift.until is not None:
            drift = _before_saturation(name, drift, trajectory, early)
        kept.append(Kept(name, tuple(elapsed), tuple(deviations), tuple(peaks), drift))
    return tuple(kept)


def _before_saturation(
    name: str, whole: Drift, trajectory: Trajectory, early: Callable[[int], Trajectory]
) -> Drift:
    """Return the drift of the quantity ``name``, computed only from samples before the deviation saturates.

    The time at which a deviation saturates is defined at :data:`codegen.lab.long_runs.drift.LEVEL`.
    """
    times = [t - trajectory.times[0] for t in trajectory.times[1:]]
    level = times.index(whole.until) + 1 if whole.until is not None else 0
    if level > FEWEST:
        return whole
    steps = max(trajectory.counts[level], FEWEST)
    start = early(steps)
    deviations, peaks, _ = start.series[name].relative(trajectory.scales[name])
    elapsed = [t - start.times[0] for t in start.times[1:]]
    reached = next((k for k, x in enumerate(peaks) if x >= LEVEL * whole.largest), len(peaks) - 1)
    count = max(reached + 1, FEWEST)
    growth = fit(elapsed[:count], deviations[:count], peaks[:count])
    return replace(growth, largest=whole.largest, rounding=whole.rounding, until=elapsed[reached])
