"""Whether two programs mean the same: interpretation at points of the scene, in double precision."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import islice

from codegen.errors import SceneError
from codegen.ir.domain import FloatDomain, NotConverged, Value
from codegen.ir.expr import evaluate
from codegen.ir.interpret import flatten, interpret
from codegen.ir.program import Program
from codegen.ir.values import Kind, Var
from codegen.scene.problem import Problem

STEPS = tuple(2.0**-k for k in (2, 3, 4, 6, 8, 10, 13, 16, 20, 24))
"""Step sizes to try, the largest first: what a wrong rewriting leaves is largest there. Where the field is so
fast that the first reaches too far, all are shortened."""

REACH = 0.5
"""The most that a step may move along the field: beyond, rounding would be amplified."""

FAILURES = (NotConverged, ArithmeticError, ValueError)
"""How an interpretation fails; ValueError for the root of a negative number."""

Result = tuple[float, dict[str, Value], dict[str, Value], dict[Var, Value]]
"""Step size, inputs, new state, and what solved the equations of the last program that was compared."""

SWEEPS = 24
"""The most sweeps over a block: a step that needs more is too large to compare roundings."""

TRIES, APART = 3, 16
"""How many steps a program may be compared in, and by what factor they differ: equations put otherwise need
smaller steps to settle where they are iterated, and one step in which they do is enough."""

AGREE = 2.0**-36
"""Relative difference of results that mean the same: far above rounding and the tolerance of a block."""


class _Point:
    """Results from one state; those in smaller steps are computed when they are asked for."""

    def __init__(self, more: Iterator[Result]) -> None:
        self._more = more
        self.computed = list(islice(more, 1))

    def results(self) -> Iterator[Result]:
        """Yield the results, the largest step first."""
        yield from self.computed
        for result in self._more:
            self.computed.append(result)
            yield result


class Reference:
    """What a program means: its results after one step from points of a scene.

    The points are the initial state, which may be special (an equilibrium, a symmetric position), and one
    nearby without any symmetry; the step is the largest of moderate reach for which the blocks settle. A
    program that is compared begins at the solutions of the one before it: where its equations are others, it
    moves away from them.
    """

    def __init__(self, program: Program, scene: Problem) -> None:
        self.scene = scene
        self.kinds = {v.name: v.kind for v in program.inputs}
        points = [_Point(self._some(program, state)) for state in _states(scene)]
        self.points = [point for point in points if point.computed]
        if not self.points:
            raise SceneError(
                "no step can be computed from the initial state, nor from one nearby",
                where=scene.name,
                expected="a field that is finite there, and stages that can be solved for small steps",
                hint="look for roots of negative numbers, zero denominators and numbers above 1e308",
            )

    def _some(self, program: Program, state: dict[str, Value]) -> Iterator[Result]:
        """Yield what happens in the largest step and in two smaller ones, for programs that settle later."""
        speed = _speed(self.scene, state)
        inputs = {name: state[name] for name in self.kinds}
        if not math.isfinite(speed):
            return
        excess = math.frexp(speed * STEPS[0] / REACH)[1]  # a power of two above it
        count, last = 0, math.inf
        for moderate in STEPS:
            step = math.ldexp(moderate, -max(excess, 0))
            if count and step > last / APART:
                continue
            solutions: dict[Var, Value] = {}
            # A step that does not settle is too long; a shorter one is tried.
            try:
                after = self._run(program, step, inputs, SWEEPS, solutions)
            except FAILURES:
                continue
            yield step, inputs, after, solutions
            count, last = count + 1, step
            if count == TRIES:
                break

    def _run(
        self, program: Program, step: float, inputs: dict[str, Value], limit: int, solutions: dict[Var, Value]
    ) -> dict[str, Value]:
        domain = FloatDomain(step)
        return interpret(program, self.scene, domain, inputs, limit=limit, newton=False, solutions=solutions)

    def differs(self, program: Program) -> str:
        """Return an account of what a program does differently, or ''."""
        for point in self.points:
            account = self._in_some_step(program, point)
            if account:
                return account
        return ""

    def _in_some_step(self, program: Program, point: _Point) -> str:
        """Compare in the first step that the program makes."""
        failure = ""
        for step, inputs, before, solutions in point.results():
            try:
                after = self._run(program, step, inputs, 2 * SWEEPS, solutions)
            except NotConverged as error:
                failure = f"interpretation failed: {error}"
            except FAILURES as error:
                return f"interpretation failed: {error}"
            else:
                return self._gap(before, after)
        return failure

    def _gap(self, before: dict[str, Value], after: dict[str, Value]) -> str:
        for name, kind in self.kinds.items():
            if name not in before:
                continue
            x, y = (flatten(kind, side[name]) for side in (before, after))
            scale = max(1.0, *(abs(s) for s in x))
            gap = max(abs(s - t) for s, t in zip(x, y, strict=True))
            if not gap <= AGREE * scale or not math.isfinite(scale):
                return f"{name} moved by {gap:.3g}"
        return ""


def _speed(scene: Problem, state: dict[str, Value]) -> float:
    """Return the largest component of the field, or of the Hamiltonian's derivatives, at a state."""
    domain = FloatDomain(0.0)
    coordinates = tuple(x for block in scene.state for x in state[block.name])
    try:
        values = evaluate(scene.roots, domain, scene.values(domain, coordinates, state["t"]))
    except (ArithmeticError, ValueError):
        return math.inf
    return max(map(abs, map(float, values)))


def _states(scene: Problem) -> Iterator[dict[str, Value]]:
    """Yield the initial state, and one moved from it by the group along fixed directions."""
    domain = FloatDomain(0.0)
    start = scene.initial(domain)
    directions = [math.sin(7.0 * k + 1.0) / 8 for k in range(2 * scene.group.dim)]
    x, covector = tuple(directions[: scene.group.dim]), directions[scene.group.dim :]
    time = float(scene.span[0])
    for moved in (False, True):
        state: dict[str, Value] = {"t": time + moved / 8}
        first = 0
        for block in scene.state:
            value = start[first : first + len(block.symbols)]
            first += len(block.symbols)
            if moved and block.kind is Kind.DUAL:
                value = tuple(a + b for a, b in zip(value, covector, strict=True))
            elif moved:
                value = tuple(scene.action.actexp(domain, scene.group, x, value))
            state[block.name] = value
        yield state
