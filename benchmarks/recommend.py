"""Compare ``orderconds recommend`` with an exhaustive search over the library, in the same run.

    python benchmarks/recommend.py [SCENE...] [--errors 1e-4 1e-8 1e-12]

Each recipe of the library is emitted, compiled and raced for each error. The recommended recipe and the best
of the exhaustive search are then timed alternately. The last column is the ratio of their CPU times. The exit
status is 1 if a ratio is above 1.25. An exhaustive search takes 3 to 30 minutes a scene.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

from codegen.lab.efficiency.race import Racer, Result
from codegen.lab.efficiency.recommend import Request, race_all, recommend
from codegen.lab.reference import cached_reference

ROOT = Path(__file__).resolve().parents[1]
SCENES = ("dipole", "free_rigid_body", "heavy_top", "fast_heavy_top", "driven_spin", "duffing")
OUTSIDERS = sorted(str(path.relative_to(ROOT)) for path in (ROOT / "tests/outsider").glob("*pendulum*.py"))
ERRORS = (1e-4, 1e-8, 1e-12)
WORST = 1.25
TURNS = 5


def timed(scene: str, results: list[Result]) -> list[float]:
    """Return the least CPU seconds of several runs, timed alternately."""
    task = Request(scene, 1.0).task
    exact = cached_reference(task.problem())
    racers = [Racer(task.equations(r.entry.recipe.form), exact, r.entry) for r in results]
    for racer, result in zip(racers, results, strict=True):
        racer.error(result.control)
    turns = [[x.seconds(r.control) for x, r in zip(racers, results, strict=True)] for _ in range(TURNS)]
    return [min(column) for column in zip(*turns, strict=True)]


def main() -> int:
    """Print a table with one line for each scene and error."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scenes", nargs="*", default=[*SCENES, *OUTSIDERS])
    parser.add_argument("--errors", nargs="*", type=float, default=list(ERRORS))
    arguments = parser.parse_args()
    worst = 0.0
    print("| scene | error | recommended | time | search | best of all | time | ratio |")
    print("|---|---|---|---|---|---|---|---|")
    for scene in arguments.scenes:
        found = {}
        for error in arguments.errors:
            start = time.monotonic()
            found[error] = recommend(Request(scene, error)), time.monotonic() - start
        every = race_all(Request(scene, 1.0), arguments.errors)
        for error, (advice, search) in found.items():
            reached = sorted((r for r in every[error] if r.reached), key=lambda r: r.seconds)
            if not reached or not advice.places:
                counts = f"{len(advice.places)} reach it | | | {len(reached)} reach it"
                print(f"| {scene} | {error:g} | {counts} | | |")
                worst = max(worst, 0.0 if len(reached) == len(advice.places) else 9.9)
                continue
            mine, best, *_ = advice.places[0], *reached[:3]
            others = timed(scene, [mine, *reached[:3]])
            least = min(others)
            best = [mine, *reached[:3]][others.index(least)]
            ratio = others[0] / least
            worst = max(worst, ratio)
            labels = [x.entry.recipe.label for x in (mine, best)]
            print(
                f"| {scene} | {error:g} | {labels[0]} | {1e6 * others[0]:.3g} µs | {search:.0f} s "
                f"| {labels[1]} | {1e6 * least:.3g} µs | {ratio:.2f} |",
                flush=True,
            )
    return int(worst > WORST)


if __name__ == "__main__":
    sys.exit(main())
