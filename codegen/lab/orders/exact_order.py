"""The exact order of a method on a scene, computed from the Taylor series of the local error of a step.

If the field of a scene is polynomial or rational, the Taylor coefficients of the local error are exact
numbers. The order is p if the coefficient of h^(p+1) is the first nonzero coefficient, where h is the step
size.

The error of one step says nothing about other points of the solution. Let q be the order that the order
conditions give. At a special point, for example where derivatives of the field vanish, all coefficients up to
h^(q+1) can be zero although the order of the method is q. In this case, the steps that start at later points
of the solution (:data:`LATER`) are examined, too.

If exact arithmetic cannot represent an initial coordinate, a nearby rational number replaces the coordinate.
The new initial point may be off the manifold. The equations, the group action and the order conditions are
valid off the manifold, too.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from codegen.certify import CertifiedOrder, certified_order
from codegen.emitter import optimise_method
from codegen.errors import MethodError, SceneError
from codegen.ir.domain import FloatDomain, SeriesDomain
from codegen.ir.expr import Expr, evaluate
from codegen.ir.number import Number
from codegen.ir.selection import Kink
from codegen.lab.number_types import Vector
from codegen.lab.orders.local_error import local_error
from codegen.lab.runner import Interpreted
from codegen.lower import problem_for
from codegen.method import Method
from codegen.scene.problem import Problem, StateField
from orderconds.errors import InputError
from orderconds.ring.protocol import Ring

LATER = (Fraction(1, 3), Fraction(5, 7))
"""The later points of the solution, as fractions of the time span.

A point of symmetry of a solution is often the middle or the end of the span; these fractions avoid such
points.
"""

STEPS = 64
"""The number of steps of each run from the initial state to one of the points :data:`LATER`.

The computed points need not be accurate.
"""

DENOMINATOR = 64
"""The largest denominator of the rational numbers that replace coordinates of a state.

