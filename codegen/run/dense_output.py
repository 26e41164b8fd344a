"""Functions of a continuous extension: the coefficients of a step, and the state at a time inside the step.

The coefficients cost as much as a step. Each state inside the step then costs one polynomial and one
exponential.
"""

from __future__ import annotations

from codegen.ir.kernel import Continuous
from codegen.run.arithmetic import computed, filling, loaded, sampled, stored
from codegen.run.language import RAISES_NAN, Array, Assign, Call, For, Function, Statement
from codegen.run.plan import Plan
from codegen.run.terms import Term, count, real, value, whole

EXTEND, MOVED, EXTENDED = "extend", "moved_by", "extended_state"
"""The names of the functions of a continuous extension."""


class DenseOutput:
    """Builds the functions of a continuous extension, and the calls of these functions."""

    theta = real("theta")

    def __init__(self, plan: Plan, extension: Continuous) -> None:
        self.plan, self.extension = plan, extension
        self.own = Plan(extension.coefficients, plan.format)
        self.mover = Plan(extension.moved, plan.format)
        # The mover reads a state and the coordinates of an element of the Lie algebra. ``width`` is the
        # number of these coordinates, the dimension of the algebra.
        self.width = self.mover.size - plan.size
        # The extension is a polynomial in theta with one coefficient for each power from 1 to ``degree``.
        self.powers = real("powers", extension.degree * self.width)
        self.inner = plan.state("inner")

    def functions(self) -> tuple[Function, ...]:
        """Return the functions, callees first."""
        about = "Apply exp(x) to a state; the coordinates x in the Lie algebra follow the state in the array."
        return self.extend(), filling(self.mover, MOVED, about, self.inner), self.extended()

    def extend(self) -> Function:
        """Return the emitted function that computes the coefficients of the extension of a step."""
        own, state = self.own, self.plan.state()
        body: list[Statement] = [
            *sampled(own),
            *loaded(own.symbols, state, own.arrangement.symbols()),
            *computed(own),
            *stored(self.powers, [value(x) for x in own.arrangement.outputs]),
        ]
        parameters = (state, *own.moment(), *own.parameters, *own.sampled(), self.powers)
        about = (
            "The continuous extension of a step: the coefficients of theta, theta^2, ... of the coordinates."
        )
        return Function(EXTEND, about, parameters, tuple(body), guard=RAISES_NAN)

    def extended(self) -> Function:
        """Return the emitted function that computes the state at a fraction theta of a step."""
        plan, state, m = self.plan, self.plan.state(), self.width
        pair, i, total = real("pair", self.mover.size), count("i"), real("total")
        # Coordinate i of the coefficient of theta^(p + 1) is at the place i + p m.
        entries = [self.powers[i + p * m] for p in range(self.extension.degree)]
        # The polynomial has no constant term, because the extension begins at the state. The last product
        # with theta is therefore separate.
        horner = [Assign(total, total * self.theta + x) for x in reversed(entries[:-1])]
        # The state and the coordinates x are in one array, because the mover has a single argument.
        body = (
            Array(pair),
            Assign(pair.part(0, plan.size), state),
            For(
                i,
                whole(m),
                (Assign(total, entries[-1]), *horner, Assign(pair[i + plan.size], self.theta * total)),
            ),
            Call(MOVED, (pair, self.inner)),
        )
        parameters = (state, self.powers, self.theta, self.inner)
        about = "The state inside a step, at the fraction theta of the step."
        return Function(EXTENDED, about, parameters, body)

    def coefficients(self, state: Term, t: Term, h: Term) -> Call:
        """Return the call that computes the coefficients of the step from ``state`` at the time ``t`` with
        size ``h``."""
        own = self.own
        return Call(EXTEND, (state, *own.moment(t, h), *own.parameters, *own.sampled(), self.powers))

    def state_at(self, state: Term, theta: Term) -> Call:
        """Return the call for the state at the fraction ``theta`` of a step that begins with ``state``."""
        return Call(EXTENDED, (state, self.powers, theta, self.inner))
