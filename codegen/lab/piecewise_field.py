"""Vector fields that are only piecewise smooth.

A selection (:mod:`codegen.ir.smoothness`) is an operation with several cases (*sides*), for example an
absolute value. The margins of a selection are functions of the state and the time. While the current case
applies, all margins are positive. At an event, a margin becomes zero, and the integration continues with the
smooth field of the new case.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property

from flint import arb

from codegen.errors import SceneError
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr
from codegen.ir.smoothness import Sides, on_sides, selections
from codegen.ir.table import PiecewisePolynomial
from codegen.lab.ambient_field import FUNCTIONS, ball
from codegen.lab.number_types import Evaluate, Scalar, Vector
from codegen.lab.straight_line_field import straight_line
from codegen.scene.problem import TIME, Problem

AHEAD = 1e-34
"""Operations such as abs(x) have several cases. The sign of x at t + AHEAD gives the case just after t.

AHEAD is much larger than the rounding error of t, and much smaller than the time scales of the solution.
"""

NEAR = (1e-5, 1e-6)
"""Lengths of time after an event, for a comparison of the fields before and after the event.

Let f and g be the fields before and after the event, and let k be the number of continuous derivatives of the
field at the event. At the time s after the event, |f - g| is about c s^(k + 1) with a constant c. The values
of |f - g| for the two lengths s in NEAR give k.
"""

VANISHING = 1e-30
"""A margin is a function of the state and the time. A margin with an absolute value less than VANISHING
counts as zero.

The field can be non-smooth at a zero of a margin.
"""

SUBSTEPS = 24
"""The largest number of points inside a step at which :meth:`Sided.leaves` tests the signs of the margins.

