"""The growth of rounding errors over many steps, with and without compensated summation.

In exact arithmetic, the method conserves a quantity. Because of rounding errors, the computed quantity
deviates from its initial value. If the rounding errors are independent, the deviation grows like the square
root of the number of steps (Brouwer 1937). If the rounding errors are biased, the deviation grows in
proportion to the number of steps.

Let d(n) be the root mean square deviation of several runs after n steps. A power n^p is fitted to d(n). The
confidence interval of the exponent comes from the jackknife method.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass

from codegen.emitter import Compiled, compensated, emit_compiled
from codegen.errors import MethodError
from codegen.integrator import Integrator, StepFailed
from codegen.ir.domain import NotConverged, PreciseDomain
from codegen.ir.expr import Expr
from codegen.lab.invariants import MANIFOLD, expressions, magnitudes
from codegen.lab.long_runs.drift import CONFIDENCE
from codegen.lab.long_runs.trajectory import scale
from codegen.lab.number_functions import of_scalars
from codegen.lab.number_types import Evaluate, Scalar, Vector
from codegen.lab.runner import Emitted
from codegen.lab.stability.extreme_steps import DIGITS, precise_step, solved_step
from codegen.lab.straight_line_field import straight_line
from codegen.loader import load
from codegen.lower import problem_for
from codegen.printers import DEFAULT

STARTS = 16
"""The number of runs. The runs have different initial states on one trajectory."""

APART = 37
"""APART steps lead from the initial state of one run to the initial state of the next run."""

TIMES = 9
"""The number of measurements in a run. The number of steps doubles from one measurement to the next."""

EXACT = 1e-30
"""A quantity counts as exactly conserved if its relative change in one step is less than EXACT."""


CHAIN = 3
"""The number of consecutive steps in :func:`changes_of_a_step`.

The function measures the largest change of a quantity. In a single step, the change may be zero by chance
although the method does not conserve the quantity.
"""

NEARLY = 1e-14
"""A bound for the relative change of a quantity in one step from a state with rounding errors.

