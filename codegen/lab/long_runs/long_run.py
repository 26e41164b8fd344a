"""Long runs of emitted code: conserved quantities, symplecticity, reversibility, and growth of rounding
errors.

Energy, declared invariants and the manifold equations are evaluated after every step; deviations are
relative to the size of the quantity. Reversibility is tested by a run to the end and back with -h; a
symmetric method returns to the initial state up to rounding.
"""

from __future__ import annotations

import math
from collections.abc import Collection
from contextlib import suppress
from dataclasses import dataclass

from codegen.emitter import Compiled
from codegen.ir.domain import NotConverged
from codegen.lab.distance import distance
from codegen.lab.long_runs.drift import BLOCKS, Drift, fit
from codegen.lab.long_runs.rounding_growth import Growth, exactly_conserved, rounding_growth
from codegen.lab.long_runs.symplecticity import symplectic_defect
from codegen.lab.long_runs.trajectory import Trajectory, record
from codegen.lab.orders.step_sizes import rounding as rounding_bound
from codegen.lab.runner import Emitted
from codegen.loader import StepFailed

ROUNDING_STEPS = 20_000
"""The growth of rounding errors is measured from several starts over at most this number of steps."""


@dataclass(frozen=True)
class Kept:
    """One conserved quantity: its relative deviations and peaks at the sample times, and their drift.

    A peak is the largest absolute deviation over all steps since the previous sample.
    """

    name: str
    times: tuple[float, ...]
    deviations: tuple[float, ...]
    peaks: tuple[float, ...]
    drift: Drift


@dataclass(frozen=True)
class LongRun:
    """A run of ``steps`` steps of size ``h``.

    ``failure`` is the message of a step that failed. The results then describe the steps before the failure,
    and ``kept`` is empty if there are too few steps. ``reversals`` are pairs: a number of steps, and the
    distance from the initial state after that many steps forward and back. One pair is for the whole run and
    one for a hundredth of it, because chaos amplifies rounding errors in long runs. ``symplectic`` is the
    symplectic defect of one step; None if the scene is not Hamiltonian, if the run failed, or if the step is
    too long for the solver in 60 digits. ``rounding`` is the growth of rounding errors in the quantities that
    the method conserves exactly.
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

    def as_json(self) -> dict[str, object]:
        """Return plain data, without the sampled deviations; numbers that are not finite are null."""
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
            "failure": self.failure,
            "rounding": [g.as_json() for g in self.rounding],
        }


def long_run(
    compiled: Compiled, h: float, steps: int, *, back: bool = True, rounding: bool = False
) -> LongRun:
    """Run emitted code from the initial state of the scene over many steps.

    ``back`` includes the run back, which doubles the time; ``rounding`` includes the growth of rounding
    errors with and without compensation (:mod:`codegen.lab.long_runs.rounding_growth`).
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
            failure = f"in the run back, {failed}"
    middle = len(trajectory.states) // 2
    symplectic = None
    if scene.is_hamiltonian and not failure:
        with suppress(NotConverged):
            symplectic = symplectic_defect(compiled, trajectory.states[middle], h)
    starts = [(first, runner.initial), (trajectory.times[middle], trajectory.states[middle])]
    conserved = tuple(exactly_conserved(compiled, starts, h))
    growth: tuple[Growth, ...] = ()
    if rounding and not failure:
        growth = rounding_growth(compiled, h, min(steps, ROUNDING_STEPS))
    kept = _kept(trajectory, conserved)
    return LongRun(
        scene.name, compiled.method.label, h, trajectory.steps, kept, reversals, symplectic, failure, growth
    )


def _reversals(runner: Emitted, trajectory: Trajectory, h: float) -> tuple[tuple[int, float], ...]:
    """Return pairs: a number of steps, and the distance from the start after the run forward and back."""
    reversals = []
    for k in (len(trajectory.counts) // 100, len(trajectory.counts) - 1):
        n = trajectory.counts[k]
        end = runner.integrator.run(trajectory.states[k], -h, n, trajectory.times[k])
        reversals.append((n, distance(runner.compiled.scene, end, runner.initial)))
    return tuple(reversals)


def _kept(trajectory: Trajectory, conserved: Collection[str]) -> tuple[Kept, ...]:
    """Return the quantities with their drifts.

    The method conserves the quantities in ``conserved`` exactly; their deviation counts as rounding.
    """
    elapsed = [t - trajectory.times[0] for t in trajectory.times[1:]]
    if len(elapsed) < 2 * BLOCKS:
        return ()
    bound = rounding_bound(trajectory.steps, 2.0**-52, 1.0)
    kept = []
    for name, series in trajectory.series.items():
        deviations, peaks = series.relative()
        drift = fit(elapsed, deviations, peaks, math.inf if name in conserved else bound)
        kept.append(Kept(name, tuple(elapsed), tuple(deviations), tuple(peaks), drift))
    return tuple(kept)
