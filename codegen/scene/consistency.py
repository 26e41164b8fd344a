"""Checks of the formulas of a scene: its initial state, velocity, Hamiltonian field, flows and invariants.

Formulas and their derivatives are compared at sample points of the manifold
(:class:`codegen.scene.orbit.Orbit`). Only :func:`check_action` uses central differences.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from codegen.errors import SceneError
from codegen.groups.capabilities import Inverse
from codegen.groups.laws import is_built_in
from codegen.groups.linear_algebra import Vector
from codegen.ir.differentiate import gradient
from codegen.ir.expr import Expr
from codegen.ir.rounding_domain import RoundingDomain, Sized
from codegen.scene.orbit import DIGITS, Orbit, orbit_of
from codegen.scene.piecewise_invariants import check_cases
from codegen.scene.problem import TIME, Problem

ROUNDING = 1e-12
ROUNDED = "the numbers are rounded: write exact numbers, such as cos(Rational(1, 10)) in place of cos(0.1)"
"""The hint for an initial state that is wrong by a rounding error."""

Stated = Mapping[str, tuple[tuple[Expr, ...], tuple[Expr, ...] | None]]
"""A map from names to pairs of formulas. The two formulas of each pair must be equal.

If the second formula is None, the first formula must equal the right-hand side of the differential equation.
"""


STEP_DIGITS, SLOPE_DIGITS = 10, 12
"""The step 10^-STEP_DIGITS and the tolerance 10^-SLOPE_DIGITS of the central differences in check_action.

