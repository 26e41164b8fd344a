"""Error against run time: contestants on one scene, each over its own ladder of steps or tolerances.

A contestant is an emitted method or a peer. Each rung gives one :class:`Row`: the error at the end of the
span in the scene's own measure, and CPU time as :mod:`codegen.lab.timing` takes it. A run that fails is a row
too, with its reason. The ladder of an emitted method doubles its steps until the error no longer falls near
rounding, or one run exceeds the budget.
"""

from __future__ import annotations

import math
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any, Protocol

from codegen.build import compile_files, find_compiler
from codegen.certify import certified_order
from codegen.emitter import Compiled, compile_method
from codegen.ir.program import Assign
from codegen.lab.distance import distance
from codegen.lab.peers import TOLERANCES, Peer, PeerFailed
from codegen.lab.reference import Reference
from codegen.lab.runner import Emitted, RunFailed
from codegen.lab.timing import cost, samples
from codegen.loader import Statistics
from codegen.method import Method
from codegen.printers.c.module import FLAGS
from codegen.scene.problem import Problem

BUDGET = 1.0
"""CPU seconds that one run of a ladder may take."""

MOST_STEPS = 5 * 2**21
COUNTED = 1e-3
"""CPU seconds below which the cost of a call from Python is taken off a run."""

NEAR_ROUNDING = 1e-9
"""Errors below this, relative to the state, may stand still because of rounding."""

EVALUATIONS = frozenset({"field", "fieldt", "hamilton", "hamiltont", "force", "forcet", "differential"})
"""Operations that evaluate a scene; in the body frame a velocity and a force make one evaluation."""

EXPONENTIALS = frozenset({"exp", "actexp", "flow", "flowt", "flowfor", "flowtfor"})


@dataclass(frozen=True)
class Row:
    """One run. ``h`` is the (mean) step, ``control`` the tolerance or number of steps asked for.

    ``seconds`` is the least CPU time, ``spread`` the most of it relative to the least, less one.
    ``evaluations``, ``exponentials`` and ``iterations`` are those of the whole run, None where they are not
    counted; ``failure`` says why there is no error and no time.
    """

    scene: str
    method: str
    target: str
    control: float
    h: float | None
    steps: int | None
    error: float | None
    seconds: float | None
    spread: float | None
    ns_per_step: float | None
    evaluations: int | None
    exponentials: int | None
    iterations: int | None
    emission_seconds: float
    compile_seconds: float
    failure: str = ""

    def as_json(self) -> dict[str, Any]:
        """Return plain data."""
        return asdict(self)


class Contestant(Protocol):
    """What climbs a ladder: ``label`` and ``target`` name it, ``key`` changes when its code does."""

    label: str
    target: str
    key: str

    def controls(self) -> Iterator[float]:
        """Yield the rungs, coarse to fine."""

    def prepare(self) -> None:
        """Do what comes before the first run, and keep the seconds it took."""

    def measure(self, control: float) -> Row:
        """Run at one rung and time it."""

    def enough(self, rows: Sequence[Row]) -> bool:
        """Say whether finer rungs would show nothing more."""


def climb(
    contestant: Contestant, known: Callable[[float], Row | None], tell: Callable[[Row], object]
) -> tuple[Row, ...]:
    """Return the rows of a contestant; ``known`` gives those measured before, ``tell`` hears each one.

    What all rungs are known of is not even prepared.
    """
    rows: list[Row] = []
    ready = False
    for control in contestant.controls():
        row = known(control)
        if row is None:
            if not ready:
                contestant.prepare()
                ready = True
            row = contestant.measure(control)
        rows.append(row)
        tell(row)
        if contestant.enough(rows):
            break
    return tuple(rows)


