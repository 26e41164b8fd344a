"""Measures the points of work-precision diagrams.

A :class:`Candidate` is an emitted method or another integrator (a peer). Each candidate is run with several
step sizes or tolerances. The error is measured at the end of the time span in the norm of the scene.
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
"""The maximum number of repetitions of a measurement.

The runs of an integrator are sorted from coarse to fine. Two neighbouring runs are measured again if the run
with fewer steps took more CPU time.
"""

NEAR_ROUNDING = 1e-9
"""Only errors up to NEAR_ROUNDING times the size of the state are attributed to rounding."""


@dataclass(frozen=True)
class Row:
    """The measured data of an integrator for one value of ``control``.

    - ``control``: the requested tolerance or number of steps.
    - ``h``: the mean step size.
    - ``seconds``: the CPU time of a run. Each batch of runs gives a mean CPU time, and ``seconds`` is the
      least of these means.
    - ``spread``: q/``seconds`` - 1, where q is the upper quartile of the mean CPU times of all batches.
    - ``evaluations``, ``exponentials``, ``iterations``: the numbers of field evaluations, group exponentials
      and iterations for implicit equations in the run, or None if they were not counted.
    - ``emit_seconds``, ``compile_seconds``: the times to emit and to compile the code.
    - ``failure``: the reason why the run failed, or '' for a successful run.
    - ``form``: the name of the form of the equations, or '' if the scene has only one form.
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
        """Return the row as a dictionary that can be written as JSON."""
        return asdict(self)


class Candidate(Protocol):
    """The interface of a measured integrator: a method, or a peer (another integrator).

    ``target`` is the programming language of a method, or 'peer'. ``key`` identifies the code of the
    candidate in the cache. ``form`` is the name of the form of the equations, or '' if the scene has only one
    form.
    """

    label: str
    target: str
    key: str
    form: str

    def controls(self) -> Iterator[float]:
        """Yield the numbers of steps or the tolerances of the runs, from coarse to fine."""

    def prepare(self) -> None:
        """Prepare the candidate before its first run. Raise InputError if it cannot run on the scene."""

    def measure(self, control: float) -> Row:
        """Measure the error in one run and the CPU time in several runs, and return both as a row.

        ``control`` is the number of steps or the tolerance.
        """

    def enough(self, rows: Sequence[Row]) -> bool:
        """Return True if no further run is needed.

        ``rows`` contains the results of all runs up to now.
        """


def measure_rows(
    candidate: Candidate,
    scene: str,
    exact: Reference,
    cache: MeasurementCache,
    done: Callable[[Row], object],
) -> tuple[Row, ...]:
    """Make the runs of a candidate, and return one row for each run.

    ``done`` is called with the row of each run. Before the first run that is not in the cache,
    ``candidate.prepare()`` is called. If this call fails, no further run is made, and the last row of the
    result contains the error message.
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
    """Repeat measurements with implausible times, and return the rows with the least times.

    Two consecutive runs have implausible times if the run with fewer steps took longer. ``fresh`` contains
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
    """Return True if the run ``a`` has fewer steps than the run ``b`` and nevertheless took longer."""
    if None in (a.seconds, b.seconds, a.steps, b.steps):
        return False
    return (a.steps or 0) < (b.steps or 0) and (a.seconds or 0.0) > (b.seconds or 0.0)


@dataclass
class Refused:
    """A method that cannot be emitted for the scene. ``reason`` says why."""

    label: str
    target: str
    reason: str
    key: str = ""
    form: str = ""

    def controls(self) -> Iterator[float]:
        """Yield one placeholder, 0, because there is no emitted code to run."""
        yield 0.0

    def prepare(self) -> None:
        """Always raise InputError. The message is the reason why the method cannot be emitted."""
        raise InputError(self.reason)

    def measure(self, control: float) -> Row:
        """Always raise InputError, because there is no emitted code that could be measured."""
        raise InputError(self.reason)

    def enough(self, rows: Sequence[Row]) -> bool:
        """Return True: no run is needed, because this object represents a method that cannot be emitted."""
        return True


def doubled_steps() -> Iterator[float]:
    """Yield the number of steps of each run: 1, 2, 4, and so on, at most MOST_STEPS."""
    n = 1
    while n <= MOST_STEPS:
        yield float(n)
        n *= 2


def beyond_budget(rows: Sequence[Row], budget: float) -> bool:
    """Return True if the next run would take longer than ``budget`` seconds of CPU time.

    The next run is expected to take twice as long as the last run in ``rows``.
    """
    last = rows[-1]
    return last.seconds is not None and 2 * last.seconds > budget


def at_rounding(rows: Sequence[Row], exact: Reference) -> bool:
    """Return True if rounding errors probably prevent further convergence.

    Let e1, e2 and e3 be the last three errors in ``rows``, where e3 is the last. The result is True if e1 is
    at most :data:`NEAR_ROUNDING` times the size of the state, and if both e2 and e3 are larger than e1/3.
    """
    errors = [r.error for r in rows[-3:] if r.error is not None]
    size = max(1.0, math.hypot(*map(float, exact.state)))
    return len(errors) == 3 and errors[0] <= NEAR_ROUNDING * size and min(errors[1:]) > errors[0] / 3
