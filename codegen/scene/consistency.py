"""Checks of the formulas of a scene: its initial state, velocity, Hamiltonian field, flows and invariants.

Derivatives are exact, by reverse differentiation of the formulas. They are compared at the points of an
:class:`codegen.scene.orbit.Orbit`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from codegen.errors import SceneError
from codegen.groups.actions import LeftMultiplication
from codegen.ir.differentiate import gradient
from codegen.ir.expr import Expr
from codegen.scene.orbit import Orbit, orbit_of
from codegen.scene.problem import TIME, Problem

if TYPE_CHECKING:
    import mpmath

ROUNDING = 1e-12
ROUNDED = "the numbers are rounded: write exact ones, such as cos(Rational(1, 10)) for cos(0.1)"
"""The hint for an initial state that is wrong by a rounding error."""

Stated = Mapping[str, tuple[tuple[Expr, ...], tuple[Expr, ...] | None]]
"""Formulas that a scene contains, by the name that messages use, and the computed formulas that they must
equal. If the computed formulas are None, the formulas of the scene must equal the velocity f.y."""


def check_problem(problem: Problem, stated: Stated) -> None:
    """Raise :class:`SceneError` if the scene contradicts itself."""
    orbit = orbit_of(problem)
    check_start(orbit)
    for what, (formulas, derived) in stated.items():
        check_equal(orbit, formulas, what, derived)
    check_parts(orbit, problem)
    check_invariants(orbit, problem.invariants)


def check_parts(orbit: Orbit, problem: Problem) -> None:
    """Raise :class:`SceneError` if the parts of a Hamiltonian do not add up to it.

    They are compared on the orbit: H and the sum may differ by a relation such as |q|^2 = 1.
    """
    if not problem.parts or problem.hamiltonian is None:
        return
    parts = tuple(problem.parts.values())
    for point in orbit.points:
        values = orbit.values((problem.hamiltonian, *parts), point)
        if values is not None and not orbit.sized(values[0] - sum(values[1:]), values):
            names = ", ".join(problem.parts)
            raise SceneError(
                f"the parts {names} add up to {orbit.text(sum(values[1:]))} {_place(orbit, point)}",
                where=orbit.name,
                expected=f"{orbit.text(values[0])}, the value of H",
                hint="name every summand of H in parts, and no other terms",
            )


def check_start(orbit: Orbit) -> None:
    """Raise :class:`SceneError` if the initial state should be an element of the group, because the group
    acts on itself, but is not."""
    if not isinstance(orbit.action, LeftMultiplication):
        return
    start = tuple(orbit.points[0][s] for s in orbit.symbols)
    for law, defect in orbit.group.laws(orbit.domain, start):
        if not orbit.sized(defect, (1,)):
            raise SceneError(
                f"an initial state that violates {law} by {orbit.text(defect)}",
                where=orbit.name,
                expected=f"an element of {orbit.group.name}",
                hint=ROUNDED if abs(defect) < ROUNDING else "",
            )


def check_equal(
    orbit: Orbit, stated: Sequence[Expr], what: str, derived: Sequence[Expr] | None = None
) -> None:
    """Raise :class:`SceneError` if formulas of the scene differ from the ``derived`` formulas, or from f.y if
    ``derived`` is None.

    ``what`` names the formulas of the scene in the message.
    """
    for point in orbit.points:
        right = orbit.velocity(point) if derived is None else orbit.values(derived, point)
        left = orbit.values(stated, point)
        for k, (x, y) in enumerate(zip(left or (), right or (), strict=True)):
            if not orbit.sized(x - y, (x, y)):
                raise SceneError(
                    f"{what}[{k}] is {orbit.text(x)} {_place(orbit, point)}",
                    where=orbit.name,
                    expected=f"{orbit.text(y)}, by {'f.y' if derived is None else 'the derivatives of H'}",
                )


def check_flow(
    orbit: Orbit, name: str, formulas: Sequence[Expr], rates: Sequence[Expr], elapsed: str
) -> None:
    """Raise :class:`SceneError` if the formulas that a scene gives for the flow of a part are not this flow.

    The formulas must equal the state at the time 0. At all times their time derivatives must be the part's
    ``rates``; ``elapsed`` is the symbol of the time in the formulas. The derivatives are exact, and are
    compared with 40 digits.
    """
    slopes = [gradient(formula, (elapsed,))[0] for formula in formulas]
    for point in orbit.points:
        for tau in (0, 1, -2):
            there = point | {elapsed: orbit.domain.rational(tau, 3)}
            moved = orbit.values(formulas, there)
            if moved is None:
                raise SceneError(f"the flow of {name} cannot be evaluated", where=orbit.name)
            after = point | dict(zip(orbit.symbols, moved, strict=True))
            pairs = [("has the time derivative", orbit.values(slopes, there), orbit.values(rates, after))]
            if tau == 0:
                pairs.insert(0, ("has the value", moved, tuple(point[s] for s in orbit.symbols)))
            for verb, left, right in pairs:
                for k, (x, y) in enumerate(zip(left or (), right or (), strict=True)):
                    if not orbit.sized(x - y, (x, y, 1)):
                        raise SceneError(
                            f"the flow of {name} {verb} {orbit.text(x)} in {orbit.symbols[k]} "
                            f"at {elapsed} = {orbit.text(there[elapsed])}",
                            where=orbit.name,
                            expected=f"{orbit.text(y)}, by the equations of the part",
                            hint="if summands do not commute, their flows do not compose to the flow of "
                            "their sum: define them as separate parts",
                        )


def check_invariants(orbit: Orbit, invariants: Mapping[str, Expr]) -> None:
    """Raise :class:`SceneError` if a declared invariant is not constant along the solutions.

    The time derivative dI.(f.y) + dI/dt of an invariant I is formed exactly and must vanish at every point.
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
                    expected="a function that is constant along the field",
                    hint="correct its formula, or remove it from invariants",
                )


def _place(orbit: Orbit, point: dict[str, mpmath.mpf]) -> str:
    shown = [f"{s} = {orbit.text(point[s])}" for s in (*orbit.symbols[:3], TIME)]
    return "where " + ", ".join(shown)