A margin is a function of the state and the time. A negative margin shows that an operation such as abs(x) has
passed from one case to another inside the step.
"""

MOST_EVENTS, MOST_SECANTS = 1000, 100

MOST = 9


@dataclass(frozen=True)
class PiecewiseField:
    """The smooth fields of a scene whose vector field contains selections (operations with several cases).

    Each combination of cases has its own smooth field. The dictionary ``compiled`` stores the results of
    :meth:`on`.
    """

    scene: Problem
    compiled: dict[Sides, tuple[Evaluate, Evaluate]] = field(default_factory=dict)

    @cached_property
    def roots(self) -> tuple[Expr, ...]:
        """The right-hand side of the differential equation of the scene, one expression for each
        coordinate.
        """
        domain = ExprDomain()
        state = tuple(domain.space.sym(s) for s in self.scene.symbols)
        return self.scene.velocity(domain, state, domain.space.sym(TIME))

    @cached_property
    def nodes(self) -> list[Expr]:
        """All selections of the field. A selection is an operation with several cases."""
        return selections(self.roots)

    def on(self, sides: Sides) -> tuple[Evaluate, Evaluate]:
        """Return two functions of (state, t): a smooth vector field, and the margins of the selections.

        A selection is an operation with several cases. ``sides[k]`` is the case of the selection
        ``nodes[k]``. The smooth field is the right-hand side of the differential equation in which each
        selection is replaced by the formula for its case. The margins are numbers. For example, the margin
        for the case x > 0 of abs(x) is x. While all cases in ``sides`` apply, all margins are positive.
        """
        if sides not in self.compiled:
            pair = on_sides(self.roots, self.nodes, sides)
            name, symbols = self.scene.name, self.scene.symbols
            first, second = (straight_line(name, symbols, tuple(r)).python(ball, FUNCTIONS) for r in pair)
            self.compiled[sides] = first, second
        return self.compiled[sides]

    def sides_at(self, y: Vector, t: Scalar, flow: Evaluate | None = None) -> Sides:
        """Return the case that applies just after the time t, for each operation with several cases.

        The state just after t is computed by a short Euler step from y with the derivative ``flow(y, t)``. By
        default, ``flow`` is the field of the scene.
        """
        whole = straight_line(self.scene.name, self.scene.symbols, self.roots).python(ball, FUNCTIONS)
        ahead = arb(AHEAD)
        slopes = (whole if flow is None else flow)(y, t)
        point = tuple((a + ahead * b).mid() for a, b in zip(y, slopes, strict=True))
        tests = tuple(node.args[0] for node in self.nodes)
        values = straight_line(self.scene.name, self.scene.symbols, tests).python(ball, FUNCTIONS)
        return tuple(
            _side(node.payload, x) for node, x in zip(self.nodes, values(point, t + ahead), strict=True)
        )

    def beyond(self, sides: Sides, y: Vector, t: Scalar) -> tuple[Sides, int]:
        """Return the cases that apply after an event at (y, t), and the smoothness of the field at (y, t).

        An operation such as abs(x) has several cases. ``sides`` contains, for each such operation, the case
        that applies before the event. The smoothness is the number of continuous derivatives of the field, or
        -1 if the field is discontinuous. The largest returned smoothness is :data:`MOST`.
        Raises :class:`SceneError` if the solution slides along a discontinuity of the field.
        """
        before, _ = self.on(sides)
        after = self.sides_at(y, t, before)
        field_after, _ = self.on(after)
        if self.sides_at(y, t, field_after) != after:
            raise SceneError(
                f"from t = {float(t):.6g} the solution slides along a discontinuity of the field",
                where=self.scene.name,
                expected="a solution that crosses the discontinuity",
                hint="replace sign(x) by tanh(x/w) for a small width w, "
                "or choose a span that ends before this time",
            )
        slopes = field_after(y, t)
        gaps = []
        for time in NEAR:
            point = tuple((a + arb(time) * b).mid() for a, b in zip(y, slopes, strict=True))
            pairs = zip(before(point, t + time), field_after(point, t + time), strict=True)
            gaps.append(max(abs(float((a - b).mid())) for a, b in pairs))
        if not min(gaps) > 0.0 or gaps[1] < 1e-50:
            return after, MOST
        return after, min(MOST, round(math.log(gaps[0] / gaps[1]) / math.log(NEAR[0] / NEAR[1])) - 1)


Advance = Callable[..., tuple[Vector, float]]
"""A function of (field, y, t, length): the state after a step from (y, t), and an estimate of its error."""


class Sided:
    """A vector field as a function of (state, t). The field is smooth until the next event.

    A selection is an operation with several cases, such as abs(x). ``sides`` contains the current case of
    each selection. ``kinks`` contains the number of continuous derivatives at each past event, or -1 if the
    field is discontinuous there. ``points`` contains the pairs (state, t) of the latest evaluations of the
    field.
    """

    def __init__(self, fields: PiecewiseField) -> None:
        self.fields = fields
        self.kinks: list[int] = []
        self.points: list[tuple[Vector, Scalar]] = []

    def begin(self, y: Vector, t: Scalar, least: float) -> None:
        """Set ``sides`` for a run that begins at the state y and the time t.

        ``least`` is the length of the shortest permitted step.
        """
        self.sides, self.least = self.fields.sides_at(y, t), least

    def __call__(self, y: Vector, t: Scalar) -> Vector:
        """Return the value of the field at the state y and the time t, and add (y, t) to ``points``."""
        self.points.append((y, t))
        return self.fields.on(self.sides)[0](y, t)

    def margins(self, y: Vector, t: Scalar) -> Vector:
        """Return the margins of the operations with several cases, such as abs(x).

        All margins are positive while the current case of each operation applies.
        """
        return self.fields.on(self.sides)[1](y, t)

    def leaves(self, y: Vector, t: Scalar, new: Vector, length: Scalar) -> bool:
        """Return True if a margin is negative at a tested point of a step from (y, t) to ``new``.

        The end of the step is always tested. If the step is longer than twice the shortest permitted length,
        the last :data:`SUBSTEPS` entries of ``points`` are tested, too.
        """
        inner, self.points = self.points[-SUBSTEPS:], []
        if any(x < 0 for x in self.margins(new, t + length)):
            return True
        return float(length) > self.least * 2 and any(x < 0 for p in inner for x in self.margins(*p))

    def cross(self, y: Vector, t: Scalar, length: Scalar, advance: Advance) -> tuple[Scalar, Vector] | None:
        """Find the first event in a step from (y, t), and set ``sides`` to the cases that apply after the
        event.

        At an event, a margin is zero (:meth:`margins`). The result is the time and the state of the event, or
        None if the caller must try a shorter step.
        """
        start = self.margins(y, t)
        end = self.margins(advance(self, y, t, length)[0], t + length)
        crossed = [k for k, x in enumerate(end) if x < 0]
        # ``_root`` needs a function with a positive value at 0 and a negative value at ``length``.
        if not crossed or any(abs(start[k]) < VANISHING for k in crossed):
            return None

        def margin(tau: Scalar) -> Scalar:
            values = self.margins(advance(self, y, t, tau)[0], t + tau)
            return min((values[k].mid() for k in crossed), key=float)

        tau = _root(margin, min((start[k].mid() for k in crossed), key=float), margin(length), length)
        place = advance(self, y, t, tau)[0]
        now = (t + tau).mid()
        self.sides, smooth = self.fields.beyond(self.sides, place, now)
        self.kinks.append(smooth)
        if len(self.kinks) > MOST_EVENTS:
            raise SceneError(
                f"the solution passes more than {MOST_EVENTS} points where the field is not smooth",
                where=self.fields.scene.name,
                expected="a solution with fewer of these points",
                hint="shorten the span",
            )
        self.points = []
        return now, place


def _root(margin: Callable[[Scalar], Scalar], low: Scalar, high: Scalar, length: Scalar) -> Scalar:
    """Return a zero of ``margin`` between 0 and ``length``, by the Illinois variant of the false position
    method.

    ``margin`` must have the value ``low`` > 0 at 0, and the value ``high`` < 0 at ``length``.
    """
    a, b, moved = arb(0), length, 0
    for _ in range(MOST_SECANTS):
        tau = ((a * high - b * low) / (high - low)).mid()
        value = margin(tau)
        if abs(value) < VANISHING / 1e8 or abs(b - a) < VANISHING / 1e8:
            break
        if value < 0:
            low = (low / 2).mid() if moved < 0 else low
            b, high, moved = tau, value, -1
        else:
            high = (high / 2).mid() if moved > 0 else high
            a, low, moved = tau, value, 1
    return tau


def _side(function: str, x: Scalar) -> int:
    if isinstance(function, PiecewisePolynomial):
        return sum(bool(x >= arb(k.numerator) / k.denominator) for k in function.knots)
    return int(x > 0)
