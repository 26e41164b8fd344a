"""Emitted functions of a continuous extension (dense output) of a step.

The function EXTEND computes the coefficients of the extension. The function EXTENDED applies exp(x) to the
old state. Here x is the polynomial in theta with these coefficients, and theta is the fraction of the step.
"""

from __future__ import annotations

from codegen.ir.kernel import Continuous
from codegen.run.arithmetic import computed, filling, loaded, sampled, stored
from codegen.run.language import RAISES_NAN, Array, Assign, Call, For, Function, Statement
from codegen.run.plan import Plan
from codegen.run.terms import Term, count, real, value, whole

EXTEND, MOVED, EXTENDED = "extend", "moved_by", "extended_state"
"""The names of three emitted functions of a continuous extension.

- EXTEND computes the coefficients of the extension.
- MOVED applies exp(x) to a state, where x is an element of the Lie algebra.
- EXTENDED computes the state at a time inside the step.
"""


class DenseOutput:
    """Builds the functions of a continuous extension, and the calls of these functions."""

    theta = real("theta")

    def __init__(self, plan: Plan, extension: Continuous) -> None:
        self.plan, self.extension = plan, extension
        self.own = Plan(extension.coefficients, plan.format)
        self.mover = Plan(extension.moved, plan.format)
        # The kernel ``extension.moved`` applies exp(x) to a state, where x is an element of the Lie algebra.
        # ``width`` is the number of coordinates of x.
        self.width = self.mover.size - plan.size
        # The extension is a polynomial in theta with one coefficient for each power from 1 to ``degree``.
        self.powers = real("powers", extension.degree * self.width)
        self.inner = plan.state("inner")

    def functions(self) -> tuple[Function, ...]:
        """Return the functions of the continuous extension.

        Each function comes after the functions that it calls.
        """
        about = (
            "Apply exp(x) to a state, where x is an element of the Lie algebra. The first array contains the "
            "state and then the coordinates of x."
        )
        return self.extend(), filling(self.mover, MOVED, about, self.inner), self.extended()

    def extend(self) -> Function:
        """Return the emitted function that computes the coefficients of the extension."""
        own, state = self.own, self.plan.state()
        body: list[Statement] = [
            *sampled(own),
            *loaded(own.symbols, state, own.arrangement.symbols()),
            *computed(own),
            *stored(self.powers, [value(x) for x in own.arrangement.outputs]),
        ]
        parameters = (state, *own.moment(), *own.parameters, *own.sampled(), self.powers)
        about = (
            "The continuous extension of a step applies exp(x) to the old state, where x is a polynomial in "
            "theta. Compute the coefficients of theta, theta^2, ... in x."
        )
        return Function(EXTEND, about, parameters, tuple(body), guard=RAISES_NAN)

    def extended(self) -> Function:
        """Return the emitted function that computes the state at a fraction theta of a step."""
        plan, state, m = self.plan, self.plan.state(), self.width
        pair, i, total = real("pair", self.mover.size), count("i"), real("total")
        # ``powers`` contains the coefficients of theta, theta^2, ... in this order, each with m coordinates.
        # Therefore coordinate i of the coefficient of theta^(p + 1) has the index i + p * m.
        entries = [self.powers[i + p * m] for p in range(self.extension.degree)]
        # The polynomials in theta have no constant term. For each polynomial, Horner's rule computes the
        # factor ``total``. The polynomial is theta times ``total``.
        horner = [Assign(total, total * self.theta + x) for x in reversed(entries[:-1])]
        # The result is exp(x) applied to the old state, where the coordinates of x are polynomials in theta.
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
        about = "Compute the state at the time t + theta h during a step from t to t + h."
        return Function(EXTENDED, about, parameters, body)

    def coefficients(self, state: Term, t: Term, h: Term) -> Call:
        """Return the call that computes the coefficients of the extension for one step.

        The step begins at the time ``t`` and at ``state``, and it has the size ``h``.
        """
        own = self.own
        return Call(EXTEND, (state, *own.moment(t, h), *own.parameters, *own.sampled(), self.powers))

    def state_at(self, state: Term, theta: Term) -> Call:
        """Return the call that computes the state at the fraction ``theta`` of a step.

        The step begins with ``state``.
        """
        return Call(EXTENDED, (state, self.powers, theta, self.inner))
