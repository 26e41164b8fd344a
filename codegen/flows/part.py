"""Parts of a Hamiltonian: the formula of a part, and the exact flows recognised in the formula."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from codegen.groups.linear_algebra import Vector
from codegen.ir.differentiate import gradient
from codegen.ir.domain import SeriesDomain
from codegen.ir.expr import Expr, evaluate, walk
from codegen.ir.number import Number
from codegen.scene.flow import Flow
from codegen.scene.orbit import Orbit, orbit_of
from codegen.scene.problem import TIME, Problem
from orderconds.ring import QQ
from orderconds.ring.protocol import Element

Matrix = list[list[Fraction]]

CONSTANTS = SeriesDomain(QQ, 0)
"""The domain of exact rational numbers: power series in h of degree zero."""


@dataclass(frozen=True)
class Summand:
    """A part of a Hamiltonian, or a summand of a part. The exact flow of the part or summand is the
    composition of named flows, which commute."""

    flows: tuple[tuple[str, Flow], ...]

    @property
    def timed(self) -> bool:
        """True if a flow depends on the time."""
        return any(flow.timed for _, flow in self.flows)


@dataclass(frozen=True)
class Part:
    """A part of a Hamiltonian as the sum of summands with exact flows.

    If no closed form is known, there are no summands, and ``reason`` contains the reason.
    """

    name: str
    summands: tuple[Summand, ...]
    reason: str = ""

    @property
    def exact(self) -> bool:
        """True if the flow of the whole part is known."""
        return len(self.summands) == 1


@dataclass(frozen=True)
class Formula:
    """The formula of one part, with the derivatives that are needed to recognise its flow."""

    problem: Problem
    name: str
    root: Expr

    def whole(self, flow: Flow) -> Part:
        """Return the part with the exact flow ``flow``."""
        return Part(self.name, (Summand(((self.name, flow),)),))

    def refused(self, reason: str) -> Part:
        """Return the part without flows. ``reason`` says why no closed form is known."""
        return Part(self.name, (), reason)

    @property
    def qs(self) -> tuple[str, ...]:
        """The symbols of q."""
        return self.problem.state[0].symbols

    @property
    def mus(self) -> tuple[str, ...]:
        """The symbols of mu."""
        return self.problem.state[1].symbols

    @cached_property
    def by_q(self) -> list[Expr]:
        """The partial derivatives with respect to q."""
        return gradient(self.root, self.qs)

    @cached_property
    def by_mu(self) -> list[Expr]:
        """The partial derivatives with respect to mu."""
        return gradient(self.root, self.mus)

    @cached_property
    def timed(self) -> bool:
        """True if the formula contains the time."""
        return any(n.op == "sym" and n.payload == TIME for n in walk([self.root]))

    @cached_property
    def orbit(self) -> Orbit:
        """The problem with sample points. Two formulas count as equal if they agree at these points."""
        return orbit_of(self.problem)

    def constants(self, roots: Sequence[Expr], q: Vector[Element]) -> list[Fraction] | None:
        """Return the values of the formulas ``roots`` at (q, mu = 0). The result is None if a value is not a
        rational number, or if a formula contains the time or a run-time parameter."""
        symbols = {n.payload for n in walk(roots) if n.op == "sym"}
        if symbols & {*self.problem.runtime, TIME}:
            return None
        state = (*q, *(CONSTANTS.rational(0) for _ in self.mus))
        try:
            values = evaluate(roots, CONSTANTS, self.problem.values(CONSTANTS, state))
        except (ArithmeticError, ValueError):
            return None
        return [Number(QQ, x.coefficients[0]).fraction() for x in values]

    def matrix(self, slopes: Sequence[Expr], names: Sequence[str], q: Vector[Element]) -> Matrix | None:
        """Return the matrix of derivatives of ``slopes`` with respect to the symbols ``names``, at q and mu =
        0.

        The result is None if :meth:`constants` returns None for a row.
        """
        rows = [self.constants(gradient(slope, names), q) for slope in slopes]
        return None if any(row is None for row in rows) else [row for row in rows if row is not None]
