"""Numerical test that two programs have the same results.

An interpreter executes both programs for steps of different sizes from two states of the scene.
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
from codegen.scene.problem import Problem

STEPS = tuple(2.0**-k for k in (2, 3, 4, 6, 8, 10, 13, 16, 20, 24))
"""Step sizes to try. The largest is first, because a wrong rewriting has the largest effect in a long step.

If the first step would exceed the bound :data:`REACH`, all step sizes are divided by the same power of two.
"""

TINY_STEPS, DIGITS = (32, 64, 128, 256, 512, 1024), 500
"""Step sizes 2^-k for k in TINY_STEPS, which are used with DIGITS decimal digits.

These steps are tried if no step in double precision can be compared. The last of these steps is short enough
even for a scene with a coefficient of 1e300.
"""

REACH = 0.5
"""An upper bound of the step size h times the largest component of the field.

Steps above this bound would amplify rounding errors.
"""

FAILURES = (NotConverged, ArithmeticError, ValueError)
"""The errors that interpreting a program may raise. A root of a negative number raises ValueError."""

SWEEPS = 24
"""The largest number of sweeps (fixed-point iterations) over a block of the reference program in doubles.

A step that needs more sweeps is too long for an accurate comparison. Then a shorter step is tried. If each
sweep divides the error by four, 24 sweeps divide the error by 2^48.
"""

MORE_SWEEPS, FEW_DIGITS = 400, 60
"""If results in doubles differ, the step is repeated with FEW_DIGITS digits and up to MORE_SWEEPS sweeps."""

NOT_A_NUMBER = "differs by nan"
"""If a difference is not a number (NaN), its description ends with these words."""

APART = 16
"""If the results of a step cannot be compared, the next step is shorter by at least this factor."""

LARGEST = 2.0**512
"""Results above this number are not compared."""

CLOSE = 2.0**-200
"""Results with DIGITS digits count as equal up to this relative difference."""

AGREE = 2.0**-36
"""Results in doubles count as equal up to this relative difference.

