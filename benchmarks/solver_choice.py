"""Time emitted C with each solver, and compare the predicted times and the chosen solver with the results.

    python benchmarks/solver_choice.py [--rounds N] [--only SCENE ...] [--fit]

For each scene of the gallery and each implicit method that can integrate it, C is emitted with fixed-point
iteration, Newton's method and simplified Newton. If ``--solver auto`` chooses different solvers for the
blocks of a step, this program is added. All programs make the steps of the usage example from the initial
state. They run in rounds of alternating order and measure their own CPU time. Results are medians over the
rounds. ``--fit`` prints the weights of ``codegen/run/step_cost.py`` that fit these medians best; it needs
scipy. The table in README.md is only written if all scenes are run.
"""

from __future__ import annotations

import argparse
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import astuple, dataclass, field, fields, replace
from pathlib import Path

from codegen import scenes
from codegen.build import compile_files, find_compiler
from codegen.emitter import Compiled, compile_method, emit_compiled
from codegen.ir.kernel import FIXED_POINT, NEWTON, SIMPLIFIED_NEWTON
from codegen.run.solver_choice import AUTO, SWEEPS, Candidate
from codegen.run.step_cost import Amounts
from codegen.scene.momentum_frame import start_of
from orderconds.errors import InputError

HERE = Path(__file__).parent
FLAGS = ("-std=c11", "-O2", "-ffp-contract=off")
METHODS = (
    "vcg:midpoint",
    "vcg:triple_jump",
    "vcf:cf4",
    "vcf:vcf_gauss2",
    "vrkmk(2):gauss2",
    "vrkmk(4):gauss3",
    "ambient:gauss2",
    "ambient:radau2a3",
    "discrete_gradient:midpoint",
    "slgi:midpoint",
)
SOLVERS = {FIXED_POINT: "fixed point", NEWTON: "Newton", SIMPLIFIED_NEWTON: "simplified Newton"}
ROUNDS, STEPS, SECONDS = 7, 1000, 0.01
"""Number of rounds, steps of a run, and least CPU seconds of all runs of a program in a round."""
LARGEST_RATIO = 1.1
"""Requirement: largest ratio of the time with the chosen solver to the time with the fastest solver."""
MOST = 30
"""Weights are fitted to programs with at most this number of sweeps per step. Programs with more sweeps use
continuation in h."""
MARK, END = "<!-- solver_choice.py writes what follows -->", "<!-- up to here -->"
DRIVER = """
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include "{module}.h"
int main(int argc, char **argv)
{{
    const double initial[{size}] = {{{initial}}};
    double state[{size}];
    const size_t repeats = argc > 1 ? (size_t)strtoul(argv[1], NULL, 10) : 1;
    {prefix}statistics statistics;
    size_t made = 0;
    int status = 0;
    const clock_t start = clock();
    for (size_t k = 0; k < repeats && status == 0; k++) {{
        memcpy(state, initial, sizeof state);
        memset(&statistics, 0, sizeof statistics);
        status = {prefix}run(state, {time}{h!r}, {steps}, NULL, 0, &statistics, &made);
    }}
    printf("%.9f %zu {format}", (double)(clock() - start) / CLOCKS_PER_SEC, made{counts});
    return 0;
}}
"""


@dataclass
class Side:
    """One program: predicted time (None without convergence of the trial), measured times, in ns per step."""

    compiled: Compiled
    program: Path
    predicted: float | None = None
    robust: bool = False
    made: int = 0
    repeats: int = 1
    sweeps: tuple[float, ...] = ()
    matrices: float = 0.0
    amounts: Amounts = field(default_factory=Amounts)
    times: list[float] = field(default_factory=list)

    @property
    def measured(self) -> float | None:
        """The median of the measured times; None if a step fails."""
        return statistics.median(self.times) if self.times else None


@dataclass(frozen=True)
class Row:
    """One case: its programs by solver, and the solver that was chosen."""

    name: str
    unknowns: str
    sides: dict[str, Side]
    chosen: str

    @property
    def ratio(self) -> float | None:
        """The time with the chosen solver divided by the least time; None if a time is not known."""
        times = {s: side.measured for s, side in self.sides.items()}
        known, mine = [t for t in times.values() if t is not None], times[self.chosen]
        return None if mine is None else mine / min(known)

    @property
    def fastest(self) -> str:
        """The name of the fastest solver; empty if no solver completes all steps."""
        times = {s: side.measured for s, side in self.sides.items()}
        return min((s for s in times if times[s] is not None), key=lambda s: times[s] or 0.0, default="")

    @property
    def robust_preferred(self) -> bool:
        """True if the chosen solver is robust and the fastest solver is not."""
        fastest = self.sides.get(self.fastest)
        return fastest is not None and self.sides[self.chosen].robust and not fastest.robust

    def cells(self) -> list[str]:
        """Return the cells of the row in the table."""
        shown = [self.name, self.unknowns]
        for solver in SOLVERS:
            shown.append(pair(self.sides[solver]) if solver in self.sides else "-")
        chosen = SOLVERS.get(self.chosen) or f"mixed: {pair(self.sides[self.chosen])}"
        mark = " (robust)" if self.robust_preferred else ""
        return [*shown, chosen + mark, "-" if self.ratio is None else f"{self.ratio:.2f}"]


