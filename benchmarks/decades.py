"""Compare the best emitted method with heyoka and with DOP853 in C, for each decade of the error.

    python benchmarks/decades.py [--scenes NAME...] [--quick] [-o FOLDER] [--continue FILE]

For each scene and each error 1e-3 to 1e-12, the search of ``orderconds recommend`` finds the fastest emitted
methods of the library, with equal steps and with step-size control, in every classical form. The other
integrators run in every form, too, with the loosest tolerance that reaches the error. All of them are then
timed in turns by the same protocol (:func:`codegen.lab.timing.span_times`), and the least CPU time counts: a
short run is continued over several spans, and the overhead of a call from Python is subtracted. A
ratio above 1 means that the emitted method is faster. With -o the table is also written to decades.md and
decades.json. If all scenes and all decades are measured, the table is written to README.md. If some scenes
failed, --continue FILE reads the rows of the other scenes from decades.json, and only the missing scenes are
measured. Progress is written to stderr. A scene takes one to four minutes.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from codegen import scenes
from codegen.lab.efficiency.equations import Equations, all_equations
from codegen.lab.efficiency.goal import Goal
from codegen.lab.efficiency.race import Racer, Result
from codegen.lab.efficiency.search import Search
from codegen.lab.efficiency.task import Task
from codegen.lab.number_types import Vector
from codegen.lab.peers import Peer, Prepared, find
from codegen.lab.reference import Reference, cached_reference
from codegen.lab.timing import Overhead
from orderconds.errors import InputError

MARK, END = "<!-- decades.py writes what follows -->", "<!-- up to here -->"
PEERS = ("heyoka", "c-dop853")
DECADES = tuple(range(3, 13))
QUICK = (4, 8, 12)
BUDGET, QUICK_BUDGET = 180.0, 20.0
"""The seconds that a search may take. Searches on large systems need more than a minute, because each method
is compiled."""

TURNS = 5
LEADERS = 3


@dataclass
class PeerRacer(Racer):
    """An integrator of other software in one form of the equations, controlled by its tolerance."""

    peer: Peer = field(kw_only=True)

    def __post_init__(self) -> None:
        self.prepared: dict[float, Prepared] = {}
        # The overhead of a call does not depend on the tolerance.
        self.overhead = Overhead(lambda: self.run(next(iter(self.prepared)), 0))

    def prepare(self, control: float) -> None:
        """Compile the integrator for a tolerance."""
        if control not in self.prepared:
            self.prepared[control] = self.peer.prepare(self.equations.problem, 10.0**-control)

    def run(self, control: float, spans: int = 1) -> tuple[Vector, int]:
        """Return the state and the number of steps of a run over a multiple of the span."""
        self.prepare(control)
        outcome = self.prepared[control].run(spans)
        return outcome.state, outcome.steps


@dataclass(frozen=True)
class Runner:
    """A run that reaches the error, with its racer and its name."""

    name: str
    racer: Racer
    result: Result


def peer_racers(peer: Peer, equations: tuple[Equations, ...], exact: Reference) -> list[PeerRacer]:
    """Return the racers of a peer, one for each form of the equations."""
    controlled: Any = SimpleNamespace(recipe=SimpleNamespace(adaptive=True))
    return [PeerRacer(e, exact, controlled, peer=peer) for e in equations]


def fastest(racers: list[PeerRacer], error: float) -> Runner | None:
    """Return the fastest run of a peer for an error; None if it does not reach it in any form."""
    runs = []
    for racer in racers:
        try:
            result = racer.reach(error)
        except InputError:  # the peer refuses this form
            continue
        if result.reached:
            form = f" ({racer.equations.name})" if racer.equations.name else ""
            runs.append(Runner(racer.peer.name + form, racer, result))
    return min(runs, key=lambda r: r.result.seconds, default=None)


def ours(search: Search, error: float) -> list[Runner]:
    """Return the fastest emitted methods for an error."""
    places, _ = search.leaders(Goal(error))
    return [Runner(p.entry.recipe.label, search.racers[p.entry.recipe], p) for p in places[:LEADERS]]


def in_turns(runners: list[Runner]) -> list[float]:
    """Return the least CPU seconds of each run, timed in turns."""
    turns = [[r.racer.seconds(r.result.control) for r in runners] for _ in range(TURNS)]
    return [min(column) for column in zip(*turns, strict=True)]


def rows_of(scene: str, decades: tuple[int, ...], budget: float) -> list[dict[str, object]]:
    """Return one row for each decade of a scene."""
    # The reference solution is computed before the search, so its time does not count towards the budget.
    note(f"{scene}: reference solution")
    cached_reference(scenes.load(scene))
    search = Search(Task(scene, budget=budget), tuple(Goal(10.0**-d) for d in decades), note)
    search.run()
    equations = all_equations(search.problem)
    peers = {peer.name: peer_racers(peer, equations, search.exact) for peer in find(PEERS)}
    rows: list[dict[str, object]] = []
    for decade in decades:
        note(f"{scene}: 1e-{decade}")
        mine = ours(search, 10.0**-decade)
        others = {name: fastest(racers, 10.0**-decade) for name, racers in peers.items()}
        rivals = {name: run for name, run in others.items() if run is not None}
        times = in_turns([*mine, *rivals.values()])
        best = min(times[: len(mine)], default=math.inf)
        row: dict[str, object] = {
            "scene": scene,
            "error": float(f"1e-{decade}"),
            "method": mine[times.index(best)].name if mine else "",
            "seconds": best if mine else None,
            "complete": search.complete,
        }
        spent = dict(zip(rivals, times[len(mine) :], strict=True))
        for name in peers:
            row[name] = rivals[name].name if name in rivals else ""
            row[f"{name} seconds"] = spent.get(name)
            row[f"{name} ratio"] = spent[name] / best if name in spent and mine else None
        rows.append(row)
    return rows


def line(row: dict[str, object]) -> str:
    """Return a row of the table."""

    def shown(value: object, form: str, factor: float = 1.0) -> str:
        return format(factor * value, form) if isinstance(value, float) else "not reached"

    cells = [str(row["scene"]), f"{row['error']:g}", str(row["method"]), shown(row["seconds"], ".3g", 1e6)]
    for name in PEERS:
        ratio = row[f"{name} ratio"]
        mark = "**" if isinstance(ratio, float) and ratio < 1 else ""
        cells += [str(row[name]), f"{mark}{shown(ratio, '.2f')}{mark}"]
    return f"| {' | '.join(cells)} |"


INTRODUCTION = """\
## The fastest emitted method at each decade

