"""Time steps on n x 4 matrices with orthonormal columns for n = 50, 100, 200, 400 and 800.

The field is X' = (1 - X X^T) A X with a tridiagonal matrix A. All sizes are timed in turn, for several
rounds. The least CPU time of each size is kept, because other processes can only increase a time. The script
prints the time of a step for each n, and the exponent p of the best power c n^p. The last column describes
the part of a step that does not depend on n, the operations with small matrices: the number of rows that take
the same time. The script exits with 1 if the exponent of Lie-Euler differs from 1 by more than 0.1.

usage: python benchmarks/stiefel.py [ROUNDS]
"""

from __future__ import annotations

import sys
import time
from collections.abc import Sequence

import numpy as np

from codegen import emit, load
from codegen.integrator import Integrator
from codegen.scene import Problem, StiefelScene, banded, unknown

SIZES = (50, 100, 200, 400, 800)
COLUMNS = 4
METHODS = ("rkmk(0):euler", "cf:cf4", "rkmk:rk4")
REQUIRED = 0.1
"""The largest permitted distance of the exponent of the first method from 1."""

H = 0.01
ROWS = 400_000
"""The number of rows times steps in a timed run. Such a run takes at least 10 ms."""

ROUNDS = 15


def scene(n: int) -> Problem:
    """Return the scene with n rows."""
    X, A = unknown(n, COLUMNS), banded(n, {-1: -1, 0: 2, 1: -1})
    return StiefelScene(x=X, velocity=A @ X - X @ X.T @ A @ X, span=(0, 1), name=f"columns{n}")


def start(n: int) -> list[float]:
    """Return a matrix with orthonormal columns and without small entries.

    From unit vectors the solution would contain numbers below 1e-308, with which processors are slow.
    """
    columns: list[float] = (
        np.linalg.qr(np.random.default_rng(1).normal(size=(n, COLUMNS)))[0].ravel().tolist()
    )
    return columns


def least_times(integrators: Sequence[Integrator], rounds: int) -> list[float]:
    """Return the least CPU time of a step for each size, in seconds; the sizes are timed in turn."""
    times = [float("inf")] * len(SIZES)
    states = [start(n) for n in SIZES]
    for _ in range(rounds):
        for place, n in enumerate(SIZES):
            steps = ROWS // n
            begin = time.process_time()
            integrators[place].run(states[place], H, steps)
            times[place] = min(times[place], (time.process_time() - begin) / steps)
    return times


def exponent(times: Sequence[float]) -> float:
    """Return p of the power c n^p with the least squares of the logarithms."""
    return float(np.polyfit(np.log(SIZES), np.log(times), 1)[0])


def constant_part(times: Sequence[float]) -> float:
    """Return F/c of the line F + c n with the least relative errors."""
    weights = 1 / np.array(times)
    slope, constant = np.polyfit(SIZES, times, 1, w=weights)
    return float(constant / slope)


def main() -> int:
    """Print the table; return 1 if the exponent of the first method is not close to 1."""
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else ROUNDS
    print(
        f"{'method':<16}" + "".join(f"{f'n = {n}':>11}" for n in SIZES) + f"{'exponent':>11}{'constant':>12}"
    )
    exponents = []
    for label in METHODS:
        times = least_times([load(emit(scene(n), label, "c")) for n in SIZES], rounds)
        exponents.append(exponent(times))
        cells = "".join(f"{1e6 * t:>8.2f} us" for t in times)
        print(f"{label:<16}{cells}{exponents[-1]:>11.3f}{constant_part(times):>7.0f} rows", flush=True)
    return int(abs(exponents[0] - 1) > REQUIRED)


if __name__ == "__main__":
    sys.exit(main())