Such a state is not exactly on the manifold. Therefore the bound is larger than :data:`EXACT`.
"""


@dataclass(frozen=True)
class Growth:
    """The growth of rounding errors in a conserved quantity.

    - ``quantity``: the name of the quantity.
    - ``compensated``: True if the steps use compensated summation.
    - ``steps``: the numbers of steps after which the deviation is measured.
    - ``sizes``: the root mean square of the relative deviations of all runs, for each entry of ``steps``.
    - ``exponent``: the exponent p of the power n^p fitted to ``sizes``, where n is the number of steps.
    - ``half_width``: the half width of the 95 % confidence interval of the exponent.
    """

    quantity: str
    compensated: bool
    steps: tuple[int, ...]
    sizes: tuple[float, ...]
    exponent: float
    half_width: float

    @property
    def law(self) -> str:
        """The name of the law of growth, derived from the confidence interval of ``exponent``.

        If the whole interval is below 1/4, the law is ``bounded``. Otherwise, an interval with a half width
        below 0.1 is first widened to the half width 0.1. Then the interval determines the law:

        - ``random walk``: the interval contains 1/2, but not 1.
        - ``systematic``: the interval contains 1, but not 1/2.
        - ``random walk or systematic``: the interval contains 1/2 and 1.
        - ``neither law``: the interval contains neither 1/2 nor 1.
        """
        if self.exponent + self.half_width < 0.25:
            return "bounded"
        laws = {"random walk": 0.5, "systematic": 1.0}
        held = [name for name, p in laws.items() if abs(self.exponent - p) <= max(self.half_width, 0.1)]
        return " or ".join(held) or "neither law"

    def as_json(self) -> dict[str, object]:
        """Return the growth as a dictionary of plain data for JSON."""
        return {
            "quantity": self.quantity,
            "compensated": self.compensated,
            "steps": list(self.steps),
            "rms": list(self.sizes),
            "exponent": self.exponent,
            "half_width": self.half_width,
            "law": self.law,
        }


def rounding_growth(compiled: Compiled, h: float, steps: int) -> tuple[Growth, ...]:
    """Measure how rounding errors grow in every exactly conserved quantity over ``steps`` steps.

    For each quantity, the result contains one item without compensated summation. If possible, the result
    also contains one item with compensated summation. If a run fails, the result is empty.
    """
    scene, plain = compiled.scene, Emitted(compiled)
    domain = PreciseDomain(0, DIGITS)
    first = float(scene.span[0])
    if not exactly_conserved(compiled, [(first, plain.initial)], h):
        return ()
    runs: list[tuple[bool, Integrator]] = [(False, plain.integrator)]
    with suppress(MethodError):
        runs.append((True, load(emit_compiled(compensated(compiled), DEFAULT))))
    counts = [steps >> k for k in reversed(range(TIMES)) if steps >> k]
    growths = []
    try:
        starts = _starts(runs[-1], plain.initial, first, h)
        kept = exactly_conserved(compiled, (starts[0], starts[-1]), h)
        scales = _Sizes(compiled, domain)
        for carried, integrator in runs:
            deviations = [
                _deviations(kept, scales, integrator, start, t, h, counts, domain, carried)
                for t, start in starts
            ]
            for name in kept:
                sizes = [[row[name] for row in member] for member in deviations]
                growths.append(_growth(name, carried, counts, sizes))
    except StepFailed:
        return ()
    return tuple(sorted(growths, key=lambda g: (list(kept).index(g.quantity), g.compensated)))


def _starts(
    run: tuple[bool, Integrator], initial: Sequence[float], t: float, h: float
) -> list[tuple[float, list[float]]]:
    """Return the initial values (time, state) of the measured runs. They lie on one trajectory.

    ``run`` is a pair (compensated, integrator).
    """
    carried, integrator = run
    size, starts = len(initial), []
    state = [*initial, *([0.0] * size if carried else [])]
    for k in range(STARTS):
        starts.append((t + k * APART * h, state[:size]))
        state = integrator.run(state, h, APART, t + k * APART * h)
    return starts


def exactly_conserved(
    compiled: Compiled, starts: Sequence[tuple[float, Sequence[float]]], h: float
) -> dict[str, Evaluate]:
    """Return functions that evaluate the exactly conserved quantities. The keys are the names of quantities.

    One step is made from each pair (time, state) in ``starts``. A quantity is in the result if its relative
    change is below a bound in every step. The bound is :data:`EXACT` for the first pair and :data:`NEARLY`
    for the other pairs. If a step cannot be computed, the result is empty.
    """
    domain = PreciseDomain(0, DIGITS)
    quantities = _quantities(compiled, domain, expressions(compiled.scene))
    sizes = _Sizes(compiled, domain)
    for k, (t, state) in enumerate(starts):
        numbers = [domain.context.mpf(x) for x in state]
        try:
            after = precise_step(compiled, numbers, t, h)
            for name, evaluate in list(quantities.items()):
                before = evaluate(numbers, t)
                end = domain.context.mpf(t) + domain.context.mpf(h)
                change = _distance(evaluate(after, end), before, sizes.size(name, before, numbers, t))
                if not change < (NEARLY if k else EXACT):
                    del quantities[name]
        except (NotConverged, ArithmeticError, ValueError):
            return {}
    return quantities


def changes_of_a_step(compiled: Compiled, runner: Emitted, h: float) -> dict[str, float]:
    """Return the largest change per step of each conserved quantity, for the first :data:`CHAIN` steps.

    If a step cannot be computed with 60 digits, the result is empty.
    """
    domain = PreciseDomain(0, DIGITS)
    problem = problem_for(compiled.scene, compiled.method)
    quantities = _quantities(compiled, domain, expressions(compiled.scene))
    number = domain.context.mpf
    state: Sequence[Scalar] = problem.initial(domain)
    t, changes = number(float(compiled.scene.span[0])), dict.fromkeys(quantities, 0.0)
    try:
        for _ in range(CHAIN):
            after = solved_step(compiled, runner, state, t, h)
            for name, evaluate in quantities.items():
                pairs = zip(evaluate(after, t + h), evaluate(state, t), strict=True)
                changes[name] = max(changes[name], float(max(abs(a - b) for a, b in pairs)))
            state, t = after, t + h
    except (NotConverged, ArithmeticError, ValueError):
        return {}
    return changes


def _quantities(
    compiled: Compiled, domain: PreciseDomain, kept: dict[str, tuple[Expr, ...]]
) -> dict[str, Evaluate]:
    """Return functions that evaluate the quantities of ``kept`` in the arithmetic ``domain``."""
    functions = of_scalars(domain.context)
    scene = compiled.scene
    return {
        name: straight_line(scene.name, scene.symbols, exprs).python(domain.number, functions)
        for name, exprs in kept.items()
    }


def _distance(values: Vector, before: Vector, scale: Scalar) -> float:
    """Return the largest absolute value of a component of ``values`` - ``before``, divided by ``scale``."""
    return float(max(abs(a - b) for a, b in zip(values, before, strict=True)) / scale)


class _Sizes:
    """Computes the sizes of conserved quantities (:func:`scale`). Deviations are divided by these sizes."""

    def __init__(self, compiled: Compiled, domain: PreciseDomain) -> None:
        self.magnitudes = _quantities(compiled, domain, magnitudes(compiled.scene))

    def size(self, name: str, value: Vector, state: Sequence[Scalar], t: float) -> Scalar:
        """Return the size of the quantity ``name``, whose value is ``value``.

        For the residual of the manifold equations, the size is defined as 1.
        """
        if name == MANIFOLD:
            return 1
        (magnitude,) = self.magnitudes[name](state, t)
        return scale(value[0], magnitude)


def _deviations(
    kept: dict[str, Evaluate],
    sizes: _Sizes,
    integrator: Integrator,
    start: list[float],
    t: float,
    h: float,
    counts: Sequence[int],
    domain: PreciseDomain,
    carried: bool,
) -> list[dict[str, float]]:
    """Return the relative change of every quantity since the start, for each number of steps in ``counts``.

    If ``carried`` is True, the state of the integrator contains the coordinates and the accumulated rounding
    errors.
    """
    number, size = domain.context.mpf, len(start)

    def values(state: Sequence[float], count: int) -> dict[str, Vector]:
        carries = state[size:] if carried else [0.0] * size
        exact = [number(x) + number(c) for x, c in zip(state[:size], carries, strict=True)]
        # The time is an argument, because a conserved quantity may depend on it.
        time = number(t) + count * number(h)
        return {name: evaluate(exact, time) for name, evaluate in kept.items()}

    state, done, rows = [*start, *([0.0] * size if carried else [])], 0, []
    before = values(state, 0)
    numbers = [number(x) for x in start]
    scales = {name: sizes.size(name, x, numbers, t) for name, x in before.items()}
    for count in counts:
        state = integrator.run(state, h, count - done, t + done * h)
        done = count
        now = values(state, count)
        rows.append({name: _distance(x, before[name], scales[name]) for name, x in now.items()})
    return rows


def _growth(name: str, carried: bool, counts: Sequence[int], members: Sequence[Sequence[float]]) -> Growth:
    """Return the growth of the deviations of the quantity ``name``.

    Each list in ``members`` belongs to one run, and contains one deviation for each number of steps in
    ``counts``.
    """
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
    """Return the slope of log(size) against log(count), fitted to the positive sizes by least squares."""
    pairs = [(math.log(n), math.log(x)) for n, x in zip(counts, sizes, strict=True) if x > 0]
    if len(pairs) < 2:
        return 0.0
    x, y = (sum(values) / len(pairs) for values in zip(*pairs, strict=True))
    slope: float = sum((a - x) * (b - y) for a, b in pairs) / sum((a - x) ** 2 for a, _ in pairs)
    return slope
