"""How rounding grows over many steps, with and without compensation, against the square-root law.

Looked at is what a method keeps exactly but for rounding: the laws of the manifold, and those invariants
that one step in 60 digits does not move. Independent roundings make such a quantity walk at random, with
deviations like the square root of the number of steps (Brouwer 1937); roundings that favour one side make it
drift, like the number itself: a body that spins by the same angle in every step makes the same error in every
step, which no carry mends. Deviations are found exactly, in 60 digits, for several starts along one
trajectory. The exponent is that of their root mean square; its interval comes from leaving out one start
after the other.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

from codegen.emitter import Compiled, emit_compiled
from codegen.errors import MethodError
from codegen.ir.domain import NotConverged, PreciseDomain
from codegen.lab.compensated import compensated
from codegen.lab.drift import CONFIDENCE
from codegen.lab.invariants import MANIFOLD, expressions
from codegen.lab.runner import Emitted
from codegen.lab.stability.extremes import DIGITS, precise_step
from codegen.lab.straight_line_field import straight_line
from codegen.loader import Integrator, StepFailed, load

STARTS = 16
APART = 37
"""Steps from one start to the next."""

RUNGS = 9
"""Deviations are looked at after so many numbers of steps, each twice the one before."""

EXACT = 1e-30
"""Relative change by one step in 60 digits below which a quantity is kept exactly."""

Values = tuple[Any, ...]


@dataclass(frozen=True)
class Growth:
    """The root mean square of the deviation of a kept quantity after numbers of steps, and its exponent.

    ``half_width`` is that of the exponent's interval at 95 %. Deviations are relative, as in a long run.
    """

    quantity: str
    compensated: bool
    steps: tuple[int, ...]
    sizes: tuple[float, ...]
    exponent: float
    half_width: float

    @property
    def law(self) -> str:
        """The growth in words: the laws that the interval does not rule out."""
        if self.exponent + self.half_width < 0.25:
            return "bounded"
        laws = {"random walk": 0.5, "systematic": 1.0}
        held = [name for name, p in laws.items() if abs(self.exponent - p) <= max(self.half_width, 0.1)]
        return " or ".join(held) or "neither law"

    def as_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {
            "quantity": self.quantity,
            "compensated": self.compensated,
            "steps": list(self.steps),
            "rms": list(self.sizes),
            "exponent": self.exponent,
            "half_width": self.half_width,
            "law": self.law,
        }


def roundoff(compiled: Compiled, h: float, steps: int) -> tuple[Growth, ...]:
    """Return the growth of rounding in every quantity that a method keeps exactly, plain and compensated.

    Where a step has no compensated form there is the plain one alone; where a run fails there is none.
    """
    scene, plain = compiled.scene, Emitted(compiled, "c")
    domain = PreciseDomain(0, DIGITS)
    first = float(scene.span[0])
    kept = _kept_exactly(compiled, plain.initial, first, h, domain)
    if not kept:
        return ()
    runs: list[tuple[bool, Integrator]] = [(False, plain.integrator)]
    with suppress(MethodError):
        runs.append((True, load(emit_compiled(compensated(compiled), "c"))))
    counts = [steps >> k for k in reversed(range(RUNGS)) if steps >> k]
    found = []
    try:
        starts = _starts(runs[-1], plain.initial, first, h)
        for carried, integrator in runs:
            deviations = [
                _deviations(kept, integrator, start, t, h, counts, domain, carried) for t, start in starts
            ]
            for name in kept:
                sizes = [[row[name] for row in member] for member in deviations]
                found.append(_growth(name, carried, counts, sizes))
    except StepFailed:
        return ()
    return tuple(sorted(found, key=lambda g: (list(kept).index(g.quantity), g.compensated)))


def _starts(
    run: tuple[bool, Integrator], initial: Sequence[float], t: float, h: float
) -> list[tuple[float, list[float]]]:
    """Return times and states along a trajectory, of the compensated step where there is one.

    What a start is off the manifold is turned about with it, and must not be taken for what rounding did.
    """
    carried, integrator = run
    size, found = len(initial), []
    state = [*initial, *([0.0] * size if carried else [])]
    for k in range(STARTS):
        found.append((t + k * APART * h, state[:size]))
        state = integrator.run(state, h, APART, t + k * APART * h)
    return found


def _kept_exactly(
    compiled: Compiled, state: Sequence[float], t: float, h: float, domain: PreciseDomain
) -> dict[str, Callable[..., Values]]:
    """Return the quantities, as functions over 60 digits, that one exact step does not move."""
    functions = {name: getattr(domain.context, name) for name in ("sqrt", "sin", "cos", "exp", "log")}
    quantities = {
        name: straight_line(compiled.scene, exprs).python(domain.number, functions)
        for name, exprs in expressions(compiled.scene).items()
    }
    numbers = [domain.context.mpf(x) for x in state]
    try:
        after = precise_step(compiled, numbers, t, h)
    except (NotConverged, ArithmeticError, ValueError):
        return {}
    return {
        name: evaluate
        for name, evaluate in quantities.items()
        if _distance(name, evaluate(after, t + h), evaluate(numbers, t)) < EXACT
    }


def _distance(name: str, values: Values, before: Values) -> float:
    """Return the largest change, of an invariant relative to its size where that is not zero."""
    scale = 1 if name == MANIFOLD else max(abs(x) for x in before) or 1
    return float(max(abs(a - b) for a, b in zip(values, before, strict=True)) / scale)


def _deviations(
    kept: dict[str, Callable[..., Values]],
    integrator: Integrator,
    start: list[float],
    t: float,
    h: float,
    counts: Sequence[int],
    domain: PreciseDomain,
    carried: bool,
) -> list[dict[str, float]]:
    """Return the deviation of every quantity after each number of steps."""
    number, size = domain.context.mpf, len(start)

    def values(state: Sequence[float]) -> dict[str, Values]:
        carries = state[size:] if carried else [0.0] * size
        exact = [number(x) + number(c) for x, c in zip(state[:size], carries, strict=True)]
        return {name: evaluate(exact, t) for name, evaluate in kept.items()}

    state, done, rows = [*start, *([0.0] * size if carried else [])], 0, []
    before = values(state)
    for count in counts:
        state = integrator.run(state, h, count - done, t + done * h)
        done = count
        rows.append({name: _distance(name, x, before[name]) for name, x in values(state).items()})
    return rows


def _growth(name: str, carried: bool, counts: Sequence[int], members: Sequence[Sequence[float]]) -> Growth:
    """Return the growth of the root mean square over members, with the jackknife's interval."""
    import scipy.stats

    sizes = _rms(members)
    exponent = _slope(counts, sizes)
    n = len(members)
    left = [_slope(counts, _rms([m for j, m in enumerate(members) if j != k])) for k in range(n)]
    mean = sum(left) / n
    error = math.sqrt((n - 1) / n * sum((x - mean) ** 2 for x in left))
    half = float(scipy.stats.t.ppf((1 + CONFIDENCE) / 2, n - 1)) * error
    return Growth(name, carried, tuple(counts), tuple(sizes), exponent, half)


def _rms(members: Sequence[Sequence[float]]) -> list[float]:
    return [math.sqrt(sum(x * x for x in column) / len(members)) for column in zip(*members, strict=True)]


def _slope(counts: Sequence[int], sizes: Sequence[float]) -> float:
    """Return the least-squares slope of log size against log count, zeros left out."""
    pairs = [(math.log(n), math.log(x)) for n, x in zip(counts, sizes, strict=True) if x > 0]
    if len(pairs) < 2:
        return 0.0
    x, y = (sum(values) / len(pairs) for values in zip(*pairs, strict=True))
    slope: float = sum((a - x) * (b - y) for a, b in pairs) / sum((a - x) ** 2 for a, _ in pairs)
    return slope
