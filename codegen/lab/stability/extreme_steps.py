"""Single steps with extreme input: the result of emitted code is compared with an exact result.

The exact result is the step made by the interpreter (:mod:`codegen.ir.interpret`) with at least 60 digits.
The interpreter also makes several steps with simulated rounding errors of double precision. These steps are
called *probes*. The differences between the probes and the exact result show how much rounding can change the
result.

There are three verdicts:

- *wrong*: the result is not finite, or the error of the result is too large to be caused by rounding.
- *accurate*: rounding can cause the error, and at least :data:`LEAST` digits are correct.
- *undetermined*: rounding can cause the error, and fewer digits are correct.

Correct digits are counted separately for each component (for example a group element) of the state. Implicit
equations can have several solutions. The interpreter therefore starts Newton's method at the solution found
by the emitted code.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import accumulate
from typing import TYPE_CHECKING

from flint import arb

from codegen.emitter import Compiled, Optimised
from codegen.groups import Rotation
from codegen.integrator import StepFailed
from codegen.ir.ball_domain import BallDomain
from codegen.ir.domain import FloatDomain, NotConverged, Value
from codegen.ir.interpret import flatten, interpret
from codegen.ir.values import Kind
from codegen.lab.number_types import Scalar, Vector
from codegen.lab.runner import Emitted, split_state
from codegen.lower import problem_for
from codegen.printers import target

if TYPE_CHECKING:
    import mpmath

DIGITS = 60
EPSILON = 2.0**-53
TINY = 2.0**-1022
"""The smallest normal double. A result whose absolute value is less than TINY counts as zero."""

ROUNDINGS = 256.0
"""A factor in the largest permitted error of a step.

Emitted code makes the step. The step is repeated with simulated rounding errors. Each component of the state
(for example a group element) is tested separately. Let d be the largest error of a coordinate of the
component in all repetitions. Let s be the largest absolute value of a coordinate of the component before or
after the exact step. The result of the emitted code counts as wrong if the error of a coordinate of the
component exceeds ROUNDINGS * (d + EPSILON * s + TINY).
"""

LEAST = 3
"""If fewer than LEAST digits of a result are correct, the result is not accurate."""

PROBES = 4

SWEEPS, CORRECTIONS = 60, 30
"""The interpreter solves a system of implicit equations with at most SWEEPS fixed-point iterations, or with
at most CORRECTIONS Newton iterations.
"""

PATIENCE = 100
"""The largest number of fixed-point iterations in :func:`solved_step` before Newton's method is used."""

ACCURATE, WRONG = "accurate", "WRONG"
SILENT = f"undetermined: rounding leaves fewer than {LEAST} correct digits"
UNSOLVED = f"{WRONG}: the interpreter found no solution of the implicit equations"

ANGLES = (1e-300, 1e-8, math.pi - 1e-9, math.pi, 2 * math.pi, 100.0, 1e3, 1e4, 1e5, 1e6, 1e8, 1e300)
STEPS = (1e-300, 1e-12, 1e-8, 1e-4)
SCALES = (0.0, 5e-324, 1e-160, 1e-75, 1e75, 1e150, 1e308)


@dataclass(frozen=True)
class Case:
    """The input of one step: the state, the time ``t`` and the step size ``h``.

    ``name`` describes the extreme input, for example "h = 0" or "angle pi".
    """

    name: str
    state: tuple[float, ...]
    t: float
    h: float


@dataclass(frozen=True)
class Answer:
    """The verdict on the result of a step with extreme input.

    ``verdict`` is ``accurate``, or a text that begins with ``status``, ``undetermined`` or ``WRONG``.
    ``error`` is the largest relative error of a component (for example a momentum) of the state.
    ``determined`` is the approximate number of decimal digits that can be correct in double precision.
    If the result is not compared with an exact result, ``error`` and ``determined`` are None.
    """

    case: Case
    verdict: str
    error: float | None = None
    determined: float | None = None

    def as_json(self) -> dict[str, object]:
        """Return plain data, which can be written as JSON. Infinite numbers become None."""
        digits = self.determined
        return {
            "case": self.case.name,
            "h": self.case.h if math.isfinite(self.case.h) else None,
            "verdict": self.verdict,
            "error": self.error,
            "digits_determined": None if digits is None or math.isinf(digits) else digits,
        }


