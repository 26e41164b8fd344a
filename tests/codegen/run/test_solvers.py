"""Implicit blocks of every family by every solver in every target: same answers, clean failures."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from itertools import pairwise

import pytest

from codegen.emitter import emit_compiled
from codegen.integrator import Statistics, Status, StepFailed
from codegen.ir.domain import FloatDomain
from codegen.ir.interpret import interpret
from codegen.ir.kernel import FIXED_POINT, NEWTON, SIMPLIFIED_NEWTON, Newton, Start
from codegen.loader import load
from codegen.lower import problem_for
from codegen.printers import names as target_names
from tests.compilations import compiled, emitted
from tests.promises import ulps

IMPLICIT = {
    "rk": ("linear_oscillator", "rk:gauss2"),
    "rkmk": ("driven_spin", "rkmk(2):gauss2"),
    "cg": ("driven_spin", "cg:gauss1"),
    "cf": ("driven_spin", "cf:gauss1"),
    "vcg": ("heavy_top", "vcg:midpoint"),
    "vcg kutta": ("heavy_top", "vcg:kutta3"),
    "vrkmk": ("dipole", "vrkmk(2):gauss2"),
    "vcf": ("dipole", "vcf:midpoint"),
    "vrkmk_pade": ("dipole", "vrkmk_pade(1):kutta3"),
    "slgi": ("dipole", "slgi:midpoint"),
    "discrete_gradient": ("dipole", "discrete_gradient:midpoint"),
}
SOLVERS = (NEWTON, SIMPLIFIED_NEWTON, FIXED_POINT)

REPRESENTATIVES = ("rkmk", "vcg", "vrkmk", "discrete_gradient")
"""One family of each kind of equations: the quick run tries all solvers on these."""


@cache
def loaded(scene, method, solver, target):
    emission = emitted(scene, method, target, solver)
    return load(emission), tuple(emission.manifest["initial"])


def stepped(made, state, h):
    """One step by the interpreter, which differentiates nothing."""
    view = problem_for(made.scene, made.method)
    values, first = {"t": 0.0}, 0
    for block in view.state:
        values[block.name] = tuple(state[first : first + len(block.symbols)])
        first += len(block.symbols)
    after = interpret(made.lowered, view, FloatDomain(h), values)
    return [x for block in view.state for x in after[block.name]]


def quick_or_slow(quick):
    return () if quick else pytest.mark.slow


@pytest.mark.parametrize(
    ("family", "solver", "target"),
    [
        pytest.param(
            family,
            solver,
            target,
            marks=quick_or_slow(
                # gcc needs most of a minute for three stages with Newton's method.
                (target == "c" and solver == NEWTON and family != "vcg kutta")
                or (family in REPRESENTATIVES and (target == "c" or solver == SIMPLIFIED_NEWTON))
            ),
        )
        for family in IMPLICIT
        for solver in SOLVERS
        for target in sorted(target_names())
    ],
)
def test_every_solver_finds_the_solution_of_the_interpreter(family, solver, target):
    integrator, state = loaded(*IMPLICIT[family], solver, target)
    expected = stepped(compiled(*IMPLICIT[family], solver), state, 1 / 128)
    assert ulps(integrator.step(list(state), 1 / 128), expected) <= 32


@pytest.mark.parametrize(
    ("family", "solver"),
    [
        pytest.param(f, s, marks=quick_or_slow((s == NEWTON and f != "vcg kutta") or f in REPRESENTATIVES))
        for f in IMPLICIT
        for s in SOLVERS
    ],
)
def test_a_run_is_the_steps_it_is_made_of_but_begins_them_better(family, solver):
    """Starts are extrapolated: far fewer sweeps, the same solutions to the sharpness of the stopping rule."""
    integrator, state = loaded(*IMPLICIT[family], solver, "c")
    alone, together = Statistics(), Statistics()
    current = list(state)
    for k in range(20):
        current = integrator.step(current, 1 / 512, k / 512, statistics=alone)
    ran = integrator.run(list(state), 1 / 512, 20, statistics=together)
    assert ulps(ran, current) <= 512
    work = [sum(counts.sweeps) + 3 * counts.matrices for counts in (together, alone)]
    assert work[0] < 0.9 * work[1]


@pytest.mark.parametrize("solver", SOLVERS)
def test_c_and_python_take_the_same_sweeps_and_make_the_same_matrices(solver):
    counts, ends = [], []
    for target in sorted(target_names()):
        integrator, state = loaded("heavy_top", "vcg:midpoint", solver, target)
        statistics = Statistics()
        ends.append(integrator.run(list(state), 0.002, 60, statistics=statistics))
        counts.append(statistics)
    assert counts[0] == counts[1]
    assert ulps(*ends) <= 8
    assert (counts[0].matrices > 0) == (solver == NEWTON)


def test_newtons_method_reaches_steps_that_a_fixed_point_does_not():
    """The heavy top as printed, midpoint, h = 1/20: the momenta turn by half a radian a step."""
    integrator, state = loaded("heavy_top", "vcg:midpoint", NEWTON, "c")
    statistics = Statistics()
    end = integrator.run(list(state), 0.05, 1000, statistics=statistics)
    assert statistics.sweeps[0] < 8 * 1000
    scene = compiled("heavy_top", "vcg:midpoint", NEWTON).scene
    energies = [scene.invariant(FloatDomain(0.0), "energy", s) for s in (state, end)]
    assert energies[1] == pytest.approx(energies[0], rel=2e-2)
    slow, _ = loaded("heavy_top", "vcg:midpoint", FIXED_POINT, "c")
    with pytest.raises(StepFailed) as failure:
        slow.run(list(state), 0.05, 1000)
    assert failure.value.status == Status.NOT_CONVERGED
    assert list(failure.value.state) == list(state)


@pytest.mark.parametrize("target", sorted(target_names()))
def test_newtons_method_makes_steps_several_times_as_long_as_the_fastest_rate(target):
    """The stiff spin relaxes at rates of 1000 and 2000; a fixed point leaves the numbers."""
    integrator, state = loaded("stiff_driven_spin", "rkmk(0):gauss1", NEWTON, target)
    statistics = Statistics()
    end = integrator.run(list(state), 0.003, 500, statistics=statistics)
    assert math.hypot(*end) == pytest.approx(1, abs=1e-12)
    assert statistics.sweeps[0] < 4 * 500
    slow, _ = loaded("stiff_driven_spin", "rkmk(0):gauss1", FIXED_POINT, target)
    with pytest.raises(StepFailed):
        slow.step(list(state), 0.003)


@pytest.mark.parametrize("target", sorted(target_names()))
def test_a_solution_is_continued_to_steps_that_newtons_method_does_not_reach(target):
    """Gauss' method of order six in steps of fifty fast times: it keeps the radius, and is accurate."""
    integrator, state = loaded("stiff_driven_spin", "ambient:gauss3", NEWTON, target)
    coarse, fine = (integrator.run(list(state), 2.0 / n, n) for n in (80, 320))
    assert math.hypot(*coarse) == pytest.approx(1, abs=1e-12)
    assert coarse == pytest.approx(fine, abs=1e-6)


