"""Orders on scenes whose field is not smooth."""

from __future__ import annotations

import mpmath
import pytest
import sympy

from codegen.certify import CertifiedOrder
from codegen.commands.recommend import searched
from codegen.emitter import compile_method, emit
from codegen.errors import SceneError
from codegen.groups import LeftMultiplication, Rn
from codegen.lab.efficiency.recommend import Recommendation, Request
from codegen.lab.orders.convergence import Convergence
from codegen.lab.orders.exact_order import exact_local_error
from codegen.lab.orders.order_study import order_study
from codegen.lab.orders.scene_convergence import converge
from codegen.lab.orders.step_sizes import Refinement, Run
from codegen.lab.reference import reference
from codegen.method import parse
from codegen.scene import FieldScene, HamiltonianScene, table
from codegen.scene.problem import Problem
from tests.codegen.ir.selections import FORMULAS, x, y


def oscillator(force: sympy.Expr, start: object = 1, span: object = 2) -> Problem:
    """x'' = -force(x)."""
    u, v = state = Rn(2).point("z")
    f = [v, -force.xreplace({x: u, y: v})]
    return FieldScene(group=Rn(2), action=LeftMultiplication(), y=state, f=f, y0=[start, 0], span=(0, span))


def test_the_reference_crosses_a_kink() -> None:
    # x'' = -x for x > 0 and -4 x for x < 0: a quarter of the period 2 pi, then of the period pi
    spring = sympy.Piecewise((x, x > 0), (4 * x, True))
    exact = reference(oscillator(spring))
    with mpmath.workdps(40):
        time = 2 - mpmath.pi / 2
        expected = (-mpmath.sin(2 * time) / 2, -mpmath.cos(2 * time))
        assert all(abs(a - b) < mpmath.mpf(10) ** -28 for a, b in zip(exact.state, expected, strict=True))
    assert exact.kinks == (0,)


def test_the_reference_crosses_a_jump_and_the_points_of_a_table() -> None:
    # x'' = -1 for x > 0 and +1 for x < 0: parabolas
    exact = reference(oscillator(sympy.sign(x)))
    with mpmath.workdps(40):
        time = 2 - mpmath.sqrt(2)
        assert abs(exact.state[0] - (time**2 / 2 - mpmath.sqrt(2) * time)) < mpmath.mpf(10) ** -28
    assert exact.kinks == (-1,)
    assert reference(oscillator(table([-2, -1, 0, 0.5, 2], [-2, -1.5, 0, 0.2, 2], x), span=3)).kinks == (2, 2)


def test_a_solution_that_stays_on_a_jump_is_refused() -> None:
    with pytest.raises(SceneError, match="slides along a discontinuity of the field") as caught:
        reference(oscillator(x + sympy.Rational(3, 10) * sympy.sign(y), span=20))
    assert "\n" not in str(caught.value)


def test_an_order_across_a_kink_is_neither_confirmed_nor_refuted() -> None:
    (result,) = converge(oscillator(sympy.Piecewise((x, x > 0), (4 * x, True))), "ambient:rk4")
    assert result.verdict == "undecided"
    assert "crosses one point where the field is not smooth" in result.sentence()
    assert "at most order 2" in result.sentence()


def test_an_order_that_the_kink_keeps_is_confirmed() -> None:
    (result,) = converge(oscillator(sympy.Piecewise((x, x > 0), (4 * x, True))), "ambient:heun")
    assert result.verdict == "holds"


def test_a_local_error_at_a_kink_is_refused_in_one_line() -> None:
    scene = oscillator(sympy.Abs(x), start=0)
    with pytest.raises(SceneError, match="not smooth at the initial state") as caught:
        exact_local_error(scene, parse("ambient:rk4", ("ambient",)))
    assert "\n" not in str(caught.value)


