"""Scenes in small and large units: what is checked and recognised does not depend on the units."""

from __future__ import annotations

import pytest
import sympy

from codegen.errors import SceneError
from codegen.flows.recognise import recognise
from codegen.groups import LeftMultiplication, Rn
from codegen.lower import problem_for
from codegen.method import Method
from codegen.passes.flows import commuting
from codegen.scene import FieldScene, HamiltonianScene
from tests.strategies import shipped

SMALL = sympy.Rational(1, 10**30)


def oscillator(V=1, xi=1):
    group = Rn(1)
    q, p = group.point("q"), group.dual("p")
    T, U = SMALL * p.dot(p) / 2, SMALL * q.dot(q) / 2
    return HamiltonianScene(
        group=group,
        q=q,
        mu=p,
        H=T + U,
        parts={"T": T, "V": V * U},
        q0=sympy.Matrix([1]),
        mu0=sympy.Matrix([0]),
        span=(0, 10**30),
        xi=xi * SMALL * p,
        n=-SMALL * q,
    )


@pytest.mark.parametrize(
    ("wrong", "message"), [({"V": 3}, "the parts T, V add up to"), ({"xi": 5}, r"xi\[0\] is")]
)
def test_wrong_formulas_are_found_in_small_units(wrong, message):
    oscillator()
    with pytest.raises(SceneError, match=message):
        oscillator(**wrong)


def test_flows_are_recognised_and_do_not_commute_in_small_units():
    problem = oscillator()
    assert [part.summands[0].flows[0][1].text() for part in recognise(problem)] == ["drift", "kick"]
    assert not commuting(problem_for(problem, Method("splitting", shipped("strang"))))("T", "V")


@pytest.mark.parametrize("size", [1, 10**30, 10**200, SMALL])
def test_an_action_is_checked_at_states_of_every_size(size):
    x, y = sympy.symbols("x y", real=True)
    FieldScene(group=Rn(2), action=LeftMultiplication(), y=[x, y], f=[y, -x], y0=[size, 0], span=(0, 1))


@pytest.mark.parametrize("unit", [1, 10**30])
def test_a_wrong_invariant_is_found_in_every_unit(unit):
    x, y = sympy.symbols("x y", real=True)
    plane = {"group": Rn(2), "action": LeftMultiplication(), "y": [x, y], "y0": [1, 0], "span": (0, 1)}
    FieldScene(f=[y, -x], invariants={"e": (x**2 + y**2) / unit}, **plane)
    with pytest.raises(SceneError, match="the invariant e changes"):
        FieldScene(f=[y, -x], invariants={"e": x / unit}, **plane)
