"""The exact order of an emitted step is computed from its local error, also where the start is irrational."""

from __future__ import annotations

import json
from fractions import Fraction

import pytest
from click.testing import CliRunner
from sympy import symbols

from codegen import scenes
from codegen.certify import CertifiedOrder
from codegen.errors import MethodError, SceneError
from codegen.groups import LeftMultiplication, Rn
from codegen.lab.default_methods import methods_for
from codegen.lab.orders import exact_order
from codegen.lab.orders.exact_order import exact_local_error
from codegen.scene import FieldScene
from codegen.scene.problem import Problem
from orderconds.cli import program
from tests.codegen.commands.conftest import registered

__all__ = ["registered"]


def error_of(scene: str, method: str) -> exact_order.ExactLocalError:
    problem = scenes.load(scene)
    (chosen,) = methods_for(problem, (method,))
    return exact_local_error(problem, chosen)


@pytest.mark.parametrize(
    ("scene", "method", "order"),
    [
        ("free_rigid_body", "rkmk(0):euler", 1),
        ("free_rigid_body", "cg:cg3", 3),
        ("free_rigid_body", "rkmk(2):rk4", 4),
        ("free_rigid_body", "rkmk(2):gauss2", 4),
        ("free_rigid_body", "ambient:rk4", 4),
        ("duffing_sl2", "cf:cf4", 4),
        ("heavy_top", "vcg:midpoint", 2),
        ("heavy_top", "vrkmk(2):gauss2", 4),
        ("free_rigid_body_s3", "discrete_gradient:midpoint", 2),
    ],
)
def test_the_exact_order_is_the_one_of_the_order_conditions(scene: str, method: str, order: int) -> None:
    found = error_of(scene, method)
    assert (found.order, found.vanishes, found.verdict) == (order, False, "holds")
    assert any(text != "0" for text in found.coefficients)


def test_the_leading_coefficient_is_the_textbook_one() -> None:
    """Explicit Euler on the Duffing oscillator errs by -h^2/2 y''."""
    found = error_of("duffing", "rk:euler")
    x = y = Fraction(3, 4)
    acceleration, jerk = -x - x**3, -y - 3 * x**2 * y
    assert found.order == 1
    assert [Fraction(text) for text in found.coefficients] == [-acceleration / 2, -jerk / 2]


def test_an_irrational_start_is_replaced_by_a_rational_one() -> None:
    found = error_of("free_rigid_body", "cg:cg3")
    assert all(Fraction(text).denominator <= exact_order.DENOMINATOR for text in found.start)
    exact = error_of("duffing", "rk:rk4")
    assert exact.start == ("3/4", "3/4")


@pytest.mark.parametrize("x", [0.0, 0.001, -0.007, 1e-12, 5e-324, 0.0156, 0.3, -7.77, 1e12])
def test_a_rational_coordinate_has_a_small_relative_error(x: float) -> None:
    """A coordinate in small units must not become zero: at zero, the field may vanish."""
    near = exact_order._near(x)
    assert abs(near - Fraction(x)) <= abs(Fraction(x)) / 50
    if abs(x) >= 1 / exact_order.DENOMINATOR:
        assert near.denominator <= exact_order.DENOMINATOR


def test_an_order_below_the_stated_one_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(exact_order, "certified_order", lambda method, scene: CertifiedOrder(4, "exact"))
    assert error_of("free_rigid_body", "cg:cg3").verdict == "fails"


def test_a_local_error_that_vanishes_gives_a_lower_bound(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(exact_order, "certified_order", lambda method, scene: CertifiedOrder(2, "exact"))
    found = error_of("free_rigid_body", "rkmk(2):rk4")
    assert (found.order, found.vanishes, found.coefficients) == (3, True, ())
    assert "at least 3" in found.sentence()


def polynomial(degree: int) -> Problem:
    """The solution is x = 1 + t + t^(degree + 1); derivatives of orders 2 to degree vanish at t = 0."""
    x, t = symbols("x t", real=True)
    field = (degree + 1) * t**degree + 1
    return FieldScene(
        group=Rn(1), action=LeftMultiplication(), y=[x], f=[field + 0 * x], y0=[1], span=(0, 1), name="s"
    )


@pytest.mark.parametrize("method", ["ambient:rk4", "rkmk:rk4"])
def test_a_field_whose_derivatives_vanish_at_the_start_shows_its_order_later(method: str) -> None:
    problem = polynomial(6)
    (chosen,) = methods_for(problem, (method,))
    found = exact_local_error(problem, chosen)
    assert (found.order, found.vanishes, found.verdict, found.points) == (4, False, "holds", 2)
    assert Fraction(found.time) > 0
    assert Fraction(found.coefficients[0]) != 0
    assert "order 4 in exact arithmetic on this scene (computed at a later point of" in found.sentence()


def test_an_order_that_no_point_bounds_is_stated_for_the_points_only() -> None:
    """Simpson's rule integrates t^3 exactly."""
    problem = polynomial(3)
    (chosen,) = methods_for(problem, ("ambient:rk4",))
    found = exact_local_error(problem, chosen)
    assert (found.order, found.vanishes, found.points) == (5, True, 3)
    assert "steps from the initial state and 2 later points of the solution" in found.sentence()
    assert "on this scene" not in found.sentence()


def test_a_field_that_is_not_rational_has_no_exact_local_error() -> None:
    with pytest.raises(SceneError, match="sqrt"):
        error_of("dipole", "cf:cf4")


def test_coefficients_that_are_balls_have_no_exact_local_error() -> None:
    with pytest.raises(MethodError, match="intervals"):
        error_of("free_rigid_body", "cg:cg4a")


def test_the_command_prints_the_orders_and_its_json_has_exact_coefficients() -> None:
    words = ["localerror", "free_rigid_body", "-m", "cg:cg3", "-m", "cf:cf4"]
    done = CliRunner().invoke(program, words)
    assert done.exit_code == 0, done.output
    assert "coefficient of h^4" in done.stdout
    sentence = "order 4 in exact arithmetic on this scene; the order conditions give 4 (certificate: exact)"
    assert f"holds: {sentence}" in done.stdout
    (first, second) = json.loads(CliRunner().invoke(program, [*words, "--json"]).stdout)
    assert (first["order"], second["order"]) == (3, 4)
    assert any(Fraction(x) for x in first["leading_coefficients"].values())


def test_a_method_without_exact_coefficients_is_a_row_and_the_others_go_on() -> None:
    words = ["localerror", "free_rigid_body", "-m", "cg:cg4a", "-m", "cg:cg3"]
    done = CliRunner().invoke(program, words)
    assert done.exit_code == 1, done.output
    (line,) = (line for line in done.stdout.splitlines() if "undecided" in line)
    assert "the coefficients of cg:cg4a are intervals" in line
    assert "holds: order 3" in done.stdout
    unknown, known = json.loads(CliRunner().invoke(program, [*words, "--json"]).stdout)
    assert (unknown["verdict"], unknown["order"]) == ("undecided", None)
    assert "intervals" in unknown["failure"]
    assert (known["verdict"], known["order"], known["failure"]) == ("holds", 3, "")
    assert known.keys() == unknown.keys()
    (dipole,) = json.loads(
        CliRunner().invoke(program, ["localerror", "dipole", "-m", "cf:cf4", "--json"]).stdout
    )
    assert (dipole["verdict"], "sqrt" in dipole["failure"]) == ("undecided", True)
