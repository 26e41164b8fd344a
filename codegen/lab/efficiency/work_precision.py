"""Work-precision diagrams: error against CPU time, over a sequence of step sizes or tolerances.

A :class:`Candidate` is an emitted method or another integrator (a peer). Each run produces one :class:`Row`
with its CPU time and the error at the end of the span, in the norm of the scene. The row of a failed run
contains the reason.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import asdict, dataclass
from itertools import pairwise
from typing import Protocol

from codegen.lab.measurement_cache import MeasurementCache
from codegen.lab.reference import Reference
from orderconds.errors import InputError

BUDGET = 1.0
"""The default limit of the CPU time of one run, in seconds."""

MOST_STEPS = 5 * 2**21

AGAIN = 3
"""If a run takes longer than a run with more steps, both are measured again, at most AGAIN times."""

NEAR_ROUNDING = 1e-9
"""Rounding errors may prevent further convergence if the error is below NEAR_ROUNDING, relative to the size
of the state.
"""


@dataclass(frozen=True)
class Row:
    """One run. ``control`` is the requested tolerance or number of steps, and ``h`` is the mean step size.

    ``form`` is the name of the form of the equations, or '' if the scene has one form only. ``seconds`` is
    the least CPU time of several batches. Three quarters of the batches take at most (1 + ``spread``) times
    ``seconds``. ``evaluations``, ``exponentials`` and ``iterations`` are totals of the run, or None if they
    were not counted. ``failure`` is the reason if the run failed, otherwise ''.
    """

    scene: str
    method: str
    target: str
    control: float
    h: float | None = None
    steps: int | None = None
    error: float | None = None
    seconds: float | None = None
    spread: float | None = None
    ns_per_step: float | None = None
    evaluations: int | None = None
    exponentials: int | None = None
    iterations: int | None = None
    emit_seconds: float = 0.0
    compile_seconds: float = 0.0
    failure: str = ""
    form: str = ""

    def as_json(self) -> dict[str, str | float | int | None]:
        """Return the row as a dictionary of plain data, which can be written as JSON."""
        return asdict(self)


class Candidate(Protocol):
    """A method or peer to measure.

    ``label`` and ``target`` identify the candidate in tables. ``key`` identifies its code in the cache.
    ``form`` is the name of the form of the equations, or '' if the scene has one form only.
    """

    label: str
    target: str
    key: str
    form: str

    def controls(self) -> Iterator[float]:
        """Yield numbers of steps or tolerances, from coarse to fine."""

    def prepare(self) -> None:
        """Prepare the first run. Raise InputError if the candidate cannot run on the scene."""

    def measure(self, control: float) -> Row:
        """Measure the error in one run and the CPU time in several runs, and return the row."""

    def enough(self, rows: Sequence[Row]) -> bool:
        """Return True if no run with more steps or a smaller tolerance is needed after ``rows``."""


def measure_rows(
    candidate: Candidate,
    scene: str,
    exact: Reference,
    cache: MeasurementCache,
    done: Callable[[Row], object],
) -> tuple[Row, ...]:
    """Return the rows of a candidate. ``done`` is called with each row.

    Rows in ``cache`` are not measured again. If the candidate cannot be prepared, the last row contains the
    reason.
    """
    rows: list[Row] = []
    ready = False
    fresh: set[float] = set()
    for control in candidate.controls():
        key = ("bench", candidate.label, candidate.target, candidate.key, control, exact.digits())
        row = cache.find(key, Row)
        if row is None:
            try:
                if not ready:
                    candidate.prepare()
            except (InputError, ArithmeticError) as error:
                names = (scene, candidate.label, candidate.target)
                row = Row(*names, control, failure=str(error), form=candidate.form)
                return (*rows, row)
            ready = True
            row = candidate.measure(control)
            fresh.add(control)
            cache.store(key, row)
        rows.append(row)
        done(row)
        if candidate.enough(rows):
            break
    if fresh:
        rows = monotone(rows, candidate.measure, fresh)
        for row in rows:
            key = ("bench", candidate.label, candidate.target, candidate.key, row.control, exact.digits())
            cache.store(key, row)
    return tuple(rows)


def monotone(rows: Sequence[Row], measure: Callable[[float], Row], fresh: Collection[float]) -> list[Row]:
    """Measure two consecutive runs again if the run with fewer steps took longer. Return all rows.

    Measurements are repeated at most :data:`AGAIN` times, and the least times are used. ``fresh`` contains
    the controls (tolerances or numbers of steps) of the runs that may be measured again.
    """
    kept = list(rows)
    for _ in range(AGAIN):
        wrong = [k for k, (a, b) in enumerate(pairwise(kept)) if _inverted(a, b)]
        for k in sorted({*wrong, *(i + 1 for i in wrong)}):
            if kept[k].control not in fresh:
                continue
            again, old = measure(kept[k].control), kept[k].seconds
            if again.seconds is not None and old is not None and again.seconds < old:
                kept[k] = again
        if not wrong:
            break
    return kept


def _inverted(a: Row, b: Row) -> bool:
    """Return True if the first row has fewer steps than the second row but took longer."""
    if None in (a.seconds, b.seconds, a.steps, b.steps):
        return False
    return (a.steps or 0) < (b.steps or 0) and (a.seconds or 0.0) > (b.seconds or 0.0)


@dataclass
class Refused:
    """A method that cannot be emitted for the scene. Its only row contains the reason."""

    label: str
    target: str
    reason: str
    key: str = ""
    form: str = ""

    def controls(self) -> Iterator[float]:
        """Yield a single number, so that the candidate has one row, which contains the reason."""
        yield 0.0

    def prepare(self) -> None:
        """Raise InputError with the reason."""
        raise InputError(self.reason)

    def measure(self, control: float) -> Row:
        """Raise InputError with the reason."""
        raise InputError(self.reason)

    def enough(self, rows: Sequence[Row]) -> bool:
        """Return True, because no run is possible."""
        return True


def doubled_steps() -> Iterator[float]:
    """Yield the numbers of steps 1, 2, 4, ..., at most MOST_STEPS."""
    n = 1
    while n <= MOST_STEPS:
        yield float(n)
        n *= 2


def beyond_budget(rows: Sequence[Row], budget: float) -> bool:
    """Return True if the next run would take longer than ``budget`` CPU seconds.

    The next run is expected to take twice as long as the last run.
    """
    last = rows[-1]
    return last.seconds is not None and 2 * last.seconds > budget


def at_rounding(rows: Sequence[Row], exact: Reference) -> bool:
    """Return True if rounding errors probably prevent further convergence.

    Let e be the error of the run before the last two runs. The result is True if e is at most
    :data:`NEAR_ROUNDING` times the size of the state, and the last two errors are above e/3.
    """
    errors = [r.error for r in rows[-3:] if r.error is not None]
    size = max(1.0, math.hypot(*map(float, exact.state)))
    return len(errors) == 3 and errors[0] <= NEAR_ROUNDING * size and min(errors[1:]) > errors[0] / 3
