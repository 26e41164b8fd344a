"""Invariants with several cases are constant in each case, and do not jump."""

from __future__ import annotations

import pytest
from sympy import Abs, And, Expr, Heaviside, Max, Min, Piecewise, Rational, sign, sqrt, symbols

from codegen.errors import SceneError
from codegen.groups import LeftMultiplication, Rn
from codegen.scene import FieldScene, HamiltonianScene, table
from codegen.scene.problem import Problem

x, y = symbols("x y", real=True)


def scene(invariant: Expr, force: Expr = -x) -> Problem:
    """x'' = force, with one declared invariant."""
    return FieldScene(
        group=Rn(2),
        action=LeftMultiplication(),
        y=[x, y],
        f=[y, force],
        y0=[1, 0],
        span=(0, 10),
        invariants={"e": invariant},
    )


@pytest.mark.parametrize(
    "changing",
    [
        Heaviside(x),
        sign(x) + 3 * sign(y),
        Piecewise((x, x < Rational(-9, 10)), (0, True)),
        1 + Max(0, -x - Rational(95, 100)),
        Piecewise((1, And(x > 2, x < Rational(201, 100))), (0, True)),
        x**2 + y**2 + Max(0, Rational(1, 10**6) - (x - 5) ** 2),
        table([0, 8, 9], [0, 0, 1], x, "linear"),
        (x**2 + y**2) * sign(x - 7) ** 2 + sign(x - 7),
        # Max(x, y) = 0 where x = 0 and y < 0. There, Max(x, y) does not change its case.
        Piecewise((x**2 + y**2, Max(x, y) > 0), (2, True)),
        Piecewise((x**2 + y**2, Min(x, y + 2) > 0), (2, True)),
    ],
    ids=str,
)
def test_an_invariant_that_changes_its_case_and_value_is_refused(changing: Expr) -> None:
    with pytest.raises(SceneError, match="the invariant e") as caught:
        scene(changing)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "constant",
    [
        Abs(x**2 + y**2 - 2),
        sign(x**2 + y**2 - Rational(1, 3)),
        Max(x**2 + y**2, sqrt(x**2 + y**2)),
        (x * Abs(x)) ** 2 / x**2 + y**2,
    ],
    ids=str,
)
def test_an_invariant_with_cases_that_is_constant_is_accepted(constant: Expr) -> None:
    assert list(scene(constant).invariants) == ["e"]


def test_the_energy_of_a_potential_with_cases_is_accepted() -> None:
    scene(y**2 / 2 + Abs(x), -sign(x))
    scene(y**2 / 2 + Max(0, x - 2) ** 2 + x**2, -2 * x - 2 * Max(0, x - 2))
    scene(y**2 / 2 + Piecewise((x**2, x > 0), (2 * x**2, True)), -Piecewise((2 * x, x > 0), (4 * x, True)))
    spring = Piecewise((x - 1, x > 1), (x + 1, x < -1), (0, True))
    scene(y**2 / 2 + Piecewise(((x - 1) ** 2, x > 1), ((x + 1) ** 2, x < -1), (0, True)) / 2, -spring)
    scene(y**2 / 2 + Abs(Max(x, -1)), -Piecewise((1, x > 0), (-1, x > -1), (0, True)))


def test_the_energy_of_a_hamiltonian_with_a_table_is_accepted() -> None:
    group = Rn(1)
    q, p = group.point("q"), group.dual("p")
    potential = table([-2, -1, 0, 1, 2], [4, 1, 0, 1, 4], q[0])
    problem = HamiltonianScene(
        group=group, q=q, mu=p, H=p[0] ** 2 / 2 + potential, q0=[1], mu0=[0], span=(0, 1)
    )
    assert "energy" in problem.invariants