This difference is far above rounding errors, which were at most 2^-51 in 170 comparisons on scenes of the
gallery. A wrong coefficient is found even if its error is only 2^-28
(``tests/codegen/passes/test_equivalence.py``).
"""


@dataclass(frozen=True)
class _Step:
    """One step of the reference program: the new state ``after``, and the solutions of implicit equations.

    - ``moved`` is True if the step begins near the initial state, and False if it begins at the initial
      state.
    - ``tiny`` is True for a step of :data:`TINY_STEPS`. Its results are compared relative to the change of
      the state.
    """

    domain: Domain
    inputs: dict[str, Value]
    after: dict[str, Value]
    solutions: dict[Var, Value]
    moved: bool
    tiny: bool = False


class _Bounded(PreciseDomain):
    """Arithmetic with many digits that raises an error if an iteration diverges."""

    def call(self, function: str, *args: Scalar) -> Scalar:
        """Return the value of a function.

        OverflowError is raised if the absolute value of an argument is above 10^(digits/2). For such an
        argument, only few digits of the result would be correct.
        """
        if any(abs(x) > self.rational(10) ** (self.digits // 2) for x in args):
            raise OverflowError(function)
        return super().call(function, *args)

    def settled(self, old: Sequence[Scalar], new: Sequence[Scalar], previous: Scalar) -> tuple[bool, Scalar]:
        """Return a pair: whether the iteration has converged, and the size of its last change.

        NotConverged is raised if the change is at least 10^digits, because the iteration then diverges.
        """
        done, change = super().settled(old, new, previous)
        if not change < self.rational(10) ** self.digits:
            raise NotConverged("a fixed-point iteration diverges")
        return done, change


class _Point:
    """The results of steps that begin at the same state, sorted by decreasing step size.

    Only the first result is computed at once. The others are computed when they are needed.
    """

    def __init__(self, more: Iterator[_Step]) -> None:
        self._more = more
        self.computed = list(islice(more, 1))

    def results(self) -> Iterator[_Step]:
        """Yield the results, first the result of the longest step."""
        yield from self.computed
        for result in self._more:
            self.computed.append(result)
            yield result


class Reference:
    """The reference for comparisons: the results of a program after one step from points of a scene.

    The steps begin at two points. One point is the initial state, which may be special (an equilibrium or a
    symmetric position). The other point is near the initial state and has no symmetry. From each point, the
    longest step with three properties is used: it does not exceed :data:`REACH`, its results are finite,
    and the iterations for its implicit equations converge.
    """

    def __init__(self, program: Program, scene: Problem) -> None:
        self.scene, self.program = scene, program
        self.kinds = {v.name: v.kind for v in program.inputs}
        points = [_Point(self._some(program, moved)) for moved in (False, True)]
        self.points = [point for point in points if point.computed]
        if not self.points:
            raise _no_step(scene)

    def _some(self, program: Program, moved: bool) -> Iterator[_Step]:
        """Yield the results of steps that begin at the same state. The longest step comes first.

        If ``moved`` is True, the steps begin near the initial state. Otherwise they begin at the initial
        state.
        """
        state = _state(self.scene, FloatDomain(0.0), moved)
        speed = _speed(self.scene, state)
        inputs = {name: state[name] for name in self.kinds}
        # Programs are compared by steps from two states. If the field is not finite at this state, only steps
        # from the other state are compared.
        if not math.isfinite(speed):
            return
        # After a division of STEPS[0] by 2**excess, its product with ``speed`` is at most REACH.
        excess = math.frexp(speed * STEPS[0] / REACH)[1]
        last = math.inf
        for moderate in STEPS:
            # Powers of h have no rounding errors if the step size is a power of two.
            step = math.ldexp(moderate, -max(excess, 0))
            if step <= last / APART and (result := self._step(program, FloatDomain(step), inputs, moved)):
                yield result
                last = step
        for power in TINY_STEPS:
            precise = self._precise(Fraction(1, 2 ** (power + max(excess, 0))), DIGITS, moved)
            if (result := self._step(program, *precise, moved, tiny=True)) and self._is_short(result, power):
                yield result

    def _precise(self, h: Fraction, digits: int, moved: bool) -> tuple[Domain, dict[str, Value]]:
        """Return an arithmetic with ``digits`` decimal digits for step size h, and the state at the start.

        This state is near the initial state if ``moved`` is True. Otherwise it is the initial state.
        """
        domain = _Bounded(h, digits)
        state = _state(self.scene, domain, moved)
        return domain, {name: state[name] for name in self.kinds}

    def _step(
        self, program: Program, domain: Domain, inputs: dict[str, Value], moved: bool, *, tiny: bool = False
    ) -> _Step | None:
        """Return the result of one step of a program, or None if the step cannot be computed."""
        # The solutions of the implicit equations are stored. When another program is compared with this one,
        # its iterations start from these solutions.
        solutions: dict[Var, Value] = {}
        # If the iteration does not converge, or numbers overflow, the step is too long.
        try:
            after = self._run(program, domain, inputs, (1 + tiny) * SWEEPS, solutions)
        except FAILURES:
            return None
        # Very large results are excluded. Another program with the same results may add in another order, and
        # its partial sums may overflow.
        finite = all(abs(x) < LARGEST for name in after for x in self._numbers(name, after))
        return _Step(domain, inputs, after, solutions, moved, tiny) if finite else None

    def _is_short(self, step: _Step, power: int) -> bool:
        """Return True if a step of size 2^-p, where p is ``power``, changes the state only slightly.

        Every number x of the state may change by at most 2^(-p/2) max(1, |x|).
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
        domain: Domain,
        inputs: dict[str, Value],
        limit: int,
        solutions: dict[Var, Value],
    ) -> dict[str, Value]:
        return interpret(program, self.scene, domain, inputs, limit=limit, newton=False, solutions=solutions)

    def differs(self, program: Program) -> str:
        """Return a description of the first difference between the results of ``program`` and the reference.

        If there is no difference, the result is ''. SceneError is raised if the programs cannot be compared
        at any point.
        """
        accounts = [self._in_some_step(program, point) for point in self.points]
        if all(account is None for account in accounts):
            raise _no_step(self.scene)
        return next(filter(None, accounts), "")

    def _in_some_step(self, program: Program, point: _Point) -> str | None:
        """Compare ``program`` with the reference in the longest possible step, and describe the difference.

        - If the programs agree, the result is ''.
        - If ``program`` fails in all steps, the result describes its last failure.
        - If the reference has no suitable step, the result is None.
        """
        failure = None
        for step in point.results():
            # In a long step, iterations may fail to converge and sums may overflow, so a shorter step is
            # tried.
            try:
                after = self._run(program, step.domain, step.inputs, 2 * SWEEPS, step.solutions)
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
        """Return True if the iterations of the reference program converge in arithmetic with many digits."""
        if step.tiny:
            return True
        domain, inputs = self._precise(Fraction(step.domain.h), FEW_DIGITS, step.moved)
        try:
            self._run(self.program, domain, inputs, MORE_SWEEPS, {})
        except FAILURES:
            return False
        return True

    def _by_newton(self, program: Program, step: _Step) -> str | None:
        """Solve the implicit equations of both programs by Newton's method with many digits, and compare.

        Return a description of the difference, or '' if there is none. If Newton's method fails, return None.
        """
        domain, inputs = self._precise(Fraction(step.domain.h), FEW_DIGITS, step.moved)
        solutions: dict[Var, Value] = {}
        try:
            first, second = (
                interpret(p, self.scene, domain, inputs, limit=SWEEPS, solutions=solutions)
                for p in (self.program, program)
            )
        except FAILURES:
            return None
        return self._gap(_Step(domain, inputs, first, {}, step.moved), second)

    def _confirmed(self, program: Program, step: _Step, account: str) -> str:
        """Repeat the step of both programs with many digits, and return the difference of the results.

        If there is no difference, return ''. If the step cannot be repeated, return ``account``, which
        describes the difference in doubles.
        """
        if NOT_A_NUMBER in account:
            return account
        domain, inputs = self._precise(Fraction(step.domain.h), FEW_DIGITS, step.moved)
        try:
            results = [self._run(p, domain, inputs, MORE_SWEEPS, {}) for p in (self.program, program)]
        except FAILURES:
            return account
        return self._gap(_Step(domain, inputs, results[0], {}, step.moved), results[1])

    def _gap(self, step: _Step, after: dict[str, Value]) -> str:
        for name in self.kinds:
            # An input that the step only reads, such as the time, has no new value to compare.
            if name not in step.after:
                continue
            x, y = (self._numbers(name, side) for side in (step.after, after))
            # Components may vanish by symmetry, so the comparison is absolute for small values.
            scale, agree = max(1.0, *(abs(s) for s in x)), AGREE
            if step.tiny:
                start = self._numbers(name, step.inputs)
                # The gap is compared with the change of the state. If the change is zero, the lower bound of
                # ``scale`` allows for rounding errors.
                change = max(abs(s - t) for s, t in zip(x, start, strict=True))
                scale, agree = max(change, scale * step.domain.rational(1, 10 ** (DIGITS - 100))), CLOSE
            gap = max(abs(s - t) for s, t in zip(x, y, strict=True))
            # The condition is written with ``not``, so that NaN counts as a difference.
            if not gap <= agree * scale:
                return f"{name} differs by {float(gap / (scale if step.tiny else 1)):.3g}"
        return ""


