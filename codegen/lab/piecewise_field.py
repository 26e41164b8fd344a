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
from fractions import Fraction
from functools import cached_property

from flint import arb

from codegen.errors import SceneError
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr
from codegen.ir.smoothness import Sides, on_sides, selections
from codegen.ir.table import PiecewisePolynomial
from codegen.lab.ambient_field import FUNCTIONS, ball
from codegen.lab.number_functions import Functions
from codegen.lab.number_types import Evaluate, Scalar, Vector
from codegen.lab.step_polynomial import SERIES, StepPolynomial
from codegen.lab.straight_line_field import straight_line
from codegen.scene.problem import TIME, Problem

AHEAD = 1e-34
"""A short time, used for operations with several cases, such as abs(x) with the cases x > 0 and x <= 0.

The sign of x at the time t + AHEAD decides which case of abs(x) applies just after the time t. The time t has
about 60 decimal digits, so AHEAD is much larger than the rounding error of t. AHEAD is also much smaller than
the time scales of the solution.
"""

FARTHER, UNCLEAR = 1e-20, 1e-55
"""A time that is longer than AHEAD, and a bound for rounding errors.

If |x| <= UNCLEAR at the time t + AHEAD, the sign of x can be wrong because of rounding errors. Then the sign
of x at the time t + FARTHER replaces the sign at the time t + AHEAD. For example, let x = t^2 and t = 0. At
the time FARTHER, x is FARTHER^2 = 1e-40, which is much larger than UNCLEAR.
"""

NEAR = (1e-5, 1e-6)
"""Lengths of time after an event, for a comparison of the fields before and after the event.

Let f and g be the smooth fields before and after the event. The formulas of f are also evaluated after the
event. Let k be the number of continuous derivatives of the piecewise smooth field at the event. At the time s
after the event, |f - g| is about c s^(k + 1) with a constant c. The values of |f - g| for the two lengths s
in NEAR give k.
"""

VANISHING = 1e-30
"""The largest accepted value of d / max(1, s).

Here d is the largest difference of a coordinate between the state after a step and the Taylor polynomial of
the step. The number s is the largest absolute value of a coordinate after the step.

The step itself has a tolerance of at most 1e-33. A value above VANISHING is therefore caused by an error
of the polynomial. The search for a point where the field is not smooth (:func:`_root`) has the smaller
tolerance VANISHING / 10^8.
"""

MOST_EVENTS, MOST_SECANTS = 1000, 100

MOST = 9


