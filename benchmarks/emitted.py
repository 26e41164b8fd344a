"""Time emitted C beside hand-written C of the same method and scene; write the second table of README.md.

    python benchmarks/emitted.py [--pairs N] [--only WORD ...] [--races SCENE ...] [--budget S]

Both programs are built by the same compiler with the same flags and make the same steps from the same state.
They run in pairs of fresh processes, in alternating order, and measure their own CPU time. The result is the
median ratio of the pairs with its distribution-free 95 % interval. If valgrind is installed, callgrind counts
the instructions of a step. Both programs must compute the same final state. With ``--races`` the cases are
left out, and the times to an accuracy are printed for the named scenes. README.md is only written if all
cases and races are run.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from importlib.util import find_spec
from math import comb
from pathlib import Path

from codegen.artifact import Artifact
from codegen.build import compile_files, find_compiler
from codegen.emitter import compile_method, emit
from codegen.lab.efficiency.bench import bench
from codegen.lab.efficiency.ranking import fastest_form, prevailing_form
from codegen.lab.peers import installed

HERE = Path(__file__).parent
FLAGS = ("-std=c11", "-O2", "-ffp-contract=off")
PAIRS = 41
LARGEST_RATIO, LARGEST_END = 1.05, 1.15
"""Requirement: the median ratio to hand-written code is at most LARGEST_RATIO, and its 95 % interval ends
below LARGEST_END."""
MARK, END = "<!-- emitted.py writes what follows -->", "<!-- up to here -->"
DRIVER = """
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
{declarations}
int main(int argc, char **argv)
{{
    double state[{size}] = {{{initial}}};
    const size_t steps = argc > 1 ? (size_t)strtoul(argv[1], NULL, 10) : 1;
    const double h = {h!r};
    size_t sweeps = 0;
    const clock_t start = clock();
    {call}
    printf("%.9f %zu", (double)(clock() - start) / CLOCKS_PER_SEC, sweeps);
    for (int i = 0; i < {size}; i++) {{
        printf(" %.17g", state[i]);
    }}
    return 0;
}}
"""


@dataclass(frozen=True)
class Case:
    """One row: scene, method, step size, number of steps. ``hand`` names the file in handwritten/."""

    scene: str
    method: str
    hand: str
    h: float
    steps: int
    sweeps: bool = False


CASES = {
    "rkmk4": Case("free_rigid_body", "rkmk:rk4", "free_rigid_body_rkmk4", 0.02, 1_500_000),
    "cf4": Case("free_rigid_body", "cf4", "free_rigid_body_cf4", 0.02, 1_500_000),
    "top_rkmk4": Case("fast_heavy_top", "rkmk:rk4", "fast_heavy_top_rkmk4", 0.001, 400_000),
    "top_cf4": Case("fast_heavy_top", "cf:cf4", "fast_heavy_top_cf4", 0.001, 400_000),
    "top_splitting4": Case(
        "fast_heavy_top", "splitting:blanes_moan_rkn4", "fast_heavy_top_splitting4", 0.02, 1_000_000
    ),
    "top_splitting6": Case(
        "fast_heavy_top", "splitting:blanes_moan_rkn6a", "fast_heavy_top_splitting6", 0.02, 500_000
    ),
    "vcg2": Case("dipole", "vcg:midpoint", "dipole_vcg2", 0.01, 150_000, sweeps=True),
    "vrkmk4": Case("dipole", "vrkmk(2):gauss2", "dipole_vrkmk4", 0.01, 100_000, sweeps=True),
    "vcf4": Case("dipole", "vcf:cf4", "dipole_vcf4", 0.01, 60_000, sweeps=True),
    "body_rkmk4": Case(str(HERE / "free_body.py"), "rkmk:rk4", "free_body_rkmk4", 0.02, 400_000),
}


RACES = {
    "free_rigid_body": ("rkmk:rk4", "cf4", "rkmk:butcher6"),
    "dipole": ("vcg:midpoint", "vrkmk(2):gauss2", "vcf:cf4", "cf4"),
    "fast_heavy_top": ("rkmk:rk4", "cf4", "splitting:blanes_moan_rkn4", "splitting:blanes_moan_rkn6a"),
}
"""The methods of each scene that are compared with the peers."""

CONTROLLED = ("ambient:dop853",)
"""The methods with step-size control that are compared with the peers on every scene."""

PEERS = ("scipy-dop853", "heyoka", "diffrax", "c-dop853")
DECADES = (4, 6, 8, 10, 12)
BUDGET = 0.5
"""CPU seconds that one run of a race may take."""


@dataclass(frozen=True)
class Run:
    """The output of one process: CPU seconds, number of sweeps over the equations, and the final state."""

    seconds: float
    sweeps: int
    state: tuple[float, ...]


def main() -> int:
    """Run the cases, print the tables, and write them to README.md; return the exit status 0."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pairs", type=int, default=PAIRS)
    parser.add_argument("--only", nargs="*", choices=CASES, default=list(CASES), metavar="CASE")
    parser.add_argument("--races", nargs="*", choices=RACES, default=[], metavar="SCENE")
    parser.add_argument("--budget", type=float, default=BUDGET)
    asked = parser.parse_args()
    if asked.races:
        print("".join(race(scene, asked.budget) for scene in asked.races))
        return 0
    rows = []
    for key in asked.only:
        print(f"{key} ...", file=sys.stderr, flush=True)
        rows.append(row(CASES[key], asked.pairs))
    text = f"{table(rows)}\n{verdict(rows)}\n"
    if asked.only == list(CASES):
        text = f"{text}\n{RACE}\n{''.join(race(scene, asked.budget) for scene in RACES)}"
    print(text)
    if asked.only == list(CASES):
        page = HERE / "README.md"
        before, _, after = page.read_text(encoding="utf-8").partition(MARK)
        words = after.partition(END)[2]
        written = f"{MARK}\n{HEAD}\n{environment(asked.pairs)}\n\n{text.rstrip()}\n\n{END}{words}"
        page.write_text(f"{before.rstrip()}\n\n{written}", encoding="utf-8")
    return 0


