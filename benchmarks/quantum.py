"""Compare Magnus methods in emitted C with DOP853 in C and with QuTiP on the driven four-level system.

    python benchmarks/quantum.py [--error 1e-10]

Each solver integrates ``four_level_system`` over its time interval, with the longest steps or the loosest
tolerance for which the error of the final state is at most the given one. The error is the largest error of
a component; the reference has 28 digits. All solvers are then timed in turns in this process, and the least
CPU time counts. DOP853 runs with step-size control and with equal steps. QuTiP runs ``sesolve`` with three
of its methods; its set-up is not timed. The exit status is 1 if another solver is faster than the
commutator-free Magnus method of order six. Without QuTiP (pip install qutip) its rows are skipped.
"""

from __future__ import annotations

import argparse
import importlib.util
import math
import sys
import time
import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from codegen import scenes
from codegen.emitter import compile_method, emit_compiled
from codegen.ir.domain import FloatDomain
from codegen.lab.peers import find
from codegen.lab.reference import cached_reference
from codegen.loader import load

SCENE = "four_level_system"
LEVELS = 4
OURS = "cf_magnus:cf_magnus6"
EMITTED = (OURS, "cf_magnus:cf_magnus8", "cf_magnus:cf_magnus4", "magnus:magnus6", "ambient:dop853")
QUTIP = ("vern9", "dop853", "adams")
TURNS = 7
BATCH = 0.02

State = Sequence[float]
Solve = Callable[[], State]


@dataclass(frozen=True)
class Solver:
    """A solver with its control, the number of steps or the tolerance, that reaches the error."""

    name: str
    control: str
    error: float
    solve: Solve


def emitted(method: str) -> Iterator[tuple[str, Solve]]:
    """Yield runs of a method in emitted C, with more and more steps of equal length."""
    artifact = emit_compiled(compile_method(SCENE, method), "c")
    module, start = load(artifact), artifact.manifest["initial"]
    first, last = map(float, scenes.load(SCENE).span)
    steps = 50.0
    while steps < 1e5:
        n = round(steps)
        yield f"{n} steps", lambda n=n: module.run(start, (last - first) / n, n, first)
        steps *= 1.05


def controlled() -> Iterator[tuple[str, Solve]]:
    """Yield runs of DOP853 in C with step-size control, with tighter and tighter tolerances."""
    (peer,) = find(["c-dop853"])
    for quarter in range(24, 56):
        prepared = peer.prepare(scenes.load(SCENE), 10.0 ** (-quarter / 4))
        yield f"tolerance 1e-{quarter / 4:g}", lambda prepared=prepared: prepared.run().state


def qutip_runs(method: str) -> Iterator[tuple[str, Solve]]:
    """Yield runs of QuTiP's ``sesolve`` with tighter and tighter tolerances."""
    import numpy as np
    import qutip

    scene = scenes.load(SCENE)
    domain = FloatDomain(0.0)
    value = {name: float(domain.number(number)) for name, number in scene.parameters.items()}
    nu = value["nu"]
    number_operator = np.diag(np.arange(LEVELS)).astype(complex)
    coupling = np.diag(np.sqrt(np.arange(1, LEVELS)), 1).astype(complex)
    static = -value["a"] / 2 * number_operator @ (number_operator - np.eye(LEVELS))
    drive = value["rabi"] / 2 * (coupling + coupling.T)
    H = qutip.QobjEvo(
        [
            qutip.Qobj(static),
            [qutip.Qobj(value["delta"] * number_operator), f"cos({nu} * t)"],
            [qutip.Qobj(drive), f"sin({nu} * t)**2"],
        ]
    )
    initial = scene.initial(domain)
    psi = qutip.Qobj(np.array([complex(*x) for x in zip(initial[:LEVELS], initial[LEVELS:], strict=True)]))
    times = [float(x) for x in scene.span]
    for quarter in range(28, 57, 2):
        tolerance = 10.0 ** (-quarter / 4)
        options = {"method": method, "atol": tolerance, "rtol": tolerance, "nsteps": 10**7}
        solver = qutip.SESolver(H, options=options | {"normalize_output": False, "progress_bar": ""})

        def solve(solver: qutip.SESolver = solver) -> State:
            final = solver.run(psi, times).final_state.full().ravel()
            return [*final.real, *final.imag]

        yield f"tolerance 1e-{quarter / 4:g}", solve


def reached(name: str, runs: Iterator[tuple[str, Solve]], error: float) -> Solver | None:
    """Return the first run with an error of at most ``error``; None if there is none."""
    exact = [float(x) for x in cached_reference(scenes.load(SCENE)).state]
    for control, solve in runs:
        try:
            found = max(abs(x - y) for x, y in zip(solve(), exact, strict=True))
        except ArithmeticError:
            continue
        if found <= error:
            return Solver(name, control, found, solve)
    return None


def seconds(solve: Solve) -> float:
    """Return the CPU time of a run, as the mean of a batch."""
    count, start = 0, time.process_time()
    while time.process_time() - start < BATCH:
        solve()
        count += 1
    return (time.process_time() - start) / count


def main() -> int:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--error", type=float, default=1e-10)
    error = parser.parse_args().error
    warnings.filterwarnings("ignore", module="qutip")
    candidates = [(f"{m} in emitted C", emitted(m)) for m in EMITTED]
    candidates.append(("DOP853 in C, step-size control", controlled()))
    if importlib.util.find_spec("qutip") is not None:
        candidates += [(f"QuTiP sesolve, {m}", qutip_runs(m)) for m in QUTIP]
    else:
        print("QuTiP: skipped, because it is not installed (pip install qutip)")
    solvers = []
    for name, runs in candidates:
        found = reached(name, runs, error)
        if found is None:
            print(f"{name}: does not reach the error {error:g}")
        else:
            solvers.append(found)
    turns = [[seconds(s.solve) for s in solvers] for _ in range(TURNS)]
    times = [min(column) for column in zip(*turns, strict=True)]
    own = next((x for s, x in zip(solvers, times, strict=True) if s.name.startswith(OURS)), math.inf)
    print("| solver | control | error | ms | time / time of CF-Magnus 6 |", "|---|---|---|---|---|", sep="\n")
    for solver, x in zip(solvers, times, strict=True):
        print(f"| {solver.name} | {solver.control} | {solver.error:.1e} | {1e3 * x:.3f} | {x / own:.2f} |")
    others = [x for s, x in zip(solvers, times, strict=True) if "DOP853" in s.name or "QuTiP" in s.name]
    others += [x for s, x in zip(solvers, times, strict=True) if "dop853" in s.name]
    return int(any(x <= own for x in others))


if __name__ == "__main__":
    sys.exit(main())
