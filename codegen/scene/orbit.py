"""Comparison of formulas at sample points on the orbit of the initial state under the group.

Two formulas may be equal on the orbit but different outside the orbit.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property

from codegen.errors import SceneError
from codegen.groups.actions import Action
from codegen.groups.base import LieGroup
from codegen.ir.expr import Expr, evaluate
from codegen.ir.number import Number
from codegen.ir.rounding_domain import RoundingDomain, Sized
from codegen.ir.smoothness import combinations, on_sides, selections
from codegen.scene.problem import TIME, Problem

DIGITS = 40
TOLERANCE = Fraction(1, 10**20)
"""The relative tolerance of the test whether a sum is zero: |sum| is at most TOLERANCE * (sum of |terms|), or
|sum| is as small as the rounding errors of the terms (:mod:`codegen.ir.rounding_domain`).

Both bounds are proportional to the terms, so that the test does not depend on the units of the scene.
"""

POINTS = 4
"""The largest number of sample points of an :class:`Orbit`. The points of :data:`NEAR` are not counted.

The first sample point is the initial state. The distances of the other sample points from the initial state
are about 1.
"""

NEAR, NEAR_STEPS = 2, 100
"""NEAR is the largest number of sample points near the initial state. The time between these points is the
time span of the scene divided by NEAR_STEPS.

NEAR is 2, because one point is not sufficient if the force is zero at the initial state: the momentum at the
first point can equal the initial momentum. The momentum at the second point is usually different.
"""

LEAST = 1e-3
"""If a run-time parameter is smaller than LEAST or larger than 1/LEAST, formulas are also compared for values
of the run-time parameters between LEAST and 1 (:func:`variants`).
"""


@dataclass(frozen=True)
class Orbit:
    """A problem y' = f(y).y, and sample points on the orbit of its initial state.

    ``symbols`` are the coordinates, ``start`` is the initial state, and ``roots`` are the components of f.
    ``parameters`` are the default values of the parameters. Each entry of ``others`` contains other values
    (:func:`variants`).
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
    others: tuple[Mapping[str, Number], ...]

    @cached_property
    def domain(self) -> RoundingDomain:
        """The arithmetic of all computations: floating-point arithmetic with 40 digits that also estimates
        the rounding error of each number."""
        return RoundingDomain(0, DIGITS)

    @property
    def changing(self) -> tuple[str, ...]:
        """The parameters whose values differ between sample points."""
        own = self.parameters
        return tuple(name for name in own if any(other[name] != own[name] for other in self.others))

    @cached_property
    def points(self) -> tuple[dict[str, Sized], ...]:
        """The values of all symbols at the initial state and at random points of its orbit.

        Points where f is not finite are omitted. :class:`SceneError` is raised if f is not finite at the
        initial state for the default values of the parameters.
        """
        points = self._around(self.parameters)
        for values in self.others:
            # Formulas may be undefined for other values of the parameters.
            with suppress(SceneError):
                points += self._around(values)
        return tuple(points)

    def _around(self, parameters: Mapping[str, Number]) -> list[dict[str, Sized]]:
        """Return the sample points for these values of the parameters.

        SceneError is raised if the initial state is not finite, or if f is not finite there.
        """
        d, rng = self.domain, random.Random("orbit")
        constants = {name: d.number(x) for name, x in parameters.items()}
        y0 = self._start(constants)
        points: list[dict[str, Sized]] = []
        for k in range(POINTS):
            x = tuple(d.rational(rng.randint(-99, 99), 100) for _ in range(self.group.dim))
            y = self.action.act(d, self.group, self.group.exp(d, x), y0) if k else y0
            values = self._at(y, Fraction(k, POINTS), constants)
            if self._finite(self.values(self.roots, values)):
                points.append(values)
            elif not k:
                raise SceneError(
                    "f at the initial state is not a finite real number",
                    where=self.name,
                    expected="an initial state where f is smooth",
                )
        return [*points, *self._near(points[0], constants, rng)]

    def _near(
        self, start: dict[str, Sized], constants: dict[str, Sized], rng: random.Random
    ) -> list[dict[str, Sized]]:
        """Return points near the initial state.

        The points are about as far from the initial state as the solution moves in 1/:data:`NEAR_STEPS` of
        the time span.

        If the typical values of a coordinate are far below 1, points at distances of about 1 from the initial
        state are not sufficient. At such points, some terms of a formula may be smaller than the rounding
        errors of other terms.
        """
        d, points, point = self.domain, [], start
        for k in range(1, NEAR + 1):
            share = (self.span[1] - self.span[0]) / NEAR_STEPS
            factors = [d.rational(*(share * rng.randint(1, 99) / 100).as_integer_ratio()) for _ in self.roots]
            f, y = self.values(self.roots, point) or (), tuple(point[s] for s in self.symbols)
            try:
                x = tuple(r * a for r, a in zip(factors, f, strict=True))
                y = self.action.act(d, self.group, self.group.exp(d, x), y)
            except (ArithmeticError, ValueError):
                break
            point = self._at(y, Fraction(k, NEAR_STEPS), constants)
            if not self._finite(self.values(self.roots, point)):
                break
            points.append(point)
        return points

    def _at(self, y: tuple[Sized, ...], share: Fraction, constants: dict[str, Sized]) -> dict[str, Sized]:
        """Return the values of all symbols: coordinates ``y``, parameters ``constants``, and the time.

        The time is first + ``share`` * (last - first), where (first, last) is the time span of the scene.
        """
        first, last = self.span
        t = self.domain.rational(*(first + (last - first) * share).as_integer_ratio())
        return {**dict(zip(self.symbols, y, strict=True)), **constants, TIME: t}

    def _start(self, constants: dict[str, Sized]) -> tuple[Sized, ...]:
        start = self.values(self.start, constants)
        if start is None or not self._finite(start):
            raise SceneError(
                "a coordinate of the initial state is not a finite real number",
                where=self.name,
                expected="real numbers",
            )
        return start

    def values(self, roots: Sequence[Expr], values: dict[str, Sized]) -> tuple[Sized, ...] | None:
        """Return the values of the formulas ``roots``, or None if a formula cannot be evaluated."""
        try:
            return tuple(evaluate(roots, self.domain, values))
        except (ArithmeticError, ValueError):
            return None

    def _finite(self, values: Sequence[Sized] | None) -> bool:
        context = self.domain.context
        return values is not None and all(
            isinstance(x.value, context.mpf) and context.isfinite(x.value) for x in values
        )

    def velocity(self, point: dict[str, Sized]) -> tuple[Sized, ...]:
        """Return the time derivatives of the coordinates at a sample point."""
        f = tuple(evaluate(self.roots, self.domain, point))
        y = tuple(point[s] for s in self.symbols)
        return self.action.velocity(self.domain, self.group, f, y)

    def sized(self, total: Sized, terms: Sequence[Sized] = ()) -> bool:
        """Return True if ``total``, a sum or difference of ``terms``, is zero up to errors.

        The bound of |total| is TOLERANCE * (sum of |terms|) plus the rounding error of ``total``. Without
        ``terms``, the bound is only the rounding error of ``total``.
        """
        d = self.domain
        bound = (
            sum((abs(x.value) for x in terms), d.context.mpf(0))
            * d.rational(*TOLERANCE.as_integer_ratio()).value
        )
        return bool(abs(total.value) <= bound + d.rounding(total))

    def vanish(self, roots: Sequence[Expr]) -> bool:
        """Return True if all formulas in ``roots`` are zero, up to rounding, at all sample points.

        If a formula cannot be evaluated at one of the points, the result is False. A formula with selections
        must be zero in all combinations of their cases, because the sample points need not reach all cases.
        """
        nodes = selections(roots)
        cases = combinations(nodes)
        for sides in cases or ():
            smooth = on_sides(roots, nodes, sides)[0] if nodes else roots
            values = [self.values(smooth, point) for point in self.points]
            if not all(row is not None and all(self.sized(x) for x in row) for row in values):
                return False
        return cases is not None

    def text(self, x: Sized) -> str:
        """Return a number as text for a message."""
        return str(self.domain.context.nstr(x.value, 6))


