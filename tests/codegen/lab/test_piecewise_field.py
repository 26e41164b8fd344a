"""Events of short duration: the reference must stop at each point where the field is not smooth."""

from __future__ import annotations

import mpmath
import pytest
from sympy import Abs, And, Expr, Heaviside, Max, Piecewise, Rational, Symbol, exp

from codegen.errors import SceneError
from codegen.groups import LeftMultiplication, Rn
from codegen.lab.reference import reference
from codegen.scene import FieldScene
from codegen.scene.problem import Problem

PLACE = Rational(3, 10)


def oscillator(force: Expr, span: object = 2, start: object = 1) -> Problem:
    """x'' = -x + force(x), where the formula of the force contains the symbol x."""
    state = u, v = Rn(2).point("z")
    field = [v, -u + force.xreplace({Symbol("x"): u})]
    return FieldScene(
        group=Rn(2), action=LeftMultiplication(), y=state, f=field, y0=[start, 0], span=(0, span)
    )


x = Symbol("x")
BUMPS = {
    # The work of the force between the two ends of its interval is its integral over x.
    "parabola": (Max(0, 10**8 * (Rational(1, 10**6) - (x - PLACE) ** 2)), Rational(4, 30), (0, 0)),
    "wide parabola": (Max(0, 100 * (1 - ((x - PLACE) * 50) ** 2)), Rational(8, 3), (0, 0)),
    "narrow window": (
        Piecewise((1000, And(x > PLACE, x < PLACE + Rational(1, 10**4))), (0, True)),
        Rational(1, 10),
        (-1, -1),
    ),
    "difference of steps": (
        100 * (Heaviside(x - PLACE) - Heaviside(x - PLACE - Rational(1, 10**3))),
        Rational(1, 10),
        (-1, -1),
    ),
}


@pytest.mark.parametrize("name", BUMPS)
def test_a_force_that_acts_briefly_changes_the_energy_by_its_work(name: str) -> None:
    force, work, kinks = BUMPS[name]
    exact = reference(oscillator(force, start=1 if work < 1 else 3, span=Rational(21, 10)))
    # The solution passes the interval of the force once, towards smaller x.
    lost = 1 - 2 * work if work < 1 else 9 - 2 * work
    with mpmath.workdps(40):
        square = sum(v**2 for v in exact.state)
        assert abs(square - mpmath.mpf(lost.p) / lost.q) < mpmath.mpf(10) ** -28
    assert exact.kinks == kinks


def test_a_pulse_in_time_inside_a_condition_is_found() -> None:
    # The condition holds for |t - 1/3| < w with w^2 = log(2) / 10^8.
    t = Symbol("t")
    pulse = Max(0, exp(-(10**8) * (t - Rational(1, 3)) ** 2) - Rational(1, 2))
    assert reference(oscillator(1000 * pulse, span=1)).kinks == (0, 0)


def test_a_solution_that_only_touches_a_kink_has_a_reference() -> None:
    # x = cos t touches x = 1 at t = 2 pi, from below.
    exact = reference(oscillator(1000 * Max(0, x - 1 - Rational(1, 10**20)), span=7))
    assert exact.kinks == ()
    with mpmath.workdps(40):
        assert abs(exact.state[0] - mpmath.cos(7)) < mpmath.mpf(10) ** -28


def test_two_coordinates_that_stay_equal_have_a_reference() -> None:
    state = u, v = Rn(2).point("z")
    f = [-u + Abs(u - v), -v + Abs(u - v)]
    scene = FieldScene(group=Rn(2), action=LeftMultiplication(), y=state, f=f, y0=[1, 1], span=(0, 2))
    assert reference(scene).kinks == ()


def test_a_margin_that_is_zero_up_to_rounding_errors_has_no_reference() -> None:
    state = u, v = Rn(2).point("z")
    f = [v, -u + Max(0, u**2 + v**2 - 1)]
    scene = FieldScene(group=Rn(2), action=LeftMultiplication(), y=state, f=f, y0=[1, 0], span=(0, 2))
    with pytest.raises(SceneError, match="no reference solution beyond"):
        reference(scene)
