"""A bench measures the errors and CPU times of emitted methods and peers (other integrators) on a scene.

For each required error, the bench names the two fastest integrators.
"""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path

from codegen import scenes
from codegen.artifact import write_texts
from codegen.errors import MethodError
from codegen.lab.default_methods import methods_for
from codegen.lab.efficiency.adaptive_candidate import AdaptiveCandidate
from codegen.lab.efficiency.emitted_candidate import EmittedCandidate
from codegen.lab.efficiency.equations import Equations, all_equations
from codegen.lab.efficiency.peer_candidate import PeerCandidate
from codegen.lab.efficiency.ranking import Place, by_form, frontier, in_form, places
from codegen.lab.efficiency.work_precision import Candidate, Refused, Row, measure_rows
from codegen.lab.measurement_cache import MeasurementCache
from codegen.lab.page.figures import Curve, efficiency_figure
from codegen.lab.page.series_style import Styles
from codegen.lab.page.svg import standalone
from codegen.lab.peers import Peer, find
from codegen.lab.progress import Progress
from codegen.lab.reference import Reference, cached_reference
from codegen.lower import lowering
from codegen.method import Method
from codegen.printers import DEFAULT, names
from codegen.scene.problem import Problem
from orderconds.errors import InputError
from orderconds.tableau import Tableau


@dataclass(frozen=True, repr=False)
class Result:
    """The result of a bench.

    - ``entries``: maps the name of a candidate (a method or another integrator) to one row for each run.
    - ``places``: the fastest and the second fastest candidate for each required error, such as 1e-6.
    - ``paths``: the paths of the files that were written.
    """

    scene: Problem
    entries: dict[str, tuple[Row, ...]]
    places: tuple[Place, ...]
    paths: tuple[str, ...] = ()

    def __repr__(self) -> str:
        best = (
            f", fastest at error 1e-{self.places[-1].decade}: {self.places[-1].winner}" if self.places else ""
        )
        return f"<bench of {self.scene.name}: {len(self.rows)} runs{best}>"

    def _repr_svg_(self) -> str:
        return picture(self)

    @property
    def rows(self) -> tuple[Row, ...]:
        """The rows of all candidates in one list. A row describes one run."""
        return tuple(row for rows in self.entries.values() for row in rows)

    @property
    def setups(self) -> tuple[tuple[str, float, float], ...]:
        """The times in seconds for the emission and the compilation of the candidates.

        Each triple contains a label (:func:`in_form`), the time of emission, and the time of compilation.
        """
        return tuple(
            (in_form(label, form), own[0].emit_seconds, max(r.compile_seconds for r in own))
            for label, rows in self.entries.items()
            for form, own in by_form(rows).items()
        )


@dataclass(frozen=True)
class Bench:
    """Measures the errors and CPU times of candidates on one scene.

    A candidate is an emitted method or another integrator.

    If ``folder`` is not None, :meth:`run` writes the results to this folder.
    """

    scene: Problem
    exact: Reference
    candidates: tuple[Candidate, ...]
    folder: Path | None = None

    def run(self, done: Callable[[Row], object], cache: MeasurementCache | None = None) -> Result:
        """Make all runs that are not in the cache, and rank the candidates.

        The function ``done`` is called with the row of each run. CSV, JSON and SVG files with the results are
        written to ``self.folder``. The default cache is a hidden folder there. If ``self.folder`` is None,
        there are no result files and no default cache.
        """
        name, stem = self.scene.name, scenes.file_stem(self.scene)
        own = MeasurementCache(self.folder / f".{stem}.measured" if self.folder else None)
        entries: dict[str, tuple[Row, ...]] = {}
        for c in self.candidates:
            rows = measure_rows(c, name, self.exact, cache or own, done)
            entries[entry_name(c)] = (*entries.get(entry_name(c), ()), *rows)
        result = Result(self.scene, entries, places(entries))
        if self.folder is None:
            return result
        texts = {
            f"{stem}.csv": table(result.rows),
            f"{stem}.json": json.dumps([r.as_json() for r in result.rows], indent=2) + "\n",
            f"{stem}.svg": picture(result),
        }
        written = write_texts({self.folder / file: text for file, text in texts.items()})
        own.remove()
        return replace(result, paths=tuple(str(path) for path in written))


