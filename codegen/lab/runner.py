"""Running a method over a scene's span: the interpreter, in double or any precision, or an emitted module.

A :data:`Runner` hides which: it takes a number of steps and returns the final state, so that every
executor of a program climbs the same ladder of step sizes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from codegen.artifact import Artifact
from codegen.certify import CertifiedOrder
from codegen.emitter import Compiled, Optimised, compile_method, emit_compiled
from codegen.errors import MethodError
from codegen.ir.domain import Domain, FloatDomain, NotConverged, PreciseDomain
from codegen.ir.interpret import flatten, interpret
from codegen.loader import Integrator, Statistics, StepFailed, load
from codegen.lower import problem_for
from codegen.method import Method
from codegen.scene.problem import Problem

TARGETS = ("c", "python", "interpreter")
DOUBLE = 16
"""Decimal digits up to which the interpreter uses doubles."""


class RunFailed(ArithmeticError):
    """A run that stopped: an iteration did not converge, or a number was not finite."""


@dataclass
class Interpreted:
    """The interpreter on the optimised step program, in ``digits`` decimal digits (16: doubles)."""

    compiled: Optimised
    digits: int = DOUBLE
    target: str = "interpreter"

    @property
    def epsilon(self) -> float:
        """2^-52 for doubles, else 10^(1 - digits)."""
        return 2.0**-52 if self.digits <= DOUBLE else 10.0 ** (1 - self.digits)

    @property
    def most_steps(self) -> int:
        """About ten seconds' worth."""
        return 1280 if self.digits <= DOUBLE else 320

    @cached_property
    def view(self) -> Problem:
        """The scene as the family sees it."""
        return problem_for(self.compiled.scene, self.compiled.method)

    def final(self, steps: int) -> tuple[Any, ...]:
        """Return the state at the end of the span."""
        start, end = self.view.span
        h = (end - start) / steps if steps else end - start
        double = self.digits <= DOUBLE
        domain: Domain = FloatDomain(float(h)) if double else PreciseDomain(h, self.digits)
        state, first = self.view.initial(domain), domain.rational(*start.as_integer_ratio())
        for k in range(steps):
            state = self._step(domain, state, first + k * domain.h)
        return state

    def _step(self, domain: Domain, state: Sequence[Any], t: Any) -> tuple[Any, ...]:
        values: dict[str, Any] = {"t": t}
        start = 0
        for block in self.view.state:
            end = start + len(block.symbols)
            values[block.name] = tuple(state[start:end])
            start = end
        program = self.compiled.program
        inputs = {v.name: values[v.name] for v in program.inputs}
        try:
            found = interpret(program, self.view, domain, inputs)
        except (NotConverged, ZeroDivisionError, OverflowError, ValueError) as error:
            raise RunFailed(str(error)) from error
        return tuple(x for b in self.view.state for x in flatten(b.kind, found[b.name]))


@dataclass
class Emitted:
    """An emitted module, compiled and loaded: the same text that ``orderconds emit`` writes."""

    compiled: Compiled
    target: str
    order: CertifiedOrder | None = None
    epsilon = 2.0**-52

    @property
    def most_steps(self) -> int:
        """About a second's worth."""
        return 81920 if self.target == "c" else 10240

    @cached_property
    def emission(self) -> Artifact:
        """The module's files and manifest."""
        return emit_compiled(self.compiled, self.target, order=self.order)

    @cached_property
    def integrator(self) -> Integrator:
        """The loaded module."""
        return load(self.emission)

    @cached_property
    def twin(self) -> Emitted:
        """The same step emitted to Python, which can be looked into."""
        return Emitted(self.compiled, "python", self.order)

    @cached_property
    def initial(self) -> list[float]:
        """The scene's initial state in doubles."""
        return list(self.compiled.scene.initial(FloatDomain(0.0)))

    def final(self, steps: int, statistics: Statistics | None = None) -> tuple[float, ...]:
        """Return the state at the end of the span; ``statistics`` counts what blocks took."""
        first, last = self.compiled.scene.span
        h = float((last - first) / max(steps, 1))
        try:
            return tuple(self.integrator.run(self.initial, h, steps, float(first), statistics))
        except StepFailed as error:
            raise RunFailed(str(error)) from error


Runner = Interpreted | Emitted
"""Executes one compiled method over its scene's span: ``target``, ``final``, ``epsilon``, ``most_steps``."""


def runner(
    scene: Problem, method: Method, target: str, digits: int = DOUBLE, order: CertifiedOrder | None = None
) -> Runner:
    """Return the runner of a target.

    ``digits`` above 16 are for the interpreter alone; ``order`` is the method's, where it is known already.
    """
    if target not in TARGETS:
        raise MethodError(f"unknown target {target!r}", expected=f"one of {', '.join(TARGETS)}")
    if digits > DOUBLE and target != "interpreter":
        raise MethodError(
            f"{digits} digits for the target {target}",
            expected="double precision",
            hint="add --target interpreter",
        )
    compiled = compile_method(scene, method)
    return Interpreted(compiled, digits) if target == "interpreter" else Emitted(compiled, target, order)