@pytest.mark.parametrize("h", [0.002, 0.01, 0.03])
def test_the_solution_that_is_found_depends_continuously_on_the_step(h):
    """Of the solutions of a long step it is the one that tends to the motion as h tends to zero."""
    integrator, state = loaded("stiff_driven_spin", "ambient:gauss1", NEWTON, "c")
    ends = [integrator.step(list(state), h * k / 400) for k in range(401)]
    jumps = [math.dist(a, b) for a, b in pairwise(ends)]
    assert max(jumps) < 0.1
    assert max(map(math.hypot, *zip(*ends, strict=True))) < 1 + 1e-12


def test_a_part_of_a_step_is_not_taken_for_the_step(monkeypatch):
    """Tries that run out just when a shorter step was solved are a failure, in every target."""
    made = compiled("heavy_top", "vcg:midpoint", NEWTON)
    monkeypatch.setattr(Start, "TRIES", 5)
    for target in sorted(target_names()):
        integrator = load(emit_compiled(made, target))
        state = [float(x) for x in made.scene.initial(FloatDomain(0.0))]
        for h in (0.5, 1.0, 2.0, 5.0):
            with pytest.raises(StepFailed) as failure:
                integrator.step(state, h)
            assert failure.value.status == Status.NOT_CONVERGED
            assert list(failure.value.state) == state


@pytest.mark.parametrize("target", sorted(target_names()))
@pytest.mark.parametrize("solver", [NEWTON, SIMPLIFIED_NEWTON])
def test_a_step_that_cannot_be_solved_says_so_and_leaves_the_state(solver, target):
    integrator, state = loaded("stiff_driven_spin", "rkmk(0):gauss1", solver, target)
    with pytest.raises(StepFailed) as failure:
        integrator.run(list(state), 0.5, 3)
    assert failure.value.status in (Status.NOT_CONVERGED, Status.NOT_FINITE)
    assert failure.value.step == 0
    assert list(failure.value.state) == list(state)


@pytest.mark.parametrize("target", sorted(target_names()))
@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_a_state_that_is_no_number_is_reported(solver, target, bad):
    integrator, state = loaded("heavy_top", "vcg:midpoint", solver, target)
    with pytest.raises(StepFailed) as failure:
        integrator.step([bad, *state[1:]], 0.01)
    assert failure.value.status == Status.NOT_FINITE


def answered(integrator, state, h):
    """The state after a step, None where there is none."""
    try:
        return integrator.step(state, h)
    except StepFailed:
        return None


LINEAR = ("rk:gauss2", "rk:radau2a2", "vcg:midpoint", "vrkmk:gauss1")


