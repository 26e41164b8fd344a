"""Points where the field is not smooth, at the two ends of a solution.

The solution does not cross a point at its end. But a stage of the first step can be evaluated before the
initial time (a negative abscissa), and a stage of the last step after the final time (an abscissa above 1).
Such a step is compared with the same step for a smooth field, in which each selection
(:mod:`codegen.ir.smoothness`) always has the case that applies along the solution. If the difference of the
two steps is proportional to h^m, where h is the step size, the order of runs on this scene is at most m.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from codegen.emitter import Optimised, optimise_method
from codegen.ir.domain import PreciseDomain
from codegen.ir.expr import Expr, evaluate
from codegen.ir.smoothness import on_sides, selections
from codegen.ir.table import PiecewisePolynomial
from codegen.lab.number_types import Scalar, Vector
from codegen.lab.reference import AGREEMENT
from codegen.lab.stability.extreme_steps import precise_step
from codegen.scene.problem import Problem
from orderconds.errors import InputError

DIGITS = 60

AWAY = 1e-20
"""A short time, as a fraction of the time span.

The signs of formulas at this time after the start, or before the end, give the cases along the solution.
"""

SIZES = (1e-3, 1e-4)
"""The step sizes of the compared steps, as fractions of the time span.

A point where the field is not smooth counts as an end of the solution only if the steps of these sizes show
it. If the point is farther away, sufficiently short steps do not reach it.
"""

INSIDE = 100
"""No method has a stage that is INSIDE step sizes before or after its step."""

EQUAL = 1e-26
"""Two steps are equal if no coordinate differs by more than EQUAL times max(1, s).

Here s is the largest absolute value of a coordinate. EQUAL exceeds the largest error of a reference solution
(:data:`codegen.lab.reference.AGREEMENT`).
"""

assert EQUAL > AGREEMENT


def end_limits(compiled: Optimised, end: Vector) -> tuple[float, float]:
    """Return two upper bounds of the order, from the first and from the last step of a run.

    ``end`` is the exact state at the end of the time span. A bound is infinity if the stages of the step do
    not leave the smooth part of the field, or if one of the steps cannot be computed.
    """
    scene = compiled.scene
    if not any(selections(roots) for roots in _formulas(scene)):
        return math.inf, math.inf
    first, last = (PreciseDomain(0, DIGITS).rational(*x.as_integer_ratio()) for x in scene.span)
    start = scene.initial(PreciseDomain(0, DIGITS))
    return _limit(compiled, start, first, last - first), _limit(compiled, end, last, first - last)


def undefined_beyond(compiled: Optimised, end: Vector) -> str:
    """Return a text if a stage of the first or of the last step is at a time at which the field is undefined.

    Otherwise the text is empty. ``end`` is the exact state at the end of the time span. A very short first
    step must fail, and the same step must succeed at a slightly later time, or the same for the last step and
    a slightly earlier time.
    """
    first, last = (PreciseDomain(0, DIGITS).rational(*x.as_integer_ratio()) for x in compiled.scene.span)
    start, h = compiled.scene.initial(PreciseDomain(0, DIGITS)), (last - first) * SIZES[-1]

    def possible(state: Vector, t: Scalar) -> bool:
        try:
            precise_step(compiled, state, t, h, digits=DIGITS)
        except (ArithmeticError, ValueError):
            return False
        return True

    if not possible(start, first) and possible(start, first + h * INSIDE):
        return "the first step evaluates the field before the initial time, where the field is not defined"
    if not possible(end, last - h) and possible(end, last - h - h * INSIDE):
        return "the last step evaluates the field after the final time, where the field is not defined"
    return ""


def _limit(compiled: Optimised, state: Vector, t: Scalar, span: Scalar) -> float:
    """Return the bound from the step at one end of the solution.

    ``span`` is the length of the time span. It is negative if (``state``, ``t``) is the end of the last step.
    """
    scene = compiled.scene
    if not _on_boundary(scene, state, t):
        return math.inf
    try:
        smooth = optimise_method(_smooth(scene, state, t, span * AWAY), compiled.method)
        gaps = [_gap(compiled, smooth, state, t, span * size) for size in SIZES]
    except (ArithmeticError, ValueError, InputError):
        return math.inf
    if not min(gaps) > EQUAL * max(1.0, *(abs(float(x)) for x in state)):
        return math.inf
    return max(0, round(math.log(gaps[0] / gaps[1]) / math.log(SIZES[0] / SIZES[1])))


def _gap(compiled: Optimised, smooth: Optimised, state: Vector, t: Scalar, h: Scalar) -> float:
    """Return the largest difference of a coordinate between a step for the field and for the smooth field.

    A negative ``h`` means that the step ends at ``state`` at the time ``t``.
    """
    if h < 0:
        state, t, h = tuple(precise_step(smooth, state, t, h, digits=DIGITS)), t + h, -h
    pair = (precise_step(x, state, t, h, digits=DIGITS) for x in (compiled, smooth))
    return max(float(abs(a - b)) for a, b in zip(*pair, strict=True))


def _formulas(scene: Problem) -> list[Sequence[Expr]]:
    """Return the formulas of a scene from which a step is compiled, in groups."""
    energies = [x for x in (scene.hamiltonian, *scene.parts.values()) if x is not None]
    return [x for x in (scene.roots, *([x] for x in energies)) if x]


def _on_boundary(scene: Problem, state: Vector, t: Scalar) -> bool:
    """Return True if a selection changes its case at ``state`` and ``t``."""
    domain = PreciseDomain(0, DIGITS)
    values = scene.values(domain, state, t)
    nodes = [node for roots in _formulas(scene) for node in selections(roots)]
    tests = [evaluate([node.args[0]], domain, values)[0] for node in nodes]
    return any(
        abs(x - domain.rational(*knot.as_integer_ratio())) <= EQUAL * max(1.0, abs(x))
        for node, x in zip(nodes, tests, strict=True)
        for knot in (node.payload.knots if isinstance(node.payload, PiecewisePolynomial) else (0,))
    )


def _smooth(scene: Problem, state: Vector, t: Scalar, away: Scalar) -> Problem:
    """Return the scene with the cases that apply along the solution at the time ``t`` + ``away``."""
    domain = PreciseDomain(0, DIGITS)
    # The midpoint rule is used, because the solution can touch the boundary of a case.
    half = _moved(state, scene.velocity(domain, state, t), away / 2)
    point = _moved(state, scene.velocity(domain, half, t + away / 2), away)
    values = scene.values(domain, point, t + away)

    def continued(roots: Sequence[Expr]) -> tuple[Expr, ...]:
        nodes = selections(roots)
        if not nodes:
            return tuple(roots)
        tests = evaluate([node.args[0] for node in nodes], domain, values)
        sides = tuple(_side(node.payload, x, domain) for node, x in zip(nodes, tests, strict=True))
        return tuple(on_sides(roots, nodes, sides)[0])

    energy = scene.hamiltonian
    return replace(
        scene,
        roots=continued(scene.roots),
        hamiltonian=None if energy is None else continued([energy])[0],
        parts={name: continued([part])[0] for name, part in scene.parts.items()},
    )


def _moved(state: Vector, velocity: Vector, time: Scalar) -> Vector:
    return tuple(x + time * v for x, v in zip(state, velocity, strict=True))


def _side(function: str, x: Scalar, domain: PreciseDomain) -> int:
    if isinstance(function, PiecewisePolynomial):
        return sum(x >= domain.rational(*knot.as_integer_ratio()) for knot in function.knots)
    return int(x > 0)
