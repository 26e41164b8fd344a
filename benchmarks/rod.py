"""Time emitted steps of a swinging rod for 4 to 1000 sections, and beside PyElastica.

    python benchmarks/rod.py [--elastica PYTHON] [--turns N] [--quick]

The scene is swinging_rod: clamped at one end, under gravity. The first table shows the CPU time of a step of
two methods, and the exponent of N that fits the times. The second table needs a Python that can import
elastica (``pip install pyelastica`` in an environment of its own), which has Numba. Each program solves its
own discretisation of the rod with N pieces until t = 1. Its best number of steps is the smallest of a
geometric sequence with which the position of the tip has an error below 1e-4, relative to its own solution
with many steps. Compilation by Numba is not timed. Both models have the same length, mass, inertia and
stiffnesses. They differ in two points: PyElastica divides forces by the stretch of an element and
bending moments by its cube, and its clamped element does not bend.
"""

from __future__ import annotations

import argparse
import json
import math
import subprocess
import sys
import time
from typing import Any

from codegen import emit, load_lattice
from codegen.scenes.free_rod import straight

METHODS = ("splitting:strang", "cf:cf4")
SIZES = (4, 8, 16, 32, 64, 128, 256, 512, 1000)
EXPONENT, FASTER = (0.9, 1.1), 5.0
"""The bounds of the exponent of N, and the least ratio of the CPU times of PyElastica and of emitted code."""

TIME, GRAVITY, ERROR, RATIO, FINE = 1.0, 10.0, 1e-4, 1.1, 4
"""The time span, the gravity, the error, the ratio of two numbers of steps, and the number of steps of the
reference, divided by the first number of steps at which the method is stable."""

PEER = """
import json, sys, time
import numpy as np
import elastica as ea

class Simulator(ea.BaseSystemCollection, ea.Constraints, ea.Forcing):
    pass

def run(n, gravity, end, steps):
    simulator, radius = Simulator(), 0.1
    area = np.pi * radius**2
    rod = ea.CosseratRod.straight_rod(n, np.zeros(3), np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0]),
        1.0, radius, 1 / area, youngs_modulus=400 / area, shear_modulus=160 / area)
    simulator.append(rod)
    simulator.constrain(rod).using(
        ea.OneEndFixedBC, constrained_position_idx=(0,), constrained_director_idx=(0,))
    simulator.add_forcing_to(rod).using(ea.GravityForces, acc_gravity=np.array([-gravity, 0.0, 0.0]))
    simulator.finalize()
    stepper, t, dt = ea.PositionVerlet(), 0.0, end / steps
    start = time.process_time()
    for _ in range(steps):
        t = stepper.step(simulator, t, dt)
    return rod.position_collection[:, -1].tolist(), time.process_time() - start

run(4, 0.0, 1e-6, 2)
for line in sys.stdin:
    n, gravity, end, steps = json.loads(line)
    print(json.dumps(run(n, gravity, end, steps)), flush=True)
"""


class Emitted:
    """The emitted module of the swinging rod."""

    def __init__(self, method: str) -> None:
        self.lattice = load_lattice(emit("swinging_rod", method, target="c", parameters=["ds", "g"]))

    def run(self, n: int, steps: int, end: float = TIME) -> tuple[list[float], float]:
        """Return the tip of a rod of length 1 at the end, and the CPU seconds."""
        ds = 1 / (n + 0.5)
        states = straight(n, ds)
        start = time.process_time()
        result = self.lattice.run(states, end / steps, steps, ds=ds, g=GRAVITY)
        seconds = time.process_time() - start
        last = result.states[-1]
        tip = [last[9 + k] + ds / 2 * last[2 + 3 * k] for k in range(3)]
        return (tip if result.ok else [math.nan] * 3), seconds


