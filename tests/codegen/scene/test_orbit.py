"""Sample points of a problem: on the manifold, where the field is finite, and what vanishes there."""

from __future__ import annotations

import pytest
from sympy import Abs, Matrix, Max, Rational, log, sqrt, symbols

from codegen.errors import SceneError
from codegen.groups import LeftMultiplication, Rn
from codegen.ir.number import Number
from codegen.scene import FieldScene, param
from codegen.scene.orbit import LEAST, NEAR, POINTS, orbit_of
from codegen.scene.run_time import with_runtime
from tests.strategies import field_scene, hamiltonian_scene

y = Matrix(symbols("y0:2", real=True))


def plane(f, y0=(1, 0)):
    return FieldScene(group=Rn(2), action=LeftMultiplication(), y=y, f=f, y0=y0, span=(0, 1))


@pytest.mark.parametrize("problem", [hamiltonian_scene("SO(3)"), field_scene("SL(2)"), field_scene("S^3")])
def test_the_points_are_on_the_manifold(problem):
    orbit = orbit_of(problem)
    assert len(orbit.points) == POINTS + NEAR
    if isinstance(orbit.action, LeftMultiplication):
        for point in orbit.points:
            state = tuple(point[s] for s in orbit.symbols)
            for _, defect in orbit.group.laws(orbit.domain, state):
                assert orbit.sized(defect)
    distinct = {tuple(str(point[s]) for s in orbit.symbols) for point in orbit.points}
    assert len(distinct) == POINTS + NEAR


def test_formulas_that_vanish_on_the_group_alone_vanish():
    problem = hamiltonian_scene("SO(3)")
    orbit, space = orbit_of(problem), problem.hamiltonian.space
    column = [space.sym(f"q{i}0") for i in range(3)]
    gram = column[0] * column[0] + column[1] * column[1] + column[2] * column[2] - 1
    assert orbit.vanish([gram])
    assert not orbit.vanish([gram, column[0]])
    assert not orbit.vanish([gram + space.const(Number.rational(1, 10**19))])


def test_points_where_the_field_is_not_finite_are_left_out():
    problem = plane([log(y[0] - y[0] ** 2 * 99 / 100), 0])
    orbit = orbit_of(problem)
    assert 1 <= len(orbit.points) < POINTS + NEAR


def test_a_formula_without_a_value_does_not_vanish():
    problem = plane([y[1], 0])
    space, orbit = problem.roots[0].space, orbit_of(problem)
    a, b = space.sym("y0"), space.sym("y1")
    zero = (a + b) * (a + b) - a * a - 2 * (a * b) - b * b
    assert orbit.vanish([zero])
    assert not orbit.vanish([zero / (a - 1)])  # the initial state has a = 1


def test_a_start_where_the_field_is_not_finite_is_refused():
    with pytest.raises(SceneError, match="f at the initial state is not a finite real number"):
        plane([log(y[1]), 0])


@pytest.mark.parametrize("unit", [1, 10**30])
def test_units_do_not_change_what_vanishes(unit):
    scale = Number.rational(1, unit)
    problem = plane([y[1], 0])
    space, orbit = problem.roots[0].space, orbit_of(problem)
    a, b = (space.const(scale) * space.sym(s) for s in ("y0", "y1"))
    assert orbit.vanish([(a + b) * (a + b) - a * a - 2 * (a * b) - b * b, space.zero])
    assert not orbit.vanish([a])
    assert not orbit.vanish([b * b])


def test_some_points_are_near_the_initial_state_in_the_units_of_the_scene():
    orbit = orbit_of(plane([y[1], -y[0]], y0=(Rational(1, 10**30), 0)))
    for point in orbit.points[POINTS:]:
        assert all(0 < abs(point[s].value) < 1e-29 for s in orbit.symbols)


def test_a_formula_that_vanishes_for_the_default_of_a_run_time_parameter_only_does_not_vanish():
    x, k = symbols("x", real=True), param("k", 0)
    problem = FieldScene(
        group=Rn(1), action=LeftMultiplication(), y=[x], f=[k * x], y0=[1], span=(0, 1), name="s"
    )
    assert orbit_of(problem).vanish(problem.roots)
    assert not orbit_of(with_runtime(problem, ("k",))).vanish(problem.roots)


def line(k, f=lambda x, k: k * x):
    x = symbols("x", real=True)
    return FieldScene(group=Rn(1), action=LeftMultiplication(), y=[x], f=[f(x, k)], y0=[0], span=(0, 1))


@pytest.mark.parametrize("default", [Rational(1, 10**25), -Rational(1, 10**25), 10**25, -(10**25)])
def test_very_small_and_very_large_parameters_also_have_usual_values_of_the_same_sign(default):
    orbit = orbit_of(with_runtime(line(param("k", default)), ("k",)))
    values = [float(point["k"].value) for point in orbit.points]
    assert any(LEAST <= abs(k) <= 1 for k in values)
    assert all(k * default > 0 for k in values)


def test_a_field_that_exists_only_near_the_initial_state_is_tested_with_other_parameters_there():
    """The field is not finite at the points that are far from the initial state."""
    problem = line(param("k", 0), lambda x, k: k * x + sqrt(Rational(1, 10**4) - x))
    space = problem.roots[0].space
    product = space.sym("k") * space.sym("x")
    assert orbit_of(problem).vanish([product])
    assert not orbit_of(with_runtime(problem, ("k",))).vanish([product])


def test_values_of_a_parameter_for_which_the_field_is_not_defined_are_ignored():
    problem = line(param("k", Rational(1, 10**9)), lambda x, k: sqrt(Rational(1, 10**8) - k))
    orbit = orbit_of(with_runtime(problem, ("k",)))
    assert all(point["k"].value < 1e-8 for point in orbit.points)


def test_a_formula_with_selections_vanishes_only_if_all_its_cases_vanish():
    """The sample points are far from 10, where the case of the maximum changes."""
    problem = line(param("k", 0), lambda x, k: Max(x - 10, 0) + Abs(x))
    space, orbit = problem.roots[0].space, orbit_of(problem)
    a = space.sym("x")
    assert not orbit.vanish([space.call("choose", a - 10, a, space.zero)])
    assert orbit.vanish([space.call("fabs", a) * space.call("fabs", -a) - a * a])
