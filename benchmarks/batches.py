"""Time emitted batches and the batch mode of heyoka to the same error.

    python benchmarks/batches.py [--systems N] [--turns N] [--error E]

The systems of a batch have different initial states. heyoka steps as many systems at once as its vector
registers have numbers, and chooses its step size; it gets the loosest tolerance that reaches the error. An
emitted module makes equal steps; each method gets the smallest number of steps that reaches the error, on a
ladder of ratio 1.1. The error is the largest deviation of a coordinate, over all systems, from heyoka at its
smallest tolerance. All programs run in turns in one process, and their CPU times are printed with the median
and the quartiles of the ratios. A group of systems of heyoka is started from Python; the time of runs of
length zero is subtracted from its time, which favours heyoka.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import heyoka
import numpy as np
from numpy.typing import NDArray

import codegen
from codegen import scenes
from codegen.ir.domain import FloatDomain
from codegen.ir.elementary import MATHEMATICAL
from codegen.lab.straight_line_field import velocity

END = 20.0
"""The length of a run."""

MOST = 4096
"""The largest number of steps that is tried."""

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Case:
    """A scene and the methods that are compared with heyoka on it."""

    scene: str
    methods: tuple[str, ...]


METHODS = ("ambient:verner8_efficient", "ambient:dop853", "rkmk(6):dop853")
CASES = (Case("free_rigid_body", METHODS), Case("driven_spin", METHODS))


class Peer:
    """The batch mode of heyoka on a scene, with one tolerance."""

    def __init__(self, scene: str, tolerance: float, lanes: int) -> None:
        problem = scenes.load(scene)
        variables = heyoka.make_vars(*problem.symbols)
        functions = {name: getattr(heyoka, name) for name in MATHEMATICAL}
        formulas = velocity(problem).python(lambda x: heyoka.expression(float(x)), functions)
        roots = formulas(list(variables), heyoka.time)
        start = np.zeros((len(variables), lanes))
        self.lanes = lanes
        self.solver: Any = heyoka.taylor_adaptive_batch(
            list(zip(variables, roots, strict=True)), start, time=np.zeros(lanes), tol=tolerance
        )

    def run(self, states: Floats, end: float) -> Floats:
        """Return the states, of shape (size, N), at the time ``end``. N is a multiple of the lanes."""
        result, zeros, ends = np.empty_like(states), np.zeros(self.lanes), np.full(self.lanes, end)
        for first in range(0, states.shape[1], self.lanes):
            own = slice(first, first + self.lanes)
            self.solver.set_time(zeros)
            self.solver.state[:] = states[:, own]
            self.solver.propagate_until(ends)
            result[:, own] = self.solver.state
        return result


class Emitted:
    """An emitted batch of one method with a number of equal steps."""

    def __init__(self, scene: str, method: str, states: Floats, end: float = END) -> None:
        self.integrator = codegen.load(codegen.emit(scene, method, target="c", batch=True))
        self.states, self.end = states, end
        self.out = np.empty(states.T.shape, order="F")
        self.steps = 8

    def run(self) -> bool:
        """Run all systems; return False if a step fails."""
        self.out[:] = self.states.T
        return self.integrator.run_batch(self.out, h=self.end / self.steps, steps=self.steps, out=self.out).ok

    def reach(self, reference: Floats, error: float, most: int = MOST) -> float | None:
        """Choose the number of steps; return the error that they reach, or None if it is above the bound."""
        while self.steps <= most:
            if self.run() and (found := _deviation(self.out.T, reference)) <= error:
                return found
            self.steps = int(1.1 * self.steps) + 1
        return None


def _deviation(states: Floats, reference: Floats) -> float:
    return float(abs(states - reference).max())


def seconds(work: Callable[[], object]) -> float:
    """Return the CPU time of a call."""
    begin = time.process_time()
    work()
    return time.process_time() - begin


def _peer(
    scene: str, states: Floats, reference: Floats, error: float, lanes: int
) -> tuple[Peer, float, float]:
    """Return heyoka with the loosest tolerance that reaches the error, the tolerance, and its error."""
    for power in range(4, 16):
        peer = Peer(scene, 10.0**-power, lanes)
        found = _deviation(peer.run(states, END), reference)
        if found <= error:
            return peer, 10.0**-power, found
    raise SystemExit(f"heyoka does not reach the error {error:g} on {scene}")


def rows(case: Case, systems: int, turns: int, error: float) -> Iterator[tuple[str, float]]:
    """Yield one row of the table for heyoka, and one for each method, with the ratio heyoka / program."""
    lanes = heyoka.recommended_simd_size()
    systems += -systems % lanes
    start = np.array([float(x) for x in scenes.load(case.scene).initial(FloatDomain(0.0))])
    states = np.ascontiguousarray((start * (1 + 1e-3 * np.arange(systems) / systems)[:, None]).T)
    reference = Peer(case.scene, 1e-18, lanes).run(states, END)
    peer, tolerance, reached = _peer(case.scene, states, reference, error, lanes)
    found: dict[str, tuple[Emitted, float]] = {}
    for method in case.methods:
        candidate = Emitted(case.scene, method, states)
        if (deviation := candidate.reach(reference, error)) is not None:
            found[method] = candidate, deviation
    times: dict[str, list[float]] = {name: [] for name in ("heyoka", *found)}
    for _ in range(turns):
        empty = seconds(lambda: peer.run(states, 0.0))
        times["heyoka"].append(seconds(lambda: peer.run(states, END)) - empty)
        for method, (candidate, _) in found.items():
            times[method].append(seconds(candidate.run))
    scale = 1e6 / systems
    base = statistics.median(times["heyoka"])
    yield (
        f"| {case.scene} | heyoka {heyoka.__version__}, {lanes} systems at once | tolerance {tolerance:.0e} "
        f"| {reached:.1e} | {base * scale:.2f} | 1 | - |",
        0.0,
    )
    for method in case.methods:
        if method not in found:
            yield f"| {case.scene} | {method} | not reached | - | - | - | - |", 0.0
            continue
        candidate, deviation = found[method]
        ratios = [a / b for a, b in zip(times["heyoka"], times[method], strict=True)]
        low, middle, high = statistics.quantiles(ratios, n=4)
        yield (
            f"| {case.scene} | {method} | {candidate.steps} steps | {deviation:.1e} "
            f"| {statistics.median(times[method]) * scale:.2f} | {middle:.2f} | {low:.2f} to {high:.2f} |",
            middle,
        )


def main() -> int:
    """Print a table with a row for each scene and program; return 1 if heyoka is the fastest on a scene."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--systems", type=int, default=1000, help="systems in a batch")
    parser.add_argument("--turns", type=int, default=15, help="measurements of each program")
    parser.add_argument("--error", type=float, default=1e-9, help="the error that all programs reach")
    options = parser.parse_args()
    print("| scene | program | control | error | us per system | heyoka / program | quartiles |")
    print("|---|---|---|---:|---:|---:|---:|")
    slower = False
    for case in CASES:
        best = 0.0
        for row, ratio in rows(case, options.systems, options.turns, options.error):
            print(row, flush=True)
            best = max(best, ratio)
        slower |= best < 1
    return int(slower)


if __name__ == "__main__":
    raise SystemExit(main())