def row(case: Case, pairs: int) -> list[str]:
    """Build the programs of a case, time them in pairs, and return the cells of the row."""
    with tempfile.TemporaryDirectory() as folder:
        emission = emit(case.scene, case.method)
        sides = [
            build_emitted(case, emission, Path(folder) / "emitted"),
            build_hand(case, emission, Path(folder) / "hand"),
        ]
        if find_spec("casadi") is not None and not emission.manifest["interface"]["blocks"]:
            sides.append(build_casadi(case, emission, Path(folder) / "casadi"))
        for side in sides[1:]:
            check_same(run(sides[0], 200).state, run(side, 200).state)
        times: list[tuple[float, ...]] = []
        for k in range(pairs):
            order = range(len(sides)) if k % 2 == 0 else reversed(range(len(sides)))
            made = {i: run(sides[i], case.steps) for i in order}
            times.append(tuple(made[i].seconds for i in range(len(sides))))
        sweeps = [f"{run(side, 10_000).sweeps / 10_000:.1f}" if case.sweeps else "-" for side in sides[:2]]
        counts = [instructions(side) for side in sides]
    low, high = interval([a / b for a, b, *_ in times])
    nanoseconds = [1e9 * statistics.median(column) / case.steps for column in zip(*times, strict=True)]
    ratio = statistics.median(a / b for a, b, *_ in times)
    casadi = statistics.median(c / b for _, b, c in times) if len(sides) > 2 else None
    return [
        f"{case.method} on {Path(case.scene).stem}",
        *(f"{x:.1f}" for x in nanoseconds[:2]),
        f"{ratio:.3f}",
        f"{low:.3f} to {high:.3f}",
        "-" if casadi is None else f"{casadi:.2f}",
        *(f"{x:.0f}" if x else "-" for x in counts[:2]),
        *sweeps,
        exponentials(emission),
    ]


def verdict(rows: list[list[str]]) -> str:
    """Return which cases satisfy the requirement, and for which cases the code of CasADi is the fastest.

    >>> row = ["a", "1", "1", "1.040", "1.030 to 1.100", "0.90"]
    >>> verdict([row, ["b", "1", "1", "1.200", "1.190 to 1.210", "-"]]).partition("; ")[2]
    'not satisfied: b. The code of CasADi is faster than the hand-written code in: a.'
    """
    slow = [r[0] for r in rows if float(r[3]) > LARGEST_RATIO or float(r[4].split()[-1]) >= LARGEST_END]
    text = f"The requirement is satisfied in {len(rows) - len(slow)} of {len(rows)} cases"
    text += f"; not satisfied: {', '.join(slow)}." if slow else "."
    beaten = [r[0] for r in rows if r[5] != "-" and float(r[5]) < 1]
    if not beaten:
        return text
    return f"{text} The code of CasADi is faster than the hand-written code in: {', '.join(beaten)}."


