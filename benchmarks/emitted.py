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
from math import comb
from pathlib import Path

from codegen.build import compile_files, find_compiler
from codegen.emission import Emission
from codegen.emit import emit

HERE = Path(__file__).parent
FLAGS = ("-std=c11", "-O2", "-ffp-contract=off")
PAIRS = 41
MARK = "<!-- emitted.py writes what follows -->"
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
    "vcg2": Case("dipole", "vcg:midpoint", "dipole_vcg2", 0.01, 150_000, sweeps=True),
}


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
    text = table(rows)
    print(text)
    if asked.only == list(CASES):
        page = HERE / "README.md"
        kept = page.read_text(encoding="utf-8").partition(MARK)[0].rstrip()
        page.write_text(f"{kept}\n\n{MARK}\n{HEAD}\n{environment(asked.pairs)}\n\n{text}", encoding="utf-8")
    return 0


def row(case: Case, pairs: int) -> list[str]:
    """Build both sides of a case, time them in pairs, and return the cells of its row."""
    with tempfile.TemporaryDirectory() as folder:
        emission = emit(case.scene, case.method)
        sides = [
            build_emitted(case, emission, Path(folder) / "emitted"),
            build_hand(case, emission, Path(folder) / "hand"),
        ]
        check_same(run(sides[0], 200).state, run(sides[1], 200).state)
        times: list[tuple[float, float]] = []
        for k in range(pairs):
            order = (0, 1) if k % 2 == 0 else (1, 0)
            made = {i: run(sides[i], case.steps) for i in order}
            times.append((made[0].seconds, made[1].seconds))
        sweeps = [f"{run(side, 10_000).sweeps / 10_000:.1f}" if case.sweeps else "-" for side in sides]
        counts = [instructions(side) for side in sides]
    low, high = interval([a / b for a, b in times])
    nanoseconds = [1e9 * statistics.median(column) / case.steps for column in zip(*times, strict=True)]
    ratio = statistics.median(a / b for a, b in times)
    return [
        f"{case.method} on {case.scene}",
        *(f"{x:.1f}" for x in nanoseconds),
        f"{ratio:.3f}",
        f"{low:.3f} to {high:.3f}",
        *(f"{x:.0f}" if x else "-" for x in counts),
        *sweeps,
        exponentials(emission),
    ]


def build_emitted(case: Case, emission: Emission, folder: Path) -> Path:
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


def build_hand(case: Case, emission: Emission, folder: Path) -> Path:
    """Return the program that runs a hand-written step."""
    size = len(emission.manifest["initial"])
    driver = DRIVER.format(
        declarations=f"{'size_t' if case.sweeps else 'void'} handwritten_run(double *, double, size_t);",
        size=size,
        initial=", ".join(map(repr, emission.manifest["initial"])),
        h=case.h,
        call=f"{'sweeps = ' if case.sweeps else ''}handwritten_run(state, h, steps);",
    )
    names = [f"{case.hand}.c", "rotation.h"]
    files = {name: (HERE / "handwritten" / name).read_text(encoding="utf-8") for name in names}
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
    """Refuse to time two programs that compute different things."""
    gap = max(abs(a - b) for a, b in zip(x, y, strict=True))
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


def exponentials(emission: Emission) -> str:
    """Say how often a step and each sweep evaluate functions of a rotation angle."""
    cells = []
    for counts in emission.manifest["operations"].values():
        cells.append(str(sum(n for name, n in counts.items() if name.startswith("stumpff"))))
    return " + ".join(cells)


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
CPU time of fresh processes run in pairs. *Ratio* is the median of emitted/hand-written over the pairs, with
the 95 % interval of the median; asked are at most 1.05 and an interval below 1.15. Instructions a step are
counted by callgrind. *Sweeps* are evaluations of an implicit step's equations; *exponentials* counts the
functions of a rotation angle in a step, + in each sweep, of the emitted code. The hand-written steps do
without the checks of the emitted ones (finite state and step) and may change variables as a person would.
"""


def environment(pairs: int) -> str:
    """Say with what was measured."""
    compiler = find_compiler()
    return f"{pairs} pairs a figure; {os.cpu_count()} cores; {compiler.version}; {' '.join(FLAGS)}."


def table(rows: list[list[str]]) -> str:
    """Return the rows as a Markdown table."""
    head = ["case", "ns a step", "by hand", "ratio", "interval", "instructions", "by hand", "sweeps"]
    head += ["by hand", "exponentials"]
    lines = [head, ["---"] + ["---:"] * 9, *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


if __name__ == "__main__":
    sys.exit(main())
