"""Taylor's method: exact order, agreement of unrolled code and loops, step control, manifolds."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction
from functools import cache

import pytest
from sympy import Matrix, Rational, exp, sin, sqrt, symbols

import codegen.groups
import codegen.kernel.taylor_expansion
from codegen import scenes
from codegen.certify import certified_order
from codegen.emitter import compile_method, emit_compiled
from codegen.errors import MethodError
from codegen.groups import LeftMultiplication, Rn
from codegen.integrator import Status, StepFailed
from codegen.ir.domain import FloatDomain
from codegen.ir.interpret import interpret
from codegen.ir.precision import DOUBLE
from codegen.lab.distance import distance
from codegen.lab.orders.exact_order import exact_local_error
from codegen.lab.reference import cached_reference
from codegen.lab.stability.linear_stability import region
from codegen.loader import load
from codegen.lower import families_for, lowering, problem_for
from codegen.method import parse
from codegen.printers import names as target_names
from codegen.run.execute import Machine
from codegen.run.floats import EmittedFloats
from codegen.run.plan import Plan
from codegen.run.unit import unit_of
from codegen.scene import FieldScene
from codegen.scene.momentum_frame import start_of
from orderconds import check, derive
from orderconds.errors import InputError
from tests.promises import ulps

ROUNDING = 64
"""Units in the last place by which orders of summation may differ."""


def plane(x_slope, y_slope):
    """A scene on the plane with the coordinates x, y."""
    return FieldScene(
        title="A field on the plane",
        group=Rn(2),
        action=LeftMultiplication(),
        y=Matrix(symbols("x y")),
        f=Matrix([x_slope, y_slope]),
        y0=[Rational(3, 5), Rational(2, 7)],
        span=(0, 1),
    )


def mixed():
    """A field with every elementary operation, and the time."""
    x, y, t = symbols("x y t")
    return plane(sin(x * y) / (2 + x**2) + t * y, exp(-y) * sqrt(3 + x) - (1 + y**2) ** Rational(-3, 2))


def method(scene, text):
    return parse(text, families_for(scene))


@cache
def compiled(scene, text, unrolled=True, adaptive=False):
    """A method, with unrolled code or as a loop whatever its length."""
    limit = codegen.kernel.taylor_expansion.UNROLLED
    codegen.kernel.taylor_expansion.UNROLLED = math.inf if unrolled else -1
    try:
        return compile_method(mixed() if scene == "mixed" else scene, text, adaptive=adaptive)
    finally:
        codegen.kernel.taylor_expansion.UNROLLED = limit


@pytest.mark.parametrize(
    ("scene", "degree"),
    [("duffing", 7), ("free_rigid_body", 6), ("free_rigid_body_s3", 5), ("heavy_top", 4)],
)
def test_the_order_over_power_series_is_the_degree_and_not_more(scene, degree):
    problem = scenes.load(scene)
    error = exact_local_error(problem, method(problem, f"taylor({degree})"))
    assert (error.order, error.vanishes, error.verdict) == (degree, False, "holds")
    assert error.certified.order == degree


@pytest.mark.parametrize("unrolled", [True, False])
@pytest.mark.parametrize("scene", ["mixed", "free_rigid_body", "heavy_top", "driven_spin", "dipole"])
def test_all_targets_and_the_interpreter_agree_in_unrolled_code_and_in_a_loop(scene, unrolled):
    made = compiled(scene, "taylor(6)", unrolled)
    assert bool(made.kernel.outputs) is unrolled
    problem, t = problem_for(made.scene, made.method), float(made.scene.span[0]) + 0.25
    start = list(start_of(made.scene))
    for h in (0.0625, -0.03125):
        values = {"y": tuple(start), "t": t}
        expected = list(interpret(made.lowered, problem, FloatDomain(h), values)["y"])
        for target in target_names():
            found = load(emit_compiled(made, target)).step(start, h, t)
            assert ulps(found, expected) <= ROUNDING


@pytest.mark.parametrize("unrolled", [True, False])
def test_c_python_and_the_executor_choose_the_same_steps(unrolled):
    made = compiled("free_rigid_body", "taylor(8)", unrolled, True)
    start = list(start_of(made.scene))
    ends = [
        load(emit_compiled(made, target)).adaptive(start, 0.0, 2.0, rtol=1e-9, atol=1e-9)
        for target in target_names()
    ]
    machine = Machine(unit_of(Plan(made.kernel, DOUBLE)), EmittedFloats())
    state, time, h, accepted = list(start), [0.0], [0.0], [0]
    machine.call("run_adaptive", state, time, 2.0, h, 1e-9, 1e-9, 1000, accepted, None)
    for end in ends:
        assert (end.accepted, end.rejected, end.t) == (accepted[0], 0, 2.0)
        assert ulps(end.state, state) <= ROUNDING


@pytest.mark.parametrize("scene", ["duffing", "free_rigid_body", "driven_spin"])
@pytest.mark.parametrize("degree", [6, 14])
def test_adaptive_steps_reach_the_tolerance_and_return(scene, degree):
    made = compiled(scene, f"taylor({degree})", True, True)
    exact, integrator = cached_reference(made.scene), load(emit_compiled(made, "c"))
    first, last = map(float, made.scene.span)
    start, errors = list(start_of(made.scene)), []
    for tolerance in (1e-5, 1e-8, 1e-11):
        end = integrator.adaptive(start, first, last, rtol=tolerance, atol=tolerance)
        errors.append(distance(made.scene, end.state, exact.state))
        assert errors[-1] <= 20 * tolerance
    assert errors[2] < 1e-3 * errors[0]
    back = integrator.adaptive(end.state, last, first, rtol=1e-11, atol=1e-11)
    assert max(abs(a - b) for a, b in zip(back.state, start, strict=True)) < 1e-8


def test_a_given_step_size_bounds_the_first_step_only():
    integrator = load(emit_compiled(compiled("duffing", "taylor(10)", True, True), "c"))
    start = [0.75, 0.75]
    free = integrator.adaptive(start, 0.0, 2.0, rtol=1e-8, atol=1e-8)
    bounded = integrator.adaptive(start, 0.0, 2.0, 1e-3, rtol=1e-8, atol=1e-8)
    assert free.accepted < bounded.accepted <= free.accepted + 2


def test_the_limit_of_steps_and_bad_arguments_are_statuses():
    integrator = load(emit_compiled(compiled("duffing", "taylor(10)", True, True), "c"))
    for arguments, status in (
        ({"limit": 2}, Status.LIMIT),
        ({"rtol": -1.0}, Status.BAD_STEP),
        ({"rtol": 0.0, "atol": 0.0}, Status.BAD_STEP),
    ):
        with pytest.raises(StepFailed) as failure:
            integrator.adaptive([0.75, 0.75], 0.0, 2.0, **({"rtol": 1e-8, "atol": 1e-8} | arguments))
        assert failure.value.status is status


def singular():
    """sqrt(x) and 1/y, which have no Taylor polynomial at zero."""
    x, y = symbols("x y")
    return plane(sqrt(x), 1 / y)


@pytest.mark.parametrize("target", target_names())
@pytest.mark.parametrize("unrolled", [True, False])
@pytest.mark.parametrize("start", [(0.0, 1.0), (1.0, 0.0), (-1.0, 1.0)])
def test_a_singular_field_gives_a_status_and_keeps_the_state(start, unrolled, target, monkeypatch):
    monkeypatch.setattr(codegen.kernel.taylor_expansion, "UNROLLED", math.inf if unrolled else -1)
    integrator = load(emit_compiled(compile_method(singular(), "taylor(5)", adaptive=True), target))
    with pytest.raises(StepFailed) as failure:
        integrator.step(start, 0.125)
    assert (failure.value.status, tuple(failure.value.state)) == (Status.NOT_FINITE, start)
    with pytest.raises(StepFailed) as failure:
        integrator.adaptive(start, 0.0, 1.0)
    assert (failure.value.status, tuple(failure.value.state)) == (Status.NOT_FINITE, start)


def test_an_equilibrium_takes_one_step():
    integrator = load(emit_compiled(compiled("duffing", "taylor(10)", True, True), "c"))
    assert integrator.adaptive([0.0, 0.0], 0.0, 50.0).accepted == 1


@pytest.mark.parametrize(
    ("scene", "name"),
    [
        ("free_rigid_body", "radius"),
        ("free_rigid_body_s3", "length"),
        ("free_rigid_body_quaternion", "length"),
    ],
)
def test_the_manifold_is_kept_to_rounding_over_many_steps(scene, name):
    made = compiled(scene, "taylor(8)")
    start = list(start_of(made.scene))
    end = load(emit_compiled(made, "c")).run(start, 0.0625, 100_000)
    values = [made.scene.invariant(FloatDomain(0.0), name, x) for x in (start, end)]
    assert abs(values[1] - values[0]) < 1e-12


def test_a_rotation_matrix_stays_orthogonal_over_many_steps():
    made = compiled("heavy_top", "taylor(8)")
    end = load(emit_compiled(made, "c")).run(list(start_of(made.scene)), 0.001, 100_000)
    laws = made.scene.group.laws(FloatDomain(0.0), tuple(end[:9]))
    assert max(abs(x) for _, x in laws) < 1e-14


def test_families_with_tableaux_ask_for_one_and_this_family_for_none():
    families = families_for(scenes.load("duffing"))
    assert parse("taylor(12)", families).label == "taylor(12)"
    for text, message in (
        ("taylor", "the family taylor has no degree"),
        ("taylor(0)", "expected a degree from 1 to 40"),
        ("taylor(41)", "expected a degree from 1 to 40"),
        ("taylor:rk4", "the family taylor has no tableaux"),
        ("taylor(3):rk4", "the family taylor has no tableaux"),
    ):
        with pytest.raises(InputError, match=message.replace("(", r"\(")):
            parse(text, families)


def test_step_control_needs_two_coefficients():
    with pytest.raises(MethodError, match=r"step-size control for taylor\(1\)"):
        compile_method("duffing", "taylor(1)", adaptive=True)


def test_inputs_without_formula_are_refused():
    with pytest.raises(
        MethodError, match=r"actuated_rigid_body, because .* of the run-time input u0 are unkn"
    ):
        compile_method("actuated_rigid_body", "taylor(4)", inputs=("u0",))


def test_commands_say_why_there_are_no_conditions():
    for ask in (lambda: derive("taylor", order=2), lambda: check("rk4", family="taylor")):
        with pytest.raises(InputError, match=r"its order is P by construction"):
            ask()


def test_the_certified_order_is_the_degree_by_construction():
    problem = scenes.load("heavy_top")
    order = certified_order(method(problem, "taylor(9)"), problem)
    assert (order.order, order.certificate) == (9, "construction")
    assert not lowering("taylor").symplectic(problem, method(problem, "taylor(9)"))


def test_the_stability_function_is_the_polynomial_of_the_exponential():
    problem = scenes.load("duffing")
    found = region(method(problem, "taylor(4)"))
    assert found is not None
    assert found.value(-1.0) == pytest.approx(1 - 1 + 1 / 2 - 1 / 6 + 1 / 24)
    # The intervals of every Runge-Kutta method with four stages and order four.
    assert found.real == pytest.approx(2.785, abs=1e-3)
    assert found.imaginary == pytest.approx(2 * math.sqrt(2), abs=1e-3)


def test_long_code_becomes_a_loop_and_short_code_does_not():
    assert compile_method("heavy_top", "taylor(8)").kernel.outputs
    assert not compile_method("heavy_top", "taylor(20)").kernel.outputs


def test_operations_of_a_loop_are_counted():
    made = compile_method("heavy_top", "taylor(20)")
    counted = emit_compiled(made, "c").manifest["operations"]["step"]
    # 18 products of two series: n - 1 terms in the inner sum of order n, and two more.
    assert 18 * 18 * 19 // 2 < counted["mul"] < 2 * 18 * 20 * 21 // 2


def test_the_symbols_of_a_scene_may_be_those_of_the_code():
    """The names of loops, sums and coefficients are changed where a scene has them."""
    sum_, k = symbols("series left")
    scene = FieldScene(
        title="Names",
        group=Rn(2),
        action=LeftMultiplication(),
        y=Matrix([sum_, k]),
        f=Matrix([k, -sum_]),
        y0=[1, 0],
        span=(0, 1),
    )
    made = replace(compile_method(scene, "taylor(12)", adaptive=True))
    for target in target_names():
        end = load(emit_compiled(made, target)).adaptive([1.0, 0.0], 0.0, 1.0, rtol=1e-12, atol=1e-12)
        assert end.state[0] == pytest.approx(math.cos(1.0), abs=1e-11)
    assert Fraction(1) == made.scene.span[1]


@pytest.mark.parametrize(
    ("scene", "kept"),
    [
        ("free_rigid_body", True),
        ("free_rigid_body_s3", True),
        ("heavy_top", True),
        ("duffing_sl2", True),
        ("unprojected", False),
    ],
)
def test_the_manifold_is_claimed_only_where_a_step_is_projected_onto_it(scene, kept, monkeypatch):
    """An SO(3) whose action projects nothing loses the claim; the orbit of SL(2) in the plane is open."""
    if scene == "unprojected":
        monkeypatch.setattr(codegen.groups.Linear, "to_orbit", lambda self, d, group, y, start: y)
        scene = "free_rigid_body"
    assert lowering("taylor").keeps_manifold(scenes.load(scene)) is kept


@pytest.mark.parametrize("scene", ["heavy_top", "dipole"])
def test_adaptive_runs_in_the_body_frame_agree_with_those_in_space(scene):
    problem = scenes.load(scene)
    group = problem.group
    start = tuple(map(float, problem.initial(FloatDomain(0.0))))
    first, last = map(float, problem.span)
    ends = {}
    for frame in ("space", "body"):
        module = emit_compiled(compile_method(problem, "taylor(12)", frame=frame, adaptive=True), "c")
        q, mu = start[: group.size], start[group.size :]
        state = start if frame == "space" else (*q, *group.Adt(FloatDomain(0.0), q, mu))
        ends[frame] = tuple(load(module).adaptive(list(state), first, last, rtol=1e-12, atol=1e-12).state)
    q, momentum = ends["body"][: group.size], ends["body"][group.size :]
    body = (*q, *group.Adtinv(FloatDomain(0.0), q, momentum))
    assert max(abs(a - b) for a, b in zip(body, ends["space"], strict=True)) < 1e-9
