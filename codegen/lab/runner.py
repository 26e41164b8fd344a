"""Runs a method over the time span of a scene, with the interpreter or with an emitted module.

A :data:`Runner` computes the final state after a given number of steps.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from codegen import printers
from codegen.artifact import Artifact
from codegen.certify import CertifiedOrder
from codegen.emitter import Compiled, Optimised, compile_method, emit_compiled
from codegen.errors import MethodError
from codegen.integrator import Integrator, Statistics, StepFailed
from codegen.ir.ball_domain import BallDomain
from codegen.ir.domain import Domain, FloatDomain, NotConverged, PreciseDomain
from codegen.ir.interpret import flatten, interpret
from codegen.lab.number_types import Scalar, Vector
from codegen.loader import load
from codegen.lower import problem_for
from codegen.method import Method
from codegen.scene.problem import Problem

INTERPRETER = "interpreter"
"""The name that selects the interpreter in place of a target such as C or Python."""

DOUBLE = 16
"""The interpreter computes with doubles if at most DOUBLE decimal digits are requested."""


class RunFailed(ArithmeticError):
    """Raised if a run stops before the end of the time span.

    For example, an iteration does not converge, or a number is not finite.
    """


@dataclass
class Interpreted:
    """A runner that executes the optimised program of a step with the interpreter.

    If ``digits`` is at most 16, the runner computes with doubles, and the final state contains floats.
    Otherwise the runner computes with ``digits`` decimal digits, and the final state contains mpmath numbers.
    """

    compiled: Optimised
    digits: int = DOUBLE
    target: str = INTERPRETER

    @property
    def epsilon(self) -> float:
        """The machine epsilon: 2^-52 for doubles, otherwise 10^(1 - ``digits``)."""
        return 2.0**-52 if self.digits <= DOUBLE else 10.0 ** (1 - self.digits)

    @property
    def most_steps(self) -> int:
        """The largest number of steps in a convergence test.

        A run with this number of steps takes about ten seconds.
        """
        return 1280 if self.digits <= DOUBLE else 320

    @cached_property
    def domain(self) -> Domain:
        """The arithmetic of the result of :meth:`final`: double precision, or mpmath with more digits."""
        return FloatDomain(0.0) if self.digits <= DOUBLE else PreciseDomain(0, self.digits)

    @cached_property
    def problem(self) -> Problem:
        """The scene in the form that the method requires, for example as a Hamiltonian system."""
        return problem_for(self.compiled.scene, self.compiled.method)

    def final(self, steps: int) -> Vector:
        """Integrate over the time span in ``steps`` steps of equal size, and return the final state.

        Raises :class:`RunFailed` if a step fails.
        """
        start, end = self.problem.span
        h = (end - start) / steps if steps else end - start
        if self.digits <= DOUBLE:
            final = self._run(FloatDomain(float(h)), steps)
            if not all(map(math.isfinite, final)):
                raise RunFailed("the run computes a number that is not finite")
            return final
        # Arb balls are several times faster than mpmath numbers.
        domain = BallDomain(h, self.digits)
        with domain.precision():
            state = self._run(domain, steps)
        # In ball arithmetic, a division by zero raises no error.
        if not all(x.is_finite() for x in state):
            raise RunFailed("the run computes a number that is not finite")
        context = PreciseDomain(0, self.digits).context
        return tuple(domain.mpf(x, context) for x in state)

    def _run(self, domain: Domain, steps: int) -> Vector:
        """Return the state after ``steps`` steps of size ``domain.h``."""
        start, _ = self.problem.span
        state, first = self.problem.initial(domain), domain.rational(*start.as_integer_ratio())
        for k in range(steps):
            state = self._step(domain, state, first + k * domain.h)
        return state

    def _step(self, domain: Domain, state: Vector, t: Scalar) -> Vector:
        values: dict[str, Scalar] = {"t": t, **split_state(self.problem, state)}
        program = self.compiled.program
        inputs = {v.name: values[v.name] for v in program.inputs}
        try:
            outputs = interpret(program, self.problem, domain, inputs)
        except (NotConverged, ZeroDivisionError, OverflowError, ValueError) as error:
            raise RunFailed(str(error)) from error
        return tuple(x for b in self.problem.state for x in flatten(b.kind, outputs[b.name]))


def split_state(problem: Problem, state: Sequence[Scalar]) -> dict[str, Vector]:
    """Return a dictionary that maps the name of each state component to the coordinates of the component."""
    fields: dict[str, Vector] = {}
    start = 0
    for field in problem.state:
        end = start + len(field.symbols)
        fields[field.name] = tuple(state[start:end])
        start = end
    return fields


@dataclass
class Emitted:
    """A runner that executes the emitted module of a compiled method, in double precision."""

    compiled: Compiled
    target: str = printers.DEFAULT
    order: CertifiedOrder | None = None
    epsilon = 2.0**-52
    domain = FloatDomain(0.0)

    @property
    def most_steps(self) -> int:
        """The largest number of steps in a convergence test.

        A run with this number of steps takes about one second.
        """
        return printers.target(self.target).most_steps

    @cached_property
    def artifact(self) -> Artifact:
        """The emitted files of the module, and its manifest (a description of the module)."""
        return emit_compiled(self.compiled, self.target, order=self.order)

    @cached_property
    def integrator(self) -> Integrator:
        """The loaded module. One function of the module makes a single step, and another makes many steps."""
        return load(self.artifact)

    @cached_property
    def observed(self) -> Emitted:
        """A runner whose emitted module also returns the solutions of the implicit equations.

        The new runner executes the same method, and uses a target that can emit such a module.
        """
        return Emitted(self.compiled, printers.observable().name, self.order)

    @cached_property
    def initial(self) -> list[float]:
        """The initial state of the scene in doubles."""
        return list(self.compiled.scene.initial(FloatDomain(0.0)))

    def final(self, steps: int, statistics: Statistics | None = None, spans: int = 1) -> tuple[float, ...]:
        """Return the final state of a run over ``spans`` time spans, with ``steps`` equal steps in each span.

        ``statistics`` records the iterations that solve the implicit equations of the steps. Raises
        :class:`RunFailed` if a step fails.
        """
        first, last = self.compiled.scene.span
        h = float((last - first) / max(steps, 1))
        try:
            return tuple(self.integrator.run(self.initial, h, spans * steps, float(first), statistics))
        except StepFailed as error:
            raise RunFailed(str(error)) from error


Runner = Interpreted | Emitted
"""An object that solves the differential equation of a scene with a numerical method.