def _speed(scene: Problem, state: dict[str, Value]) -> float:
    """Return the largest component of the field, or of the derivatives of the Hamiltonian, at a state."""
    domain = FloatDomain(0.0)
    coordinates = tuple(x for block in scene.state for x in state[block.name])
    try:
        # A field that overflows or divides by zero counts as not finite.
        values = evaluate(scene.roots, domain, scene.values(domain, coordinates, state["t"]))
    except (ArithmeticError, ValueError):
        return math.inf
    return max(map(abs, map(float, values)))


def _no_step(scene: Problem) -> SceneError:
    """Return the error for a scene on which no step of a method can be computed."""
    return SceneError(
        "no step of the method can be computed from the initial state, nor from a state nearby",
        where=scene.name,
        expected="a field that is finite at these states, and stages solvable for small steps",
        hint="check the scene for roots of negative numbers, zero denominators, numbers above 1e308",
    )


def _state(scene: Problem, domain: Domain, moved: bool) -> dict[str, Value]:
    """Return the initial state, or a nearby state if ``moved`` is True.

    In the nearby state, the time is larger by 1/8, and a fixed covector is added to momenta. All other parts
    of the state are moved by a fixed group element.
    """
    start = scene.initial(domain)
    # The directions are sines of integers: numbers without symmetries, and the same in every run.
    directions = [_exactly(domain, math.sin(7.0 * k + 1.0) / 8) for k in range(2 * scene.group.dim)]
    x, covector = tuple(directions[: scene.group.dim]), directions[scene.group.dim :]
    state: dict[str, Value] = {"t": _exactly(domain, float(scene.span[0]) + moved / 8)}
    first = 0
    for block in scene.state:
        value = start[first : first + len(block.symbols)]
        first += len(block.symbols)
        # A covector is added to momenta. Other parts of the state are moved by a group element, so that they
        # stay on the manifold.
        if moved and block.kind is Kind.DUAL:
            value = tuple(a + b for a, b in zip(value, covector, strict=True))
        elif moved:
            value = tuple(scene.action.actexp(domain, scene.group, x, value))
        state[block.name] = value
    return state


def _exactly(domain: Domain, x: float) -> Scalar:
    return domain.rational(*x.as_integer_ratio())