def bench(
    scene: Problem | str,
    methods: Sequence[Method | Tableau | str],
    targets: Sequence[str],
    peers: Sequence[str],
    budget: float,
    output: str | None,
    progress: Progress,
    adaptive: Sequence[Method | Tableau | str] = (),
    forms: Sequence[str] = (),
) -> Bench:
    """Return a bench of methods and peers (other integrators) on a scene.

    - ``methods``: methods that run with equal steps.
    - ``adaptive``: methods that run with step-size control. If ``methods`` and ``adaptive`` are empty, the
      default methods for the scene are used (:func:`methods_for`).
    - ``targets``: the names of programming languages in which the methods are emitted.
    - ``budget``: the longest CPU time of a run in seconds.
    - ``output``: the folder for the files of the results, or None.
    - ``forms``: names of forms of the equations, for example ``quaternion`` (default: all forms). Methods
      that use the Lie group ignore ``forms``.

    InputError is raised for wrong names and options. If a method cannot be emitted for the scene, the result
    contains the reason.
    """
    for target in targets:
        if target not in names():
            raise MethodError(f"unknown target {target!r}", expected=f"one of {', '.join(names())}")
    problem = scenes.with_one_system(scenes.problem_of(scene))
    fixed = () if adaptive and not methods else methods_for(problem, methods)
    controlled = methods_for(problem, adaptive) if adaptive else ()
    for method in controlled:
        # If the method has no step-size control, MethodError is raised here, before the long computations.
        replace(method, adaptive=True).embedded()
    others = find(peers)
    equations = all_equations(problem, forms)
    folder = _folder(output)
    progress(f"{problem.name}: reference solution")
    exact = cached_reference(problem)
    ours: list[Candidate] = []
    for method, adapt in [*((m, False) for m in fixed), *((m, True) for m in controlled)]:
        for target in dict.fromkeys(targets):
            progress(f"{problem.name}: emitting {method.label}")
            ours += emitted_forms(problem, method, exact, target, budget, equations, adaptive=adapt)
    return Bench(problem, exact, (*ours, *peer_forms(problem, others, exact, budget, equations)), folder)


def emitted_forms(
    scene: Problem,
    method: Method,
    exact: Reference,
    target: str,
    budget: float,
    equations: Sequence[Equations],
    *,
    adaptive: bool = False,
) -> list[Candidate]:
    """Return the candidates for a method.

    A method that treats the state as a vector in R^n has one candidate for each element of ``equations``.
    Every other method has only one candidate, which integrates the original equations of the scene.
    """
    suited = equations if lowering(method.family).in_coordinates else [Equations(scene)]
    return [emitted(scene, method, exact, target, budget, adaptive=adaptive, equations=e) for e in suited]


def peer_forms(
    scene: Problem, peers: Sequence[Peer], exact: Reference, budget: float, equations: Sequence[Equations]
) -> list[Candidate]:
    """Return one candidate for each pair of a peer (another integrator) and an element of ``equations``.

    Exception: a peer with projection onto the manifold has only one candidate.
    """
    return [
        PeerCandidate(scene, peer, exact, budget, equations=e)
        for peer in peers
        for e in ([Equations(scene)] if peer.projects else equations)
    ]


def entry_name(candidate: Candidate) -> str:
    """Return the label of a candidate, followed by the target language if it is not the default."""
    other = candidate.target in names() and candidate.target != DEFAULT
    return f"{candidate.label} ({candidate.target})" if other else candidate.label


def emitted(
    scene: Problem,
    method: Method,
    exact: Reference,
    target: str,
    budget: float,
    *,
    adaptive: bool = False,
    equations: Equations | None = None,
) -> Candidate:
    """Emit a method for a scene, and return the emitted integrator as a candidate for measurements.

    If the method cannot be emitted for the scene, return a :class:`Refused` with the reason.
    """
    kind = AdaptiveCandidate if adaptive else EmittedCandidate
    try:
        return kind(scene, method, exact, target, budget, equations=equations)
    except (InputError, ArithmeticError) as error:
        label = f"adaptive {method.label}" if adaptive else method.label
        return Refused(label, target, str(error), form=equations.name if equations is not None else "")


def _folder(output: str | None) -> Path | None:
    if output is None:
        return None
    folder = Path(output)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(
            f"cannot write to this path: {error.strerror}",
            where=output,
            expected="a folder that can be written to",
        ) from None
    return folder


def table(rows: Sequence[Row]) -> str:
    """Return the rows as CSV text with a header. An unknown value is written as an empty field."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    columns = [field.name for field in fields(Row)]
    writer.writerow(columns)
    for row in rows:
        values = row.as_json()
        writer.writerow(["" if values[n] is None else values[n] for n in columns])
    return stream.getvalue()


def curves(result: Result, styles: Styles) -> list[Curve]:
    """Return one curve of errors and CPU times for each candidate with a successful run.

    The runs of a candidate can use different forms of the equations. The curve omits a run if the candidate
    reaches the same error faster with another form (:func:`frontier`).
    """
    drawn = []
    for label, rows in result.entries.items():
        runs = [(r.seconds, r.error, r.spread or 0.0) for r in frontier(rows) if r.error and r.seconds]
        if runs:
            points = tuple((time, error) for time, error, _ in runs)
            upper = tuple(time * (1 + spread) for time, _, spread in runs)
            drawn.append(Curve(label, points, styles.of(label), upper=upper))
    return drawn


def picture(result: Result) -> str:
    """Return the work-precision diagram as an SVG document."""
    title = f"Error against CPU time, {result.scene.title}"
    label = f"error at t = {float(result.scene.span[1]):g}"
    return standalone(
        efficiency_figure(f"bench-{result.scene.name}", title, curves(result, Styles(result.entries)), label)
    )
