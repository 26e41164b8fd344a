"""Time emitted C beside hand-written C of the same method and scene; write the second table of README.md.

    python benchmarks/emitted.py [--pairs N] [--only WORD ...]

Both sides are built by the same compiler with the same flags and make the same steps from the same state in
fresh processes, in pairs, the first of a pair changing; CPU time is taken inside the process. The figure is
the median ratio of the pairs with its distribution-free 95 % interval. Instructions a step are counted by
callgrind where valgrind is there. Both sides must end in the same state. Nothing is written when only some
cases are run.
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
from codegen.lab.efficiency.ranking import seconds_to
from codegen.lab.peers import installed

HERE = Path(__file__).parent
FLAGS = ("-std=c11", "-O2", "-ffp-contract=off")
PAIRS = 41
ASKED, HIGHEST = 1.05, 1.15
"""The largest median ratio to hand-written code, and what its interval stays below."""
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
    """One row: scene, method, step size; ``hand`` names the file in handwritten/."""

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
}


RACES = {
    "free_rigid_body": ("rkmk:rk4", "cf4", "rkmk:butcher6"),
    "dipole": ("vcg:midpoint", "vrkmk(2):gauss2", "vcf:cf4", "cf4"),
    "fast_heavy_top": ("rkmk:rk4", "cf4", "splitting:blanes_moan_rkn4", "splitting:blanes_moan_rkn6a"),
}
"""Scene -> methods that race against the peers."""

PEERS = ("scipy-dop853", "heyoka", "diffrax", "c-dop853")
DECADES = (4, 6, 8, 10, 12)


@dataclass(frozen=True)
class Run:
    """What one process says: CPU seconds, sweeps over equations, and the final state."""

    seconds: float
    sweeps: int
    state: tuple[float, ...]


def main() -> int:
    """Run the cases, print the table and write it; return 1 where the two sides part."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pairs", type=int, default=PAIRS)
    parser.add_argument("--only", nargs="*", choices=CASES, default=list(CASES), metavar="CASE")
    asked = parser.parse_args()
    rows = []
    for key in asked.only:
        print(f"{key} ...", file=sys.stderr, flush=True)
        rows.append(row(CASES[key], asked.pairs))
    text = f"{table(rows)}\n{verdict(rows)}\n"
    if asked.only == list(CASES):
        text = f"{text}\n{RACE}\n{''.join(race(scene) for scene in RACES)}"
    print(text)
    if asked.only == list(CASES):
        page = HERE / "README.md"
        before, _, after = page.read_text(encoding="utf-8").partition(MARK)
        words = after.partition(END)[2]
        written = f"{MARK}\n{HEAD}\n{environment(asked.pairs)}\n\n{text.rstrip()}\n\n{END}{words}"
        page.write_text(f"{before.rstrip()}\n\n{written}", encoding="utf-8")
    return 0


def row(case: Case, pairs: int) -> list[str]:
    """Build both sides of a case, time them in pairs, and return the cells of its row."""
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
        f"{case.method} on {case.scene}",
        *(f"{x:.1f}" for x in nanoseconds[:2]),
        f"{ratio:.3f}",
        f"{low:.3f} to {high:.3f}",
        "-" if casadi is None else f"{casadi:.2f}",
        *(f"{x:.0f}" if x else "-" for x in counts[:2]),
        *sweeps,
        exponentials(emission),
    ]


def verdict(rows: list[list[str]]) -> str:
    """Say in words which cases keep to what is asked, and where CasADi's code beats the hand-written one.

    >>> row = ["a", "1", "1", "1.040", "1.030 to 1.100", "0.90"]
    >>> verdict([row, ["b", "1", "1", "1.200", "1.190 to 1.210", "-"]]).partition("; ")[2]
    'by hand it is faster than that in: b. CasADi beats the hand in: a.'
    """
    slow = [r[0] for r in rows if float(r[3]) > ASKED or float(r[4].split()[-1]) >= HIGHEST]
    text = f"What is asked holds in {len(rows) - len(slow)} of {len(rows)} cases"
    text += f"; by hand it is faster than that in: {', '.join(slow)}." if slow else "."
    beaten = [r[0] for r in rows if r[5] != "-" and float(r[5]) < 1]
    return text + (f" CasADi beats the hand in: {', '.join(beaten)}." if beaten else "")


