"""The symplectic defect of a step is the same in all units, and separates symplectic steps from others."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from sympy import Expr, Integer, Matrix, Rational, diag, sqrt

from codegen.emitter import compile_method
from codegen.groups import SE3, SO3, Rn
from codegen.lab.long_runs.long_run import long_run
from codegen.lab.long_runs.properties import SYMPLECTIC, properties
from codegen.lab.long_runs.symplecticity import symplectic_defect
from codegen.lab.runner import Emitted
from codegen.scene import HamiltonianScene
from codegen.scene.problem import Problem

Make = Callable[[Expr, Expr], Problem]

UNITS = [
    (Integer(1), Integer(1)),
    (Rational(1, 10**30), Integer(1)),
    (Integer(10) ** 24, Integer(10) ** 11),
    (Rational(1, 10**27), Rational(1, 10**10)),
]
"""A unit of mass and a unit of length: plain numbers, electrons, planets and atoms."""


def oscillator(mass: Expr, length: Expr, q0: int = 1) -> Problem:
    """H = p^2/(2m) + m (q^2/2 + q^4/(4 L^2)) with q(0) = L and p(0) = 0 in units of mass and length."""
    q, p = Rn(1).point("q"), Rn(1).dual("p")
    kinetic = p.dot(p) / (2 * mass)
    potential = mass * (q[0] ** 2 / 2 + q[0] ** 4 / (4 * length**2))
    parts = {"T": kinetic, "V": potential}
    return HamiltonianScene(
        group=Rn(1),
        q=q,
        mu=p,
        H=kinetic + potential,
        parts=parts,
        q0=[q0 * length],
        mu0=Matrix([0]),
        span=(0, 1),
    )


def orbit(mass: Expr, length: Expr) -> Problem:
    q, p = Rn(2).point("q"), Rn(2).dual("p")
    kinetic, potential = p.dot(p) / (2 * mass), -mass * length**3 / sqrt(q.dot(q))
    return HamiltonianScene(
        group=Rn(2),
        q=q,
        mu=p,
        H=kinetic + potential,
        parts={"T": kinetic, "V": potential},
        q0=[length, 0],
        mu0=Matrix([0, mass * length]),
        span=(0, 1),
    )


def top(mass: Expr, length: Expr) -> Problem:
    """A free rigid body in a field; only the unit of the inertia changes."""
    group, unit = SO3(), mass * length**2
    g, mu = group.point("g"), group.dual("m")
    body = Matrix(3, 3, list(g)).T * Matrix(mu)
    H = (body.T * diag(1, Rational(1, 2), Rational(1, 3)) * body)[0] / (2 * unit) + unit * g[8]
    return HamiltonianScene(
        group=group, q=g, mu=mu, H=H, q0=list(Matrix.eye(3)), mu0=Matrix([unit, unit / 3, 0]), span=(0, 1)
    )


def rigid(mass: Expr, length: Expr, offset: int = 1) -> Problem:
    """A rigid body in space, whose centre of mass is held by a spring and begins at ``offset`` lengths."""
    G = SE3()
    g, mu = G.point("g"), G.dual("mu")
    R, a, m, p = Matrix(3, 3, g[:9]), Matrix(g[9:]), Matrix(mu[:3]), Matrix(mu[3:])
    action, body = mass * length**2, R.T * (m - a.cross(p))
    kinetic = body.dot(diag(1, 2, 3).inv() * body) / (2 * action) + p.dot(p) / (4 * mass)
    H = kinetic + mass * a.dot(a) / 4 + action * R[2, 0]
    q0 = [*Matrix.eye(3), offset * length, 0, 0]
    return HamiltonianScene(
        group=G, q=g, mu=mu, H=H, q0=q0, mu0=[action, 0, action, 0, mass * length, 0], span=(0, 1)
    )


def rigid_at_the_origin(mass: Expr, length: Expr) -> Problem:
    return rigid(mass, length, offset=0)


def defect(scene: Problem, method: str, h: float) -> float:
    made = compile_method(scene, method)
    return symplectic_defect(made, Emitted(made).initial, h)


@pytest.mark.parametrize("scene", [oscillator, orbit])
@pytest.mark.parametrize("units", UNITS)
def test_symplectic_steps_are_found_in_all_units(scene: Make, units: tuple[Expr, Expr]) -> None:
    assert defect(scene(*units), "splitting:strang", 0.01) < SYMPLECTIC
    assert defect(scene(*units), "vcg:midpoint", 0.01) < SYMPLECTIC


@pytest.mark.parametrize("scene", [oscillator, orbit, top])
def test_the_defect_of_other_steps_is_the_same_in_all_units(scene: Make) -> None:
    known = defect(scene(*UNITS[0]), "rkmk(2):rk4", 0.01)
    assert SYMPLECTIC < known < 1e-6
    for units in UNITS[1:]:
        assert defect(scene(*units), "rkmk(2):rk4", 0.01) == pytest.approx(known, rel=1e-9)


@pytest.mark.parametrize("scene", [rigid, rigid_at_the_origin])
def test_rotations_and_translations_have_units_of_their_own(scene: Make) -> None:
    """The defect was proportional to the unit of length if this unit is small."""
    known, small = (
        defect(scene(Integer(1), x), "rkmk(0):rk4", 0.01) for x in (Integer(1), Integer(10) ** 12)
    )
    assert known > SYMPLECTIC
    assert small == pytest.approx(known, rel=1e-9)


def test_short_steps_of_other_methods_do_not_count_as_symplectic() -> None:
    """With h = 1/1000, the defect of a method of order 4 is far below the precision of doubles."""
    made = compile_method(oscillator(*UNITS[0]), "cf:cf4")
    run = long_run(made, 1e-3, 20, back=False)
    assert run.symplectic is not None
    assert run.symplectic < 1e-15
    assert properties(made, run).symplectic is False


def test_a_symplectic_method_in_a_small_unit_has_the_property() -> None:
    made = compile_method(oscillator(Rational(1, 10**12), Integer(1)), "splitting:strang")
    assert properties(made, long_run(made, 0.01, 100, back=False)).symplectic is True


def test_a_state_at_rest_has_no_scale() -> None:
    made = compile_method(oscillator(Integer(1), Integer(1), q0=0), "splitting:strang")
    run = long_run(made, 0.01, 20, back=False)
    assert run.symplectic is None
    assert "which is zero before and after the step" in run.unmeasured