Every runner has the attributes ``target``, ``epsilon``, ``domain`` and ``most_steps``, and the member
function ``final``.
"""


def check_target(target: str, digits: int = DOUBLE) -> None:
    """Check that a target is known and can compute with ``digits`` decimal digits.

    Raises :class:`codegen.errors.MethodError` if a condition fails.
    """
    known = (*printers.names(), INTERPRETER)
    if target not in known:
        raise MethodError(f"unknown target {target!r}", expected=f"one of {', '.join(known)}")
    if digits > DOUBLE and target != INTERPRETER:
        raise MethodError(
            f"the target {target} cannot compute with {digits} digits",
            expected=f"at most {DOUBLE} digits, because emitted code uses double precision",
            hint="add --target interpreter",
        )


def runner(
    scene: Problem, method: Method, target: str, digits: int = DOUBLE, order: CertifiedOrder | None = None
) -> Runner:
    """Return a runner of a method on a scene.

    ``target`` is the name of a target such as ``c``, or ``interpreter``. More than 16 decimal ``digits``
    require the interpreter. ``order`` is the order of the method, if the caller already knows it. Raises
    :class:`codegen.errors.MethodError` if the target is unknown, or if the target cannot compute with
    ``digits`` digits.
    """
    check_target(target, digits)
    compiled = compile_method(scene, method)
    return Interpreted(compiled, digits) if target == INTERPRETER else Emitted(compiled, target, order)
