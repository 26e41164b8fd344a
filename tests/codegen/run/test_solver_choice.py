"""Which solver a block gets: the robust one of least predicted time, and any that is asked for."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest
from click.testing import CliRunner
from sympy import Matrix, Rational

from codegen.commands.emit import command as emit_command
from codegen.commands.emit import explanation
from codegen.emitter import compile_method, emit_compiled
from codegen.groups import LeftMultiplication, Rn
from codegen.integrator import StepFailed
from codegen.ir.kernel import FIXED_POINT, NEWTON, SIMPLIFIED_NEWTON
from codegen.loader import load
from codegen.run import solver_choice
from codegen.run.elimination import inverted
from codegen.run.solver_choice import CHOICES, FEW_STEPS, LARGE, STEPS, Candidate, is_linear
from codegen.run.step_cost import Amounts, StepCost
from codegen.scene import FieldScene
from codegen.scene.momentum_frame import start_of
from orderconds.errors import UnknownName
from tests.compilations import compiled, emitted

TRIED = f"measured over the first {STEPS} steps of size h = "


def heat(points, duration):
    """The heat equation on a line of points, in units of their distance."""
    group = Rn(points)
    u = group.point("u")
    padded = [0, *u, 0]
    field = Matrix([padded[k] - 2 * padded[k + 1] + padded[k + 2] for k in range(points)])
    return FieldScene(
        title="Heat equation",
        name="heat",
        group=group,
        action=LeftMultiplication(),
        y=u,
        f=field,
        y0=[Rational(k * (points + 1 - k), points) for k in range(1, points + 1)],
        span=(0, duration),
        velocity=field,
    )


def chosen_from(scene, monkeypatch):
    """The choice for gauss2 on a scene of one block, and the solvers of the kernels built for it."""
    built = []
    made = solver_choice.to_kernel

    def counting(program, problem, solvers):
        built.append(set(solvers.values()))
        return made(program, problem, solvers)

    monkeypatch.setattr(solver_choice, "to_kernel", counting)
    (choice,) = compile_method(scene, "ambient:gauss2").solvers
    return choice, built


def test_a_stiff_linear_scene_is_solved_by_newtons_method(monkeypatch):
    """With 64 unknowns the fixed point fails; simplified Newton, a matrix in each step, is not built."""
    choice, built = chosen_from(heat(32, 800), monkeypatch)
    assert (choice.solver, choice.unknowns) == (NEWTON, LARGE)
    assert choice.compared[0] == f"fixed point: fails in one of the first {STEPS} steps of size h = 8"
    assert choice.reason.startswith("2 sweeps and 0.05 matrices a step")
    assert built == [{NEWTON}]


def test_a_fixed_point_that_fails_in_longer_steps_yields_to_newtons_method(monkeypatch):
    """At the step of the example the fixed point converges and would be faster."""
    choice, built = chosen_from(heat(32, 20), monkeypatch)
    assert choice.solver == NEWTON
    assert choice.reason.endswith("; fixed point would be faster, but does not converge in a step of 8 h")
    assert built == [{NEWTON}]


def test_trials_of_many_unknowns_make_few_steps(monkeypatch):
    choice, built = chosen_from(heat(36, 800), monkeypatch)
    assert choice.solver == NEWTON
    assert f"measured over the first {FEW_STEPS} steps" in choice.reason
    assert built == [{NEWTON}]


def test_no_kernel_is_built_beside_a_cheap_fixed_point_of_many_unknowns(monkeypatch):
    choice, built = chosen_from(heat(36, 1), monkeypatch)
    assert choice.solver == FIXED_POINT
    assert [": not tried, because it would take at least " in line for line in choice.compared] == [
        False,
        True,
        True,
    ]
    assert built == []


@pytest.mark.parametrize(
    "method",
    [
        "vcg:midpoint",
        pytest.param("vcf:cf4", marks=pytest.mark.slow),
        "vrkmk(2):gauss2",
        pytest.param("ambient:gauss2", marks=pytest.mark.slow),
    ],
)
def test_the_chosen_solver_is_the_robust_one_of_least_predicted_time(method):
    sides = {s: compiled("dipole", method, s) for s in (FIXED_POINT, NEWTON, SIMPLIFIED_NEWTON)}
    tried = {s: Candidate(made.kernel, made.problem, start_of(made.scene)) for s, made in sides.items()}
    (choice,) = compiled("dipole", method).solvers
    assert choice.solver == min((s for s in tried if tried[s].robust), key=lambda s: tried[s].step())


def test_a_prediction_grows_with_every_sweep_and_matrix():
    made = compiled("dipole", "vrkmk(2):gauss2", NEWTON)
    cost = StepCost(made.kernel)
    assert cost.step([1], [0]) < cost.step([2], [0]) < cost.step([2], [1])
    twice = cost.block(0, 2, 1) + cost.block(0, 2, 1)
    assert cost.block(0, 4, 2) == twice
    assert cost.amounts([0], [0]) + cost.block(0, 2, 1) == cost.amounts([2], [1])


def test_the_inverse_that_is_not_a_formula_costs_the_cube_of_its_size():
    for method, cubes in (("vcg:midpoint", 0), ("vrkmk(2):gauss2", 6**3)):
        made = compiled("dipole", method, NEWTON)
        assert StepCost(made.kernel).block(0, 0, 1).cubes == cubes
    made = compiled("dipole", "vcg:midpoint", FIXED_POINT)
    assert StepCost(made.kernel).block(0, 0, 1) == Amounts()


def test_a_scene_that_no_solver_solves_says_so_in_the_header():
    made = compiled("stiff_driven_spin", "rkmk(0):gauss1")
    (choice,) = made.solvers
    assert choice.solver == NEWTON
    assert choice.reason == (
        f"no solver converges in the first {STEPS} steps of size h = 0.05, with or without continuation "
        "in h; take shorter steps"
    )
    assert words_of_header(made).count(choice.text()) == 1


def test_a_scene_that_is_solved_by_continuation_says_so():
    (choice,) = compiled("stiff_driven_spin", "ambient:gauss2").solvers
    assert choice.solver == NEWTON
    assert choice.reason == (
        f"no solver converges in the first {STEPS} steps of size h = 0.05 without continuation in h "
        "(initial guesses from shorter steps); with continuation, the solver needs 15.5 sweeps "
        "and 7.6 matrices a step"
    )


def test_a_scene_near_the_limit_of_fixed_points_is_solved_by_newtons_method():
    (choice,) = compiled("heavy_top", "vcg:midpoint").solvers
    assert (choice.solver, choice.unknowns) == (NEWTON, 6)
    assert "the solver does not converge in a step of size 8 h" in choice.compared[0]


def test_many_unknowns_that_change_slowly_are_iterated():
    (choice,) = compiled("linear_oscillator", "rk:gauss2").solvers
    assert (choice.solver, choice.unknowns) == (FIXED_POINT, 16)
    assert choice.reason == f"4 sweeps a step, {TRIED}0.03"


def words_of_header(made):
    """The words of an emitted C file, with the borders of its comment left out."""
    artifact = emit_compiled(made, "c")
    source = artifact.files[f"{artifact.manifest['module']}.c"]
    return " ".join(source.replace("\n *", "\n").split())


def test_figures_of_other_solvers_are_in_the_explanation_alone():
    made = compiled("dipole", "vrkmk(2):gauss2")
    (choice,) = made.solvers
    assert choice.text() in words_of_header(made)
    assert choice.reason.endswith(f"{TRIED}0.005")
    assert [line.partition(":")[0] for line in choice.compared] == [
        "fixed point",
        "Newton's method",
        "Newton's method with the Jacobian to first order in h",
    ]
    told = explanation(made)
    for line in choice.compared:
        assert line in told
        assert line not in words_of_header(made)


@pytest.mark.parametrize("solver", [NEWTON, SIMPLIFIED_NEWTON, FIXED_POINT])
def test_the_solver_that_is_asked_for_is_emitted(solver):
    made = compiled("heavy_top", "vcg:alexander2", solver)
    assert {loop.solver for loop in made.kernel.loops} == {solver}
    assert [c.reason for c in made.solvers] == ["as asked for"] * 2
    emission = emitted("heavy_top", "vcg:alexander2", solver=solver)
    assert emission.manifest["interface"]["solvers"] == [solver] * 2
    assert [c["solver"] for c in emission.manifest["solvers"]] == [solver] * 2
    source = emission.files["heavy_top_vcg_alexander2.c"]
    assert f"--solver {solver}" in words_of_header(made)
    assert source.count(" * solved by:") == 2
    assert ("memory->inverse_1" in source) == (solver == NEWTON)


def test_explicit_methods_have_nothing_to_solve():
    made = compiled("free_rigid_body", "cf4", NEWTON)
    assert made.solvers == ()
    assert "solved by" not in emitted("free_rigid_body", "cf4", solver=NEWTON).files["free_rigid_body_cf4.c"]


def test_an_unknown_solver_is_named_with_those_there_are():
    with pytest.raises(UnknownName, match="unknown solver broyden") as failure:
        compile_method("dipole", "vcg:midpoint", solver="broyden")
    assert all(name in str(failure.value) for name in CHOICES)


def test_a_robust_solver_may_not_take_many_times_as_long(monkeypatch):
    """With no price at all to be paid, the faster fixed point stays; the reason warns of longer steps."""
    monkeypatch.setattr(solver_choice, "PRICE", 1.0)
    monkeypatch.setattr(solver_choice, "is_linear", lambda loop: False)
    choice, _ = chosen_from(heat(32, 20), monkeypatch)
    assert choice.solver == FIXED_POINT
    assert choice.reason.endswith(
        "; longer steps may fail, because the solver does not converge in a step of 8 h"
    )


def test_stiff_linear_equations_are_solved_by_newtons_method_at_any_price(monkeypatch):
    """With 72 unknowns, a step of Newton's method takes more than PRICE times as long as the fixed point."""
    choice, built = chosen_from(heat(36, 20), monkeypatch)
    assert (choice.solver, choice.unknowns) == (NEWTON, 72)
    assert choice.reason.endswith("; fixed point would be faster, but does not converge in a step of 8 h")
    assert built == [{NEWTON}]