def pair(side: Side) -> str:
    """Return the predicted and the measured nanoseconds per step as text."""
    texts = ["-" if t is None else f"{t:.0f}" for t in (side.predicted, side.measured)]
    return " / ".join(texts)


def main() -> int:
    """Run the cases, print the table, and write it to README.md."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=ROUNDS)
    parser.add_argument("--only", nargs="*", choices=scenes.names(), default=None, metavar="SCENE")
    parser.add_argument("--fit", action="store_true")
    asked = parser.parse_args()
    rows = []
    for scene in asked.only or scenes.names():
        print(f"{scene} ...", file=sys.stderr, flush=True)
        rows += [row for method in METHODS if (row := measured_row(scene, method, asked.rounds)) is not None]
    text = f"{HEAD}\n{environment(asked.rounds)}\n\n{table(rows)}\n{verdict(rows)}\n"
    print(text)
    if asked.only is None:
        page = HERE / "README.md"
        before, _, after = page.read_text(encoding="utf-8").partition(MARK)
        rest = after.partition(END)[2]
        page.write_text(f"{before.rstrip()}\n\n{MARK}\n{text}\n{END}{rest or chr(10)}", encoding="utf-8")
    if asked.fit:
        print(fitted([side for row in rows for side in row.sides.values()]))
    return 0


def measured_row(scene: str, method: str, rounds: int) -> Row | None:
    """Return the row of a case; None if the method is explicit or cannot integrate the scene."""
    try:
        auto = compile_method(scene, method)
    except InputError:
        return None
    if not auto.solvers:
        return None
    used = {choice.solver for choice in auto.solvers}
    chosen = used.pop() if len(used) == 1 else AUTO
    with tempfile.TemporaryDirectory() as folder:
        sides: dict[str, Side] = {}
        for solver in [*SOLVERS, *([AUTO] if chosen == AUTO else [])]:
            try:
                compiled = compile_method(scene, method, solver=solver)
            except InputError:
                continue
            sides[solver] = built(compiled, Path(folder) / solver)
        for k in range(rounds):
            for side in list(sides.values())[:: 1 if k % 2 == 0 else -1]:
                if side.made == STEPS:
                    side.times.append(1e9 * run(side, side.repeats) / STEPS / side.repeats)
    unknowns = " + ".join(str(choice.unknowns) for choice in auto.solvers)
    return Row(f"{method} on {scene}", unknowns, sides, chosen)


def built(compiled: Compiled, folder: Path) -> Side:
    """Build the program of a compiled method; return it with the predicted time and the counts of a run."""
    artifact = emit_compiled(compiled, "c")
    interface, blocks = artifact.manifest["interface"], len(compiled.kernel.loops)
    first, last = artifact.manifest["span"]
    counted = [f"statistics.sweeps[{k}]" for k in range(blocks)]
    newton = NEWTON in interface["solvers"]
    counted += ["statistics.matrices"] if newton else []
    driver = DRIVER.format(
        module=artifact.manifest["module"],
        size=interface["size"],
        initial=", ".join(map(repr, artifact.manifest["initial"])),
        prefix=interface["prefix"],
        time=f"{first!r}, " if interface["time"] else "",
        h=(last - first) / 100,
        steps=STEPS,
        format=" ".join(["%zu"] * len(counted)),
        counts="".join(f", {c}" for c in counted),
    )
    folder.mkdir()
    compile_files({**artifact.files, "driver.c": driver}, folder, folder / "program", FLAGS, find_compiler())
    side = Side(compiled, folder / "program")
    candidate = Candidate(compiled.kernel, compiled.problem, start_of(compiled.scene))
    if candidate.usual.converged:
        side.predicted, side.robust = candidate.step(), candidate.robust
    seconds, made, *counts = output(side.program, 1)
    side.made, side.repeats = int(made), max(1, round(SECONDS / max(seconds, 1e-6)))
    if side.made == STEPS:
        sweeps = [n / STEPS for n in counts[:blocks]]
        kept = [loop.solver == NEWTON for loop in compiled.kernel.loops]
        each = counts[-1] / STEPS / sum(kept) if newton else 0.0
        matrices = [each if k else m for k, m in zip(kept, candidate.usual.matrices, strict=True)]
        side.sweeps, side.amounts = tuple(sweeps), candidate.cost.amounts(sweeps, matrices)
    return side


def run(side: Side, repeats: int) -> float:
    """Return the CPU seconds of a number of runs."""
    return output(side.program, repeats)[0]


def output(program: Path, repeats: int) -> list[float]:
    """Return the output of a program: seconds, completed steps, sweeps of each block, Newton matrices."""
    answer = subprocess.run([program, str(repeats)], check=True, capture_output=True, text=True)
    return [float(word) for word in answer.stdout.split()]


def verdict(rows: Sequence[Row]) -> str:
    """Return the number of cases that satisfy the requirement, and the case with the largest ratio."""
    known = [(row.ratio, row) for row in rows if row.ratio is not None]
    fair = [(ratio, row) for ratio, row in known if not row.robust_preferred]
    near = sum(ratio <= LARGEST_RATIO for ratio, _ in known)
    lines = [
        f"With the chosen solver, the time is at most {LARGEST_RATIO} times the least time "
        f"in {near} of {len(known)} cases."
    ]
    if fair:
        ratio, row = max(fair, key=lambda pair: pair[0])
        lines.append(f"The largest ratio is {ratio:.2f}: {row.name}.")
    other = [(ratio, row) for ratio, row in known if row.robust_preferred]
    if other:
        ratio, row = max(other, key=lambda pair: pair[0])
        lines.append(
            f"In {len(other)} cases the fastest solver is not robust; the largest ratio of these cases is "
            f"{ratio:.2f}: {row.name}."
        )
    failing = [row.name for row in rows if row.sides[row.chosen].measured is None and row.fastest]
    none = [row.name for row in rows if not row.fastest]
    if failing:
        lines.append(
            f"The chosen solver fails, but another solver completes all steps: {', '.join(failing)}."
        )
    if none:
        lines.append(f"No solver completes {STEPS} steps: {', '.join(none)}.")
    gaps = [
        abs(side.predicted / side.measured - 1)
        for row in rows
        for side in row.sides.values()
        if side.predicted is not None and side.measured is not None
    ]
    lines.append(f"The median relative error of a prediction is {100 * statistics.median(gaps):.0f} %.")
    return "\n".join(lines)


def fitted(sides: Sequence[Side]) -> str:
    """Return the weights of the cost model that fit the measured times best."""
    from scipy.optimize import nnls

    used = [(s.amounts, s.measured) for s in sides if s.measured is not None and max(s.sweeps) <= MOST]
    matrix = [[x / time for x in astuple(amounts)] for amounts, time in used]
    weights, _ = nnls(matrix, [1.0] * len(used))
    gaps = sorted(abs(a.cost(Amounts(*map(float, weights))) / t - 1) for a, t in used)
    named = {f.name: float(f"{w:.2g}") for f, w in zip(fields(Amounts), weights, strict=True)}
    error = 100 * gaps[len(gaps) // 2]
    return f"{replace(Amounts(), **named)}\n{len(used)} programs; median error {error:.0f} %"


def environment(rounds: int) -> str:
    """Return the conditions of the measurement: rounds, compiler and flags."""
    return f"{rounds} rounds; {find_compiler().version}; {' '.join(FLAGS)}."


def table(rows: Sequence[Row]) -> str:
    """Return the rows as a Markdown table."""
    head = ["case", "unknowns", *SOLVERS.values(), "chosen", "ratio"]
    lines = [head, ["---", "---:", "---:", "---:", "---:", "---", "---:"], *(row.cells() for row in rows)]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


HEAD = f"""
## The choice of a solver

`solver_choice.py` times emitted C of the implicit methods on the scenes of the gallery, with each solver.
Every run makes {STEPS} steps from the initial state, with the step size h of the usage example.

- *fixed point*, *Newton*, *simplified Newton*: nanoseconds per step, predicted / measured. The prediction is
  made by `codegen/run/step_cost.py` from a trial of 20 steps; it is missing if the trial does not converge.
  The measurement is a median of CPU times; it is missing if a step fails.
- *chosen*: the solver that `--solver auto` chooses. *(robust)*: the fastest solver does not converge in a
step
  of size 8 h within {SWEEPS} sweeps, but the chosen solver does.
- *ratio*: the time with the chosen solver divided by the time with the fastest solver. Required: at most
  {LARGEST_RATIO}.
"""


if __name__ == "__main__":
    sys.exit(main())