@dataclass(frozen=True)
class PiecewiseField:
    """The smooth fields of a scene whose vector field contains selections (operations with several cases).

    Each combination of cases has its own smooth field. The dictionaries ``compiled`` and ``expanded`` store
    the results of :meth:`on` and :meth:`series`.
    """

    scene: Problem
    compiled: dict[Sides, tuple[Evaluate, Evaluate]] = field(default_factory=dict)
    expanded: dict[Sides, tuple[Evaluate, Evaluate]] = field(default_factory=dict)

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
        ``nodes[k]``. To form the smooth field, each selection in the right-hand side of the differential
        equation is replaced by the formula for its case. The margins are numbers. For example, the margin for
        the case x > 0 of abs(x) is x. While all cases in ``sides`` apply, all margins are positive.
        """
        if sides not in self.compiled:
            self.compiled[sides] = self._pair(sides, FUNCTIONS)
        return self.compiled[sides]

    def series(self, sides: Sides) -> tuple[Evaluate, Evaluate]:
        """Return the same two functions as :meth:`on`, for power series with balls as coefficients."""
        if sides not in self.expanded:
            self.expanded[sides] = self._pair(sides, SERIES)
        return self.expanded[sides]

    def _pair(self, sides: Sides, functions: Functions) -> tuple[Evaluate, Evaluate]:
        pair = on_sides(self.roots, self.nodes, sides)
        name, symbols = self.scene.name, self.scene.symbols
        first, second = (straight_line(name, symbols, tuple(r)).python(ball, functions) for r in pair)
        return first, second

    def sides_at(self, y: Vector, t: Scalar, flow: Evaluate | None = None) -> Sides:
        """For each operation with several cases, return the case that applies just after the time t.

        For example, abs(x) has the cases x > 0 and x <= 0. The state just after t is computed by a short
        Euler step from y with the derivative ``flow(y, t)``. If this state is on a boundary between two
        cases, a longer step of the midpoint rule replaces the Euler step. By default, ``flow`` is the field
        of the scene.
        """
        whole = straight_line(self.scene.name, self.scene.symbols, self.roots).python(ball, FUNCTIONS)
        slope = whole if flow is None else flow
        tests = tuple(node.args[0] for node in self.nodes)
        values = straight_line(self.scene.name, self.scene.symbols, tests).python(ball, FUNCTIONS)
        now = slope(y, t)
        near = values(_moved(y, now, arb(AHEAD)), t + arb(AHEAD))
        if all(_distance(node.payload, x) > UNCLEAR for node, x in zip(self.nodes, near, strict=True)):
            return tuple(_side(node.payload, x) for node, x in zip(self.nodes, near, strict=True))
        # If the solution touches a boundary, as x = t^2 touches 0, the Euler step stays on the boundary.
        ahead = arb(FARTHER)
        far = values(_moved(y, slope(_moved(y, now, ahead / 2), t + ahead / 2), ahead), t + ahead)
        return tuple(
            _side(
                node.payload, b if _distance(node.payload, a) <= UNCLEAR < _distance(node.payload, b) else a
            )
            for node, a, b in zip(self.nodes, near, far, strict=True)
        )

    def beyond(self, sides: Sides, y: Vector, t: Scalar) -> tuple[Sides, int]:
        """Return the new ``sides`` after an event at (y, t), and the smoothness of the field at (y, t).

        At an event, an operation such as abs(x) changes its case, for example from x > 0 to x <= 0. The
        argument ``sides`` contains the case of each such operation before the event. The smoothness is the
        number of continuous derivatives of the field, or -1 if the field is discontinuous. The largest
        returned smoothness is :data:`MOST`.
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
"""A function that makes one step of size ``length`` from the state y at the time t.

The arguments are (field, y, t, length). The results are the new state and an estimate of the error of the new
state.
"""