The error of a central difference is about 10^-20, the square of the step.
"""


def check_problem(problem: Problem, stated: Stated) -> None:
    """Raise :class:`SceneError` if ``problem`` violates one of the following conditions.

    - The initial state lies on the manifold.
    - The two formulas of each pair in ``stated`` are equal.
    - If the scene lists the parts of its Hamiltonian, the sum of the parts is the Hamiltonian.
    - The invariants are constant along solutions.
    """
    orbit = orbit_of(problem)
    check_start(orbit)
    for what, (formulas, derived) in stated.items():
        check_equal(orbit, formulas, what, derived)
    check_parts(orbit, problem)
    check_invariants(orbit, problem.invariants)
    check_cases(orbit, problem)


def check_parts(orbit: Orbit, problem: Problem) -> None:
    """Raise :class:`SceneError` if the sum of ``problem.parts`` is not the Hamiltonian.

    The values are compared at sample points of the manifold.
    """
    if not problem.parts or problem.hamiltonian is None:
        return
    parts, zero = tuple(problem.parts.values()), orbit.domain.rational(0)
    for point in orbit.points:
        values = orbit.values((problem.hamiltonian, *parts), point)
        if values is not None and not orbit.sized(values[0] - sum(values[1:], zero), values):
            names = ", ".join(problem.parts)
            raise SceneError(
                f"the parts {names} add up to {orbit.text(sum(values[1:], zero))} {_place(orbit, point)}",
                where=orbit.name,
                expected=f"{orbit.text(values[0])}, the value of H",
                hint='list all summands of H in the argument "parts", and no other terms',
            )


def check_start(orbit: Orbit) -> None:
    """Raise :class:`SceneError` if the initial state is not on the manifold on which the group acts."""
    start = tuple(orbit.points[0][s] for s in orbit.symbols)
    for law, defect in orbit.action.laws(orbit.domain, orbit.group, start):
        if not orbit.sized(defect, (orbit.domain.rational(1),)):
            raise SceneError(
                f"the initial state violates {law} by {orbit.text(defect)}",
                where=orbit.name,
                expected=f"an element of {orbit.group.name}"
                if orbit.action.on_itself
                else f"a point of the manifold on which {orbit.group.name} acts by {orbit.action.name}",
                hint=ROUNDED if abs(defect.value) < ROUNDING else "",
            )
    _check_invertible(orbit, start)


def _check_invertible(orbit: Orbit, start: Vector[Sized]) -> None:
    group = orbit.group.offers(Inverse) if orbit.action.on_itself else None
    if group is None:
        return
    try:
        group.inverse(orbit.domain, start)
    except ZeroDivisionError as error:
        raise SceneError(
            "the initial state has no inverse",
            where=orbit.name,
            expected=f"an element of {orbit.group.name}",
            hint="give an invertible matrix",
        ) from error


def check_action(orbit: Orbit) -> None:
    """Raise :class:`SceneError` if the formulas of an action are wrong.

    At a point y, for elements g and k of the group and an element x of the Lie algebra, these equations must
    be satisfied. Here e is the identity of the group.

    - e.y = y.
    - (g k).y = g.(k.y): the action is a left action.
    - ``actexp`` at x and y is exp(x).y.
    - The velocity is the derivative of exp(eps x).y with respect to eps at eps = 0.
    """
    group, action = orbit.group, orbit.action
    d = RoundingDomain(0, _digits(orbit))
    y = tuple(d.scalar(orbit.points[-1][s].value) for s in orbit.symbols)
    x = tuple(d.rational(7 * k % 11 - 5, 8) for k in range(1, group.dim + 1))
    eps = d.rational(1, 10**STEP_DIGITS)
    ends = [action.actexp(d, group, tuple(e * a for a in x), y) for e in (eps, -eps)]
    slope = [(a - b) / (eps + eps) for a, b in zip(*ends, strict=True)]
    unmoved = "the value of y, because act(identity, y) must be y"
    laws: list[tuple[str, Vector[Sized], Vector[Sized], str]] = [
        ("act", action.act(d, group, group.identity(d), y), y, unmoved),
        ("velocity", action.velocity(d, group, x, y), tuple(slope), "d/deps act(exp(eps x), y) at eps = 0"),
    ]
    # The laws (g k).y = g.(k.y) and actexp(x, y) = exp(x).y are checked only if a user defined the action or
    # the group. For the actions and groups of this package, the tests of the package check these laws.
    if not (is_built_in(action) and is_built_in(group)):
        # Short vectors keep the products near the identity, where a local action is defined.
        g, k = (
            group.exp(
                d, tuple(d.rational(p * j % q - q // 2, 4 * q + group.dim) for j in range(1, group.dim + 1))
            )
            for p, q in ((5, 13), (3, 7))
        )
        product = action.act(d, group, group.mul(d, g, k), y)
        twice = action.act(d, group, g, action.act(d, group, k, y))
        left_action = "because act(g k, y) must be act(g, act(k, y)): the action must be a left action"
        laws.append(("act", product, twice, left_action))
        image = action.act(d, group, group.exp(d, x), y)
        laws.append(("actexp", action.actexp(d, group, x, y), image, "the value of act(exp(x), y)"))
    for what, left, right, expected in laws:
        for i, (a, b) in enumerate(zip(left, right, strict=True)):
            tolerance = d.rational(1, 10**SLOPE_DIGITS) * (abs(a) + abs(b))
            if not abs((a - b).value) <= tolerance.value + d.rounding(a - b):
                raise SceneError(
                    f"{what}[{i}] of the action {action.name} is {orbit.text(a)}",
                    where=orbit.name,
                    expected=f"{orbit.text(b)}, {expected}",
                    hint=f"correct the class {type(action).__name__}",
                )


def _digits(orbit: Orbit) -> int:
    """Return the number of digits for the central differences in :func:`check_action`.

    The number is :data:`DIGITS` if all coordinates of the sample point y are between -1 and 1. Larger
    coordinates need more digits, because the rounding error of a difference exp(eps x).y - exp(-eps x).y is
    proportional to y. For example, the number is ``DIGITS + 4`` if the largest coordinate is 1234.5.
    """
    context = orbit.domain.context
    # ``mag`` returns the binary exponent of a number, and minus infinity for the number 0.
    bits = max((0, *(context.mag(orbit.points[-1][s].value) for s in orbit.symbols)))
    return DIGITS + math.ceil(float(bits) * math.log10(2))


def check_equal(
    orbit: Orbit, stated: Sequence[Expr], what: str, derived: Sequence[Expr] | None = None
) -> None:
    """Raise :class:`SceneError` if two lists of formulas have different values at a sample point.

    - ``stated``: the formulas that the user gives in the scene.
    - ``what``: the name of these formulas in error messages, for example "velocity".
    - ``derived``: the formulas that the program derives from the Hamiltonian. If ``derived`` is None,
      ``stated`` is compared with the velocity y' = f.y, where f is the field of the scene.
    """
    source = "f.y" if derived is None else "the derivatives of H"
    for point in orbit.points:
        right = orbit.velocity(point) if derived is None else orbit.values(derived, point)
        left = orbit.values(stated, point)
        for k, (x, y) in enumerate(zip(left or (), right or (), strict=True)):
            if not orbit.sized(x - y, (x, y)):
                raise SceneError(
                    f"{what}[{k}] is {orbit.text(x)} {_place(orbit, point)}",
                    where=orbit.name,
                    expected=f"{orbit.text(y)}, from {source}",
                )


def check_flow(
    orbit: Orbit, name: str, formulas: Sequence[Expr], rates: Sequence[Expr], elapsed: str
) -> None:
    """Raise :class:`SceneError` if the user's formulas for the flow of one part of the Hamiltonian are wrong.

    At the time 0, the formulas must give the initial state of the flow. The time derivatives of the formulas
    must equal ``rates``, the right-hand sides of the differential equations of the part. ``elapsed`` is the
    symbol of the time in the formulas.
    """
    slopes = [gradient(formula, (elapsed,))[0] for formula in formulas]
    for point in orbit.points:
        for tau in (0, 1, -2):
            there = point | {elapsed: orbit.domain.rational(tau, 3)}
            moved = orbit.values(formulas, there)
            if moved is None:
                raise SceneError(f"the formulas for the flow of {name} cannot be evaluated", where=orbit.name)
            after = point | dict(zip(orbit.symbols, moved, strict=True))
            pairs = [("the time derivative is", orbit.values(slopes, there), orbit.values(rates, after))]
            if tau == 0:
                pairs.insert(0, ("the value is", moved, tuple(point[s] for s in orbit.symbols)))
            for verb, left, right in pairs:
                for k, (x, y) in enumerate(zip(left or (), right or (), strict=True)):
                    if not orbit.sized(x - y, (x, y)):
                        raise SceneError(
                            f"in the flow of {name}, the formula for {orbit.symbols[k]} is wrong: "
                            f"{verb} {orbit.text(x)} at the time {elapsed} = {orbit.text(there[elapsed])}, "
                            f"{_place(orbit, point)}",
                            where=orbit.name,
                            expected=f"{orbit.text(y)}, by the differential equations of the part {name}",
                            hint="if the part is a sum of terms whose flows do not commute, "
                            "define each term as a separate part",
                        )


def check_invariants(orbit: Orbit, invariants: Mapping[str, Expr]) -> None:
    """Raise :class:`SceneError` if a declared invariant is not constant along the solutions.

    The derivative of the invariant along the solutions must be zero at every sample point.
    """
    for name, root in invariants.items():
        slopes = gradient(root, (*orbit.symbols, TIME))
        for point in orbit.points:
            values = orbit.values(slopes, point)
            if values is None:
                continue
            terms = [a * b for a, b in zip(values, (*orbit.velocity(point), 1), strict=True)]
            total = sum(terms[1:], terms[0])
            if not orbit.sized(total, terms):
                raise SceneError(
                    f"the invariant {name} changes at the rate {orbit.text(total)}, {_place(orbit, point)}",
                    where=orbit.name,
                    expected="a function that is constant along the solutions",
                    hint=f"correct the formula of {name}, or remove {name} from the invariants",
                )


def _place(orbit: Orbit, point: dict[str, Sized]) -> str:
    shown = [f"{s} = {orbit.text(point[s])}" for s in (*orbit.symbols[:3], TIME, *orbit.changing[:3])]
    return "where " + ", ".join(shown)
