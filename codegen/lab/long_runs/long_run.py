"""Long runs of emitted code: conserved quantities, symplecticity, reversibility, and growth of rounding
errors.

The energy, the declared invariants and the manifold equations are evaluated after every step. Deviations are
divided by the size of the quantity. Reversibility is tested by a run to the end with the step size h,
followed by a run back with -h. A symmetric method returns to the initial state up to rounding.
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
"""The growth of rounding errors is measured over at most this number of steps, from several initial
states.
"""


EPSILON = 2.0**-52
UNSTABLE = 1000.0
"""If a method conserves a quantity exactly, changes up to UNSTABLE * n * EPSILON in n steps are attributed to
rounding errors.

The changes are relative to the magnitude of the quantity. EPSILON is the machine epsilon of doubles.
"""


@dataclass(frozen=True)
class Kept:
    """One conserved quantity: its deviations and peaks at the sample times, and the drift.

    A deviation is relative, and is the mean over all steps since the previous sample. A peak is the largest
    absolute deviation since the previous sample.
    """

    name: str
    times: tuple[float, ...]
    deviations: tuple[float, ...]
    peaks: tuple[float, ...]
    drift: Drift


@dataclass(frozen=True)
class LongRun:
    """The results of a run of ``steps`` steps of size ``h``.

    - ``kept``: the conserved quantities, empty if there are too few steps.
    - ``failure``: the message of a step that failed. The results then describe the steps before the failure.
    - ``reversals``: pairs of a number n and the distance from the initial state after n steps forward and n
      steps back. The two pairs are for the first hundredth of the run and for the whole run.
    - ``symplectic``: the largest symplectic defect of a step from several states, or None if not measured.
    - ``unmeasured``: the reason if the defect of a Hamiltonian scene could not be measured, otherwise ''.
    - ``rounding``: the growth of rounding errors in the quantities that the method conserves exactly.
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
        """Return plain data for JSON, without the sampled deviations. Numbers that are not finite become
        None."""
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

    If ``back`` is True, the method also runs back to the start, which doubles the time. If ``rounding`` is
    True, the growth of rounding errors is measured with and without compensated summation
    (:mod:`codegen.lab.long_runs.rounding_growth`).
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
    kept = _kept(trajectory, conserved, changes, early)
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
    """Return pairs of a number n and the distance from the initial state after n steps forward and n back."""
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
    """Return the conserved quantities with their drifts.

    The method conserves the quantities in ``conserved`` exactly, so their deviations are rounding errors.
    ``changes`` maps the name of a quantity to its change in one step, computed with 60 digits. For a quantity
    that is not in ``conserved``, a very small change in one step shows that deviations are rounding errors.
    If a quantity saturates within the first samples, the function calls ``early(n)``, which records the first
    n steps with more samples.
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
    """Return the drift of a quantity before it saturates.

    If there are too few samples before the saturation, the first steps are recorded again with more samples.
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