class Sided:
    """A vector field as a function of (state, t). The field is smooth until the next event.

    A selection is an operation with several cases, such as abs(x). ``sides`` contains the current case of
    each selection. ``kinks`` contains the number of continuous derivatives at each past event, or -1 if the
    field is discontinuous there. ``times`` contains the times of these events.
    """

    def __init__(self, fields: PiecewiseField) -> None:
        self.fields = fields
        self.kinks: list[int] = []
        self.times: list[float] = []

    def begin(self, y: Vector, t: Scalar) -> None:
        """Set ``sides`` for a run that begins at the state y and the time t."""
        self.sides = self.fields.sides_at(y, t)

    def __call__(self, y: Vector, t: Scalar) -> Vector:
        """Return the value of the field at the state y and the time t."""
        return self.fields.on(self.sides)[0](y, t)

    def margins(self, y: Vector, t: Scalar) -> Vector:
        """Return the margins of the operations with several cases, such as abs(x).

        Margins are numbers that are positive while the current case of each operation applies. For example,
        the margin for the case x > 0 of abs(x) is x.
        """
        return self.fields.on(self.sides)[1](y, t)

    def stopped(
        self, y: Vector, t: Scalar, new: Vector, length: Scalar, advance: Advance
    ) -> tuple[Scalar, Vector, float] | None:
        """Return None if the field is smooth during a step from (y, t) to ``new``.

        Otherwise, return a time, a state and a step length, with which the caller must continue. An event is
        a time at which an operation such as abs(x) changes its case.

        - If the step is too long for the search for events, return t, y and half of ``length``.
        - If there are events in the step, return the time and the state of the first event, and ``length``.
          ``sides`` then contains the cases after this event.

        Raises :class:`SceneError` if the first event cannot be found.
        """
        field_series, margin_series = self.fields.series(self.sides)
        try:
            solution = StepPolynomial(field_series, y, t)
            size = max(1.0, *(abs(float(x)) for x in new))
            # The polynomial does not represent the solution if the step is too long.
            if not all(abs(a - b) < VANISHING * size for a, b in zip(solution.at(length), new, strict=True)):
                return t, y, float(length) / 2
            bracket = solution.first_exit(self.fields.on(self.sides)[1], margin_series, length)
        except (ArithmeticError, ValueError) as failure:
            raise self._unknown(t, str(failure)) from failure
        return None if bracket is None else (*self._cross(y, t, bracket, advance), float(length))

    def _unknown(self, t: Scalar, reason: str) -> SceneError:
        return SceneError(
            f"no reference solution beyond t = {float(t):.6g}: {reason}",
            where=self.fields.scene.name,
            expected="a field that is smooth along the solution, except at points that the program can find",
            hint="choose a span that ends before this time, or replace the operation that is not smooth, "
            "for example abs(x) by sqrt(x**2 + w**2) for a small width w",
        )

    def _cross(
        self, y: Vector, t: Scalar, bracket: tuple[Scalar, Scalar], advance: Advance
    ) -> tuple[Scalar, Vector]:
        """Return the time and the state of the event in a step from (y, t).

        At an event, an operation changes its formula, for example abs(x) from x to -x at x = 0. The event is
        between the times t + a and t + b, where (a, b) = ``bracket`` is the result of
        :meth:`StepPolynomial.first_exit`. ``self.sides`` is set to the cases that apply after the event, for
        example x <= 0.
        """
        low, high = bracket
        start, end = (self.margins(advance(self, y, t, tau)[0], t + tau) for tau in bracket)
        crossed = [k for k, x in enumerate(end) if x < 0]
        if not crossed:
            raise self._unknown(
                t,
                "the program cannot decide whether an operation switches to another formula, as abs(x) does "
                "at x = 0",
            )

        def margin(tau: Scalar) -> Scalar:
            values = self.margins(advance(self, y, t, tau)[0], t + tau)
            return min((values[k].mid() for k in crossed), key=float)

        first, last = (min((values[k].mid() for k in crossed), key=float) for values in (start, end))
        # The margin ``first`` at ``low`` can be zero, or negative because of a rounding error. In both cases,
        # the event is at ``low``.
        tau = _root(margin, low, high, first, last) if first > 0 else low
        place = advance(self, y, t, tau)[0]
        now = (t + tau).mid()
        sides, smooth = self.fields.beyond(self.sides, place, now)
        if sides == self.sides:
            raise self._unknown(
                now, "the program cannot decide which formula applies, for example x or -x for abs(x)"
            )
        self.sides = sides
        self.kinks.append(smooth)
        self.times.append(float(now))
        if len(self.kinks) > MOST_EVENTS:
            raise SceneError(
                f"the solution passes more than {MOST_EVENTS} points where the field is not smooth",
                where=self.fields.scene.name,
                expected="a solution with fewer of these points",
                hint="shorten the span",
            )
        return now, place


def _root(margin: Callable[[Scalar], Scalar], a: Scalar, b: Scalar, low: Scalar, high: Scalar) -> Scalar:
    """Return a zero of ``margin`` between ``a`` and ``b``, by the Illinois variant of the false position
    method.

    ``margin`` must have the value ``low`` > 0 at ``a``, and the value ``high`` < 0 at ``b``.
    """
    moved = 0
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


def _moved(y: Vector, slope: Vector, time: Scalar) -> Vector:
    return tuple((a + time * b).mid() for a, b in zip(y, slope, strict=True))


def _distance(function: str, x: Scalar) -> float:
    """Return the distance of ``x`` from the nearest boundary between two cases of a selection."""
    knots = function.knots if isinstance(function, PiecewisePolynomial) else (Fraction(0),)
    return min(abs(float((x - arb(k.numerator) / k.denominator).mid())) for k in knots)


def _side(function: str, x: Scalar) -> int:
    if isinstance(function, PiecewisePolynomial):
        return sum(bool(x >= arb(k.numerator) / k.denominator) for k in function.knots)
    return int(x > 0)
