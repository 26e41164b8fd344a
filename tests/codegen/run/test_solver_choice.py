"""Which solver a block gets: the cheaper one that settles, and any that is asked for."""

from __future__ import annotations

from functools import cache

import pytest

from codegen.emitter import compile_method, emit
from codegen.ir.kernel import CHORD, FIXED_POINT, NEWTON
from codegen.run.solver_choice import CHOICES
from orderconds.errors import UnknownName


@cache
def compiled(scene, method, solver="auto"):
    return compile_method(scene, method, solver=solver)


def test_a_stiff_scene_is_solved_by_newtons_method():
    (choice,) = compiled("stiff_driven_spin", "rkmk(0):gauss1").solvers
    assert choice.solver == NEWTON
    assert "fixed point: does not converge" in choice.reason


def test_a_scene_near_the_limit_of_fixed_points_is_solved_by_newtons_method():
    (choice,) = compiled("heavy_top", "vcg:midpoint").solvers
    assert (choice.solver, choice.unknowns) == (NEWTON, 6)
    assert "fixed point: does not converge with steps 8 times as long" in choice.reason


def test_many_unknowns_that_change_slowly_are_iterated():
    (choice,) = compiled("linear_oscillator", "rk:gauss2").solvers
    assert (choice.solver, choice.unknowns) == (FIXED_POINT, 16)
    assert "operations a step; Newton's method: " in choice.reason


@pytest.mark.parametrize("solver", [NEWTON, CHORD, FIXED_POINT])
def test_what_is_asked_for_is_done_and_told(solver):
    made = compiled("heavy_top", "vcg:alexander2", solver)
    assert {loop.solver for loop in made.kernel.loops} == {solver}
    assert [c.reason for c in made.solvers] == ["asked for"] * 2
    emission = emit("heavy_top", "vcg:alexander2", solver=solver)
    assert emission.manifest["interface"]["solvers"] == [solver] * 2
    assert [c["solver"] for c in emission.manifest["solvers"]] == [solver] * 2
    source = emission.files["heavy_top_vcg_alexander2.c"]
    assert f"--solver {solver}" in source
    assert source.count(" * solved by:") == 2
    assert ("memory->inverse_1" in source) == (solver == NEWTON)


def test_explicit_methods_have_nothing_to_solve():
    made = compiled("free_rigid_body", "cf4", NEWTON)
    assert made.solvers == ()
    assert "solved by" not in emit("free_rigid_body", "cf4", solver=NEWTON).files["free_rigid_body_cf4.c"]


def test_an_unknown_solver_is_named_with_those_there_are():
    with pytest.raises(UnknownName, match="unknown solver broyden") as failure:
        compile_method("dipole", "vcg:midpoint", solver="broyden")
    assert all(name in str(failure.value) for name in CHOICES)