`decades.py` searches the library for the fastest emitted method on every scene of the gallery, for each error
at the end of the span, as `orderconds recommend` does. It compares this method with heyoka and with DOP853 in
C. All of them run in every classical form of the equations, and the fastest form counts. The fastest runs are
timed in turns.

- *µs*: the least CPU time of the emitted method in microseconds.
- *its time / ours*: the CPU time of the peer divided by the time of the emitted method. Above 1, the emitted
  method is faster. Ratios below 1 are bold.
- *not reached*: no run has an error that is small enough.
"""


def verdict(rows: Sequence[Mapping[str, object]]) -> str:
    """Return sentences: in how many rows the emitted method is the fastest, which rows are lost, and why."""

    def named(chosen: list[Mapping[str, object]]) -> str:
        return ", ".join(f"{row['scene']} at {row['error']:.0e}" for row in chosen)

    def reasons(chosen: list[Mapping[str, object]]) -> str:
        ended = [row for row in chosen if not row["complete"]]
        full = [row for row in chosen if row["complete"]]
        parts = [f"{named(full)} (all methods of the library were compared)"] if full else []
        parts += [f"{named(ended)} (the search ended at its time limit)"] if ended else []
        return "; ".join(parts)

    def lost(row: Mapping[str, object]) -> bool:
        ratios = [row[f"{name} ratio"] for name in PEERS]
        return any(isinstance(x, float) and x < 1 for x in ratios)

    slower = [row for row in rows if row["seconds"] is not None and lost(row)]
    missed = [row for row in rows if row["seconds"] is None]
    won = len(rows) - len(slower) - len(missed)
    lines = [f"The emitted method is at least as fast as the peers in {won} of {len(rows)} cases."]
    lines += [f"A peer is faster: {reasons(slower)}."] if slower else []
    lines += [f"No emitted method reaches the error: {reasons(missed)}."] if missed else []
    return "\n".join(lines)


def write(rows: Sequence[dict[str, object]], page: Path) -> None:
    """Write the table to the page, in place of the earlier table."""
    before, _, after = page.read_text(encoding="utf-8").partition(MARK)
    rest = after.partition(END)[2]
    table = "\n".join([*HEAD, *map(line, rows)])
    text = f"{MARK}\n{INTRODUCTION}\n{table}\n\n{verdict(rows)}\n\n{END}"
    page.write_text(f"{before.rstrip()}\n\n{text}{rest or chr(10)}", encoding="utf-8")


HEAD = (
    "| scene | error | emitted method | µs | heyoka | its time / ours | DOP853 in C | its time / ours |",
    "|---|---|---|---|---|---|---|---|",
)


def note(text: str) -> None:
    """Show what is measured, on one line of stderr."""
    if sys.stderr.isatty():
        print(f"\r\033[K{text[:100]}", end="", file=sys.stderr, flush=True)


def save(rows: Sequence[dict[str, object]], folder: Path) -> None:
    """Write the rows to decades.json and decades.md. This is done after each scene, so an interrupted run can
    be continued."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "decades.json").write_text(json.dumps(rows, indent=2) + "\n", encoding="utf-8")
    text = "\n".join([*HEAD, *map(line, rows)]) + "\n"
    (folder / "decades.md").write_text(text, encoding="utf-8")


