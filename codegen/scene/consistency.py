"""What a scene says of itself, checked when it is read: its start, field, Hamiltonian and invariants.

Derivatives are exact, by reverse differentiation of the formulas; they are compared with 40 digits at points
of the orbit of the initial state, moved by elements of the group, and at times of the span. Formulas that
agree only on the manifold (where g^T g = 1, say) agree there.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

from codegen.errors import SceneError
from codegen.ir.differentiate import gradient
from codegen.ir.domain import PreciseDomain
from codegen.ir.expr import Expr, evaluate
from codegen.ir.number import Number

DIGITS = 40
TOLERANCE = Fraction(1, 10**20)
"""Relative to the size of the terms: what rounding leaves of 40 digits, with room for cancellation."""

FLOOR = Fraction(1, 10**28)
"""What terms that cancel within themselves may leave."""

POINTS = 4
"""The initial state and three others."""


@dataclass(frozen=True)
class Orbit:
    """Where a scene lives: its group and action, the names of its coordinates, its start and its times.

    For Hamiltonian scenes that is T*G acting on itself. ``roots`` are the components of f.
    """

    name: str
    group: Any
    action: Any
    symbols: tuple[str, ...]
    start: tuple[Expr, ...]
    roots: tuple[Expr, ...]
    span: tuple[Fraction, Fraction]
    parameters: Mapping[str, Number]

    @cached_property
    def domain(self) -> PreciseDomain:
        """The numbers that are compared."""
        return PreciseDomain(0, DIGITS)

    @cached_property
    def points(self) -> tuple[dict[str, Any], ...]:
        """Values of all symbols at the initial state and at points of its orbit, where f can be evaluated.

        SceneError where it cannot be at the initial state itself.
        """
        d, rng = self.domain, random.Random("orbit")
        constants = {name: d.number(x) for name, x in self.parameters.items()}
        y0 = self._start(constants)
        found: list[dict[str, Any]] = []
        first, last = (d.rational(*x.as_integer_ratio()) for x in self.span)
        for k in range(POINTS):
            x = tuple(d.rational(rng.randint(-99, 99), 100) for _ in range(self.group.dim))
            y = self.action.act(d, self.group, self.group.exp(d, x), y0) if k else y0
            t = first + (last - first) * d.rational(k, POINTS)
            values = {**dict(zip(self.symbols, y, strict=True)), **constants, "t": t}
            if self._finite(self.values(self.roots, values)):
                found.append(values)
            elif not k:
                raise SceneError(
                    "f at the initial state is no finite real number",
                    where=self.name,
                    expected="an initial state where the field is smooth",
                )
        return tuple(found)

    def _start(self, constants: dict[str, Any]) -> tuple[Any, ...]:
        found = self.values(self.start, constants)
        if found is None or not self._finite(found):
            raise SceneError(
                "a coordinate of the initial state is no finite real number",
                where=self.name,
                expected="real numbers",
            )
        return found

    def values(self, roots: Sequence[Expr], values: dict[str, Any]) -> tuple[Any, ...] | None:
        """Return formulas at a point; None where they cannot be evaluated."""
        try:
            return tuple(evaluate(roots, self.domain, values))
        except (ArithmeticError, ValueError):
            return None

    def _finite(self, values: Sequence[Any] | None) -> bool:
        context = self.domain.context
        return values is not None and all(isinstance(x, context.mpf) and context.isfinite(x) for x in values)

    def velocity(self, point: dict[str, Any]) -> tuple[Any, ...]:
        """Return f.y in the coordinates of the state."""
        f = evaluate(self.roots, self.domain, point)
        y = tuple(point[s] for s in self.symbols)
        return tuple(self.action.velocity(self.domain, self.group, tuple(f), y))

    def sized(self, total: Any, terms: Sequence[Any]) -> bool:
        """Whether a sum is zero up to rounding, by the size of its terms."""
        size = sum((abs(x) for x in terms), self.domain.rational(0))
        allowed = [self.domain.rational(*x.as_integer_ratio()) for x in (TOLERANCE, FLOOR)]
        return bool(abs(total) <= allowed[0] * size + allowed[1])

    def text(self, x: Any) -> str:
        """Spell a number for a message."""
        return str(self.domain.context.nstr(x, 6))


def check_start(orbit: Orbit) -> None:
    """Raise :class:`SceneError` where the initial state is no element of the group that acts on itself."""
    if orbit.action.name != "left multiplication":
        return
    start = tuple(orbit.points[0][s] for s in orbit.symbols)
    for law, defect in orbit.group.laws(orbit.domain, start):
        if not orbit.sized(defect, (1,)):
            raise SceneError(
                f"an initial state with {law} off by {orbit.text(defect)}",
                where=orbit.name,
                expected=f"an element of {orbit.group.name}",
            )


def check_equal(
    orbit: Orbit, stated: Sequence[Expr], what: str, derived: Sequence[Expr] | None = None
) -> None:
    """Raise :class:`SceneError` where stated formulas differ from derived ones, or from f.y without these.

    ``what`` names the stated formulas in the message.
    """
    for point in orbit.points:
        right = orbit.velocity(point) if derived is None else orbit.values(derived, point)
        left = orbit.values(stated, point)
        for k, (x, y) in enumerate(zip(left or (), right or (), strict=True)):
            if not orbit.sized(x - y, (x, y)):
                raise SceneError(
                    f"{what}[{k}] is {orbit.text(x)} {_place(orbit, point)}",
                    where=orbit.name,
                    expected=f"{orbit.text(y)}, by {'f.y' if derived is None else 'differentiating H'}",
                )


def check_flow(
    orbit: Orbit, name: str, formulas: Sequence[Expr], rates: Sequence[Expr], elapsed: str
) -> None:
    """Raise :class:`SceneError` where stated formulas are not the flow of a part.

    They must be the state itself at the time 0, and move at the part's ``rates`` at all times after;
    ``elapsed`` is the symbol of the time in them. Their derivatives are exact, the values have 40 digits.
    """
    slopes = [gradient(formula, (elapsed,))[0] for formula in formulas]
    for point in orbit.points:
        for tau in (0, 1, -2):
            there = point | {elapsed: orbit.domain.rational(tau, 3)}
            moved = orbit.values(formulas, there)
            if moved is None:
                raise SceneError(f"the flow of {name} cannot be evaluated", where=orbit.name)
            after = point | dict(zip(orbit.symbols, moved, strict=True))
            pairs = [("moves at the rate", orbit.values(slopes, there), orbit.values(rates, after))]
            if tau == 0:
                pairs.insert(0, ("begins at", moved, tuple(point[s] for s in orbit.symbols)))
            for verb, left, right in pairs:
                for k, (x, y) in enumerate(zip(left or (), right or (), strict=True)):
                    if not orbit.sized(x - y, (x, y, 1)):
                        raise SceneError(
                            f"the flow of {name} {verb} {orbit.text(x)} in {orbit.symbols[k]}, "
                            f"where {elapsed} = {orbit.text(there[elapsed])}",
                            where=orbit.name,
                            expected=f"{orbit.text(y)}, by the equations of the part",
                            hint="flows of summands that do not commute make no flow of their sum: "
                            "name them as parts of their own",
                        )


def check_invariants(orbit: Orbit, invariants: Mapping[str, Expr]) -> None:
    """Raise :class:`SceneError` for a declared invariant that changes along the field.

    Its derivative dI.(f.y) + dI/dt is formed exactly and must vanish at every point.
    """
    for name, root in invariants.items():
        slopes = gradient(root, (*orbit.symbols, "t"))
        for point in orbit.points:
            found = orbit.values(slopes, point)
            if found is None:
                continue
            terms = [a * b for a, b in zip(found, (*orbit.velocity(point), 1), strict=True)]
            total = sum(terms[1:], terms[0])
            if not orbit.sized(total, terms):
                raise SceneError(
                    f"the invariant {name} changes at the rate {orbit.text(total)}, {_place(orbit, point)}",
                    where=orbit.name,
                    expected="a function that is constant along the field",
                    hint="leave it out of invariants",
                )


def _place(orbit: Orbit, point: dict[str, Any]) -> str:
    shown = [f"{s} = {orbit.text(point[s])}" for s in (*orbit.symbols[:3], "t")]
    return "where " + ", ".join(shown)