def race(scene: str, budget: float) -> str:
    """Return a table of the CPU times that emitted methods and installed peers need for each accuracy."""
    peers = [name for name in PEERS if installed(name)]
    print(f"race on {scene} ...", file=sys.stderr, flush=True)
    match = bench(scene, RACES[scene], ["c"], peers, budget, None, str, CONTROLLED)
    result = match.run(str)
    lines = [[f"{scene}: error", *(f"1e-{d}" for d in DECADES), "evaluations", "exponentials", "iterations"]]
    lines.append(["---"] + ["---:"] * (len(DECADES) + 3))
    found = {label: [fastest_form(rows, 10.0**-d) for d in DECADES] for label, rows in result.entries.items()}
    best = [
        min((f[0] for f in column if f is not None), default=None)
        for column in zip(*found.values(), strict=True)
    ]
    for label, rows in result.entries.items():
        times = [
            "-" if f is None else microseconds(f[0], f[0] == b, f[1])
            for f, b in zip(found[label], best, strict=True)
        ]
        own = prevailing_form(rows)
        last = next((r for r in reversed(own) if r.error is not None), own[-1])
        counts = [last.evaluations, last.exponentials, last.iterations]
        cells = ["-" if n is None or not last.steps else f"{n / last.steps:.3g}" for n in counts]
        lines.append([label, *times, *cells])
    return "".join(f"| {' | '.join(line)} |\n" for line in lines) + "\n"


def microseconds(seconds: float, best: bool, form: str = "") -> str:
    """Return a time in microseconds, in bold if it is the best of its column, and the letter of a form.

    The letter is the first one of the last word in the name of the form.

    >>> microseconds(1.234e-4, True), microseconds(1.234e-4, False, "body momentum and unit quaternion")
    ('**123**', '123 q')
    """
    text = f"{1e6 * seconds:.3g}"
    letter = f" {form.rpartition(' ')[2][0]}" if form else ""
    return f"**{text}**{letter}" if best else f"{text}{letter}"


def build_emitted(case: Case, emission: Artifact, folder: Path) -> Path:
    """Return the program that runs an emitted module."""
    interface = emission.manifest["interface"]
    prefix, blocks = interface["prefix"], interface["blocks"]
    argument = "&statistics, " if blocks else ""
    lines = [f"{prefix}statistics statistics = {{{{0}}, 0, 0}};" if blocks else ""]
    lines.append(f"if ({prefix}run(state, h, steps, NULL, 0, {argument}NULL) != 0) {{ return 1; }}")
    lines += [f"sweeps += statistics.sweeps[{k}];" for k in range(len(blocks))]
    driver = DRIVER.format(
        declarations=f'#include "{emission.manifest["module"]}.h"',
        size=len(emission.manifest["initial"]),
        initial=", ".join(map(repr, emission.manifest["initial"])),
        h=case.h,
        call="\n    ".join(lines),
    )
    return built({**emission.files, "driver.c": driver}, folder)


def build_hand(case: Case, emission: Artifact, folder: Path) -> Path:
    """Return the program that runs a hand-written step."""
    size = len(emission.manifest["initial"])
    driver = DRIVER.format(
        declarations=f"{'size_t' if case.sweeps else 'void'} handwritten_run(double *, double, size_t);",
        size=size,
        initial=", ".join(map(repr, emission.manifest["initial"])),
        h=case.h,
        call=f"{'sweeps = ' if case.sweeps else ''}handwritten_run(state, h, steps);",
    )
    sources = [HERE / "handwritten" / f"{case.hand}.c", *sorted((HERE / "handwritten").glob("*.h"))]
    files = {source.name: source.read_text(encoding="utf-8") for source in sources}
    return built({**files, "driver.c": driver}, folder)


def build_casadi(case: Case, emission: Artifact, folder: Path) -> Path:
    """Return the program that runs the step of the same method generated by CasADi."""
    sys.path.insert(0, str(HERE))
    from casadi_step import casadi_files

    driver = DRIVER.format(
        declarations="void handwritten_run(double *, double, size_t);",
        size=len(emission.manifest["initial"]),
        initial=", ".join(map(repr, emission.manifest["initial"])),
        h=case.h,
        call="handwritten_run(state, h, steps);",
    )
    files = casadi_files(compile_method(case.scene, case.method))
    return built({**files, "driver.c": driver}, folder)


def built(files: dict[str, str], folder: Path) -> Path:
    """Compile a program in a new folder and return its path."""
    folder.mkdir()
    compile_files(files, folder, folder / "program", FLAGS, find_compiler())
    return folder / "program"


def run(program: Path, steps: int) -> Run:
    """Run a program once with a number of steps and return its output."""
    answer = subprocess.run([program, str(steps)], check=True, capture_output=True, text=True).stdout.split()
    return Run(float(answer[0]), int(answer[1]), tuple(map(float, answer[2:])))


