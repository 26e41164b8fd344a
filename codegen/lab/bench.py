"""A bench: contestants on a scene, measured rung by rung, ranked, and written as table and picture."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from pathlib import Path

from codegen import scenes
from codegen.artifact import write_texts
from codegen.errors import MethodError
from codegen.lab.adaptive import AdaptiveContestant
from codegen.lab.contest import Contestant, EmittedContestant, PeerContestant, Row, climb
from codegen.lab.figures import Curve, efficiency_figure, standalone
from codegen.lab.journal import Journal
from codegen.lab.peers import find
from codegen.lab.ranking import Place, places
from codegen.lab.reference import Reference
from codegen.lab.remembered import remembered
from codegen.lab.study import methods_for
from codegen.scene.problem import Problem
from orderconds.errors import InputError

TARGETS = ("c", "python")
Tell = Callable[[str], object]


@dataclass(frozen=True)
class Result:
    """All rows by contestant, the winner of each decade of accuracy, and the files written."""

    scene: Problem
    entries: dict[str, tuple[Row, ...]]
    places: tuple[Place, ...]
    paths: tuple[str, ...] = ()

    @property
    def rows(self) -> tuple[Row, ...]:
        """Every row in order."""
        return tuple(row for rows in self.entries.values() for row in rows)

    @property
    def setups(self) -> tuple[tuple[str, float, float], ...]:
        """Contestant, seconds of emission, seconds of compilation (the most over its rungs)."""
        return tuple(
            (label, rows[0].emission_seconds, max(r.compile_seconds for r in rows))
            for label, rows in self.entries.items()
        )


@dataclass(frozen=True)
class Bench:
    """Contestants on one scene, ready to run; ``folder`` is where results go, or None."""

    scene: Problem
    exact: Reference
    contestants: tuple[Contestant, ...]
    folder: Path | None

    def run(self, tell: Callable[[Row], object], journal: Journal | None = None) -> Result:
        """Measure everything that the journal does not hold, rank, and write the files.

        The journal is by default one beside the files, which goes when they are written.
        """
        name = self.scene.name
        journal = journal or Journal(self.folder / f".{name}.journal" if self.folder else None)
        entries: dict[str, tuple[Row, ...]] = {}
        for contestant in self.contestants:

            def heard(row: Row, contestant: Contestant = contestant) -> None:
                journal.keep(contestant, self.exact, row)
                tell(row)

            def known(control: float, contestant: Contestant = contestant) -> Row | None:
                return journal.known(contestant, self.exact, control)

            label = contestant.label + (" (python)" if contestant.target == "python" else "")
            entries[label] = climb(contestant, known, heard)
        result = Result(self.scene, entries, places(entries))
        if self.folder is None:
            return result
        texts = {
            f"{name}.csv": table(result.rows),
            f"{name}.json": json.dumps([r.as_json() for r in result.rows], indent=2) + "\n",
            f"{name}.svg": picture(result),
        }
        written = write_texts({self.folder / file: text for file, text in texts.items()})
        paths = tuple(str(path) for path in written)
        journal.close()
        return Result(self.scene, entries, result.places, paths)


def bench(
    scene: str,
    methods: Sequence[str],
    targets: Sequence[str],
    peers: Sequence[str],
    budget: float,
    output: str | None,
    tell: Tell,
    adaptive: Sequence[str] = (),
) -> Bench:
    """Return a bench of methods (spelled; none: the usual ones) and peers on a scene.

    Those of ``adaptive`` run over tolerances, in steps that they choose by their embedded rows.

    Everything that can be wrong with the input is found here, before anything is measured.
    """
    for target in targets:
        if target not in TARGETS:
            raise MethodError(f"unknown target {target!r}", expected=f"one of {', '.join(TARGETS)}")
    problem = scenes.load(scene)
    chosen = () if adaptive and not methods else methods_for(problem, methods)
    choosing, others = methods_for(problem, adaptive) if adaptive else (), find(peers)
    folder = _folder(output)
    tell(f"{problem.name}: reference solution")
    exact = remembered(problem)
    ours: list[Contestant] = []
    kinds = ((EmittedContestant, chosen), (AdaptiveContestant, choosing))
    for kind, method in ((kind, m) for kind, group in kinds for m in group):
        for target in dict.fromkeys(targets):
            tell(f"{problem.name}: emitting {method.label}")
            ours.append(kind(problem, method, exact, target, budget))
    theirs = [PeerContestant(problem, peer, exact, budget) for peer in others]
    return Bench(problem, exact, (*ours, *theirs), folder)


def _folder(output: str | None) -> Path | None:
    if output is None:
        return None
    folder = Path(output)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(
            f"cannot write there: {error.strerror}", where=output, expected="a folder that can be written to"
        ) from None
    return folder


def table(rows: Sequence[Row]) -> str:
    """Return the rows as CSV, a header first; what is not known is empty."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    names = [field.name for field in fields(Row)]
    writer.writerow(names)
    for row in rows:
        values = row.as_json()
        writer.writerow(["" if values[n] is None else values[n] for n in names])
    return stream.getvalue()


def curves(result: Result) -> list[Curve]:
    """Return error against CPU time of every contestant with at least one run."""
    found = []
    for label, rows in result.entries.items():
        points = [(r.seconds, r.error) for r in rows if r.error and r.seconds]
        if points:
            found.append(Curve(label, tuple(points), peer=rows[0].target == "peer"))
    return found


def picture(result: Result) -> str:
    """Return the work-precision diagram as an SVG document."""
    title = f"Error against CPU time, {result.scene.title}"
    label = f"error at t = {float(result.scene.span[1]):g}"
    return standalone(efficiency_figure(f"bench-{result.scene.name}", curves(result), label), title)
