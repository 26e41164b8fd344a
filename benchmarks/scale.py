"""Time many systems that one emitted function steps, beside a loop of scalar runs.

    python benchmarks/scale.py [--pairs N] [--systems N]

For each case the same compiler builds the module with a batch and the module without one, with the flags that
each file states. Both make the same steps of the same systems, in turns in one process, and the ratio of
their CPU times is printed with the median and the quartiles of all turns. The number of double-precision
numbers in a vector register is printed as well: it bounds the ratio.
"""

from __future__ import annotations

import argparse
import statistics
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

from codegen.artifact import Artifact
from codegen.build import compile_files, find_compiler
from codegen.emitter import emit
from codegen.printers.c.module import VECTOR_FLAGS

FLAGS = ("-std=c11", "-ffp-contract=off")
REQUIRED = 0.6
"""The required ratio of scalar to batch time, in units of the vector width."""


@dataclass(frozen=True)
class Case:
    """A scene, a method, the step size, and the number of steps."""

    scene: str
    method: str
    h: float
    steps: int
    parameters: tuple[str, ...] = ()


CASES = (
    Case("free_rigid_body", "rkmk(2):rk4", 0.02, 200),
    Case("free_rigid_body", "cf:cf4", 0.02, 200),
    Case("driven_spin", "cf:cf4", 0.02, 200, ("nu", "b")),
    Case("driven_spin", "rkmk(2):rk4", 0.02, 200, ("nu", "b")),
    Case("heavy_top", "cf:cf4", 0.002, 100),
)

MAIN = """
#define _POSIX_C_SOURCE 199309L
#include "many.h"
#include "alone.h"
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
enum { N = %(systems)d, SIZE = %(size)d, COUNT = %(count)d };
static const double initial[SIZE] = {%(initial)s}, given[COUNT + 1] = {%(given)s};
static double states[SIZE * N], values[(COUNT + 1) * N];
static int statuses[N];
static size_t completed[N];
static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}
static void start(void)
{
    for (int k = 0; k < SIZE; k++)
        for (int i = 0; i < N; i++) states[k * N + i] = initial[k] * (1.0 + 1e-3 * i / N);
    for (int k = 0; k < COUNT; k++)
        for (int i = 0; i < N; i++) values[k * N + i] = given[k] * (1.0 + 0.1 * i / N);
}
int main(int argc, char **argv)
{
    const int turns = argc > 1 ? atoi(argv[1]) : 1;
    for (int turn = 0; turn < turns; turn++) {
        start();
        const double a = now();
        many_run_batch(N, N, states, %(time)s%(h)r, %(steps)d, %(rows)sstatuses, completed);
        const double b = now();
        double sum = 0.0;
        start();
        const double c = now();
        for (int i = 0; i < N; i++) {
            double x[SIZE];
            for (int k = 0; k < SIZE; k++) x[k] = states[k * N + i];
            alone_run(x, %(time)s%(h)r, %(steps)d, %(own)sNULL, 0, NULL);
            sum += x[0];
        }
        const double d = now();
        printf("%%.9f %%.9f %%.3g\\n", b - a, d - c, sum);
    }
    return 0;
}
"""


def program(case: Case, systems: int) -> dict[str, str]:
    """Return the files of a program that times one case."""
    options = {"target": "c", "parameters": case.parameters}
    many = emit(case.scene, case.method, prefix="many", batch=True, **options)  # type: ignore[arg-type]
    alone = emit(case.scene, case.method, prefix="alone", **options)  # type: ignore[arg-type]
    interface = many.manifest["interface"]
    names = interface["parameters"]
    initial = many.manifest["initial"]
    text = MAIN % {
        "systems": systems,
        "size": len(initial),
        "count": len(names),
        "initial": ", ".join(map(repr, initial)),
        "given": ", ".join([*(repr(many.manifest["defaults"][n]) for n in names), "0.0"]),
        "time": "0.0, " if interface["time"] else "",
        "h": case.h,
        "steps": case.steps,
        "rows": "values, " if names else "",
        "own": "".join(f"values[{k} * N + i], " for k in range(len(names))),
    }
    return {**files_of(many), **files_of(alone), "main.c": text}


def files_of(artifact: Artifact) -> dict[str, str]:
    """Return the header and the source of a module."""
    return {name: text for name, text in artifact.files.items() if name.endswith((".c", ".h"))}


LOOP = (
    "void add(double *restrict x, const double *restrict y) { for (int i = 0; i < 4096; i++) x[i] += y[i]; }"
)


def width() -> int:
    """Return the number of doubles in the vector registers that this compiler uses for a loop.

    The registers are read from the assembly text of a loop, because a compiler may prefer shorter registers
    than the processor has.
    """
    words = [*find_compiler().command, *VECTOR_FLAGS, "-S", "-x", "c", "-o", "-", "-"]
    assembly = subprocess.run(words, input=LOOP, capture_output=True, text=True, check=True).stdout
    return 8 if "%zmm" in assembly else 4 if "%ymm" in assembly else 2


def ratios(case: Case, turns: int, systems: int) -> list[tuple[float, float, float]]:
    """Return (ratio, batch, scalar) for each turn, the times in nanoseconds a step of one system."""
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        compile_files(program(case, systems), place, place / "main", (*FLAGS, *VECTOR_FLAGS), find_compiler())
        done = subprocess.run([str(place / "main"), str(turns)], capture_output=True, text=True, check=True)
    scale = 1e9 / (systems * case.steps)
    rows = [tuple(map(float, line.split())) for line in done.stdout.splitlines()]
    return [(b / a, a * scale, b * scale) for a, b, _ in rows]


def main() -> int:
    """Print one row for each case."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--pairs", type=int, default=21, help="turns of each case")
    parser.add_argument("--systems", type=int, default=1000, help="systems in a batch")
    options = parser.parse_args()
    lanes = width()
    print(f"vector width: {lanes} doubles; both programs are compiled with {' '.join(VECTOR_FLAGS)}\n")
    print("| scene | method | batch, ns | scalar, ns | ratio | quartiles | ratio / width |")
    print("|---|---|---:|---:|---:|---:|---:|")
    slow = 0
    for case in CASES:
        rows = ratios(case, options.pairs, options.systems)
        low, middle, high = statistics.quantiles([r for r, _, _ in rows], n=4)
        batch, scalar = (statistics.median(row[k] for row in rows) for k in (1, 2))
        slow += middle < REQUIRED * lanes
        print(
            f"| {case.scene} | {case.method} | {batch:.1f} | {scalar:.1f} | {middle:.2f} | "
            f"{low:.2f} to {high:.2f} | {middle / lanes:.2f} |"
        )
    return int(slow > 0)


if __name__ == "__main__":
    raise SystemExit(main())
