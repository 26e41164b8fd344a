"""Compare ``orderconds recommend`` with an exhaustive search over the library, in the same run.

    python benchmarks/recommend.py [SCENE...] [--errors 1e-4 1e-8 1e-12] [--minutes 60] [--budget 50]

The exhaustive search runs each recipe of the library (:mod:`codegen.lab.efficiency.exhaustive`). The
interpreter runs each recipe with more and more steps. A recipe is excluded if its time per step, multiplied
by the number of steps that its measured error requires, exceeds 10 times the recommended time for each error:
the accepted ratio 1.25 times a safety factor of 8. All other recipes, and a sample of the excluded recipes,
are emitted, compiled and raced for each error. A line for each scene states the numbers.

The recommended recipe and the best of the exhaustive search are then timed alternately. The column "ratio" is
the ratio of their CPU times. The exit status is 1 if a ratio is above 1.25, or if a search was ended by its
time limit. The scenes share the minutes. Progress is written to stderr.
"""

from __future__ import annotations

import argparse
import math
import sys
import time
from pathlib import Path

from codegen.lab.efficiency.exhaustive import WORST, exhaust
from codegen.lab.efficiency.race import Racer, Result
from codegen.lab.efficiency.recommend import Request, recommend
from codegen.lab.efficiency.task import BUDGET
from codegen.lab.reference import cached_reference

ROOT = Path(__file__).resolve().parents[1]
SCENES = (
    "heavy_top",
    "fast_heavy_top",
    "linear_oscillator",
    "dipole",
    "free_rigid_body",
    "stiff_driven_spin",
)
OUTSIDERS = tuple(
    str(path.relative_to(ROOT))
    for path in sorted((ROOT / "tests/outsider").glob("*.py"))
    if not path.name.startswith(("test_", "conftest"))
)
ERRORS = (1e-4, 1e-8, 1e-12)
TURNS = 5
MINUTES = 60.0


def timed(scene: str, results: list[Result]) -> list[float]:
    """Return the least CPU seconds of several runs, timed alternately."""
    task = Request(scene, 1.0).task
    exact = cached_reference(task.problem())
    racers = [Racer(task.equations(r.entry.recipe.form), exact, r.entry) for r in results]
    for racer, result in zip(racers, results, strict=True):
        racer.error(result.control)
    turns = [[x.seconds(r.control) for x, r in zip(racers, results, strict=True)] for _ in range(TURNS)]
    return [min(column) for column in zip(*turns, strict=True)]


def compared(scene: str, errors: list[float], budget: float, end: float) -> tuple[list[str], float, str]:
    """Return the lines of the table for one scene, the largest ratio, and the numbers of recipes in words.

    The search ends at ``end``; the largest ratio is then infinite.
    """
    found = {}
    for error in errors:
        start = time.monotonic()
        found[error] = recommend(Request(scene, error, budget=budget), note), time.monotonic() - start
    known = {e: advice.places[0].seconds if advice.places else math.inf for e, (advice, _) in found.items()}
    every = exhaust(Request(scene, 1.0), known, note, max(end - time.monotonic(), 1.0))
    lines, worst = [], 0.0 if every.complete else math.inf
    for error, (advice, search) in found.items():
        reached = sorted((r for r in every.results[error] if r.reached), key=lambda r: r.seconds)[:3]
        if not reached or not advice.places:
            counts = f"{len(advice.places)} reach it | | {search:.0f} s | {len(reached)} reach it"
            lines.append(f"| {scene} | {error:g} | {counts} | | |")
            worst = max(worst, math.inf if reached else 0.0)
            continue
        runs = [advice.places[0], *reached]
        times = timed(scene, runs)
        # The exhaustive search compiles the recommended program again. Two copies of a program may differ in
        # time, because their code is at different addresses, so the least time of both counts.
        first = runs[0].entry.recipe, runs[0].control
        copies = [t for t, r in zip(times, runs, strict=True) if (r.entry.recipe, r.control) == first]
        own, least = min(copies), min(times)
        worst = max(worst, own / least)
        labels = [runs[0].entry.recipe.label, runs[times.index(least)].entry.recipe.label]
        lines.append(
            f"| {scene} | {error:g} | {labels[0]} | {1e6 * own:.3g} µs | {search:.0f} s "
            f"| {labels[1]} | {1e6 * least:.3g} µs | {own / least:.2f} |"
        )
    return lines, worst, f"{scene}: {every.recipes} recipes: {every.text()}"


def note(text: str) -> None:
    """Show what is measured, on one line of stderr."""
    if sys.stderr.isatty():
        print(f"\r\033[K{text[:100]}", end="", file=sys.stderr, flush=True)


def main() -> int:
    """Print a table with one line for each scene and error."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scenes", nargs="*", default=[*SCENES, *OUTSIDERS])
    parser.add_argument("--errors", nargs="*", type=float, default=list(ERRORS))
    parser.add_argument("--minutes", type=float, default=MINUTES)
    parser.add_argument("--budget", type=float, default=BUDGET)
    arguments = parser.parse_args()
    start, worst, count = time.monotonic(), 0.0, len(arguments.scenes)
    end, notes = start + 60 * arguments.minutes, list[str]()
    print("| scene | error | recommended | time | search | best of all | time | ratio |")
    print("|---|---|---|---|---|---|---|---|", flush=True)
    for k, scene in enumerate(arguments.scenes):
        now = time.monotonic()
        share = (end - now) / (count - k)
        lines, ratio, numbers = compared(scene, arguments.errors, arguments.budget, now + share)
        note("")
        print(*lines, sep="\n", flush=True)
        notes.append(numbers)
        worst = max(worst, ratio)
        spent = (time.monotonic() - start) / 60
        left = spent / (k + 1) * (count - k - 1)
        print(f"{k + 1} of {count} scenes in {spent:.1f} min, {left:.1f} min left", file=sys.stderr)
    print("", *notes, sep="\n")
    return int(worst > WORST)


if __name__ == "__main__":
    sys.exit(main())
