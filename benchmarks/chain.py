"""Measure how the time of implicit steps grows with the number of sites of a chain.

    python benchmarks/chain.py [--seconds S]

The chain consists of pendulums that are coupled by springs, with one clamped end. The steps are those of the
midpoint rule and of the Gauss method of order 4. For each number of sites the CPU time of a step is the least
of several runs, and each run has as many steps as S seconds permit. The exponent p of the fit c N^p is
printed for each solver.
"""

from __future__ import annotations

import argparse
import math
import time

from sympy import Matrix, sin, symbols

from codegen import emit, load_lattice
from codegen.groups import LeftMultiplication, Rn
from codegen.lattice import Lattice
from codegen.scene import SiteScene, left, right

NUMBERS = (4, 8, 16, 32, 64, 125, 250, 500, 1000)
NEWTON = "simplified-newton"
METHODS = (("rk:gauss1", "fixed-point"), ("rk:gauss1", NEWTON), ("rk:gauss2", NEWTON))
H, RUNS, ALLOWED = 0.05, 5, 0.1
"""The step size, the number of runs, and the largest difference of the exponent from one."""


def lattice(method: str, solver: str) -> Lattice:
    """Return the emitted module."""
    q, p = y = Matrix(symbols("q p", real=True))
    force = left(y)[0] - 2 * q + right(y)[0] - sin(q)
    scene = SiteScene(
        group=Rn(2),
        action=LeftMultiplication(),
        y=y,
        f=[p, force],
        y0=[1, 0],
        span=(0, 1),
        boundary="open",
        outside={(-1,): [0, 0], (1,): y},
        name="pendulums",
    )
    return load_lattice(emit(scene, method, target="c", solver=solver))


def seconds_of_a_step(module: Lattice, sites: int, least: float) -> float:
    """Return the CPU seconds of a step."""
    start = [[math.cos(0.1 * i), 0.0] for i in range(sites)]
    steps, times = 1, []
    # The first call imports NumPy.
    module.run(start, H, steps)
    while True:
        before = time.process_time()
        module.run(start, H, steps)
        if time.process_time() - before > least:
            break
        steps *= 2
    for _ in range(RUNS):
        before = time.process_time()
        if not module.run(start, H, steps).ok:
            raise SystemExit(f"a step of {sites} sites failed")
        times.append((time.process_time() - before) / steps)
    return min(times)


def exponent(numbers: list[int], seconds: list[float]) -> float:
    """Return the exponent of the fit in logarithms, by least squares."""
    xs, ys = [math.log(n) for n in numbers], [math.log(t) for t in seconds]
    x, y = sum(xs) / len(xs), sum(ys) / len(ys)
    pairs = zip(xs, ys, strict=True)
    return sum((a - x) * (b - y) for a, b in pairs) / sum((a - x) ** 2 for a in xs)


def main() -> int:
    """Print the table; return 1 if the exponent of Newton's method differs from one by more than
    :data:`ALLOWED`, or if another exponent is larger than that."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=0.05)
    chosen = parser.parse_args()
    missed = False
    print(f"nanoseconds a site and step, N = {', '.join(map(str, NUMBERS))}")
    for method, solver in METHODS:
        module = lattice(method, solver)
        seconds = [seconds_of_a_step(module, n, chosen.seconds) for n in NUMBERS]
        p = exponent(list(NUMBERS), seconds)
        # For few sites, the constant time of a sweep exceeds the time of vectorised loops.
        missed |= p - 1 > ALLOWED or (solver == NEWTON and 1 - p > ALLOWED)
        each = " ".join(f"{1e9 * t / n:.0f}" for t, n in zip(seconds, NUMBERS, strict=True))
        print(f"{method}, {solver}: {each}; exponent {p:.3f}")
    return int(missed)


if __name__ == "__main__":
    raise SystemExit(main())
