"""Running a method over a scene's span: the interpreter, in double or any precision, or an emitted module.

A :class:`Runner` hides which: it takes a number of steps and returns the final state. The same ladder of step
sizes can so be climbed by every executor of a program.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

from codegen.emission import Emission
from codegen.emit import emit_kernel
from codegen.errors import MethodError
from codegen.ir.domain import Domain, FloatDomain, NotConverged, PreciseDomain
from codegen.ir.interpret import flatten, interpret
from codegen.ir.program import Program
from codegen.load import Integrator, StepFailed, load
from codegen.lower import lower, setting
from codegen.lower.kernel import to_kernel
from codegen.method import Method
from codegen.passes import optimise
from codegen.printers.recipe import Recipe
from codegen.scene import Setting

TARGETS = ("c", "python", "interpreter")
DOUBLE = 16
"""Decimal digits up to which the interpreter uses doubles."""


class RunFailed(ArithmeticError):
    """A run that stopped: an iteration did not converge, or a number was not finite."""


class Runner(Protocol):
    """Executes one method on one scene."""

    target: str

    @property
    def epsilon(self) -> float:
        """Distance from 1 to the next number of the arithmetic."""

    @property
    def most_steps(self) -> int:
        """How many steps a ladder may take without keeping people waiting."""

    def final(self, steps: int) -> tuple[Any, ...]:
        """Return the state at the end of the span after that many equal steps; :class:`RunFailed`."""


@dataclass
class Interpreted:
    """The interpreter on the optimised step program, in ``digits`` decimal digits (16: doubles)."""

    scene: Setting
    method: Method
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
    def program(self) -> Program:
        """The step after all passes."""
        return optimise(lower(self.scene, self.method), self.view)[0]

    @cached_property
    def view(self) -> Setting:
        """The scene as the family sees it."""
        return setting(self.scene, self.method)

    def final(self, steps: int) -> tuple[Any, ...]:
        """Return the state at the end of the span."""
        h = (self.scene.span[1] - self.scene.span[0]) / steps
        double = self.digits <= DOUBLE
        domain: Domain = FloatDomain(float(h)) if double else PreciseDomain(h, self.digits)
        state, first = self.view.initial(domain), domain.rational(*self.scene.span[0].as_integer_ratio())
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
        inputs = {v.name: values[v.name] for v in self.program.inputs}
        try:
            found = interpret(self.program, self.view, domain, inputs)
        except (NotConverged, ZeroDivisionError, OverflowError, ValueError) as error:
            raise RunFailed(str(error)) from error
        return tuple(x for b in self.view.state for x in flatten(b.kind, found[b.name]))


@dataclass
class Emitted:
    """An emitted module, compiled and loaded: the same text that ``orderconds emit`` writes."""

    scene: Setting
    method: Method
    target: str = "c"
    epsilon = 2.0**-52

    @property
    def most_steps(self) -> int:
        """A second's worth."""
        return 81920 if self.target == "c" else 10240

    @cached_property
    def emission(self) -> Emission:
        """The module's files and manifest."""
        view = setting(self.scene, self.method)
        program, _ = optimise(lower(self.scene, self.method), view)
        recipe = Recipe(self.method.label, (), self.initial)
        return emit_kernel(to_kernel(program, view), recipe, self.target, "measured_")

    @cached_property
    def integrator(self) -> Integrator:
        """The loaded module."""
        return load(self.emission)

    @property
    def initial(self) -> tuple[float, ...]:
        """The scene's initial state in doubles."""
        return self.scene.initial(FloatDomain(0.0))

    def final(self, steps: int) -> tuple[float, ...]:
        """Return the state at the end of the span."""
        first, last = self.scene.span
        h = float((last - first) / steps)
        try:
            return tuple(self.integrator.run(list(self.initial), h, steps, float(first)))
        except StepFailed as error:
            raise RunFailed(str(error)) from error


def runner(scene: Setting, method: Method, target: str, digits: int = DOUBLE) -> Runner:
    """Return the runner of a target; ``digits`` above 16 are for the interpreter alone."""
    if target not in TARGETS:
        raise MethodError(f"unknown target {target!r}", expected=f"one of {', '.join(TARGETS)}")
    if digits > DOUBLE and target != "interpreter":
        raise MethodError(
            f"{digits} digits for the target {target}",
            expected="double precision",
            hint="add --target interpreter",
        )
    return Interpreted(scene, method, digits) if target == "interpreter" else Emitted(scene, method, target)
