"""Time emitted steps of a spin lattice beside the same loops written by hand in C, and beside NumPy.

    python benchmarks/lattice.py [--side N] [--turns N] [--threads N]

The scene is `spin_lattice` with N x N spins. One compiler builds the emitted C and the C of
benchmarks/handwritten with the same flags. Both make the same steps in turns in one process. The ratio of
their CPU times is printed with the median and the quartiles of all turns, and the largest difference of
their states. A vectorised step of cf4 in NumPy is timed after them. With --threads only the emitted code is
timed, by wall time, for lattices of several sizes: without OpenMP, and with OpenMP on 1 and on N processors.
"""

from __future__ import annotations

import argparse
import statistics
import subprocess
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from codegen import emit
from codegen.build import build, compile_files, find_compiler
from codegen.emitter import compile_method
from codegen.ir.site_step import traffic
from codegen.lattice import CompiledLattice
from codegen.loader import LOOP_FLAGS
from codegen.printers.c.module import VECTOR_FLAGS
from codegen.printers.interface import Interface

HERE = Path(__file__).parent
SCENE = "spin_lattice"
METHODS = {"cf4": "cf:cf4", "strang": "splitting:strang"}
FLAGS = ("-std=c11", "-ffp-contract=off", *VECTOR_FLAGS)
H, STEPS = 0.05, 2
REQUIRED, FASTER = 1.2, 5.0
"""The largest ratio of emitted to hand-written code, and the least ratio of NumPy to emitted code."""

MAIN = """
#define _POSIX_C_SOURCE 199309L
#include "emitted.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
void hand_%(name)s(size_t rows, size_t cols, double *state, double h, size_t steps, double *work);
static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
int main(void)
{
    const size_t side = %(side)d, n = side * side, shape[2] = {side, side};
    double *a = malloc(3 * n * sizeof *a), *b = malloc(3 * n * sizeof *b);
    double *work = malloc(emitted_workspace(shape) * sizeof *work);
    if (!a || !b || !work) {
        return 1;
    }
    unsigned long long seed = 1;
    for (size_t i = 0; i < n; i++) {
        double s[3], norm = 0.0;
        for (int k = 0; k < 3; k++) {
            seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
            s[k] = (double)(seed >> 11) / 9007199254740992.0 - 0.5;
            norm += s[k] * s[k];
        }
        for (size_t k = 0; k < 3; k++) {
            a[k * n + i] = b[k * n + i] = s[k] / sqrt(norm);
        }
    }
    for (int turn = 0; turn < %(turns)d; turn++) {
        const double first = seconds();
        if (emitted_run(shape, a, %(h)r, %(steps)d, work, NULL)) {
            return 2;
        }
        const double second = seconds();
        hand_%(name)s(side, side, b, %(h)r, %(steps)d, work);
        printf("%%.9e %%.9e\\n", second - first, seconds() - second);
    }
    double largest = 0.0;
    for (size_t i = 0; i < 3 * n; i++) {
        largest = fmax(largest, fabs(a[i] - b[i]));
    }
    printf("%%.3e\\n", largest);
    return 0;
}
"""


def compared(name: str, side: int, turns: int) -> tuple[list[tuple[float, float]], float]:
    """Return the seconds of emitted and of hand-written steps in each turn, and the difference of states."""
    files = dict(emit(SCENE, METHODS[name], target="c", prefix="emitted").files)
    for file in ("spin_lattice.h", f"spin_lattice_{name}.c"):
        files[file] = (HERE / "handwritten" / file).read_text()
    files["main.c"] = MAIN % {"name": name, "side": side, "turns": turns, "h": H, "steps": STEPS}
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "program"
        compile_files(files, Path(folder), program, FLAGS, find_compiler())
        lines = subprocess.run([program], check=True, capture_output=True, text=True).stdout.split("\n")
    *rows, difference = [line for line in lines if line]
    return [(float(x), float(y)) for x, y in (row.split() for row in rows)], float(difference)


