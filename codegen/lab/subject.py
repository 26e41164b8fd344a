"""The subject of a report page: one scene (initial value problem) with the methods to measure on it."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Generic, TypeVar

from codegen.artifact import Artifact
from codegen.certify import certified_order
from codegen.command_names import bare, quoted
from codegen.emitter import Compiled, compile_method, emit_compiled
from codegen.errors import SceneError
from codegen.lab.default_methods import report_methods
from codegen.lab.measurement_cache import MeasurementCache
from codegen.lab.page.series_style import ADAPTIVE, Styles
from codegen.lab.peers import GROUPS, find, installed
from codegen.lab.progress import Progress
from codegen.lab.reference import Reference, cached_reference
from codegen.lower import method_for
from codegen.method import Method
from codegen.printers import DEFAULT
from codegen.scene.problem import Problem
from orderconds.errors import InputError

T = TypeVar("T")

MANY = 8
"""If a report has more than MANY scenes, the effort for each scene is reduced (:meth:`Effort.shared`)."""


@dataclass(frozen=True)
class Effort:
    """The extent of the measurements on one scene.

    - ``budget``: the longest CPU time in seconds of one run in the comparison of CPU times.
    - ``peers``: the names of the peers (other integrators for comparison).
    - ``steps``: the number of steps of a long run.
    - ``back``: True to integrate back to the initial time after each long run.
    - ``rounding``: True to measure the growth of rounding errors.
    - ``stiff``: True to test stiff variants of the scene.
    - ``endurance``: True to make runs of up to ten million steps.
    - ``search``: the time in seconds of the search for the fastest methods for the scene.
    """

    budget: float
    peers: tuple[str, ...]
    steps: int
    back: bool
    rounding: bool
    stiff: bool
    endurance: bool
    search: float = 25.0

    def shared(self, scenes: int, processes: int = 1) -> Effort:
        """Return the effort for one scene of a report on several scenes.

        If ``scenes`` (the number of scenes) is more than :data:`MANY`, the effort is reduced:

        - ``search`` is multiplied by MANY / ``scenes``.
        - ``rounding`` becomes False, except in full reports (those with ``endurance``).

        If ``processes`` scenes are measured at the same time, ``search`` is multiplied by ``processes``.

        >>> few, many = USUAL.shared(4), USUAL.shared(16)
        >>> few == USUAL, many.search, many.rounding, USUAL.shared(16, processes=2).search
        (True, 12.5, False, 25.0)
        """
        search = self.search * processes
        if scenes <= MANY:
            return replace(self, search=search)
        return replace(self, search=search * MANY / scenes, rounding=self.rounding and self.endurance)


QUICK = Effort(
    0.002, ("c-dop853",), 10_000, back=False, rounding=False, stiff=False, endurance=False, search=8.0
)
USUAL = Effort(0.05, ("c-dop853", "heyoka"), 100_000, back=True, rounding=True, stiff=True, endurance=False)
FULL = Effort(0.5, ("all",), 1_000_000, back=True, rounding=True, stiff=True, endurance=True, search=100.0)
EFFORTS = {"quick": QUICK, "usual": USUAL, "full": FULL}


@dataclass(frozen=True)
class CompiledMethod:
    """A method that is compiled for the scene of a report page.

    ``seconds`` is the compilation time. ``artifact`` contains the emitted files.
    """

    compiled: Compiled
    seconds: float
    artifact: Artifact

    @property
    def label(self) -> str:
        """The name of the method."""
        return self.compiled.method.label

    @property
    def files(self) -> list[tuple[str, str]]:
        """The names and texts of the emitted files, sorted by name."""
        return sorted(self.artifact.files.items())


@dataclass(frozen=True)
class MethodFailure:
    """The name of a method that could not be measured, and the reason."""

    method: str
    reason: str

    def as_json(self) -> dict[str, object]:
        """Return plain data, which can be written as JSON."""
        return {"method": self.method, "verdict": "fails", "failure": self.reason}


@dataclass(frozen=True)
class MethodResults(Generic[T]):
    """The results of one measurement for several methods.

    ``measured`` contains a result for each method that could be measured. ``failures`` contains the reason of
    failure for each of the remaining methods.
    """

    measured: tuple[T, ...]
    failures: tuple[MethodFailure, ...] = ()


@dataclass
class Subject:
    """The input of every measurement: one scene, and the methods to measure on it.

    - ``name``: the name of the scene as the user wrote it.
    - ``methods``: the methods that run with equal steps.
    - ``adaptive``: the methods that run with step-size control.
    - ``peers``: the names of other integrators for comparison with the methods.
    - ``results``: maps the name of each earlier measurement to its result, for use in later measurements.
    - ``named``: True if the user chose the methods, False if they are the default methods.
    """

    name: str
    scene: Problem
    methods: tuple[Method, ...]
    adaptive: tuple[Method, ...]
    peers: tuple[str, ...]
    effort: Effort
    cache: MeasurementCache = field(default_factory=lambda: MeasurementCache(None))
    progress: Progress = str
    results: dict[str, object] = field(default_factory=dict)
    named: bool = False

    @cached_property
    def exact_or_reason(self) -> Reference | str:
        """The reference solution, or the reason why it could not be computed."""
        self.progress(f"{self.scene.name}: reference solution")
        try:
            return cached_reference(self.scene)
        except SceneError as error:
            return str(error)

    @property
    def exact(self) -> Reference:
        """The reference solution. Raises :class:`codegen.errors.SceneError` if it could not be computed."""
        if isinstance(self.exact_or_reason, str):
            raise SceneError(self.exact_or_reason)
        return self.exact_or_reason

    @property
    def labels(self) -> tuple[str, ...]:
        """The names of all methods, and then the names of the peers (other integrators).

        The methods with step-size control come after the other methods.
        """
        controlled = (ADAPTIVE + m.label for m in self.adaptive)
        return (*(m.label for m in self.methods), *controlled, *(peer.name for peer in find(self.peers)))

    @cached_property
    def styles(self) -> Styles:
        """The colours and markers of all methods and peers (other integrators) that the page shows."""
        return Styles(self.labels)

    @cached_property
    def compiled(self) -> MethodResults[CompiledMethod]:
        """The compiled methods, and the reason of failure for each method that could not be compiled."""
        methods, failures = [], []
        for method in self.methods:
            self.progress(f"{self.scene.name}, {method.label}: compiling")
            start = time.perf_counter()
            try:
                compiled = compile_method(self.scene, method)
                seconds = time.perf_counter() - start
                artifact = emit_compiled(compiled, DEFAULT, order=certified_order(method, self.scene))
            except (InputError, ArithmeticError) as error:
                failures.append(MethodFailure(method.label, str(error)))
                continue
            methods.append(CompiledMethod(compiled, seconds, artifact))
        return MethodResults(tuple(methods), tuple(failures))

    def each(self, measure: Callable[[CompiledMethod], T]) -> MethodResults[T]:
        """Call ``measure`` for each compiled method, and return the results and the reasons of failures."""
        results, failures = [], list(self.compiled.failures)
        for method in self.compiled.measured:
            try:
                results.append(measure(method))
            except (InputError, ArithmeticError) as error:
                failures.append(MethodFailure(method.label, str(error)))
        return MethodResults(tuple(results), tuple(failures))

    def report_command(self, part: str) -> str:
        """Return the command line that repeats the measurement named ``part`` for this subject."""
        words = ["orderconds report", bare(self.name), *self._methods()]
        return " ".join([*words, f"--only {part}", "-o DIR"])

    def bench_command(self) -> str:
        """Return the command line that repeats the measurement of the CPU times for this subject."""
        words = ["orderconds bench", bare(self.name), *self._methods()]
        words += [f"--adaptive {quoted(bare(m.label))}" for m in self.adaptive]
        words += [f"-a {peer}" for peer in self.peers]
        return " ".join([*words, f"--budget {self.effort.budget:g}", "-o DIR"])

    def _methods(self) -> list[str]:
        return [f"-m {quoted(bare(m.label))}" for m in self.methods]


def subject(
    name: str,
    scene: Problem,
    methods: Sequence[str] = (),
    peers: Sequence[str] = (),
    effort: Effort = USUAL,
    adaptive: Sequence[str] = (),
) -> Subject:
    """Return the subject of a page of the report: a scene, and the methods and peers to measure on it.

    If no methods are given, the default methods of the report are used. If no peers are given, all
    installed peers in ``effort.peers`` are used. For unknown names, :func:`codegen.method.parse` and
    :func:`codegen.lab.peers.find` raise errors.
    """
    chosen = tuple(method_for(scene, m) for m in methods)
    controlled = tuple(replace(method_for(scene, m), adaptive=True) for m in adaptive)
    for method in controlled:
        method.embedded()  # Raises MethodError if the tableau has no embedded method.
    if not methods and not adaptive:
        chosen, controlled = report_methods(scene)
    others = tuple(peers) if peers else tuple(p for p in effort.peers if p in GROUPS or installed(p))
    find(others)
    return Subject(name, scene, chosen, controlled, others, effort, named=bool(methods or adaptive))