def cases(compiled: Compiled) -> Iterator[Case]:
    """Yield the inputs of the steps to test.

    The first input is the initial state of the scene, with a step size of one hundredth of the time span. In
    each further input, the step size or a component of the state has an unusual value, such as zero or NaN.
    """
    scene = compiled.scene
    state = tuple(float(x) for x in scene.initial(FloatDomain(0.0)))
    t, h = float(scene.span[0]), float((scene.span[1] - scene.span[0]) / 100)
    usual = Case("usual step", state, t, h)
    yield usual
    yield replace(usual, name="h = 0", h=0.0)
    yield replace(usual, name="backward", h=-h)
    for size in STEPS:
        yield replace(usual, name=f"h = {size:g}", h=size)
    speed = _speed(compiled, state, t)
    for angle in ANGLES if 0.0 < speed < math.inf else ():
        name = {math.pi: "pi", 2 * math.pi: "2 pi", math.pi - 1e-9: "pi - 1e-9"}.get(angle, f"{angle:g}")
        yield replace(usual, name=f"angle {name}", h=angle / speed)
    for scale in SCALES:
        scaled = _scaled(compiled, state, scale)
        if scaled is not None:
            yield replace(usual, name=f"momentum times {scale:g}", state=scaled)
    for bad in (math.nan, math.inf, -math.inf):
        yield replace(usual, name=f"h = {bad}", h=bad)
        for i in dict.fromkeys(_firsts(compiled)):
            spoilt = tuple(bad if k == i else x for k, x in enumerate(state))
            yield replace(usual, name=f"{scene.symbols[i]} = {bad}", state=spoilt)


def _firsts(compiled: Compiled) -> list[int]:
    """Return the indices of some entries of the state vector.

    The result contains the index of the first entry of each component of the state. The last element of the
    result is the index of the last entry of the state vector.
    """
    places, start = [], 0
    for block in compiled.scene.state:
        places.append(start)
        start += len(block.symbols)
    return [*places, start - 1]


def _scaled(compiled: Compiled, state: tuple[float, ...], scale: float) -> tuple[float, ...] | None:
    """Return a copy of ``state`` in which some components (for example momenta) are multiplied by ``scale``.

    If no component is multiplied or a number overflows, the result is None.
    """
    scene, result, start, any_scaled = compiled.scene, list(state), 0, False
    for block in scene.state:
        free = block.kind is Kind.DUAL or scene.group.abelian
        free |= block.kind is Kind.POINT and isinstance(scene.action, Rotation)
        for i in range(start, start + len(block.symbols)):
            if free:
                result[i] = 0.0 if scale == 0.0 else result[i] * scale
                any_scaled = True
        start += len(block.symbols)
    return tuple(result) if any_scaled and all(map(math.isfinite, result)) else None


def _speed(compiled: Compiled, state: Sequence[float], t: float) -> float:
    """Return the norm of the field f(state, t). The field is an element of the Lie algebra."""
    field = compiled.scene.as_field()
    domain = FloatDomain(0.0)
    (value,) = field.apply(domain, "field", None, (tuple(state), t))
    return math.hypot(*value[: compiled.scene.group.dim])


def answer(compiled: Compiled, runner: Emitted, case: Case) -> Answer:
    """Make one step with emitted code, and return the verdict on its result."""
    try:
        answered = runner.integrator.run(list(case.state), case.h, 1, case.t)
    except StepFailed as failure:
        return Answer(case, f"status: {failure.reason}")
    if not (math.isfinite(case.h) and all(map(math.isfinite, case.state))):
        return Answer(case, f"{WRONG}: the emitted code returned a result for input that is not finite")
    if not all(map(math.isfinite, answered)):
        return Answer(case, f"{WRONG}: the emitted code returned a result that is not finite")
    try:
        exact, probed = _exact(compiled, runner, case)
    except (NotConverged, ArithmeticError, ValueError):
        return Answer(
            case,
            UNSOLVED
            if compiled.kernel.loops
            else f"{WRONG}: the emitted code returned a result, but the same step with many digits failed",
        )
    error, determined, explained = 0.0, math.inf, True
    for block in _blocks(compiled):
        scale = max(max(abs(exact[i]), abs(case.state[i])) for i in block)
        gap = max(abs(answered[i] - exact[i]) for i in block)
        moves = max((abs(m[i] - exact[i]) for m in probed for i in block), default=0)
        explained &= bool(gap <= ROUNDINGS * (moves + EPSILON * scale + TINY))
        if scale > TINY:
            error = max(error, float(max(gap - ROUNDINGS * TINY, 0) / scale))
            determined = min(determined, -math.log10(max(float((moves + EPSILON * scale) / scale), 1e-17)))
    verdict = WRONG if not explained else ACCURATE if error <= 10.0**-LEAST else SILENT
    return Answer(case, verdict, error, max(determined, 0.0))