def numpy_step() -> Callable[[Any, float], Any]:
    """Return a step of cf4 on an array of shape (3, rows, columns)."""
    import numpy as np

    def field(y: Any) -> Any:
        k = sum(np.roll(y, d, axis) for axis in (1, 2) for d in (1, -1))
        k[2] += 0.5 * y[2] + 0.2
        return k

    def turn(x: Any, s: Any) -> Any:
        z = (x * x).sum(axis=0)
        a = np.sqrt(z)
        w = np.cross(x, s, axis=0)
        return s + np.sin(a) / a * w + (1 - np.cos(a)) / z * np.cross(x, w, axis=0)

    def step(y: Any, h: float) -> Any:
        k1 = field(y)
        y2 = turn(h / 2 * k1, y)
        k2 = field(y2)
        k3 = field(turn(h / 2 * k2, y))
        k4 = field(turn(h * k3 - h / 2 * k1, y2))
        middle = h / 6 * (k2 + k3)
        first = turn(h / 4 * k1 + middle - h / 12 * k4, y)
        return turn(middle - h / 12 * k1 + h / 4 * k4, first)

    return step


def numpy_seconds(side: int, steps: int = 2) -> float:
    """Return the CPU seconds of one step in NumPy."""
    import numpy as np

    spins = np.random.default_rng(1).normal(size=(3, side, side))
    spins /= np.linalg.norm(spins, axis=0)
    step, start = numpy_step(), time.process_time()
    for _ in range(steps):
        spins = step(spins, H)
    return (time.process_time() - start) / steps


def threads_compared(method: str, sides: Sequence[int], threads: int, turns: int) -> None:
    """Print the wall time of a step without OpenMP, and with OpenMP on one and on several processors."""
    import cffi
    import numpy as np

    artifact = emit(SCENE, method, target="c")
    interface = Interface.from_json(artifact.manifest["interface"])
    ffi = cffi.FFI()
    ffi.cdef("void omp_set_num_threads(int);")
    paths = [build(artifact.files, (*LOOP_FLAGS, *more)) for more in ((), ("-fopenmp",))]
    alone, shared = (CompiledLattice(interface, artifact.manifest["defaults"], path) for path in paths)
    openmp = ffi.dlopen(str(paths[1]))
    kinds = [("without OpenMP", alone, 0), ("1 thread", shared, 1), (f"{threads} threads", shared, threads)]
    for side in sides:
        shape, least = (side, side), dict.fromkeys((name for name, _, _ in kinds), float("inf"))
        steps = max(1, 400_000 // side**2)
        spins = np.random.default_rng(1).normal(size=(3, side, side))
        spins /= np.linalg.norm(spins, axis=0)
        work = np.zeros(interface.workspace_of(side**2))
        for _ in range(turns):
            for name, lattice, number in kinds:
                if number:
                    openmp.omp_set_num_threads(number)
                table = spins.copy()
                start = time.perf_counter()
                lattice.advance(shape, table, (0.0, H, steps), [], work)
                least[name] = min(least[name], (time.perf_counter() - start) / steps)
        times = ", ".join(f"{name} {1e6 * seconds:.0f} us" for name, seconds in least.items())
        print(f"{method}, {side} x {side}: {times} for a step")


def main() -> int:
    """Print the table; return 1 if a required ratio is missed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--side", type=int, default=1000)
    parser.add_argument("--turns", type=int, default=15)
    parser.add_argument("--threads", type=int, default=0)
    chosen = parser.parse_args()
    if chosen.threads:
        for method in METHODS.values():
            threads_compared(method, (32, 64, 128, 1000), chosen.threads, chosen.turns)
        return 0
    missed, emitted = False, {}
    print(f"{chosen.side} x {chosen.side} spins; {find_compiler().version}; {' '.join(FLAGS)}")
    for name, method in METHODS.items():
        rows, difference = compared(name, chosen.side, chosen.turns)
        low, ratio, high = statistics.quantiles([x / y for x, y in rows], n=4)
        emitted[name] = statistics.median(x for x, _ in rows) / STEPS
        sites = compile_method(SCENE, method).kernel.sites
        assert sites is not None
        moved = 8 * sum(traffic(sites.passes)) * chosen.side**2 / emitted[name] / 1e9
        print(
            f"{method:18} {1e9 * emitted[name] / chosen.side**2:6.1f} ns a site and step, "
            f"{ratio:.2f} ({low:.2f} to {high:.2f}) of hand-written; {moved:.1f} GB/s by --explain; "
            f"difference {difference:.0e}"
        )
        missed |= ratio > REQUIRED
    slower = numpy_seconds(chosen.side) / emitted["cf4"]
    print(f"NumPy, cf4: {slower:.1f} times the time of emitted C")
    return int(missed or slower < FASTER)


if __name__ == "__main__":
    raise SystemExit(main())
