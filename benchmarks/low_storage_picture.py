"""Draw error against evaluations and against CPU time, for 2N schemes beside other commutator-free methods.

    python benchmarks/low_storage_picture.py [--budget SECONDS] [-o FILE]

Each column of the picture is a problem: a free rigid body whose attitude is in SO(3), the same body with a
unit quaternion, which is an element of SU(2), and a lattice of spins (the scene `spin_lattice`). All
methods make equal steps in emitted C on one core. The error is that at the end of the run: for the bodies in
the norm of the scene, and for the lattice the largest deviation of a coordinate from ``ambient:dop853`` with
short steps. Measure on a quiet machine.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

import codegen
from codegen.lab.efficiency.bench import bench
from codegen.lab.page.axes import appearance, label_axes, legend, log_ticks, new_figure
from codegen.lab.page.formatting import power_of_ten, scientific
from codegen.lab.page.formatting import seconds as time_text
from codegen.lab.page.series_style import DASHED, Styles
from codegen.lab.page.svg import Text, standalone, svg_element
from codegen.lab.timing import cost
from codegen.printers import DEFAULT
from orderconds import Tableau
from orderconds.tableau import find

if TYPE_CHECKING:
    from codegen.lattice import Lattice

Floats = NDArray[np.float64]

ROOT = Path(__file__).resolve().parents[1]
PICTURE = ROOT / "docs" / "pictures" / "two_registers.svg"
SPINS = "spin_lattice"
FOUND = ("cf5_2n_s10", "cf5_2n_s12", "cf4_2n_s7", "cf5_s7")
PUBLISHED = ("yan5", "berland4", "carpenter_kennedy4", "cf4")
FAMILY = "cf"
BODIES = {
    "SO(3): free rigid body": "free_rigid_body_product",
    "SU(2): free rigid body": "free_rigid_body_quaternion",
}
SIDE, END = 32, 2.0
"""The lattice has SIDE x SIDE spins. It runs from time 0 to END."""
FINE = 4000
"""The number of steps of the reference solution of the lattice."""
ERRORS = (1e-12, 1e-1)
"""Runs with errors outside this interval are not drawn."""


@dataclass(frozen=True)
class Run:
    """One run of a method: the number of evaluations of the field, the CPU time in seconds, and the error."""

    evaluations: int
    seconds: float
    error: float


Measured = dict[str, list[Run]]
"""The runs of each method, by label."""


def on_body(scene: str, labels: Sequence[str], budget: float) -> Measured:
    """Return the runs of the methods on a scene of the gallery, with 1, 2, 4, ... steps."""
    result = bench(scene, labels, [DEFAULT], (), budget, None, str).run(str)
    return {
        label: [
            Run(row.evaluations, row.seconds, row.error)
            for row in rows
            if row.evaluations and row.seconds and row.error
        ]
        for label, rows in result.entries.items()
    }


def on_lattice(labels: Sequence[str], budget: float) -> Measured:
    """Return the runs of the methods on the lattice of spins, with 4, 8, 16, ... steps."""
    states = np.random.default_rng(1).normal(size=(SIDE, SIDE, 3))
    states /= np.linalg.norm(states, axis=-1, keepdims=True)
    fine = _lattice("ambient:dop853")
    exact = fine.run(states, h=END / FINE, steps=FINE).states
    again = fine.run(states, h=END / (FINE // 2), steps=FINE // 2).states
    if abs(exact - again).max() > ERRORS[0]:
        raise SystemExit(
            f"the reference solution of the lattice has the error {abs(exact - again).max():.1e}"
        )
    return {label: list(_ladder(label, states, exact, budget)) for label in labels}


def _lattice(label: str) -> Lattice:
    return codegen.load_lattice(codegen.emit(SPINS, label, target=DEFAULT))


def _ladder(label: str, states: Floats, exact: Floats, budget: float) -> Iterator[Run]:
    """Yield runs with more and more steps, until the error is small enough or the budget is used."""
    lattice, steps = _lattice(label), 4
    stages = len(Tableau.load(find(label.partition(":")[2])).method.stages)
    while True:
        run = partial(lattice.run, states, h=END / steps, steps=steps)
        result = run()
        time = cost(run, batch=0.01, batches=7)
        error = float(abs(result.states - exact).max()) if result.ok else math.inf
        if math.isfinite(error):
            yield Run(steps * stages, time, error)
        if error < ERRORS[0] or time > budget:
            return
        steps *= 2


def drawn(problems: dict[str, Measured]) -> str:
    """Return the picture: a column for each problem, evaluations above and CPU time below."""
    labels = list(next(iter(problems.values())))
    styles, columns = Styles(labels), len(problems)
    figure, panels = new_figure(2, columns, size=(3.4 * columns, 7.6))
    values: dict[int, list[str]] = {}
    for place, axes in enumerate(panels):
        row, column = divmod(place, columns)
        title, measured = list(problems.items())[column]
        axes.set(xscale="log", yscale="log")
        for label in labels:
            runs = above_rounding(measured[label])
            name = label.partition(":")[2]
            style = styles.of(label)
            if name in PUBLISHED:
                style = replace(style, dash=DASHED, hollow=True)
            x = [r.seconds if row else float(r.evaluations) for r in runs]
            (line,) = axes.plot(x, [r.error for r in runs], label=name, **appearance(style))
            number = len(values)
            line.set_gid(f"series:{number}")
            values[number] = [
                f"{name}: {r.evaluations} evaluations, {time_text(r.seconds)}, error {scientific(r.error)}"
                for r in runs
            ]
        axes.set_ylim(ERRORS[0] / 2, ERRORS[1] * 2)
        if not row:
            axes.set_title(title, fontsize=9)
        label_axes(
            axes, "CPU time of the run" if row else "evaluations of the field", "" if column else "error"
        )
        log_ticks(axes.xaxis, time_text if row else power_of_ten)
    legend(figure, panels)
    about = (
        "Error against the number of evaluations of the field, and against CPU time, for the methods "
        + ", ".join(label.partition(":")[2] for label in labels)
    )
    title = "Commutator-free methods with and without two registers"
    return standalone(svg_element(figure, Text("two-registers", title, f"{about}.", values)))


def above_rounding(runs: Sequence[Run]) -> list[Run]:
    """Return the runs to draw: those until the error no longer decreases by a factor of two or more."""
    kept: list[Run] = []
    for run in runs:
        if run.error < ERRORS[0] or (kept and run.error > kept[-1].error / 2):
            break
        if run.error <= ERRORS[1]:
            kept.append(run)
    return kept


def least(measured: Measured, error: float, quantity: str) -> dict[str, float]:
    """Return a quantity of each method at an error, interpolated between runs on logarithmic scales.

    ``quantity`` names an attribute of :class:`Run`. Methods that do not reach the error are left out.
    """
    costs = {}
    for label, runs in measured.items():
        for above, below in pairwise(runs):
            if below.error <= error < above.error:
                part = math.log(above.error / error) / math.log(above.error / below.error)
                first, second = getattr(above, quantity), getattr(below, quantity)
                costs[label] = first * (second / first) ** part
                break
    return costs


def main() -> None:
    """Measure the problems, write the picture, and print the costs at three errors."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--budget", type=float, default=0.02, help="the longest CPU time of a run in seconds")
    parser.add_argument("-o", "--output", type=Path, default=PICTURE, help="the picture to write")
    options = parser.parse_args()
    labels = [f"{FAMILY}:{name}" for name in (*FOUND, *PUBLISHED)]
    problems = {title: on_body(scene, labels, options.budget) for title, scene in BODIES.items()}
    problems[f"Lattice of {SIDE} x {SIDE} spins"] = on_lattice(labels, 10 * options.budget)
    options.output.write_text(drawn(problems), encoding="utf-8")
    print("| problem | error | tableau | evaluations | CPU time |\n|---|---|---|---:|---:|")
    for title, measured in problems.items():
        for error in (1e-4, 1e-7, 1e-10):
            counts, times = (least(measured, error, x) for x in ("evaluations", "seconds"))
            for label in sorted(times, key=times.__getitem__):
                name = label.partition(":")[2]
                print(f"| {title} | {error:.0e} | {name} | {counts[label]:.0f} | {time_text(times[label])} |")


if __name__ == "__main__":
    main()
