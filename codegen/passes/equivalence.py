"""Numerical test that two programs have the same results.

An interpreter executes one step of the reference program and of the rewritten program. The test uses
two different initial values.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import islice

from codegen.errors import SceneError
from codegen.ir.domain import Domain, FloatDomain, NotConverged, PreciseDomain, Scalar, Value
from codegen.ir.expr import evaluate
from codegen.ir.interpret import flatten, interpret
from codegen.ir.program import EMBEDDED, Program
from codegen.ir.values import Kind, Var
from codegen.scene.orbit import variants
from codegen.scene.problem import Problem

STEPS = tuple(2.0**-k for k in (2, 3, 4, 6, 8, 10, 13, 16, 20, 24))
"""Step sizes to try, largest first: a wrong rewriting has the largest effect in a long step."""

TINY_STEPS, DIGITS = (32, 64, 128, 256, 512, 1024), 500
"""Exponents k of the tiny step sizes 2^-k, and the number of decimal digits for these steps.

The tiny steps are tried if the results cannot be compared in double precision.
"""

REACH = 0.5
"""Upper bound for the product of the step size and the largest component of the field.

A larger step would amplify rounding errors. If necessary, all step sizes are divided by the same power of
two.
"""

FAILURES = (NotConverged, ArithmeticError, ValueError)
"""Possible exceptions in the computation of a step. ValueError is raised for roots of negative numbers."""

SWEEPS = 24
"""Largest number of fixed-point iterations (sweeps) of the reference program in double precision.

If each sweep divides the error by four, 24 sweeps divide the error by 2^48.
"""

MORE_SWEEPS, FEW_DIGITS = 400, 60
"""Parameters for the repetition of a failed comparison.

The repetition uses at most MORE_SWEEPS fixed-point iterations, and arithmetic with FEW_DIGITS decimal digits.
"""

NOT_A_NUMBER = "differs by nan"
"""The description of a difference ends with these words if the difference is NaN."""

APART = 16
"""Each step size of the reference program is at least APART times the next smaller step size."""

SLOW = -16
"""Let f be the field, and h a moderate step size. If h |f| is below about 2^SLOW, longer steps are used.
"""

LARGEST = 2.0**512
"""Upper bound for the absolute values of the results of a step.

If a result of the reference program reaches this bound, the step size is skipped.
"""

CLOSE = 2.0**-200
"""After a tiny step, two results agree if they differ by at most CLOSE times the change of the state."""

AGREE = 2.0**-36
"""The results x and y of one step of two programs agree if |x - y| <= AGREE max(1, |x|) in the maximum norm.