def _blocks(compiled: Compiled) -> list[range]:
    result, start = [], 0
    for block in compiled.scene.state:
        result.append(range(start, start + len(block.symbols)))
        start += len(block.symbols)
    return result


def _probe(case: Case, number: int) -> tuple[Vector, Scalar, Scalar]:
    """Change the state, the time and the step size of a case by rounding errors, and return the new values.

    The relative error of each value is plus or minus :data:`EPSILON`. The signs are random, with the seed
    ``number``.
    """
    draw, context = random.Random(number), mpmath_context(DIGITS)

    def rounded(x: float) -> Scalar:
        return context.mpf(x) * (1 + draw.choice((-1, 1)) * context.mpf(EPSILON))

    return tuple(rounded(x) for x in case.state), rounded(case.t), rounded(case.h)


def _digits(case: Case) -> int:
    """Return the number of digits of the exact step and of the probes, at least 60.

    Long steps and large coordinates need more digits, because long steps cause cancellation, and because the
    sine of a large number depends on all digits of this number. Small coordinates need more digits, because
    iterations for implicit equations stop at an absolute change of about 10^-digits.
    """
    sizes = [abs(x) for x in case.state if x]
    large = math.log10(max(1.0, abs(case.h), *sizes))
    small = -math.log10(min(1.0, *sizes)) if sizes else 0.0
    return DIGITS + 3 * math.ceil(large) + math.ceil(small)


def _exact(compiled: Compiled, runner: Emitted, case: Case) -> tuple[list[Scalar], list[list[Scalar]]]:
    """Make the step of a case once with at least 60 digits, and several times with simulated rounding errors.

    Return the state after the first of these steps, and a list of the states after the other steps. The first
    state counts as exact. The steps with simulated rounding errors are called probes. The number
    of digits of all steps is :func:`_digits`.
    """
    given, near, digits = (case.state, case.t, case.h), None, _digits(case)
    try:
        exact = precise_step(compiled, *given, limit=SWEEPS, newton=False, digits=digits)
    except (NotConverged, ArithmeticError, ValueError):
        near = solutions(runner, *given)
        exact = precise_step(compiled, *given, near, limit=CORRECTIONS, digits=digits)
    if near is None and compiled.kernel.loops:
        near = solutions(runner, *given)
    probes = [
        precise_step(
            compiled,
            *_probe(case, number),
            near and list(near),
            limit=CORRECTIONS,
            probe=number,
            digits=digits,
        )
        for number in range(1, PROBES + 1)
    ]
    return exact, probes


def solutions(runner: Emitted, state: Sequence[float], t: float, h: float) -> list[list[float]] | None:
    """Make one step with emitted code, and return the solutions of its implicit equations.

    The result contains a list of numbers for each system of equations. The result is None if the step fails
    or has no implicit equations.
    """
    widths = [len(loop.unknowns) for loop in runner.compiled.kernel.loops]
    if not widths:
        return None
    observed = runner.observed
    try:
        solved = target(observed.target).solutions(observed.integrator, state, t, h)
    except StepFailed:
        return None
    ends = list(accumulate(widths))
    return [x[end - n : end] for x in solved for n, end in zip(widths, ends, strict=True)]