def orbit_of(problem: Problem) -> Orbit:
    """Return the :class:`Orbit` of a problem."""
    field = problem.as_field()
    start = tuple(e for block in field.state for e in block.initial)
    return Orbit(
        *(field.name, field.group, field.action, field.symbols, start),
        *(field.roots, field.span, field.parameters, tuple(other.parameters for other in variants(field))),
    )


def variants(problem: Problem) -> tuple[Problem, ...]:
    """Return copies of a problem in which each run-time parameter has another value, which is fixed.

    If the problem has no run-time parameters, the result is empty.

    Emitted code must be correct for all values of the run-time parameters. For example, if the default value
    of k is 0, the formula k q^4 does not depend on q. In the copy, k is not 0, so k q^4 depends on q.
    """
    names, defaults = problem.runtime, problem.parameters
    if not names:
        return ()
    rng = random.Random("parameters")
    shares = {name: Number.rational(rng.randint(1, 99), 1000) for name in names}
    # A value that is not zero changes by less than 10 percent, because formulas may be undefined for values
    # with another sign or of another size.
    near = {name: share if (x := defaults[name]).is_zero else x - x * share for name, share in shares.items()}
    choices = [near]
    # With a very small or very large parameter, terms of a formula can be smaller than the tolerance.
    if any(not LEAST <= abs(float(x)) <= 1 / LEAST for x in near.values()):
        choices.append({name: share if float(near[name]) > 0 else -share for name, share in shares.items()})
    return tuple(replace(problem, parameters={**defaults, **values}, runtime=()) for values in choices)