@dataclass
class EmittedContestant:
    """A method emitted to a target, compiled and run over the span in equal steps.

    ``made`` is the method compiled already, whose emission then takes next to no time.
    """

    scene: Problem
    method: Method
    exact: Reference
    target: str = "c"
    budget: float = BUDGET
    made: Compiled | None = None

    def __post_init__(self) -> None:
        start = time.perf_counter()
        self.compiled: Compiled = self.made or compile_method(self.scene, self.method)
        self.runner = Emitted(self.compiled, self.target, certified_order(self.method, self.scene))
        self.label = self.method.label
        self.key = repr(sorted(self.runner.emission.manifest["files"].items()))
        self.emission_seconds = time.perf_counter() - start
        self.compile_seconds = 0.0
        self.idle = math.inf

    def controls(self) -> Iterator[float]:
        """Double the steps."""
        n = 1
        while n <= MOST_STEPS:
            yield float(n)
            n *= 2

    def prepare(self) -> None:
        """Compile, apart from the cache so that the time is the compiler's, then load."""
        if self.target == "c":
            self.compile_seconds = _compile_seconds(self.runner.emission.files)
        self.runner.final(0)

    def measure(self, control: float) -> Row:
        """Run over the span in ``control`` steps."""
        steps = int(control)
        first, last = self.scene.span
        h = float(Fraction(last - first) / steps)
        statistics = Statistics()
        try:
            state = self.runner.final(steps, statistics)
            error = distance(self.scene, state, self.exact.state)
            if not math.isfinite(error):
                raise RunFailed("the final state is not finite")
        except RunFailed as failure:
            return self._row(control, h, steps, failure=str(failure))
        times = self._net(samples(lambda: self.runner.final(steps)), lambda: self.runner.final(0))
        return self._row(control, h, steps, error, times, statistics)

    def _net(self, spent: Sequence[float], nothing: Callable[[], object]) -> list[float]:
        """Return times without what a call costs, the least seen of ``nothing``, where that counts."""
        if spent[0] >= COUNTED:
            return list(spent)
        self.idle = min(self.idle, cost(nothing))
        return [s - min(self.idle, s) for s in spent]

    def enough(self, rows: Sequence[Row]) -> bool:
        """Stop at the budget, and when two doublings in a row gain little near rounding."""
        last = rows[-1]
        if last.seconds is not None and 2 * last.seconds > self.budget:
            return True
        errors = [r.error for r in rows[-3:] if r.error is not None]
        size = max(1.0, math.hypot(*map(float, self.exact.state)))
        return len(errors) == 3 and errors[0] <= NEAR_ROUNDING * size and min(errors[1:]) > errors[0] / 3

    def _row(
        self,
        control: float,
        h: float,
        steps: int,
        error: float | None = None,
        times: Sequence[float] = (),
        statistics: Statistics | None = None,
        failure: str = "",
    ) -> Row:
        sweeps = statistics.sweeps if statistics is not None else []
        return Row(
            scene=self.scene.name,
            method=self.label,
            target=self.target,
            control=control,
            h=h,
            steps=steps,
            error=error,
            seconds=times[0] if times else None,
            spread=times[-1] / times[0] - 1 if times and times[0] else None,
            ns_per_step=1e9 * times[0] / steps if times else None,
            evaluations=None if failure else self._count(EVALUATIONS, steps, sweeps),
            exponentials=None if failure else self._count(EXPONENTIALS, steps, sweeps),
            iterations=None if failure else sum(sweeps),
            emission_seconds=self.emission_seconds,
            compile_seconds=self.compile_seconds,
            failure=failure,
        )

    def _count(self, names: frozenset[str], steps: int, sweeps: Sequence[int]) -> int:
        """Return how often operations are executed: once a step outside blocks, once a sweep inside."""
        total, block = 0, 0
        parts = steps * max(1, len(self.compiled.program.substeps))
        for statement in self.compiled.program.body:
            if isinstance(statement, Assign):
                total += parts * (statement.operation.name in names)
                continue
            inside = sum(a.operation.name in names for a in statement.body)
            total += inside * sweeps[block]
            block += 1
        return total


def _compile_seconds(files: Any) -> float:
    with tempfile.TemporaryDirectory() as folder:
        start = time.perf_counter()
        compile_files(
            files, Path(folder), Path(folder) / "out", (*FLAGS, "-fPIC", "-shared"), find_compiler()
        )
        return time.perf_counter() - start


@dataclass
class PeerContestant:
    """A peer on the scene's ambient equations."""

    scene: Problem
    peer: Peer
    exact: Reference
    budget: float = BUDGET
    target: str = "peer"

    def __post_init__(self) -> None:
        self.label = self.peer.name
        self.key = self.peer.version

    def controls(self) -> Iterator[float]:
        """Tighten the tolerance, or double the steps."""
        if self.peer.controlled == "tolerance":
            yield from TOLERANCES
            return
        n = 1
        while n <= MOST_STEPS:
            yield float(n)
            n *= 2

    def prepare(self) -> None:
        """Leave it to each run: a peer's code may depend on its tolerance."""

    def measure(self, control: float) -> Row:
        """Prepare, run and time."""
        start = time.perf_counter()
        try:
            prepared = self.peer.prepare(self.scene, control)
            setup = time.perf_counter() - start
            outcome = prepared.run()
            error = distance(self.scene, outcome.state, self.exact.state)
            if not math.isfinite(error):
                raise PeerFailed("the final state is not finite")
            spent = samples(prepared.run)
            counted = prepared.idle is not None and spent[0] < COUNTED
            idle = cost(prepared.idle) if counted and prepared.idle is not None else 0.0
            times = [s - min(idle, s) for s in spent]
        except PeerFailed as failure:
            setup = time.perf_counter() - start
            return Row(
                *(self.scene.name, self.label, self.target, control, None, None, None, None, None, None),
                *(None, None, None, 0.0, setup, str(failure)),
            )
        first, last = map(float, self.scene.span)
        return Row(
            self.scene.name,
            self.label,
            self.target,
            control,
            (last - first) / max(outcome.steps, 1),
            outcome.steps,
            error,
            times[0],
            times[-1] / times[0] - 1 if times[0] else None,
            1e9 * times[0] / max(outcome.steps, 1),
            outcome.evaluations,
            None,
            None,
            0.0,
            setup,
        )

    def enough(self, rows: Sequence[Row]) -> bool:
        """Stop at the budget, and for steps where rounding is met."""
        last = rows[-1]
        if last.seconds is not None and 2 * last.seconds > self.budget:
            return True
        if self.peer.controlled == "tolerance":
            return False
        errors = [r.error for r in rows[-3:] if r.error is not None]
        size = max(1.0, math.hypot(*map(float, self.exact.state)))
        return len(errors) == 3 and errors[0] <= NEAR_ROUNDING * size and min(errors[1:]) > errors[0] / 3
