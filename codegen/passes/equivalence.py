"""Equivalence of two programs: interpretation at points of the scene, in double precision."""

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
"""Step sizes to try, the largest first, because the effect of a wrong rewriting is largest there.

Any other decreasing powers of two are possible. If the first step moves too far along a fast field, all steps
are shortened."""

REACH = 0.5
"""The largest move along the field in one step: longer steps would amplify rounding.

Its value matters little: :data:`AGREE` leaves a factor of 2^15 above the rounding that occurs."""

FAILURES = (NotConverged, ArithmeticError, ValueError)
"""Errors of an interpretation; a root of a negative number raises ValueError."""

Result = tuple[float, dict[str, Value], dict[str, Value], dict[Var, Value]]
"""Step size, inputs, new state, and the solutions of the blocks of the last compared program."""

SWEEPS = 24
"""The largest number of sweeps over a block: a step that needs more is too long for a comparison up to
rounding.

A contraction by 1/4 a sweep reaches rounding, 2^-48, in 24 sweeps. For slower blocks the next, shorter step
is tried."""

TRIES, APART = 3, 16
"""The number of steps in which a program may be compared, and the smallest ratio between them.

Rewritten equations may need smaller steps to converge by iteration; one step in which they converge is
enough. The three steps span a factor of 256 or more."""

AGREE = 2.0**-36
"""Relative difference of equal results: far above rounding and the tolerance of a block.

In 170 comparisons of eight methods of the gallery the passes moved results by 2^-51 at most. A coefficient
that is wrong by 2^-28 is found: ``tests/codegen/passes/test_equivalence.py``."""


class _Point:
    """Results of steps from one state; the results of shorter steps are computed on demand."""

    def __init__(self, more: Iterator[Result]) -> None:
        self._more = more
        self.computed = list(islice(more, 1))

    def results(self) -> Iterator[Result]:
        """Yield the results, first the result of the longest step."""
        yield from self.computed
        for result in self._more:
            self.computed.append(result)
            yield result


class Reference:
    """The reference for comparisons: the results of a program after one step from points of a scene.

    One point is the initial state, which may be special (an equilibrium, a symmetric position). The other is
    a nearby point without any symmetry. The step is the longest of moderate reach for which the blocks
    converge. A compared program starts from the solutions of the reference; if its equations differ, it
    iterates away from these solutions.
    """

    def __init__(self, program: Program, scene: Problem) -> None:
        self.scene = scene
        self.kinds = {v.name: v.kind for v in program.inputs}
        points = [_Point(self._some(program, state)) for state in _states(scene)]
        self.points = [point for point in points if point.computed]
        if not self.points:
            raise SceneError(
                "no step can be computed from the initial state, nor from a state nearby",
                where=scene.name,
                expected="a field that is finite there, and stages that can be solved for small steps",
                hint="look for roots of negative numbers, zero denominators and numbers above 1e308",
            )

    def _some(self, program: Program, state: dict[str, Value]) -> Iterator[Result]:
        """Yield results of the longest step and of two shorter steps, in which more programs converge."""
        # The distance covered in a step is about h times the field, so fast fields get shorter steps.
        speed = _speed(self.scene, state)
        inputs = {name: state[name] for name in self.kinds}
        # A state where the field is not finite is skipped; the other state may be usable.
        if not math.isfinite(speed):
            return
        excess = math.frexp(speed * STEPS[0] / REACH)[1]  # a power of two above it
        count, last = 0, math.inf
        for moderate in STEPS:
            # The step is a power of two: h^k then has no rounding error that could look like a difference.
            step = math.ldexp(moderate, -max(excess, 0))
            # Steps of similar length are skipped: further steps are for programs that need much shorter
            # steps.
            if count and step > last / APART:
                continue
            # The interpreter fills this with the solutions of the blocks; compared programs start from them.
            solutions: dict[Var, Value] = {}
            # If the iteration does not converge, the step is too long; a shorter one is tried.
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
        """Return a description of the first difference, or ''."""
        for point in self.points:
            account = self._in_some_step(program, point)
            if account:
                return account
        return ""

    def _in_some_step(self, program: Program, point: _Point) -> str:
        """Compare results after the longest step for which the program converges."""
        failure = ""
        for step, inputs, before, solutions in point.results():
            try:
                after = self._run(program, step, inputs, 2 * SWEEPS, solutions)
            # The same equations in another form may converge only for shorter steps: try the next step.
            except NotConverged as error:
                failure = f"interpretation failed: {error}"
            # The reference has a result at this point, so an arithmetic failure is caused by the pass.
            except FAILURES as error:
                return f"interpretation failed: {error}"
            else:
                return self._gap(before, after)
        return failure

    def _gap(self, before: dict[str, Value], after: dict[str, Value]) -> str:
        for name, kind in self.kinds.items():
            # An input that the step only reads, such as the time, has no new value to compare.
            if name not in before:
                continue
            x, y = (flatten(kind, side[name]) for side in (before, after))
            # The comparison is relative for large values and absolute for small values, because components
            # may vanish by symmetry.
            scale = max(1.0, *(abs(s) for s in x))
            gap = max(abs(s - t) for s, t in zip(x, y, strict=True))
            # The condition is negated on purpose, so that a gap that is not a number counts as a difference.
            if not gap <= AGREE * scale or not math.isfinite(scale):
                return f"{name} moved by {gap:.3g}"
        return ""


def _speed(scene: Problem, state: dict[str, Value]) -> float:
    """Return the largest component of the field, or of the Hamiltonian's derivatives, at a state."""
    domain = FloatDomain(0.0)
    coordinates = tuple(x for block in scene.state for x in state[block.name])
    try:
        # Where the field overflows or divides by zero, it counts as not finite.
        values = evaluate(scene.roots, domain, scene.values(domain, coordinates, state["t"]))
    except (ArithmeticError, ValueError):
        return math.inf
    return max(map(abs, map(float, values)))


def _states(scene: Problem) -> Iterator[dict[str, Value]]:
    """Yield the initial state, and a state moved from it by the group in fixed directions."""
    domain = FloatDomain(0.0)
    start = scene.initial(domain)
    # Sines of integers have no symmetry or integer relation that a scene might share, and need no random
    # seed.
    directions = [math.sin(7.0 * k + 1.0) / 8 for k in range(2 * scene.group.dim)]
    x, covector = tuple(directions[: scene.group.dim]), directions[scene.group.dim :]
    time = float(scene.span[0])
    for moved in (False, True):
        state: dict[str, Value] = {"t": time + moved / 8}
        first = 0
        for block in scene.state:
            value = start[first : first + len(block.symbols)]
            first += len(block.symbols)
            # Momenta form a vector space, so a vector is added. Points and group elements are moved by the
            # group, and stay on the manifold.
            if moved and block.kind is Kind.DUAL:
                value = tuple(a + b for a, b in zip(value, covector, strict=True))
            elif moved:
                value = tuple(scene.action.actexp(domain, scene.group, x, value))
            state[block.name] = value
        yield state
