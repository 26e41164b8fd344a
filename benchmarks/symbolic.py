"""Time the symbolic engine and its peers, each task in fresh processes, and write a table to README.md.

    python benchmarks/symbolic.py [--repeats N] [--only WORD ...]

A task is timed inside its process. The time begins after the imports and ends when the list of results is
complete; medians over the processes are reported. Both programs of a task must return the same number of
results. Peers that are not installed are omitted; ``pip install '.[peers]'`` or ``make bench`` installs them.
README.md is only written if all tasks are run.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import resource
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import partial
from importlib import metadata
from importlib.util import find_spec
from pathlib import Path
from typing import Any

REPEATS = 5
PATIENCE = 150.0
"""A peer that runs longer than this number of seconds is stopped and not run again."""

MARK = "<!-- emitted.py writes what follows -->"
"""The line of README.md before the part that another script writes."""

Prepared = Callable[[], int]
"""The function that is timed. Its imports are complete, and it returns the number of results."""


def rooted_trees() -> Prepared:
    """All rooted trees to 14 vertices."""
    from orderconds.trees.rooted import rooted_trees

    return lambda: len([tree for n in range(1, 15) for tree in rooted_trees(n)])


def kauri_rooted_trees() -> Prepared:
    """All rooted trees to 14 vertices in kauri, without the empty tree."""
    from kauri.gentrees import trees_up_to_order

    return lambda: len(list(trees_up_to_order(14))) - 1


def ordered_trees() -> Prepared:
    """All ordered trees to 12 vertices."""
    from orderconds.trees.ordered import ordered_trees

    return lambda: len([tree for n in range(1, 13) for tree in ordered_trees(n)])


def kauri_ordered_trees() -> Prepared:
    """All ordered trees to 12 vertices in kauri, without the empty tree."""
    from kauri.gentrees import planar_trees_up_to_order

    return lambda: len(list(planar_trees_up_to_order(12))) - 1


def formulas() -> Prepared:
    """RK conditions to order 10 as readable index sums."""
    return _texts("rk", 10)


def nodepy_formulas() -> Prepared:
    """RK conditions to order 10 as strings of elementary weights, in NodePy."""
    from nodepy.rooted_trees import list_trees
    from nodepy.runge_kutta_method import elementary_weight_str

    def work() -> int:
        trees = [tree for n in range(1, 11) for tree in list_trees(n)]
        return len([f"{elementary_weight_str(tree)} = 1/{tree.density()}" for tree in trees])

    return work


def polynomials() -> Prepared:
    """RK conditions to order 7 as polynomials in the coefficients of 9 explicit stages."""
    from orderconds.derivation import derive
    from orderconds.stage_expansion import polynomials

    polynomials(derive("rk", 1), 1)  # its imports
    derivation = derive("rk", 7)
    return lambda: sum(len(value) for value in polynomials(derivation, 9, explicit=True)[2])


def sympy_polynomials(order: int = 7, size: int = 9) -> Prepared:
    """RK conditions as polynomials in SymPy's ``PolyRing``, computed recursively over subtrees."""
    from sympy import QQ
    from sympy.polys.rings import ring

    from orderconds.trees.levels import children
    from orderconds.trees.rooted import rooted_trees

    stages = range(size)
    entries = [(i, j) for i in stages for j in range(i)]

    def work() -> int:
        names = [f"b_{i}" for i in stages] + [f"a_{i}_{j}" for i, j in entries]
        polynomial_ring, *generators = ring(names, QQ)
        a = dict(zip(entries, generators[size:], strict=True))
        known: dict[bytes, list[Any]] = {}
        summed: dict[bytes, list[Any]] = {}

        def stage_values(tree: bytes) -> list[Any]:
            if tree not in known:
                vector = [polynomial_ring.one for _ in stages]
                for child in children(tree):
                    vector = [x * y for x, y in zip(vector, through_stages(child), strict=True)]
                known[tree] = vector
            return known[tree]

        def through_stages(tree: bytes) -> list[Any]:
            if tree not in summed:
                vector = stage_values(tree)
                summed[tree] = [
                    sum((a[i, j] * vector[j] for j in range(i)), polynomial_ring.zero) for i in stages
                ]
            return summed[tree]

        trees = [tree for n in range(1, order + 1) for tree in rooted_trees(n)]
        return sum(
            len(
                sum(
                    (b * x for b, x in zip(generators, stage_values(tree), strict=False)),
                    polynomial_ring.zero,
                )
            )
            for tree in trees
        )

    return work