def main() -> int:
    """Print the table; the exit status is 1 if a peer is faster somewhere, or a scene has no rows."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scenes", nargs="*", default=list(scenes.names()))
    parser.add_argument("--quick", action="store_true", help="three decades, a shorter search")
    parser.add_argument("-o", "--output", type=Path)
    parser.add_argument(
        "--continue", dest="earlier", type=Path, metavar="FILE", help="an earlier decades.json"
    )
    arguments = parser.parse_args()
    decades, budget = (QUICK, QUICK_BUDGET) if arguments.quick else (DECADES, BUDGET)
    earlier = json.loads(arguments.earlier.read_text(encoding="utf-8")) if arguments.earlier else []
    start, rows, failed = time.monotonic(), [], 0
    print(*HEAD, sep="\n", flush=True)
    for k, scene in enumerate(arguments.scenes, 1):
        if known := [row for row in earlier if row["scene"] == scene]:
            rows += known
            continue
        try:
            found = rows_of(scene, decades, budget)
        except (InputError, ArithmeticError) as error:
            print(f"{scene}: {error}", file=sys.stderr)
            failed += 1
            continue
        note("")
        rows += found
        if arguments.output is not None:
            save(rows, arguments.output)
        print(*map(line, found), sep="\n", flush=True)
        spent = (time.monotonic() - start) / 60
        left = spent / k * (len(arguments.scenes) - k)
        count = f"{k} of {len(arguments.scenes)} scenes"
        print(f"{count} in {spent:.1f} min, {left:.1f} min left", file=sys.stderr)
    if arguments.scenes == list(scenes.names()) and not arguments.quick and not failed:
        write(rows, Path(__file__).with_name("README.md"))
    ratios = [row[f"{name} ratio"] for row in rows for name in PEERS]
    return int(failed > 0 or any(isinstance(x, float) and x < 1 for x in ratios))


if __name__ == "__main__":
    sys.exit(main())