A coordinate near 0 could become 0. Therefore the coordinate is divided by a power of 2 before the
replacement and multiplied by this power afterwards (:func:`_near`).
"""


@dataclass(frozen=True)
class ExactLocalError:
    """The leading term of the local error of one step of size h, with exact coefficients.

    - ``certified``: the order from the order conditions.
    - ``vanishes``: True if all computed coefficients of the local error are zero.
    - ``order``: the exact order, or a lower bound of the exact order if ``vanishes`` is True.
    - ``symbols``: the names of the coordinates.
    - ``start``: the state before the step.
    - ``time``: the time before the step.
    - ``coefficients``: the coefficients of h^(``order`` + 1), one for each coordinate. If ``vanishes`` is
      True, ``coefficients`` is empty.
    - ``points``: the number of points of the solution at which the local error was computed. If all computed
      coefficients of the local error are zero at a point, a later point is examined. The attributes
      ``order``, ``vanishes``, ``start``, ``time`` and ``coefficients`` describe the step from the last point.
    """

    scene: str
    method: str
    certified: CertifiedOrder
    order: int
    vanishes: bool
    symbols: tuple[str, ...]
    start: tuple[str, ...]
    coefficients: tuple[str, ...]
    time: str = "0"
    points: int = 1

    @property
    def verdict(self) -> str:
        """The verdict ``holds`` or ``fails``.

        If the exact order is at least the order from the order conditions, the verdict is ``holds``.
        """
        return "holds" if self.order >= self.certified.order else "fails"

    def sentence(self) -> str:
        """Return the verdict, the exact order and the order from the order conditions in one line."""
        statement = f"order {self.order} in exact arithmetic on this scene"
        if self.vanishes:
            where = "the initial state"
            if self.points > 1:
                later = self.points - 1
                where += f" and {later} later point{'s' if later > 1 else ''} of the solution"
            statement = f"order at least {self.order} in exact arithmetic for steps from {where}"
        elif self.points > 1:
            statement += (
                " (computed at a later point of the solution; at the initial state, all coefficients of the "
                f"local error up to h^{self.certified.order + 1} are zero and do not show the order)"
            )
        return (
            f"{self.verdict}: {statement}; "
            f"the order conditions give {self.certified.order} (certificate: {self.certified.certificate})"
        )

    def as_json(self) -> dict[str, object]:
        """Return plain data for JSON."""
        return {
            "scene": self.scene,
            "method": self.method,
            "stated_order": self.certified.order,
            "certificate": self.certified.certificate,
            "order": self.order,
            "at_least": self.vanishes,
            "initial_time": self.time,
            "points": self.points,
            "initial_state": dict(zip(self.symbols, self.start, strict=True)),
            "leading_coefficients": dict(zip(self.symbols, self.coefficients, strict=False)),
            "verdict": self.verdict,
            "failure": "",
        }


@dataclass(frozen=True)
class NotExact:
    """A method whose local error on a scene cannot be computed exactly. ``failure`` is the reason."""

    scene: str
    method: str
    failure: str
    verdict: str = "undecided"

    def sentence(self) -> str:
        """Return the verdict and the reason in one line."""
        return f"{self.verdict}: {self.failure}"

    def as_json(self) -> dict[str, object]:
        """Return the JSON object that ``orderconds localerror`` prints."""
        return {
            "scene": self.scene,
            "method": self.method,
            "stated_order": None,
            "certificate": "none",
            "order": None,
            "at_least": False,
            "initial_time": None,
            "points": 0,
            "initial_state": {},
            "leading_coefficients": {},
            "verdict": self.verdict,
            "failure": self.failure,
        }


def local_error_or_reason(scene: Problem, method: Method) -> ExactLocalError | NotExact:
    """Return the leading term of the local error of a method on a scene.

    If this term cannot be computed exactly, return a :class:`NotExact` object with the reason.
    """
    try:
        return exact_local_error(scene, method)
    except (InputError, ArithmeticError) as error:
        return NotExact(scene.name, method.label, str(error))


def exact_local_error(scene: Problem, method: Method) -> ExactLocalError:
    """Return the leading term of the local error of one step, for a method on a scene.

    The step starts at the initial state. If all computed coefficients are zero there, steps that start at
    later points of the solution are examined until a coefficient is not zero.

    Raises :class:`codegen.errors.SceneError` if the field is not smooth at the initial state, or if exact
    Taylor coefficients cannot be computed. Raises :class:`codegen.errors.MethodError` if the coefficients of
    the method are balls (intervals), because a ball cannot prove that a number is zero.
    """
    ring = method.ring
    third = ring.rational(1, 3)
    if ring.is_zero(third - third) is not True:
        raise MethodError(
            f"the coefficients of {method.label} are intervals, not exact numbers",
            expected="exact coefficients, because intervals cannot prove that a term of the error is zero",
        )
    certified = certified_order(method, scene)
    leading = _of_step(scene, method, certified)
    for count, fraction in enumerate(LATER, start=2):
        if not leading.vanishes:
            break
        later = _later(scene, method, fraction)
        if later is None:
            break
        try:
            leading = replace(_of_step(later, method, certified), points=count)
        except SceneError:
            # The local error cannot be computed at this later point of the solution, for example because the
            # field is not smooth there. Therefore the result at the previous point is returned.
            break
    return leading


def _later(scene: Problem, method: Method, fraction: Fraction) -> Problem | None:
    """Return the scene with a later initial state: the state after ``fraction`` of the time span.

    The method computes this state in :data:`STEPS` steps. The coordinates are then rounded to rational
    numbers. The result is None if the computation fails.
    """
    first, last = scene.span
    t = first + fraction * (last - first)
    try:
        state = Interpreted(optimise_method(replace(scene, span=(first, t)), method)).final(STEPS)
    except (ArithmeticError, ValueError, InputError):
        return None
    if not all(map(math.isfinite, state)):
        return None
    values = iter(state)

    def moved(block: StateField) -> StateField:
        near = [_near(next(values)) for _ in block.initial]
        numbers = [Number.rational(x.numerator, x.denominator) for x in near]
        pairs = zip(block.initial, numbers, strict=True)
        return replace(block, initial=tuple(e.space.const(x) for e, x in pairs))

    return replace(scene, span=(t, last), state=tuple(map(moved, scene.state)))


def _of_step(scene: Problem, method: Method, certified: CertifiedOrder) -> ExactLocalError:
    """Return the leading term of the local error of the step that starts at the initial state of a scene."""
    ring = method.ring
    start = with_exact_start(scene, ring)
    optimised = optimise_method(start, method)
    problem = problem_for(start, method)
    highest = certified.order + 1
    domain = SeriesDomain(ring, 1)
    try:
        error = local_error(optimised.program, problem, ring, highest)
        initial = tuple(ring.text(x.coefficients[0]) for x in problem.initial(domain))
    except Kink as reason:
        raise SceneError(
            f"the local error has no power series in h: {reason}",
            where=scene.name,
            expected="an initial state where the field is smooth",
            hint="choose another initial state",
        ) from reason
    except ArithmeticError as reason:
        raise SceneError(
            f"the local error cannot be computed exactly: {reason}",
            where=scene.name,
            expected="a scene whose formulas are rational functions of the coordinates",
            hint="use the command 'orderconds converge'; it estimates the order from the slope of the errors",
        ) from reason
    power = min(int(x.ring.valuation(x)) for x in error)
    vanishes = power > highest
    return ExactLocalError(
        scene.name,
        method.label,
        certified,
        min(power, highest + 1) - 1,
        vanishes,
        problem.symbols,
        initial,
        () if vanishes else _texts(ring, error, power),
        str(start.span[0]),
    )


def _texts(ring: Ring, error: Vector, power: int) -> tuple[str, ...]:
    return tuple(ring.text(x.coefficients[power]) for x in error)


def _near(x: float) -> Fraction:
    """Return a rational number near ``x``. Its relative error is below 1/50, so only 0 becomes 0.

    >>> _near(0.333), _near(0.001)
    (Fraction(1, 3), Fraction(21, 20992))
    """
    # A small x could be rounded to 0. Therefore a small x is divided by ``scale``, a power of 2, so that the
    # absolute value of the quotient is between 1/2 and 1. Then the quotient is rounded.
    scale = Fraction(2) ** (math.frexp(x)[1] if abs(x) < 1 / DENOMINATOR else 0)
    return (Fraction(x) / scale).limit_denominator(DENOMINATOR) * scale


def with_exact_start(scene: Problem, ring: Ring) -> Problem:
    """Return the scene with an initial state whose coordinates are exact numbers in ``ring``.

    A coordinate that is not in ``ring`` is replaced by a nearby rational number.
    """
    values = iter(scene.initial(FloatDomain(0.0)))
    domain = SeriesDomain(ring, 1)
    parameters = {name: domain.number(number) for name, number in scene.parameters.items()}

    def exact(e: Expr, value: float) -> Expr:
        try:
            evaluate([e], domain, parameters)
        except (ArithmeticError, ValueError):
            near = _near(value)
            return e.space.const(Number.rational(near.numerator, near.denominator))
        return e

    def fields(state: Sequence[StateField]) -> tuple[StateField, ...]:
        return tuple(replace(f, initial=tuple(exact(e, next(values)) for e in f.initial)) for f in state)

    return replace(scene, state=fields(scene.state))