def commutator_free(explicit: bool) -> Prepared:
    """CF conditions to order 4 as polynomials; each of 5 stages and the update have 5 exponentials."""
    from orderconds import families
    from orderconds.derivation import derive
    from orderconds.ring.polynomials import Polynomials
    from orderconds.tableau import CommutatorFree, Stage

    size = range(5)

    def work() -> int:
        names = [f"alpha_{i}_{J}_{j}" for i in size for J in size for j in (range(i) if explicit else size)]
        names += [f"beta_{J}_{j}" for J in size for j in size]
        ring = Polynomials(names)
        at = dict(zip(names, ring.generators, strict=True))
        rows = [
            tuple(tuple(at.get(f"alpha_{i}_{J}_{j}", ring.zero) for j in size) for J in size) for i in size
        ]
        update = tuple(tuple(at[f"beta_{J}_{j}"] for j in size) for J in size)
        method = CommutatorFree(tuple(Stage(None, row) for row in rows), Stage(None, update))
        return len(families.get("cf").evaluate(method, ring, derive("cf", 4).conditions))

    return work


def kauri_commutator_free() -> Prepared:
    """CF conditions to order 4 in kauri. The update has 5 exponentials, but each stage only one."""
    from kauri.gentrees import planar_trees_of_order
    from kauri.manifold_ees import symbolic_cf_params, symbolic_lb_character

    def work() -> int:
        a, betas = symbolic_cf_params(5, 5)
        trees = [tree for n in range(1, 5) for tree in planar_trees_of_order(n)]
        return len([symbolic_lb_character(tree, a, betas, 5, 5) for tree in trees])

    return work


def crouch_grossman() -> Prepared:
    """CG conditions to order 7 as readable index sums."""
    return _texts("cg", 7)


def bch() -> Prepared:
    """The Baker-Campbell-Hausdorff series to degree 12."""
    from orderconds.words.bch import bch

    return lambda: len(bch(12))


def independent(family: str, order: int) -> Callable[[], Prepared]:
    """The independent conditions of a family up to an order, determined by rank."""

    def prepare() -> Prepared:
        import numpy as np

        from orderconds import families
        from orderconds.derivation import derive

        families.get(family)
        np.zeros(1)
        return lambda: sum(derive(family, order).counts)

    return prepare


def _texts(family: str, order: int) -> Prepared:
    from orderconds import families
    from orderconds.derivation import derive

    families.get(family)
    return lambda: len([str(condition) for condition in derive(family, order).conditions])


@dataclass(frozen=True)
class Task:
    """One row: the task in this project and in the peer, and the requirement.

    The requirement: this project is ``ratio`` times faster than the peer, or finishes within ``limit``
    seconds.
    """

    name: str
    ours: Callable[[], Prepared]
    peer: str = ""
    theirs: Callable[[], Prepared] | None = None
    ratio: float | None = None
    limit: float | None = None
    comparable: bool = True


TASKS = {
    "rooted": Task("rooted trees to 14 vertices", rooted_trees, "kauri", kauri_rooted_trees, ratio=15),
    "ordered": Task("ordered trees to 12 vertices", ordered_trees, "kauri", kauri_ordered_trees, ratio=7),
    "formulas": Task("RK conditions to order 10, text", formulas, "nodepy", nodepy_formulas, ratio=8),
    "polynomials": Task(
        "RK conditions to order 7, polynomials of 9 explicit stages",
        polynomials,
        "sympy",
        sympy_polynomials,
        ratio=30,
    ),
    "cf": Task(
        "CF conditions to order 4, polynomials of 5 explicit stages with 5 exponentials",
        partial(commutator_free, explicit=True),
        "kauri",
        kauri_commutator_free,
        limit=3,
        comparable=False,
    ),
    "cf_implicit": Task("the same, implicit stages", partial(commutator_free, explicit=False), limit=3),
    "cg": Task("CG conditions to order 7, text", crouch_grossman, limit=10),
    "bch": Task("BCH to degree 12", bch, limit=2),
    "vcg4": Task("VCG independent conditions to order 4", independent("vcg", 4), limit=3),
    "vcg5": Task("VCG independent conditions to order 5", independent("vcg", 5), limit=15),
    "vcg6": Task("VCG independent conditions to order 6", independent("vcg", 6), limit=180),
    "vcf5": Task("VCF independent conditions to order 5", independent("vcf", 5), limit=15),
}


@dataclass(frozen=True)
class Timing:
    """Median seconds over fresh processes, number of results, and largest resident memory in MiB."""

    seconds: float
    results: int
    mebibytes: float
    finished: bool = True


