"""Upper bounds of the observed order that follow from kinks at the start and at the end of a solution.

A *kink* is a point where the field is not smooth. For example, a field that contains abs(x) has a kink at
x = 0. The two *ends* of a solution are its initial point and its final point.

If an end is a kink, the solution is on one side of the kink. But a stage can be on the other side. In the
first step, a stage with a negative abscissa is before the initial time. In the last step, a stage with an
abscissa above 1 is after the final time.

The *smooth field* has the same formula on both sides of the kink: the formula that applies along the
solution. For example, if x > 0 along the solution, the smooth field contains x in place of abs(x). A step for
the field is compared with a step for the smooth field. If the results of the two steps differ by about c h^m,
where h is the step size, the observed order is at most m. The number m is the *bound* from this end.
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

At a kink, for example at x = 0 for abs(x), the sign of x is not known. Therefore the sign of x is computed a
short time after the initial time, or a short time before the final time.
"""

SIZES = (1e-3, 1e-4)
"""Two step sizes h and H, as fractions of the time span.

If a kink changes the results of steps of these sizes by d and D, the bound is log(d/D) / log(h/H).
"""

INSIDE = 100
"""The number 100: :func:`undefined_beyond` makes a step of size h at the distance 100 h from an end.

The step begins at t = 100 h after the initial time, or ends 100 h before the final time. A stage with the
abscissa c is at the time t + c h, so all stages are inside the time span for -100 <= c <= 101.
"""

EQUAL = 1e-26
"""Two states a and b near an end y of a solution are equal if |a - b| <= EQUAL max(1, |y|).

Here |y| is the maximum norm. EQUAL exceeds the largest error of a reference solution
(:data:`codegen.lab.reference.AGREEMENT`).
"""

assert EQUAL > AGREEMENT


def end_limits(compiled: Optimised, end: Vector) -> tuple[float, float]:
    """Return the upper bounds of the observed order from a kink at the start, and from a kink at the end.

    A kink is a point where the field is not smooth. For example, (2, inf) means that a kink at the start
    limits the order to 2.

    A bound is infinity if there is no kink, if the kink does not change the results of steps, or if the bound
    cannot be computed. ``end`` is the exact state at the end of the time span.
    """
    scene = compiled.scene
    if not any(selections(roots) for roots in _formulas(scene)):
        return math.inf, math.inf
    first, last = (PreciseDomain(0, DIGITS).rational(*x.as_integer_ratio()) for x in scene.span)
    start = scene.initial(PreciseDomain(0, DIGITS))
    return _limit(compiled, start, first, last - first), _limit(compiled, end, last, first - last)


def undefined_beyond(compiled: Optimised, end: Vector) -> str:
    """Return a reason if runs fail because the field is not defined at a stage outside the time span.

    The reason names the step that has this stage: the first or the last step. If runs do not fail for this
    reason, the text is empty. ``end`` is the exact state at the end of the time span.

    The first step is named if a very short step at the initial time fails, but succeeds at a slightly
    later time. The last step is named if a very short step at the final time fails, but succeeds at a
    slightly earlier time.
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
    """Return the upper bound of the observed order from the end (``state``, ``t``) of the solution.

    If the field is smooth at this end, the bound is infinity.
    ``t`` + ``span`` is the time at the other end. Therefore ``span`` is negative if ``t`` is the final time.
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
    """Return the distance between the result of a step with ``compiled`` and that of a step with ``smooth``.

    The distance is measured in the maximum norm. For ``h`` > 0, the steps start at ``state`` at the time
    ``t``. For ``h`` < 0, the steps have the size -``h`` and end near ``state`` at the time ``t``.
    """
    if h < 0:
        state, t, h = tuple(precise_step(smooth, state, t, h, digits=DIGITS)), t + h, -h
    pair = (precise_step(x, state, t, h, digits=DIGITS) for x in (compiled, smooth))
    return max(float(abs(a - b)) for a, b in zip(*pair, strict=True))


def _formulas(scene: Problem) -> list[Sequence[Expr]]:
    energies = [x for x in (scene.hamiltonian, *scene.parts.values()) if x is not None]
    return [x for x in (scene.roots, *([x] for x in energies)) if x]


def _on_boundary(scene: Problem, state: Vector, t: Scalar) -> bool:
    """Return True if an operation such as abs(x) changes its case at (``state``, ``t``)."""
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
    """Return a copy of the scene with a smooth field.

    In the copy, one formula replaces each operation with several cases. For example, x replaces abs(x) if
    x > 0 at the time ``t`` + ``away``. So both fields are equal along the solution near the time ``t``.
    """
    domain = PreciseDomain(0, DIGITS)
    # The midpoint rule also gives the right sign if the velocity is zero. For example, Euler's method gives
    # x = 0 for x' = 2 t and x(0) = 0, but the midpoint rule gives x > 0.
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