@pytest.mark.parametrize("target", sorted(target_names()))
@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("method", LINEAR)
def test_a_linear_scene_knows_no_large_and_small_states(method, solver, target):
    """Powers of two go through every sweep: answers are scaled to the last bit, failures stay failures.

    In units where the state is tiny a long step that diverges once passed for solved.
    """
    integrator, state = loaded("linear_oscillator", method, solver, target)
    for h in (0.01, 0.1, 1.0, 10.0, 100.0):
        ends = []
        for power in (0, -30, -200, 200):
            scaled = [math.ldexp(x, power) for x in state]
            end = answered(integrator, scaled, h)
            ends.append(end and [math.ldexp(x, -power) for x in end])
        assert ends == [ends[0]] * len(ends)
        assert h > 0.1 or ends[0] is not None


@pytest.mark.parametrize("target", sorted(target_names()))
@pytest.mark.parametrize(("method", "solver"), [("vcg:midpoint", NEWTON), ("vcf:midpoint", FIXED_POINT)])
def test_a_body_at_rest_stays_at_rest(method, solver, target):
    """The change of the unknowns is zero in the first sweep."""
    integrator, state = loaded("free_rigid_body_attitude", method, solver, target)
    rest = [*state[:9], 0.0, 0.0, 0.0]
    statistics = Statistics()
    assert integrator.run(rest, 0.1, 5, statistics=statistics) == rest
    assert statistics.most <= 2


def test_a_wrong_matrix_is_seen_in_the_sweeps():
    """The control: with the unit matrix Newton's method is the fixed point, and fails where that does."""
    made = compiled("heavy_top", "vcg:midpoint", NEWTON)
    (loop,) = made.kernel.loops
    space = loop.images[0].space
    size = range(len(loop.unknowns))
    unit = tuple(tuple(space.one if i == j else space.zero for j in size) for i in size)
    broken = replace(loop, newton=Newton((), unit))
    body = tuple(broken if s is loop else s for s in made.kernel.body)
    wrong = load(emit_compiled(replace(made, kernel=replace(made.kernel, body=body)), "c"))
    right, state = loaded("heavy_top", "vcg:midpoint", NEWTON, "c")
    slow, fast = Statistics(), Statistics()
    assert ulps(wrong.step(list(state), 0.01, statistics=slow), right.step(list(state), 0.01)) <= 64
    right.step(list(state), 0.01, statistics=fast)
    assert slow.sweeps[0] > 2 * fast.sweeps[0]
    with pytest.raises(StepFailed):
        wrong.step(list(state), 0.05)


def test_sweeps_fall_with_the_step_faster_the_better_the_matrix():
    """An exact matrix needs the fewest sweeps; one to first order in h as few where steps are short."""
    counts = {}
    for solver in SOLVERS:
        integrator, state = loaded("heavy_top", "vcg:midpoint", solver, "c")
        for h in (1 / 64, 1 / 1024):
            statistics = Statistics()
            integrator.step(list(state), h, statistics=statistics)
            counts[solver, h] = statistics.sweeps[0]
    assert counts[NEWTON, 1 / 64] < counts[SIMPLIFIED_NEWTON, 1 / 64] < counts[FIXED_POINT, 1 / 64]
    assert counts[SIMPLIFIED_NEWTON, 1 / 1024] <= 5
    assert counts[FIXED_POINT, 1 / 1024] > counts[SIMPLIFIED_NEWTON, 1 / 1024]


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_stage_that_is_not_finite_has_the_same_status_in_c_and_python(solver):
    """The sine of an infinite time is no number: the matrix of simplified Newton is not singular."""
    for target in ("c", "python"):
        integrator, state = loaded("driven_spin", "rkmk(2):gauss2", solver, target)
        with pytest.raises(StepFailed, match="not finite") as failure:
            integrator.run(list(state), 0.1, 5, t=math.inf)
        assert (failure.value.status, failure.value.step) == (Status.NOT_FINITE, 0)


def test_many_unknowns_are_left_to_a_fixed_point_and_moved_together():
    """Twenty-seven unknowns: Newton's method would cost more; both targets compare and move them in loops."""
    made = compiled("dipole", "slgi:cg5")
    (choice,) = made.solvers
    assert (choice.solver, choice.unknowns) == ("fixed-point", 27)
    assert choice.reason == "3.35 sweeps a step, measured over the first 20 steps of size h = 0.005"
    modules = [load(emitted("dipole", "slgi:cg5", target)) for target in ("c", "python")]
    start = emitted("dipole", "slgi:cg5", "c").manifest["initial"]
    by_c, by_python = (module.run(start, 0.01, 4) for module in modules)
    expected = start
    for _ in range(4):
        expected = stepped(made, expected, 0.01)
    assert by_c == pytest.approx(by_python, rel=1e-14, abs=1e-14)
    assert by_c == pytest.approx(expected, rel=1e-12, abs=1e-12)
    for module in modules:
        with pytest.raises(StepFailed, match=r"finite|converge"):
            module.run([*start[:-1], math.inf], 0.01, 1)