def main() -> int:
    """Run the tasks, print the table and write it; return 1 if a requirement is not satisfied."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeats", type=int, default=REPEATS)
    parser.add_argument("--only", nargs="*", choices=TASKS, default=list(TASKS), metavar="TASK")
    parser.add_argument("--one", help=argparse.SUPPRESS)
    asked = parser.parse_args()
    if asked.one:
        key, _, side = asked.one.partition(":")
        print(json.dumps(_run_here(TASKS[key].ours if side == "ours" else TASKS[key].theirs)))
        return 0
    rows = [row(key, asked.repeats) for key in asked.only]
    text = table(rows)
    print(text)
    if asked.only == list(TASKS):
        target = Path(__file__).with_name("README.md")
        others = target.read_text(encoding="utf-8").partition(MARK) if target.exists() else ("", "", "")
        page = f"{HEAD}\n{environment(asked.repeats)}\n\n{text}" + (
            "\n" + MARK + others[2] if others[1] else ""
        )
        target.write_text(page, encoding="utf-8")
    return 0 if all(cells[-1] in ("met", "-") for cells in rows) else 1


def row(key: str, repeats: int) -> list[str]:
    """Time one task in this project and in the peer, and return the cells of the row."""
    task = TASKS[key]
    print(f"{task.name} ...", file=sys.stderr, flush=True)
    ours = measure(f"{key}:ours", repeats)
    cells = [task.name, f"{ours.results}", f"{ours.seconds:.3g}", f"{ours.mebibytes:.0f}"]
    met = task.limit is None or ours.seconds <= task.limit
    met = met and ours.mebibytes < 2048
    asked = f"{task.limit:g} s" if task.limit else f"{task.ratio:g} x"
    if task.theirs is None or find_spec(task.peer) is None:
        return [*cells, "-", "-", "-", asked, ("met" if met else "missed") if task.limit else "-"]
    theirs = measure(f"{key}:theirs", repeats)
    if theirs.finished and task.comparable and theirs.results != ours.results:
        raise SystemExit(f"{task.name}: {ours.results} results here, {theirs.results} results of {task.peer}")
    bound = "" if theirs.finished else "> "
    ratio = theirs.seconds / ours.seconds
    met = met and (task.ratio is None or ratio >= task.ratio)
    cells += [task.peer, f"{bound}{theirs.seconds:.3g}", f"{bound}{ratio:.3g}"]
    return [*cells, asked, "met" if met else "missed"]


def measure(one: str, repeats: int) -> Timing:
    """Return the medians of one program of a task over fresh processes; a stopped peer is not run again."""
    command = [sys.executable, __file__, "--one", one]
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[1])}
    patience = PATIENCE if one.endswith(":theirs") else None
    found = []
    for _ in range(repeats):
        try:
            done = subprocess.run(
                command, check=True, stdout=subprocess.PIPE, env=environment, timeout=patience
            )
        except subprocess.TimeoutExpired:
            return Timing(PATIENCE, 0, 0.0, finished=False)
        found.append(json.loads(done.stdout.splitlines()[-1]))
    seconds, results, mebibytes = zip(*found, strict=True)
    return Timing(statistics.median(seconds), results[0], max(mebibytes))


def _run_here(prepare: Callable[[], Prepared] | None) -> tuple[float, int, float]:
    assert prepare is not None
    work = prepare()
    start = time.perf_counter()
    results = work()
    seconds = time.perf_counter() - start
    scale = 1024**2 if sys.platform == "darwin" else 1024
    return seconds, results, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / scale


HEAD = """# Benchmarks

`make bench` runs the scripts of this folder and writes this page. `check.py` times `orderconds check` on the
library. `symbolic.py` times the symbolic engine and its peers and writes the table below. Times are medians
over fresh processes, without imports. MiB is the largest resident memory. *Required* is a factor by which the
engine must be faster than the peer, or the largest permitted number of seconds. The memory must always be
below 2 GiB. A peer is stopped after 150 s.

This project and the peer compute the same number of results (for polynomials: the same number of terms).
Commutator-free methods are an exception: kauri has one exponential per stage instead of five, and computes
the conditions of the 9 ordered trees up to order 4 instead of 13 Lyndon words.
"""


def environment(repeats: int) -> str:
    """Return the conditions of the measurement: processes, cores, and versions of Python and the packages."""
    packages = ("python-flint", "numpy", "kauri", "nodepy", "sympy")
    versions = []
    for package in packages:
        try:
            versions.append(f"{package} {metadata.version(package)}")
        except metadata.PackageNotFoundError:
            versions.append(f"{package} not installed")
    python = f"{platform.python_implementation()} {platform.python_version()}"
    return f"{repeats} processes per task; {os.cpu_count()} cores; {python}; {', '.join(versions)}."


def table(rows: Iterable[list[str]]) -> str:
    """Return the rows as a Markdown table."""
    head = ["task", "results", "seconds", "MiB", "peer", "peer seconds", "ratio", "required", "verdict"]
    lines = [head, ["---"] + ["---:"] * 3 + ["---", "---:", "---:", "---:", "---"], *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


if __name__ == "__main__":
    sys.exit(main())
