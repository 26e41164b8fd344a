"""The parts of a Hamiltonian, with their formulas and their exact flows."""

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
"""Exact arithmetic with rational numbers."""


@dataclass(frozen=True)
class Summand:
    """A summand of a Hamiltonian, with its exact flow.

    The exact flow is the composition of the flows in ``flows``. These flows commute. Each entry of ``flows``
    is a pair (name, flow).
    """

    flows: tuple[tuple[str, Flow], ...]

    @property
    def timed(self) -> bool:
        """True if a flow in ``flows`` depends on the time."""
        return any(flow.timed for _, flow in self.flows)


@dataclass(frozen=True)
class Part:
    """A part of a Hamiltonian.

    If the part is a sum of summands with known exact flows, ``summands`` contains them. Otherwise
    ``summands`` is empty, and ``reason`` says why no exact flow is known.
    """

    name: str
    summands: tuple[Summand, ...]
    reason: str = ""

    @property
    def exact(self) -> bool:
        """True if the part consists of one summand. The exact flow of the part is then known, because it is
        the exact flow of this summand.
        """
        return len(self.summands) == 1


@dataclass(frozen=True)
class Formula:
    """The formula of one part of a Hamiltonian, and its partial derivatives.

    The derivatives are used to find the exact flow of the part.
    """

    problem: Problem
    name: str
    root: Expr

    def whole(self, flow: Flow) -> Part:
        """Return a :class:`Part` with a single summand. The exact flow of this summand is ``flow``."""
        return Part(self.name, (Summand(((self.name, flow),)),))

    def refused(self, reason: str) -> Part:
        """Return a :class:`Part` without summands. ``reason`` says why no exact flow is known."""
        return Part(self.name, (), reason)

    @property
    def qs(self) -> tuple[str, ...]:
        """The names of the coordinates of the position q."""
        return self.problem.state[0].symbols

    @property
    def mus(self) -> tuple[str, ...]:
        """The names of the coordinates of the momentum mu."""
        return self.problem.state[1].symbols

    @cached_property
    def by_q(self) -> list[Expr]:
        """The partial derivatives of the formula with respect to the coordinates of q."""
        return gradient(self.root, self.qs)

    @cached_property
    def by_mu(self) -> list[Expr]:
        """The partial derivatives of the formula with respect to the coordinates of mu."""
        return gradient(self.root, self.mus)

    @cached_property
    def timed(self) -> bool:
        """True if the formula contains the time."""
        return any(n.op == "sym" and n.payload == TIME for n in walk([self.root]))

    @cached_property
    def orbit(self) -> Orbit:
        """The sample points at which formulas of the problem are compared. If two formulas agree at all
        sample points, the compiler treats them as equal.
        """
        return orbit_of(self.problem)

    def constants(self, roots: Sequence[Expr], q: Vector[Element]) -> list[Fraction] | None:
        """Return the values of the formulas ``roots`` at the position q and the momentum mu = 0.

        The result is None if a value is not a rational number, or if a formula contains the time or a
        parameter that is set at run time.
        """
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
        """Return the matrix of the derivatives of the formulas ``slopes`` with respect to the symbols
        ``names``, at the position q and the momentum mu = 0.

        The result is None if an entry is not a rational number, or if an entry contains the time or a
        parameter that is set at run time.
        """
        rows = [self.constants(gradient(slope, names), q) for slope in slopes]
        return None if any(row is None for row in rows) else [row for row in rows if row is not None]