def test_the_header_states_where_the_field_is_not_smooth() -> None:
    kinked, smooth = (oscillator(force) for force in (sympy.Abs(x), x))
    sources = ["".join(emit(scene, "ambient:rk4").files.values()) for scene in (kinked, smooth)]
    assert "smooth:     no: abs(z0)" in sources[0]
    assert "smooth:" not in sources[1]


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(FORMULAS))
def test_methods_have_order_four_where_a_field_is_smooth(name: str) -> None:
    u, v = state = Rn(2).point("z")
    formula = FORMULAS[name].xreplace({x: u, y: v})
    scene = FieldScene(
        group=Rn(2),
        action=LeftMultiplication(),
        y=state,
        f=[sympy.sin(v) * formula / 4, u / 3 - v**2 / 5],
        y0=[0.4, 1],
        span=(0, sympy.Rational(1, 5)),
    )
    assert not reference(scene).kinks
    (result,) = converge(scene, "ambient:rk4")
    assert result.verdict == "holds", result.sentence()


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(FORMULAS))
def test_the_gradient_of_a_hamiltonian_is_compared_with_the_derivative_by_sympy(name: str) -> None:
    group = Rn(2)
    q, p = group.point("q"), group.dual("p")
    potential = FORMULAS[name].xreplace({x: q[0], y: q[1]})
    slopes = [potential.diff(s) for s in q]
    if any(e.has(sympy.DiracDelta, sympy.Derivative) for e in slopes):
        slopes = [e.replace(sympy.DiracDelta, lambda *_: sympy.Integer(0)).doit() for e in slopes]
    HamiltonianScene(
        group=group,
        q=q,
        mu=p,
        H=p.dot(p) / 2 + potential,
        n=[-e for e in slopes],
        q0=[0.4, 1],
        mu0=[0, 0.1],
        span=(0, 1),
    )


@pytest.mark.parametrize("slope", [2, 4])
def test_no_slope_across_a_kink_decides_about_a_higher_order(slope: int) -> None:
    runs = tuple(Run(n, 1 / n, (1 / n) ** slope) for n in (5, 10, 20, 40, 80))
    stated = CertifiedOrder(4, "exact")
    kinked, smooth = (
        Convergence("scene", "rk4", "c", stated, Refinement(runs), kinks) for kinks in ((0, 3), (2,))
    )
    assert kinked.verdict == "undecided"
    assert kinked.as_json()["observed_order"] == pytest.approx(slope)
    assert smooth.verdict == ("holds" if slope == 4 else "fails")


@pytest.mark.parametrize(("kinks", "said"), [(0, False), (2, True)])
def test_a_recommendation_states_the_number_of_kinks(kinks: int, said: bool) -> None:
    request = Request("scene", 1e-4, (), None, None, 5, ())
    text = searched(Recommendation(request, (), None, 1, 1, 0.0, kinks=kinks))
    assert ("crosses 2 points where the vector field is not smooth" in text) == said


def test_a_report_does_not_decide_an_order_across_a_kink() -> None:
    spring = sympy.Piecewise((x, x > 0), (4 * x, True))
    scene = oscillator(spring)
    study = order_study(compile_method(scene, "ambient:rk4"), reference(scene), str)
    assert study.verdict == "undecided"


def test_steps_end_at_the_points_of_a_table_so_the_slopes_settle() -> None:
    # A cubic table keeps order 4, but the error depends on the positions of its points in their steps.
    t = sympy.Symbol("t")
    gain = table([-1, 0.5, 1, 2], [1, 1.2, 0.9, 1], t)
    u, v = state = Rn(2).point("z")
    f = [sympy.sin(v) * gain, u * v - u]
    span = (0, sympy.Rational(3, 2))
    scene = FieldScene(group=Rn(2), action=LeftMultiplication(), y=state, f=f, y0=[1, 0.3], span=span)
    exact = reference(scene)
    assert (exact.kinks, exact.times) == ((2, 2), (0.5, 1.0))
    (found,) = converge(scene, "ambient:rk4", target="interpreter")
    assert found.verdict == "holds", found.sentence()
    assert all(run.steps % 3 == 0 for run in found.refinement.runs)


def test_a_step_that_ends_at_a_kink_is_named_as_the_reason_of_a_higher_order() -> None:
    t = sympy.Symbol("t")
    u, v = state = Rn(2).point("z")
    f = [v * (1 + sympy.Abs(t - 1)), -u]
    scene = FieldScene(group=Rn(2), action=LeftMultiplication(), y=state, f=f, y0=[1, 0], span=(0, 2))
    (found,) = converge(scene, "ambient:rk4", target="interpreter")
    assert found.verdict == "undecided"
    assert "at most order 2 if no step ends at such a point" in found.sentence()


def test_slopes_that_kinks_disturb_are_explained() -> None:
    errors = (1.0, 1 / 40, 1 / 200, 1 / 8000)
    runs = tuple(Run(5 * 2**k, 2.0**-k, e) for k, e in enumerate(errors))
    found = Convergence("scene", "rk4", "c", CertifiedOrder(4, "exact"), Refinement(runs), (2,))
    assert found.verdict == "undecided"
    assert "crosses one point where the field is not smooth" in found.sentence()