def test_a_scene_that_no_solver_solves_is_announced_by_emit():
    words = ["stiff_driven_spin", "--method", "rkmk(0):gauss1", "--json"]
    done = CliRunner().invoke(emit_command, words, standalone_mode=False)
    assert done.exception is None
    assert "warning: stiff_driven_spin, rkmk(0):gauss1: " in done.stderr
    assert "no solver converges" in done.stderr
    quiet = CliRunner().invoke(
        emit_command, ["dipole", "-m", "vcg:midpoint", "--json"], standalone_mode=False
    )
    assert quiet.stderr == ""


@pytest.mark.parametrize("target", ["c", "python"])
def test_a_failure_to_converge_names_the_other_solvers(target):
    made = compiled("dipole", "vcg:midpoint", FIXED_POINT)
    integrator = load(emit_compiled(made, target))
    start = list(start_of(made.scene))
    with pytest.raises(StepFailed, match="or emit the module with the solver newton or simplified-newton"):
        integrator.run(start, 5.0, 3)


def test_the_inverse_of_the_executor_is_that_of_emitted_code_in_every_bit():
    draw = random.Random(1)
    for n in (1, 3, 7):
        matrix = [draw.gauss(0, 10.0 ** draw.randint(-3, 3)) for _ in range(n * n)]
        given, objects = list(matrix), [Fraction(x) for x in matrix]
        assert inverted(n, given) == inverted(n, objects) == 1
        assert all(isinstance(x, float) for x in given)
        exact = max(abs(float(x) - y) / max(1.0, abs(y)) for x, y in zip(objects, given, strict=True))
        assert exact < 1e-9
    assert inverted(2, [0.0] * 4) == 0


def test_linear_equations_are_recognised():
    assert is_linear(compile_method(heat(4, 1), "ambient:gauss2").kernel.loops[0])
    assert is_linear(compile_method(heat(4, 1), "ambient:midpoint").kernel.loops[0])
    for scene, method in (("dipole", "vcg:midpoint"), ("duffing", "ambient:gauss2")):
        assert not is_linear(compiled(scene, method, FIXED_POINT).kernel.loops[0])