If the step size is in :data:`TINY_STEPS`, the criterion of :data:`CLOSE` is used instead. In 170 comparisons
on scenes of the gallery, rounding errors were at most 2^-51, far below AGREE.
"""


@dataclass(frozen=True)
class _Step:
    """One step of the reference program.

    - ``after`` is the new state.
    - ``solutions`` contains the solutions of the implicit equations.
    - ``moved`` is True if the step begins near the initial state, and False if it begins at the initial
      state.
    - ``tiny`` is True if the step size is one of :data:`TINY_STEPS`.
    """

    domain: Domain
    inputs: dict[str, Value]
    after: dict[str, Value]
    solutions: dict[Var, Value]
    moved: bool
    tiny: bool = False


class _Bounded(PreciseDomain):
    """Arithmetic with many digits. An error is raised if an iteration diverges."""

    def call(self, function: str, *args: Scalar) -> Scalar:
        """Return the value of a function.

        Numbers have d = ``self.digits`` decimal digits. OverflowError is raised if |x| > 10^(d/2) for an
        argument x. The rounding error of such an argument is about 10^(-d/2) or larger, so at least half of
        the digits of sin x, for example, would be wrong.
        """
        if any(abs(x) > self.rational(10) ** (self.digits // 2) for x in args):
            raise OverflowError(function)
        return super().call(function, *args)

    def settled(self, old: Sequence[Scalar], new: Sequence[Scalar], previous: Scalar) -> tuple[bool, Scalar]:
        """Return (converged, size of the change) for one fixed-point iteration from ``old`` to ``new``.

        ``previous`` is the size of the change in the previous iteration. Numbers have d = ``self.digits``
        decimal digits, for example d = 60. NotConverged is raised if the change from ``old`` to ``new`` is at
        least 10^d. Changes become so large only if the iteration diverges.
        """
        done, change = super().settled(old, new, previous)
        if not change < self.rational(10) ** self.digits:
            raise NotConverged("a fixed-point iteration diverges")
        return done, change


class _Point:
    """Results of single steps of the reference program from one state, in order of decreasing step size."""

    def __init__(self, more: Iterator[_Step]) -> None:
        self._more = more
        self.computed = list(islice(more, 1))

    def results(self) -> Iterator[_Step]:
        """Yield the steps. The longest step comes first."""
        yield from self.computed
        for result in self._more:
            self.computed.append(result)
            yield result


class Reference:
    """The results of the reference program after one step.

    The program computes steps from two states: the initial state, and a nearby state without symmetry. At the
    nearby state, run-time parameters do not have their default values. From each state, the program tries
    several step sizes in decreasing order. A step size is skipped if the iterations do not converge or if the
    results are not finite.
    """

    def __init__(self, program: Program, scene: Problem) -> None:
        self.scene, self.program = scene, program
        # The key is False for steps from the initial state, and True for steps from a nearby state.
        self.problems = {False: scene, True: next(iter(variants(scene)), scene)}
        self.kinds = {v.name: v.kind for v in program.inputs}
        points = [_Point(self._some(program, moved)) for moved in (False, True)]
        self.points = [point for point in points if point.computed]
        if not self.points:
            raise _no_step(scene)

    def _some(self, program: Program, moved: bool) -> Iterator[_Step]:
        """Yield steps from the initial state, or from a nearby state if ``moved`` is True.

        The longest step comes first.
        """
        scene = self.problems[moved]
        state = _state(scene, FloatDomain(0.0), moved)
        speed = _speed(scene, state)
        inputs = {name: state[name] for name in self.kinds}
        # If the field is not finite at this state, no step can begin here.
        if not math.isfinite(speed):
            return
        # All step sizes are divided by 2**excess.
        excess = math.frexp(speed * STEPS[0] / REACH)[1]
        # If the field is very small, a moderate step may change the state by less than the tolerance AGREE.
        # Then a wrong program would pass the test. Therefore the steps are longer if ``moved`` is true.
        if excess < 0 and not (moved and excess < SLOW):
            excess = 0
        last = math.inf
        for moderate in STEPS:
            # Powers of h have no rounding errors if the step size is a power of two.
            step = math.ldexp(moderate, -excess)
            if step <= last / APART and (result := self._step(program, FloatDomain(step), inputs, moved)):
                yield result
                last = step
        for power in TINY_STEPS:
            precise = self._precise(Fraction(1, 2 ** (power + max(excess, 0))), DIGITS, moved)
            if (result := self._step(program, *precise, moved, tiny=True)) and self._is_short(result, power):
                yield result

    def _precise(self, h: Fraction, digits: int, moved: bool) -> tuple[Domain, dict[str, Value]]:
        """Return a domain with step size ``h`` and ``digits`` decimal digits, and the state before a step.

        The state is the initial state of the scene, or a nearby state if ``moved`` is True.
        """
        domain = _Bounded(h, digits)
        state = _state(self.problems[moved], domain, moved)
        return domain, {name: state[name] for name in self.kinds}

    def _step(
        self, program: Program, domain: Domain, inputs: dict[str, Value], moved: bool, *, tiny: bool = False
    ) -> _Step | None:
        """Return the result of one step of a program, or None if the step cannot be computed."""
        # ``_run`` stores the solutions of the implicit equations here. The iterations of the rewritten
        # program start from the stored solutions.
        solutions: dict[Var, Value] = {}
        # If the iteration does not converge, or numbers overflow, the step is too long.
        try:
            after = self._run(program, moved, domain, inputs, (1 + tiny) * SWEEPS, solutions)
        except FAILURES:
            return None
        # If a rewritten program adds large terms in another order, its partial sums may overflow.
        finite = all(abs(x) < LARGEST for name in after for x in self._numbers(name, after))
        return _Step(domain, inputs, after, solutions, moved, tiny) if finite else None

    def _is_short(self, step: _Step, power: int) -> bool:
        """Return True if a tiny step changes the state only slightly.

        With p = ``power``, the change of every number x of the state must be at most 2^(-p/2) max(1, |x|).
        """
        return all(
            abs(x - y) <= max(1, abs(x)) * 2.0 ** -(power // 2)
            for name in self.kinds.keys() & step.after.keys()
            for x, y in zip(self._numbers(name, step.inputs), self._numbers(name, step.after), strict=True)
        )

    def _numbers(self, name: str, state: dict[str, Value]) -> tuple[Scalar, ...]:
        return flatten(self.kinds["y" if name == EMBEDDED else name], state[name])

    def _run(
        self,
        program: Program,
        moved: bool,
        domain: Domain,
        inputs: dict[str, Value],
        limit: int,
        solutions: dict[Var, Value],
    ) -> dict[str, Value]:
        scene = self.problems[moved]
        return interpret(program, scene, domain, inputs, limit=limit, newton=False, solutions=solutions)

    def differs(self, program: Program) -> str:
        """Return a description of the first difference between the results of ``program`` and the reference.

        If there is no difference, the result is ''. If no step can be compared, SceneError is raised.
        """
        accounts = [self._in_some_step(program, point) for point in self.points]
        if all(account is None for account in accounts):
            raise _no_step(self.scene)
        return next(filter(None, accounts), "")

    def _in_some_step(self, program: Program, point: _Point) -> str | None:
        """Compare the results of ``program`` and of the reference program after one step.

        The reference program makes steps of different lengths from one state, and ``point`` contains the
        results. The lengths are tried in decreasing order. The comparison uses the first length for which
        ``program`` does not fail. ``program`` fails if a result is NaN, or if an exception is raised. For
        example, an exception is raised if an iteration does not converge.

        The result is one of the following:
        - the description of a difference, or '' if there is no difference;
        - the description of a failure, if ``program`` fails for all lengths, but the reference program does
          not;
        - None, if both programs fail for all lengths.
        """
        failure = None
        for step in point.results():
            # If the iterations do not converge, or numbers overflow, a shorter step is tried.
            try:
                after = self._run(program, step.moved, step.domain, step.inputs, 2 * SWEEPS, step.solutions)
            except FAILURES as error:
                if self._is_solved(step):
                    failure = f"interpretation failed: {error}"
                elif (account := self._by_newton(program, step)) is not None:
                    return account
                continue
            account = self._gap(step, after)
            if account and not step.tiny:
                account = self._confirmed(program, step, account)
            if NOT_A_NUMBER not in account:
                return account
            failure = account
        return failure

    def _is_solved(self, step: _Step) -> bool:
        """Return True if ``self.program`` can solve the equations of ``step`` with FEW_DIGITS digits."""
        if step.tiny:
            return True
        domain, inputs = self._precise(Fraction(step.domain.h), FEW_DIGITS, step.moved)
        try:
            self._run(self.program, step.moved, domain, inputs, MORE_SWEEPS, {})
        except FAILURES:
            return False
        return True

    def _by_newton(self, program: Program, step: _Step) -> str | None:
        """Compute the step of both programs with Newton's method, and describe the difference of the results.

        The two programs are ``program`` and the reference program. The result is '' if there is no
        difference, and None if Newton's method fails.
        """
        domain, inputs = self._precise(Fraction(step.domain.h), FEW_DIGITS, step.moved)
        solutions: dict[Var, Value] = {}
        try:
            first, second = (
                interpret(p, self.problems[step.moved], domain, inputs, limit=SWEEPS, solutions=solutions)
                for p in (self.program, program)
            )
        except FAILURES:
            return None
        return self._gap(_Step(domain, inputs, first, {}, step.moved), second)

    def _confirmed(self, program: Program, step: _Step, account: str) -> str:
        """Repeat the step with many digits, and describe the difference between the programs.

        The result is '' if there is no difference. If the repeated step fails, the result is ``account``. The
        text ``account`` describes the difference in double precision.
        """
        if NOT_A_NUMBER in account:
            return account
        domain, inputs = self._precise(Fraction(step.domain.h), FEW_DIGITS, step.moved)
        try:
            results = [
                self._run(p, step.moved, domain, inputs, MORE_SWEEPS, {}) for p in (self.program, program)
            ]
        except FAILURES:
            return account
        return self._gap(_Step(domain, inputs, results[0], {}, step.moved), results[1])

    def _gap(self, step: _Step, after: dict[str, Value]) -> str:
        for name in self.kinds:
            # The time and other inputs that the step only reads have no new values to compare.
            if name not in step.after:
                continue
            x, y = (self._numbers(name, side) for side in (step.after, after))
            # If the exact results are zero, x and y contain only rounding errors, and a relative comparison
            # makes no sense.
            scale, agree = max(1.0, *(abs(s) for s in x)), AGREE
            if step.tiny:
                start = self._numbers(name, step.inputs)
                change = max(abs(s - t) for s, t in zip(x, start, strict=True))
                scale, agree = max(change, scale * step.domain.rational(1, 10 ** (DIGITS - 100))), CLOSE
            gap = max(abs(s - t) for s, t in zip(x, y, strict=True))
            # If ``gap`` is NaN, the comparison ``<=`` is false, and NaN counts as a difference.
            if not gap <= agree * scale:
                return f"{name} differs by {float(gap / (scale if step.tiny else 1)):.3g}"
        return ""


def _speed(scene: Problem, state: dict[str, Value]) -> float:
    """Return the largest absolute value of a component of the field at a state."""
    domain = FloatDomain(0.0)
    coordinates = tuple(x for block in scene.state for x in state[block.name])
    try:
        # If a value is not finite, the result is infinity.
        values = evaluate(scene.roots, domain, scene.values(domain, coordinates, state["t"]))
    except (ArithmeticError, ValueError):
        return math.inf
    # ``max`` may skip a NaN.
    return max(map(abs, map(float, values))) if all(map(math.isfinite, values)) else math.inf


def _no_step(scene: Problem) -> SceneError:
    return SceneError(
        "no step of the method can be computed from the initial state, nor from a state nearby",
        where=scene.name,
        expected="a field that is finite at these states, and solvable stage equations for small steps",
        hint="check the scene for roots of negative numbers, zero denominators, numbers above 1e308",
    )


def _state(scene: Problem, domain: Domain, moved: bool) -> dict[str, Value]:
    """Return the initial state, or a nearby state if ``moved`` is True."""
    start = scene.initial(domain)
    # Unlike random numbers, these sines are the same in every run.
    directions = [_exactly(domain, math.sin(7.0 * k + 1.0) / 8) for k in range(2 * scene.group.dim)]
    x, covector = tuple(directions[: scene.group.dim]), directions[scene.group.dim :]
    state: dict[str, Value] = {"t": _exactly(domain, float(scene.span[0]) + moved / 8)}
    first = 0
    for block in scene.state:
        value = start[first : first + len(block.symbols)]
        first += len(block.symbols)
        if moved and block.kind is Kind.DUAL:
            value = tuple(a + b for a, b in zip(value, covector, strict=True))
        elif moved:
            # The action of exp(x) maps the manifold of positions to itself.
            value = tuple(scene.action.actexp(domain, scene.group, x, value))
        state[block.name] = value
    return state


def _exactly(domain: Domain, x: float) -> Scalar:
    return domain.rational(*x.as_integer_ratio())
