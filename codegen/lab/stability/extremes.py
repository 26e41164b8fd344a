"""Extreme input, one step: emitted C against the interpreter with 60 digits on the same doubles.

A step is *accurate* when it has :data:`LEAST` digits at least, and differs from the exact step by no more
than rounding explains: rounding the input, the result of every operation of the step's program, and both
sides of the equations of an implicit step, at the last bit, moves the exact answer by so much, and every
operation of emitted code may round a few times. The digits that this leaves are *determined*. Where too few
are (a rotation by 1e20 radians is known to no angle at all) only a status will do, and an answer is told as
*undetermined*. A finite answer that rounding does not explain is *wrong*. Digits are those of the larger of
a block of the state and the same block before the step; what lies below the least normal number is zero.

Equations of long implicit steps have several solutions, and the way to any leads past the others. The
interpreter finds its own where a fixed point leads to it; elsewhere it begins at that of emitted Python,
which goes the way of C, and Newton's method makes it one to 60 digits, or shows that it is none.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import accumulate
from typing import Any

from codegen.emitter import Compiled
from codegen.ir.domain import FloatDomain, NotConverged, PreciseDomain
from codegen.ir.interpret import flatten, interpret
from codegen.ir.program import Kind
from codegen.lab.runner import Emitted
from codegen.loader import InterpretedIntegrator, StepFailed
from codegen.lower import problem_for

DIGITS = 60
EPSILON = 2.0**-53
TINY = 2.0**-1022
"""The least normal double: what underflows to less is as good as zero."""

ROUNDINGS = 256.0
"""Roundings that a step may gather, in units of what one rounding of every input and operation does."""

LEAST = 3
"""Digits below which an answer says too little to be one."""

PROBES = 4

SWEEPS, CORRECTIONS = 60, 30
"""Of the interpreter, for a fixed point and Newton's method."""

ACCURATE, WRONG = "accurate", "WRONG"
SILENT = f"undetermined: rounding leaves fewer than {LEAST} digits of it"
UNSOLVED = f"{WRONG}: the equations of this step have no solution there"

ANGLES = (1e-300, 1e-8, math.pi - 1e-9, math.pi, 2 * math.pi, 100.0, 1e3, 1e4, 1e5, 1e6, 1e8, 1e300)
STEPS = (1e-300, 1e-12, 1e-8, 1e-4)
SCALES = (0.0, 5e-324, 1e-160, 1e-75, 1e75, 1e150, 1e308)


@dataclass(frozen=True)
class Case:
    """One step: what is extreme about it, the state, the time and the step size."""

    name: str
    state: tuple[float, ...]
    t: float
    h: float


@dataclass(frozen=True)
class Answer:
    """How a case was answered: ``accurate``, a status in words, ``undetermined`` or ``WRONG``.

    ``error`` is the largest relative error of a block of the state, ``determined`` the digits that the input
    determines, None where there was no answer to compare.
    """

    case: Case
    verdict: str
    error: float | None = None
    determined: float | None = None

    def as_json(self) -> dict[str, Any]:
        """Return plain data; the digits of nothing but zeros are null, for all are determined."""
        digits = self.determined
        return {
            "case": self.case.name,
            "h": self.case.h if math.isfinite(self.case.h) else None,
            "verdict": self.verdict,
            "error": self.error,
            "digits_determined": None if digits is None or math.isinf(digits) else digits,
        }


def cases(compiled: Compiled) -> Iterator[Case]:
    """Yield extreme cases of a method on a scene, around its initial state and a hundredth of its span."""
    scene = compiled.scene
    state = tuple(float(x) for x in scene.initial(FloatDomain(0.0)))
    t, h = float(scene.span[0]), float((scene.span[1] - scene.span[0]) / 100)
    usual = Case("usual step", state, t, h)
    yield usual
    yield replace(usual, name="h = 0", h=0.0)
    yield replace(usual, name="backwards", h=-h)
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
    """Return the place of the first coordinate of every block, and of the last coordinate of all."""
    places, start = [], 0
    for block in compiled.scene.state:
        places.append(start)
        start += len(block.symbols)
    return [*places, start - 1]


def _scaled(compiled: Compiled, state: tuple[float, ...], scale: float) -> tuple[float, ...] | None:
    """Return the state with what is a vector in it scaled; None where nothing is, or it overflows."""
    from codegen.groups import Rotation

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
    """Return |f(y0)|, the angle that a unit of time turns through."""
    view = compiled.scene.as_field()
    domain = FloatDomain(0.0)
    (value,) = view.apply(domain, "field", None, (tuple(state), t))
    return math.hypot(*value[: compiled.scene.group.dim])


def answer(compiled: Compiled, runner: Emitted, case: Case) -> Answer:
    """Make one step by emitted code and judge it."""
    try:
        found = runner.integrator.run(list(case.state), case.h, 1, case.t)
    except StepFailed as failure:
        return Answer(case, f"status: {failure.reason}")
    if not (math.isfinite(case.h) and all(map(math.isfinite, case.state))):
        return Answer(case, f"{WRONG}: an answer to input that is not finite")
    if not all(map(math.isfinite, found)):
        return Answer(case, f"{WRONG}: an answer that is not finite")
    try:
        exact, probed = _exact(compiled, runner, case)
    except (NotConverged, ArithmeticError, ValueError):
        return Answer(
            case, UNSOLVED if compiled.kernel.loops else f"{WRONG}: an answer where the interpreter has none"
        )
    error, determined, explained = 0.0, math.inf, True
    for block in _blocks(compiled):
        scale = max(max(abs(exact[i]), abs(case.state[i])) for i in block)
        gap = max(abs(found[i] - exact[i]) for i in block)
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