class Elastica:
    """PyElastica in a process of its own."""

    def __init__(self, python: str) -> None:
        pipe = subprocess.PIPE
        command = [python, "-W", "ignore", "-c", PEER]
        self.process = subprocess.Popen(
            command, stdin=pipe, stdout=pipe, stderr=subprocess.DEVNULL, text=True
        )

    def run(self, n: int, steps: int) -> tuple[list[float], float]:
        """Return the tip at the end, and the CPU seconds of the steps."""
        assert self.process.stdin is not None
        assert self.process.stdout is not None
        self.process.stdin.write(json.dumps([n, GRAVITY, TIME, steps]) + "\n")
        self.process.stdin.flush()
        tip, seconds = json.loads(self.process.stdout.readline())
        return tip, seconds


def scaling(turns: int) -> bool:
    """Print the cost of a step for all sizes; return True if an exponent is outside its bounds.

    With an exponent below the bounds, short rods cost more for each section than long rods.
    """
    missed = False
    for method in METHODS:
        module, costs = Emitted(method), []
        for n in SIZES:
            steps = max(20, 100_000 // n)
            costs.append(min(module.run(n, steps, 1e-5 * steps)[1] for _ in range(turns)) / steps)
        low, high = zip(*[(math.log(n), math.log(c)) for n, c in zip(SIZES, costs, strict=True)], strict=True)
        exponent = _slope(low, high)
        shown = "  ".join(f"{n}: {1e9 * c / n:.0f}" for n, c in zip(SIZES, costs, strict=True))
        print(f"{method}: nanoseconds for a step and section: {shown}")
        inside = EXPONENT[0] <= exponent <= EXPONENT[1]
        wanted = "" if inside else f", not between {EXPONENT[0]} and {EXPONENT[1]}"
        print(f"  cost of a step ~ N^{exponent:.2f}{wanted}")
        missed = missed or not inside
    return missed


def _slope(xs: Any, ys: Any) -> float:
    """Return the slope of the line of least squares."""
    x0, y0 = sum(xs) / len(xs), sum(ys) / len(ys)
    total: float = sum((x - x0) * (y - y0) for x, y in zip(xs, ys, strict=True))
    return total / float(sum((x - x0) ** 2 for x in xs))


def best(program: Any, n: int, turns: int) -> tuple[int, float, float, list[float]]:
    """Return the best number of steps, its error, the CPU seconds, and the tip of the reference."""
    fine, _ = program.run(n, FINE * 100 * n)
    steps = 8.0 * n
    while True:
        tip, _ = program.run(n, int(steps))
        error = math.dist(tip, fine)
        if error < ERROR:
            seconds = min(program.run(n, int(steps))[1] for _ in range(turns))
            return int(steps), error, seconds, fine
        steps *= RATIO


def beside(python: str, sizes: tuple[int, ...], turns: int) -> bool:
    """Print the comparison with PyElastica; return True if a ratio misses its bound."""
    missed = False
    programs = {"PyElastica": Elastica(python), "emitted": Emitted(METHODS[0])}
    for n in sizes:
        seconds = {}
        for name, program in programs.items():
            steps, error, seconds[name], fine = best(program, n, turns)
            each = 1e6 * seconds[name] / steps
            at = ", ".join(f"{x:.4f}" for x in fine)
            print(
                f"N = {n}, {name}: {steps} steps, error {error:.1e}, {1e3 * seconds[name]:.2f} ms, "
                f"{each:.2f} us a step; tip ({at})"
            )
        ratio = seconds["PyElastica"] / seconds["emitted"]
        missed = missed or ratio < FASTER
        print(f"N = {n}: PyElastica / emitted = {ratio:.1f}{'' if ratio >= FASTER else ', MISSED'}")
    return missed


def main() -> int:
    """Print the tables; return 1 if a required figure is missed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--elastica", metavar="PYTHON", help="a Python that can import elastica")
    parser.add_argument("--turns", type=int, default=5)
    parser.add_argument("--quick", action="store_true", help="compare with PyElastica for N = 20 only")
    chosen = parser.parse_args()
    missed = scaling(chosen.turns)
    if chosen.elastica is None:
        print("skipped: PyElastica, because --elastica is not given")
        return int(missed)
    return int(beside(chosen.elastica, (20,) if chosen.quick else (20, 50, 100), chosen.turns) or missed)


if __name__ == "__main__":
    sys.exit(main())
