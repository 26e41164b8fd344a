"""Long runs of emitted code: invariants, the manifold, symplecticity, the way back, and how rounding grows.

The trajectory is sampled evenly; energy, declared invariants and the laws of the manifold are evaluated on
the samples. Deviations are relative to the size of what is kept. Reversibility is a run to the end and back
with -h; a symmetric method returns to the start up to rounding.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

from codegen.emitter import Compiled
from codegen.ir.domain import NotConverged
from codegen.lab.distance import distance
from codegen.lab.drift import BLOCKS, Drift, fit
from codegen.lab.invariants import MANIFOLD, functions
from codegen.lab.roundoff import Growth, roundoff
from codegen.lab.runner import Emitted
from codegen.lab.symplecticity import symplectic_defect
from codegen.loader import StepFailed
from codegen.scene.problem import Problem

SAMPLES = 1000


@dataclass(frozen=True)
class Kept:
    """One quantity that the flow keeps: times, deviations relative to its size, and their drift."""

    name: str
    times: tuple[float, ...]
    deviations: tuple[float, ...]
    drift: Drift


@dataclass(frozen=True)
class LongRun:
    """What a method kept on a scene over ``steps`` steps of size ``h``.

    ``failure`` says at which step and why a run ended early; the rest then speaks of what was run, and
    nothing is said of what was kept where that is too short.
    ``reversals`` are numbers of steps with the distance from the start after the way there and back: of the
    whole run and, as chaos magnifies rounding, of a hundredth of it. ``symplectic`` is the defect of one
    step, None off T*G, for a run that failed and for steps too long to be solved in 60 digits. ``rounding``
    is how it grows in what the method keeps exactly.
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

    def as_json(self) -> dict[str, Any]:
        """Return plain data, without the sampled deviations."""
        return {
            "scene": self.scene,
            "method": self.method,
            "h": self.h,
            "steps": self.steps,
            "kept": [
                {
                    "name": k.name,
                    "largest": k.drift.largest,
                    "slope": k.drift.slope,
                    "half_width": k.drift.half_width,
                    "exponent": k.drift.exponent,
                    "law": k.drift.law,
                }
                for k in self.kept
            ],
            "reversals": [{"steps": n, "distance": x} for n, x in self.reversals],
            "symplectic_defect": self.symplectic,
            "failure": self.failure,
            "rounding": [g.as_json() for g in self.rounding],
        }


ROUNDED = 20_000
"""Steps over which the growth of rounding is looked at, at most, for each of several starts."""


def longrun(
    compiled: Compiled, h: float, steps: int, *, back: bool = True, rounding: bool = False
) -> LongRun:
    """Run emitted C over many steps from the scene's initial state, and say what was kept.

    ``back`` asks for the way back as well, which doubles the run, ``rounding`` for how rounding grows, with
    and without compensation (:mod:`codegen.lab.roundoff`).
    """
    scene, runner = compiled.scene, Emitted(compiled, "c")
    first = float(scene.span[0])
    stride = max(steps // SAMPLES, 1)
    steps -= steps % stride
    failure = ""
    reversals: list[tuple[int, float]] = []
    try:
        rows = runner.integrator.trajectory(runner.initial, h, steps, stride, first)
    except StepFailed as failed:
        failure = str(failed)
        stride = max(failed.step // SAMPLES, 1)
        steps = failed.step - failed.step % stride
        rows = runner.integrator.trajectory(runner.initial, h, steps, stride, first)
    times = [first + h * stride * k for k in range(len(rows))]
    kept: tuple[Kept, ...] = ()
    if len(rows) > 2 * BLOCKS:
        kept = tuple(_kept(name, times, x) for name, x in _quantities(scene, rows, times).items())
    if back and not failure:
        try:
            for samples in (len(rows) // 100, len(rows) - 1):
                n = samples * stride
                end = runner.integrator.run(rows[samples], -h, n, times[samples])
                reversals.append((n, distance(scene, end, runner.initial)))
        except StepFailed as failed:
            failure = f"on the way back, {failed}"
    paired = scene.is_hamiltonian and not failure
    symplectic = None
    if paired:
        with suppress(NotConverged):
            symplectic = symplectic_defect(compiled, rows[len(rows) // 2], h)
    grown = roundoff(compiled, h, min(steps, ROUNDED)) if rounding and not failure else ()
    return LongRun(
        scene.name, compiled.method.label, h, steps, kept, tuple(reversals), symplectic, failure, grown
    )


def _kept(name: str, times: Sequence[float], values: Sequence[float]) -> Kept:
    elapsed = [t - times[0] for t in times[1:]]
    return Kept(name, tuple(elapsed), tuple(values[1:]), fit(elapsed, values[1:]))


def _quantities(scene: Problem, rows: Sequence[Any], times: Sequence[float]) -> dict[str, list[float]]:
    """Return deviations along a trajectory: of each invariant from its start, and from the manifold."""
    found: dict[str, list[float]] = {}
    for name, evaluate in functions(scene).items():
        series = [evaluate(row, t) for row, t in zip(rows, times, strict=True)]
        if name == MANIFOLD:
            found[name] = [max(map(abs, values)) for values in series]
            continue
        start = series[0][0]
        scale = abs(start) if start else max(1.0, *(abs(v[0]) for v in series))
        found[name] = [(v[0] - start) / scale for v in series]
    return found