def _probe(case: Case, number: int) -> tuple[tuple[Any, ...], Any, Any]:
    """Return the input with every number rounded otherwise in the last bit, up or down at random."""
    import mpmath

    draw = random.Random(number)
    context = mpmath.mp.clone()
    context.dps = DIGITS

    def rounded(x: float) -> Any:
        return context.mpf(x) * (1 + draw.choice((-1, 1)) * context.mpf(EPSILON))

    return tuple(rounded(x) for x in case.state), rounded(case.t), rounded(case.h)


def _exact(compiled: Compiled, runner: Emitted, case: Case) -> tuple[list[Any], list[list[Any]]]:
    """Return the state after the step in 60 digits, and those after the steps of the probes.

    Equations of long steps are solved in more digits: they hold numbers of the size of h and of its square.
    """
    given, near = (case.state, case.t, case.h), None
    more = 3 * math.ceil(math.log10(max(1.0, abs(case.h))))
    try:
        exact = precise_step(compiled, *given, limit=SWEEPS, newton=False)
    except (NotConverged, ArithmeticError, ValueError):
        near = solutions(runner, *given)
        exact = precise_step(compiled, *given, near, limit=CORRECTIONS, digits=DIGITS + more)
    if near is None and compiled.kernel.loops:
        near = solutions(runner, *given)
    probes = [
        precise_step(
            compiled,
            *_probe(case, number),
            near and list(near),
            limit=CORRECTIONS,
            probe=number,
            digits=DIGITS + more,
        )
        for number in range(1, PROBES + 1)
    ]
    return exact, probes


def solutions(runner: Emitted, state: Sequence[float], t: float, h: float) -> list[list[float]] | None:
    """Return the unknowns of each block that emitted Python ends a step with, in the order they are solved.

    None where it cannot make the step.
    """
    integrator = runner.twin.integrator
    assert isinstance(integrator, InterpretedIntegrator)
    module: Any = integrator.module
    plain, found = module._Memory, dict[int, list[float]]()

    def keep(self: Any, unknowns: list[float]) -> None:
        found[id(self)] = unknowns
        plain.keep(self, unknowns)

    module._Memory = type("_Memory", (plain,), {"keep": keep})
    try:
        integrator.run(list(state), h, 1, t)
    except StepFailed:
        return None
    finally:
        module._Memory = plain
    widths = [len(loop.unknowns) for loop in runner.compiled.kernel.loops]
    ends = list(accumulate(widths))
    return [list(x[end - n : end]) for x in found.values() for n, end in zip(widths, ends, strict=True)]


class Rounding(PreciseDomain):
    """Numbers of many digits, but every result of an operation is off by a rounding.

    One side of every equation is off by a rounding of it and one of its neighbour. Each is moved up or down
    at random, always the same way in a probe, so that equations stay smooth.
    """

    def __init__(self, h: Any, digits: int, probe: int) -> None:
        super().__init__(h, digits)
        self.probe = probe

    def computed(self, name: str, value: Any) -> Any:
        """Return the result of an operation, rounded."""
        draw = random.Random(f"{self.probe} {name}")
        if isinstance(value, tuple):
            return tuple(x * (1 + draw.choice((-1, 1)) * self.context.mpf(EPSILON)) for x in value)
        return value * (1 + draw.choice((-1, 1)) * self.context.mpf(EPSILON))

    def rounded(self, images: list[Any]) -> list[Any]:
        """Return the images of an equation's unknowns, rounded."""
        draw = random.Random(self.probe)
        moves = [[draw.choice((-1, 1)) * EPSILON for _ in range(2)] for _ in images]
        after = [*images[1:], images[0]]
        return [x + a * x + b * y for x, y, (a, b) in zip(images, after, moves, strict=True)]

    def increment(self, x: Any) -> Any:
        """Return the step of a difference quotient: what rounding moves is asked to some digits only."""
        return self.context.mpf(2) ** -40 * max(1, abs(x))


def precise_step(
    compiled: Compiled,
    state: Sequence[Any],
    t: Any,
    h: Any,
    near: list[list[Any]] | None = None,
    *,
    limit: int = 400,
    newton: bool = True,
    probe: int | None = None,
    digits: int = DIGITS,
) -> list[Any]:
    """Return the state after one step of the program, in many digits; ``near`` as for :func:`interpret`.

    The number of a ``probe`` says how every operation is rounded.
    """
    domain = PreciseDomain(h, digits) if probe is None else Rounding(h, digits, probe)
    view = problem_for(compiled.scene, compiled.method)
    numbers = tuple(domain.context.mpf(x) for x in state)
    values: dict[str, Any] = {"t": domain.context.mpf(t)}
    start = 0
    for block in view.state:
        values[block.name] = numbers[start : start + len(block.symbols)]
        start += len(block.symbols)
    program = compiled.program
    if near is not None:
        near[:] = [[domain.context.mpf(x) for x in block] for block in near]
    inputs = {v.name: values[v.name] for v in program.inputs}
    found = interpret(program, view, domain, inputs, limit=limit, newton=newton, near=near)
    return [x for block in view.state for x in flatten(block.kind, found[block.name])]
