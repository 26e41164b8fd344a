"""Comparison of formulas at sample points on the orbit of the initial state under the group.

Two formulas may be equal on the orbit but different outside the orbit.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING

from codegen.errors import SceneError
from codegen.groups.actions import Action
from codegen.groups.base import LieGroup
from codegen.ir.domain import PreciseDomain
from codegen.ir.expr import Expr, evaluate
from codegen.ir.number import Number
from codegen.scene.problem import TIME, Problem

if TYPE_CHECKING:
    import mpmath

DIGITS = 40
TOLERANCE = Fraction(1, 10**20)
"""The relative tolerance of the test whether a sum is zero: |sum| <= TOLERANCE * (sum of |terms|) + FLOOR.
"""

FLOOR = Fraction(1, 10**28)
"""The absolute tolerance of the test whether a sum is zero. A relative tolerance is not enough if all terms
of the sum are rounding errors.
"""

POINTS = 4
"""The largest number of sample points of an :class:`Orbit`."""


@dataclass(frozen=True)
class Orbit:
    """A problem y' = f(y).y, and sample points on the orbit of its initial state.

    ``symbols`` are the coordinates, ``start`` is the initial state, and ``roots`` are the components of f.
    For a Hamiltonian problem, y is (q, mu), and the group T*G acts on itself by left multiplication.
    """

    name: str
    group: LieGroup
    action: Action
    symbols: tuple[str, ...]
    start: tuple[Expr, ...]
    roots: tuple[Expr, ...]
    span: tuple[Fraction, Fraction]
    parameters: Mapping[str, Number]

    @cached_property
    def domain(self) -> PreciseDomain:
        """The number domain of all computations: floating-point numbers with 40 digits."""
        return PreciseDomain(0, DIGITS)

    @cached_property
    def points(self) -> tuple[dict[str, mpmath.mpf], ...]:
        """The values of all symbols at the initial state and at random points of its orbit.

        Points where f is not finite are omitted. :class:`SceneError` is raised if f is not finite at the
        initial state.
        """
        d, rng = self.domain, random.Random("orbit")
        constants = {name: d.number(x) for name, x in self.parameters.items()}
        y0 = self._start(constants)
        points: list[dict[str, mpmath.mpf]] = []
        first, last = (d.rational(*x.as_integer_ratio()) for x in self.span)
        for k in range(POINTS):
            x = tuple(d.rational(rng.randint(-99, 99), 100) for _ in range(self.group.dim))
            y = self.action.act(d, self.group, self.group.exp(d, x), y0) if k else y0
            t = first + (last - first) * d.rational(k, POINTS)
            values = {**dict(zip(self.symbols, y, strict=True)), **constants, TIME: t}
            if self._finite(self.values(self.roots, values)):
                points.append(values)
            elif not k:
                raise SceneError(
                    "f at the initial state is not a finite real number",
                    where=self.name,
                    expected="an initial state where f is smooth",
                )
        return tuple(points)

    def _start(self, constants: dict[str, mpmath.mpf]) -> tuple[mpmath.mpf, ...]:
        start = self.values(self.start, constants)
        if start is None or not self._finite(start):
            raise SceneError(
                "a coordinate of the initial state is not a finite real number",
                where=self.name,
                expected="real numbers",
            )
        return start

    def values(self, roots: Sequence[Expr], values: dict[str, mpmath.mpf]) -> tuple[mpmath.mpf, ...] | None:
        """Return the values of the formulas ``roots``, or None if a formula cannot be evaluated."""
        try:
            return tuple(evaluate(roots, self.domain, values))
        except (ArithmeticError, ValueError):
            return None

    def _finite(self, values: Sequence[mpmath.mpf] | None) -> bool:
        context = self.domain.context
        return values is not None and all(isinstance(x, context.mpf) and context.isfinite(x) for x in values)

    def velocity(self, point: dict[str, mpmath.mpf]) -> tuple[mpmath.mpf, ...]:
        """Return the time derivatives of the coordinates at a sample point."""
        f = tuple(evaluate(self.roots, self.domain, point))
        y = tuple(point[s] for s in self.symbols)
        return self.action.velocity(self.domain, self.group, f, y)

    def sized(self, total: mpmath.mpf, terms: Sequence[mpmath.mpf]) -> bool:
        """Return True if the sum ``total`` of ``terms`` is zero up to rounding errors."""
        size = sum((abs(x) for x in terms), self.domain.rational(0))
        relative, absolute = (self.domain.rational(*x.as_integer_ratio()) for x in (TOLERANCE, FLOOR))
        return bool(abs(total) <= relative * size + absolute)

    def vanish(self, roots: Sequence[Expr]) -> bool:
        """Return True if all formulas in ``roots`` are zero, up to rounding, at all sample points.

        If a formula cannot be evaluated at one of the points, the result is False.
        """
        values = [self.values(roots, point) for point in self.points]
        return all(row is not None and all(self.sized(x, (1,)) for x in row) for row in values)

    def text(self, x: mpmath.mpf) -> str:
        """Return a number as text for a message."""
        return str(self.domain.context.nstr(x, 6))


def orbit_of(problem: Problem) -> Orbit:
    """Return the :class:`Orbit` of a problem."""
    field = problem.as_field()
    start = tuple(e for block in field.state for e in block.initial)
    return Orbit(
        *(field.name, field.group, field.action, field.symbols, start),
        *(field.roots, field.span, field.parameters),
    )