class Rounding(BallDomain):
    """Arithmetic that simulates the rounding errors of double precision.

    Each operation is computed with many digits. After this, one rounding error of double precision is added
    to the result. The errors are relative, and the signs of the errors are random. If an iteration for
    implicit equations repeats an operation, the error has the same sign as before, because the equations must
    not change from iteration to iteration.

    Let g_1, ..., g_n be the right-hand sides of a system of implicit equations. Each g_i gets two errors: the
    first error is proportional to g_i, and the second error is proportional to g_(i+1). For i = n, the second
    error is proportional to g_1. Because of the second error, even a g_i that is zero can get an error.
    """

    def __init__(self, h: Scalar, digits: int, probe: int) -> None:
        super().__init__(h, digits)
        self.probe = probe
        self.signs: dict[str, list[int]] = {}
        with self.precision():
            self.unit = arb(EPSILON)

    def computed(self, name: str, value: Value) -> Value:
        """Add one simulated rounding error to each component of ``value``, and return the new value.

        ``value`` is the result of an operation, and ``name`` is the variable of this result. Results with the
        same name get errors with the same signs.
        """
        size = len(value) if isinstance(value, tuple) else 1
        if name not in self.signs:
            draw = random.Random(f"{self.probe} {name}")
            self.signs[name] = [draw.choice((-1, 1)) for _ in range(size)]
        if not isinstance(value, tuple):
            return (value * (1 + self.signs[name][0] * self.unit)).mid()
        pairs = zip(value, self.signs[name], strict=True)
        return tuple((x * (1 + sign * self.unit)).mid() for x, sign in pairs)

    def rounded(self, images: list[Scalar]) -> list[Scalar]:
        """Add rounding errors to the right-hand sides of a system of implicit equations.

        ``images`` contains the right-hand sides without the errors. The result contains the right-hand sides
        with the errors.
        """
        draw = random.Random(self.probe)
        moves = [[draw.choice((-1, 1)) * self.unit for _ in range(2)] for _ in images]
        after = [*images[1:], images[0]]
        pairs = zip(images, after, moves, strict=True)
        return [(x + a * x + b * y).mid() for x, y, (a, b) in pairs]

    def increment(self, x: Scalar, unknowns: Sequence[Scalar]) -> Scalar:
        """Return the increment of ``x`` for a difference quotient in Newton's method: 2^-40 max(1, |x|)."""
        return arb((1, -40)) * max(arb(1), abs(x.mid()))


def precise_step(
    compiled: Optimised,
    state: Sequence[Scalar],
    t: Scalar,
    h: Scalar,
    near: list[list[Scalar]] | None = None,
    *,
    limit: int = 400,
    newton: bool = True,
    probe: int | None = None,
    digits: int = DIGITS,
) -> list[Scalar]:
    """Return the state after one step made by the interpreter, as mpmath numbers with many digits.

    - ``near``: the starting values of Newton's method, one list for each system of implicit equations. The
      step overwrites ``near`` with the solutions.
    - ``limit``: the largest number of iterations for each system of implicit equations.
    - ``newton``: False to use only fixed-point iteration.
    - ``probe``: the seed of the random rounding errors that are added to the result of each operation, or
      None to add no errors.
    - ``digits``: the number of decimal digits of the arithmetic.

    ArithmeticError or ValueError is raised if a number computed in the step is not a finite real number, or
    if an iteration does not converge.
    """
    domain = BallDomain(h, digits) if probe is None else Rounding(h, digits, probe)
    context = mpmath_context(digits)
    problem = problem_for(compiled.scene, compiled.method)
    program = compiled.program
    with domain.precision():
        numbers = tuple(map(domain.scalar, state))
        values: dict[str, Scalar] = {"t": domain.scalar(t), **split_state(problem, numbers)}
        if near is not None:
            near[:] = [[domain.scalar(x) for x in block] for block in near]
        inputs = {v.name: values[v.name] for v in program.inputs}
        outputs = interpret(program, problem, domain, inputs, limit=limit, newton=newton, near=near)
        if near is not None:
            near[:] = [[domain.mpf(x, context) for x in block] for block in near]
        end = [x for block in problem.state for x in flatten(block.kind, outputs[block.name])]
        if not all(x.is_finite() for x in end):
            raise ArithmeticError("the step divides by zero, or a number is not finite")
        return [domain.mpf(x, context) for x in end]


@cache
def mpmath_context(digits: int) -> mpmath.ctx_mp.MPContext:
    """Return an mpmath context that computes with ``digits`` decimal digits."""
    # The global context of mpmath is not changed, because other code of the user can depend on it.
    import mpmath

    context = mpmath.mp.clone()
    context.dps = digits
    return context


def solved_step(
    compiled: Compiled, runner: Emitted, state: Sequence[Scalar], t: Scalar, h: Scalar
) -> list[Scalar]:
    """Return the state after one step, computed by the interpreter with :data:`DIGITS` digits.

    Implicit equations are solved by fixed-point iteration. If an iteration does not converge, Newton's method
    is used. Newton's method starts at the solution of the emitted code. Raises ArithmeticError or ValueError
    if no solution is found.
    """
    try:
        return precise_step(compiled, state, t, h, limit=PATIENCE, newton=False)
    except (ArithmeticError, ValueError):
        near = solutions(runner, [float(x) for x in state], float(t), float(h))
        if near is None:
            raise
        return precise_step(compiled, state, t, h, near, limit=CORRECTIONS)
