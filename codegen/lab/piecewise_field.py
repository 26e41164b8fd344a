"""Integrates a scene whose vector field is not smooth everywhere, with smooth fields between events.

A selection is an operation with several cases, such as an absolute value or a table. In the code, a case is
called a *side*. As long as each selection remains in its case, the field is smooth
(:mod:`codegen.ir.smoothness`). Each selection has a margin. This is a function of the state and the time that
is positive while the current case applies. An event is a time at which a margin becomes zero. After an event,
another case applies, and the integrator uses the smooth field for this case.
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
"""The case that applies just after a time t is determined at the time t + AHEAD.

Here t is usually the computed time at which an operation, such as an absolute value, changes from one of its
cases to another. AHEAD is much larger than the error of t, and much smaller than the time scales of the
solution.
"""

NEAR = (1e-5, 1e-6)
"""The smooth fields before and after an event are compared NEAR[0] and NEAR[1] time units after the event.

At an event, the field changes from one smooth field to another. The comparison shows how many derivatives of
the field are continuous at the event.
"""

VANISHING = 1e-30
"""A margin counts as zero if its absolute value is less than VANISHING.

Each selection (operation with several cases) has a margin. The margin is positive while the current case of
the selection applies.
"""

SUBSTEPS = 24
"""The largest number of points inside a step at which the integrator tests whether an event has occurred.

At an event, an operation such as an absolute value changes from one of its cases to another.
"""

MOST_EVENTS, MOST_SECANTS = 1000, 100

MOST = 9
"""The largest number of continuous derivatives that :meth:`PiecewiseField.beyond` returns.

A field with more continuous derivatives has this number, too.
"""


@dataclass(frozen=True)
class PiecewiseField:
    """The smooth fields of a scene whose vector field contains selections (operations with several cases).

    There is one smooth field for each combination of cases. ``compiled`` stores the results of :meth:`on`.
    The keys of ``compiled`` are combinations of cases.
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
        """The selections (operations with several cases) of the field."""
        return selections(self.roots)

    def on(self, sides: Sides) -> tuple[Evaluate, Evaluate]:
        """Return two functions of (state, t). The first is a smooth field, and the second returns margins.

        A selection is an operation with several cases, such as an absolute value. ``sides`` contains one case
        of each selection, and the smooth field uses these cases. The second function returns one margin for
        each selection. The margin is positive while the case in ``sides`` applies.
        """
        if sides not in self.compiled:
            pair = on_sides(self.roots, self.nodes, sides)
            name, symbols = self.scene.name, self.scene.symbols
            first, second = (straight_line(name, symbols, tuple(r)).python(ball, FUNCTIONS) for r in pair)
            self.compiled[sides] = first, second
        return self.compiled[sides]

    def sides_at(self, y: Vector, t: Scalar, flow: Evaluate | None = None) -> Sides:
        """Return the case of each selection just after the time t, on the solution through (y, t).

        A selection is an operation with several cases. ``flow`` is the vector field that the solution
        follows, by default the field of the scene.
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
        """Return the case of each selection after an event at (y, t), and the smoothness of the field there.

        A selection is an operation with several cases. ``sides`` contains the cases before the event. The
        smoothness is the number of continuous derivatives of the field, or -1 if the field jumps. Raises
        :class:`SceneError` if the field after the event points back to the cases before the event.
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
"""A function of (field, y, t, length) that makes one step from the state y at the time t.

It returns the new state and an error estimate.
"""


class Sided:
    """A vector field, called as a function of (state, t), that uses the current case of each selection.

    A selection is an operation with several cases. ``sides`` contains the current case of each selection. At
    an event, the case of a selection changes. For each past event, ``kinks`` contains the number of
    continuous derivatives of the field of the scene, or -1 if the field jumps. ``points`` is a list of the
    pairs (state, t) at which the field was evaluated in the current step.
    """

    def __init__(self, fields: PiecewiseField) -> None:
        self.fields = fields
        self.kinks: list[int] = []
        self.points: list[tuple[Vector, Scalar]] = []

    def begin(self, y: Vector, t: Scalar, least: float) -> None:
        """Determine the case of each selection at the initial state y and the initial time t.

        ``least`` is the length of the shortest permitted step.
        """
        self.sides, self.least = self.fields.sides_at(y, t), least

    def __call__(self, y: Vector, t: Scalar) -> Vector:
        """Return the value of the field at the state y and the time t, and add (y, t) to ``points``.

        Each operation with several cases uses its current case, which is in ``sides``.
        """
        self.points.append((y, t))
        return self.fields.on(self.sides)[0](y, t)

    def margins(self, y: Vector, t: Scalar) -> Vector:
        """Return the margin of each selection, that is, of each operation with several cases.

        A margin is positive while the current case of its selection applies.
        """
        return self.fields.on(self.sides)[1](y, t)

    def leaves(self, y: Vector, t: Scalar, new: Vector, length: Scalar) -> bool:
        """Return True if the case of a selection changes in a step, that is, if a margin becomes negative.

        The step has the given length and leads from the state ``y`` at the time ``t`` to the state ``new``.
        The margins are tested at the end of the step. They are also tested at the points of the last
        :data:`SUBSTEPS` evaluations of the field, if the step is longer than two shortest permitted steps.
        """
        inner, self.points = self.points[-SUBSTEPS:], []
        if any(x < 0 for x in self.margins(new, t + length)):
            return True
        return float(length) > self.least * 2 and any(x < 0 for p in inner for x in self.margins(*p))

    def cross(self, y: Vector, t: Scalar, length: Scalar, advance: Advance) -> tuple[Scalar, Vector] | None:
        """Find the first event in a step, and change to the cases that apply after the event.

        At an event, the case of a selection (an operation with several cases) changes. The step has the given
        length and begins at (y, t). Return the time and the state of the event. If the event cannot be found
        in this step, return None. The caller must then try a shorter step.
        """
        start = self.margins(y, t)
        end = self.margins(advance(self, y, t, length)[0], t + length)
        crossed = [k for k, x in enumerate(end) if x < 0]
        # If a margin is zero at the beginning of the step, the step begins at an event. The root search would
        # find this event again and not the next event. Therefore the caller must try a shorter step.
        # The shorter step can end before the next event.
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
                f"more than {MOST_EVENTS} points where the field is not smooth",
                where=self.fields.scene.name,
                expected="a solution with fewer of these points",
                hint="shorten the span",
            )
        self.points = []
        return now, place


def _root(margin: Callable[[Scalar], Scalar], low: Scalar, high: Scalar, length: Scalar) -> Scalar:
    """Return a zero of the function ``margin``, by the Illinois variant of the false position method.

    The argument of ``margin`` is the time since the beginning of a step of the given length. The value at the
    beginning is ``low`` > 0, and the value at the end is ``high`` < 0.
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