def race(scene: str) -> str:
    """Return a table of CPU times to accuracies, of emitted methods and of the peers that are installed."""
    peers = [name for name in PEERS if installed(name)]
    print(f"race on {scene} ...", file=sys.stderr, flush=True)
    match = bench(scene, RACES[scene], ["c"], peers, 0.5, None, str)
    result = match.run(str)
    lines = [[f"{scene}: error", *(f"1e-{d}" for d in DECADES), "evaluations", "exponentials", "iterations"]]
    lines.append(["---"] + ["---:"] * (len(DECADES) + 3))
    found = {label: [seconds_to(rows, 10.0**-d) for d in DECADES] for label, rows in result.entries.items()}
    best = [
        min((s for s in column if s is not None), default=None)
        for column in zip(*found.values(), strict=True)
    ]
    for label, rows in result.entries.items():
        times = found[label]
        last = next((r for r in reversed(rows) if r.error is not None), rows[-1])
        counts = [last.evaluations, last.exponentials, last.iterations]
        cells = ["-" if n is None or not last.steps else f"{n / last.steps:.3g}" for n in counts]
        lines.append([label, *(spelled(s, s == b) for s, b in zip(times, best, strict=True)), *cells])
    return "".join(f"| {' | '.join(line)} |\n" for line in lines) + "\n"


def spelled(seconds: float | None, best: bool) -> str:
    """Spell a time in microseconds, the best of a column in bold."""
    text = "-" if seconds is None else f"{1e6 * seconds:.3g}"
    return f"**{text}**" if best and seconds is not None else text


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
    """Return the program that runs the same method's step as CasADi writes it."""
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
    """Run a program once."""
    answer = subprocess.run([program, str(steps)], check=True, capture_output=True, text=True).stdout.split()
    return Run(float(answer[0]), int(answer[1]), tuple(map(float, answer[2:])))


def check_same(x: tuple[float, ...], y: tuple[float, ...], tolerance: float = 1e-11) -> None:
    """Refuse to time two programs that compute different things; ``tolerance`` is relative to the state."""
    gap = max(abs(a - b) for a, b in zip(x, y, strict=True)) / max(1.0, *map(abs, x))
    if not gap <= tolerance:
        raise SystemExit(f"the hand-written and the emitted state differ by {gap:.3g}")


def instructions(program: Path, steps: int = 1000) -> float:
    """Return the instructions of one step, 0 without valgrind: start and end of the process drop out."""
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
    """Say how often a step and each sweep evaluate functions of a rotation angle."""
    cells = []
    for counts in emission.manifest["operations"].values():
        cells.append(str(sum(n for name, n in counts.items() if name.startswith("stumpff"))))
    return " + ".join([cells[0], *(n for n in cells[1:] if n != "0")])


def interval(values: list[float], confidence: float = 0.95) -> tuple[float, float]:
    """Return order statistics that hold the median with at least that confidence, whatever the distribution.

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
CPU time of fresh processes run in pairs. The hand-written steps are portable C, as fast as we could make
them: chains shortened by hand, functions of an angle by polynomials of least error, solutions of sixteen
steps continued, Jacobians to first order, body momenta kept from step to step. They do without the checks of
emitted code: finite state and step, at the end of each step.

- *ns a step*, *by hand*: medians of CPU time a step of the emitted and of the hand-written code.
- *ratio*: the median over the pairs of emitted/hand-written, *interval* the 95 % interval of that median;
  asked are at most 1.05 and an interval below 1.15.
- *CasADi*: the time of the step that CasADi generates from the same explicit method over that of the
  hand-written one: below 1 it would beat it.
- *instructions*, *by hand*: of a step, counted by callgrind; they do not vary from run to run.
- *sweeps*, *by hand*: evaluations of an implicit step's equations.
- *exponentials*: the functions of a rotation angle in an emitted step, + in each sweep.
"""


RACE = """
## Time to an accuracy, beside peers

CPU microseconds until the error at the end of the scene's span is as small as the head of the column says,
interpolated between runs over step sizes or tolerances; fresh measurements of the same run as the table
above. Peers integrate the ambient equations; what they compile before the first step is not counted, nor is
ours; the fastest of a column is bold. Counts are those of one step at the finest run (of iterations: sweeps
over all equations of the step).
"""


def environment(pairs: int) -> str:
    """Say with what was measured."""
    compiler = find_compiler()
    return f"{pairs} pairs a figure; {os.cpu_count()} cores; {compiler.version}; {' '.join(FLAGS)}."


def table(rows: list[list[str]]) -> str:
    """Return the rows as a Markdown table."""
    head = [
        "case",
        "ns a step",
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