def check_same(x: tuple[float, ...], y: tuple[float, ...], tolerance: float = 1e-11) -> None:
    """Exit with a message if two final states differ; ``tolerance`` is relative to the size of the state."""
    gap = max(abs(a - b) for a, b in zip(x, y, strict=True)) / max(1.0, *map(abs, x))
    if not gap <= tolerance:
        raise SystemExit(f"the final states of hand-written and emitted code differ by {gap:.3g}")


def instructions(program: Path, steps: int = 1000) -> float:
    """Return the number of instructions of one step, 0 without valgrind.

    It is computed from two runs, so that the start and the end of the process are not counted.
    """
    if shutil.which("valgrind") is None:
        return 0.0
    counts = []
    for n in (steps, 2 * steps):
        command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", str(program), str(n)]
        text = subprocess.run(command, check=True, capture_output=True, text=True).stderr
        found = re.search(r"Collected : (\d+)", text)
        assert found is not None
        counts.append(int(found[1]))
    return (counts[1] - counts[0]) / steps


def exponentials(emission: Artifact) -> str:
    """Return the numbers of functions of a rotation angle in a step and in each sweep of its blocks."""
    cells = []
    for counts in emission.manifest["operations"].values():
        cells.append(str(sum(n for name, n in counts.items() if name.startswith("stumpff"))))
    return " + ".join([cells[0], *(n for n in cells[1:] if n != "0")])


def interval(values: list[float], confidence: float = 0.95) -> tuple[float, float]:
    """Return order statistics that enclose the median with a confidence, for any distribution.

    >>> interval([float(k) for k in range(1, 32)])
    (10.0, 22.0)
    """
    ordered, n = sorted(values), len(values)
    tail, k = 0.0, 0
    while k < n // 2 and tail + comb(n, k) / 2**n <= (1 - confidence) / 2:
        tail += comb(n, k) / 2**n
        k += 1
    first = max(k - 1, 0)
    return ordered[first], ordered[n - 1 - first]


HEAD = """
## Emitted code beside hand-written code

`emitted.py` times emitted C beside the C of `handwritten/`: the same method, scene, step, compiler and flags,
CPU time of fresh processes that run in pairs. The hand-written steps are portable C and optimised by hand:
short dependency chains, minimax polynomials for functions of an angle, extrapolation of the solutions of
sixteen steps, Jacobians to first order, body momenta stored from step to step. They omit the checks of
emitted code that the state and the step size are finite.

- *ns per step*, *by hand*: median CPU times of a step of the emitted code and of the hand-written code.
- *ratio*, *interval*: the median of the ratio emitted/hand-written over the pairs, and its 95 % interval.
  Required: the ratio is at most 1.05, and the interval ends below 1.15.
- *CasADi*: the same ratio for the step that CasADi generates from the explicit method. Below 1, the code of
  CasADi is faster than the hand-written code.
- *instructions*, *by hand*: instructions of a step, counted by callgrind; they are equal in every run.
- *sweeps*, *by hand*: evaluations of the equations of an implicit step.
- *exponentials*: evaluations of functions of a rotation angle in an emitted step, + the evaluations in each
  sweep.
"""


RACE = """
## Time to an accuracy, beside peers

CPU time in microseconds that is needed for the error in the head of the column, at the end of the span of the
scene. Times are interpolated between runs with different step sizes or tolerances. They were measured
together with the table above. Peers and the emitted methods *ambient* integrate the equations in
coordinates. They run on every classical form of the equations, and the fastest form counts: *p*, the
equations as printed; *m*, the momentum in the body and a rotation matrix; *q*, the momentum in the body and a
unit quaternion (seven equations). Compilation before the first step is not counted, neither for peers nor for
emitted code. The fastest time of a column is bold. Evaluations, exponentials and iterations are averages over
the steps of the finest run.
"""


def environment(pairs: int) -> str:
    """Return the conditions of the measurement: pairs, cores, compiler and flags."""
    compiler = find_compiler()
    return f"{pairs} pairs per case; {os.cpu_count()} cores; {compiler.version}; {' '.join(FLAGS)}."


def table(rows: list[list[str]]) -> str:
    """Return the rows as a Markdown table."""
    head = [
        "case",
        "ns per step",
        "by hand",
        "ratio",
        "interval",
        "CasADi",
        "instructions",
        "by hand",
        "sweeps",
    ]
    head += ["by hand", "exponentials"]
    lines = [head, ["---"] + ["---:"] * 10, *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


if __name__ == "__main__":
    sys.exit(main())
