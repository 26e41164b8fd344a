"""A family in a file of its own: its conditions and its lowering are two classes, and no other file changes.

The family is a toy. Its stages are computed from the first slope alone, k_1 = f(y0) and
k_i = f(exp(h c_i k_1).y0), and y1 = exp(h sum_i b_i k_i).y0. It has order two at most.
"""

from __future__ import annotations

import json

import pytest
from click.testing import CliRunner

from codegen import scenes
from codegen.certify import certified_order
from codegen.commands.converge import command as converge
from codegen.commands.emit import command as emit
from codegen.emitter import compile_method
from codegen.errors import MethodError
from codegen.ir.values import Kind, Var
from codegen.lab.orders.local_error import local_error, valuation
from codegen.lower import families_for, names, problem_for, register, unregister
from codegen.lower.field import FieldLowering
from codegen.lower.stages import Stages
from codegen.method import Method, parse
from orderconds import families
from orderconds.cli import program
from orderconds.families.rk import RungeKuttaFamily, tree_conditions
from orderconds.trees.rooted import rooted_trees
from tests.strategies import field_scene, shipped


class OneSlopeFamily(RungeKuttaFamily):
    name = "one_slope"
    description = "Stages from the first slope alone."
    order_bound = 2

    def conditions(self, order):
        return tree_conditions(tuple(rooted_trees(order)), self.name)


class OneSlopeLowering(FieldLowering):
    family = "one_slope"

    def lower(self, problem, method):
        tableau = method.runge_kutta()
        y = Var("y", Kind.POINT)
        stages = Stages(problem, method, (y,))
        build = stages.builder
        k = [build.fresh(f"k{i + 1}", Kind.ALG) for i in range(tableau.s)]

        def moved(row, slopes):
            return build.act("Y", build.exp("g", stages.combination("u", Kind.ALG, row, slopes)), y)

        def images():
            return [stages.f("f", y, None)] + [stages.f("f", moved([c], k[:1]), c) for c in tableau.c[1:]]

        def starts():
            return [stages.f("f0", y, None)] * tableau.s

        return stages.program(k, images, starts, lambda: {"y": moved(tableau.b, k)})


@pytest.fixture(autouse=True)
def _registered():
    register(OneSlopeLowering, OneSlopeFamily)
    yield
    unregister("one_slope")
    families.unregister("one_slope")


def run(*words):
    return CliRunner().invoke(program, words)


def test_derive_check_solve_and_list_know_it(tmp_path):
    derived = json.loads(run("derive", "one_slope", "--order", "2", "--json").stdout)
    assert derived["counts"] == [1, 1]
    (checked,) = json.loads(run("check", "rk4", "--family", "one_slope", "--json").stdout)
    assert checked["orders"]["one_slope"]["order"] == 2  # its bound
    file = tmp_path / "found.toml"
    command = ["solve", "one_slope", "--stages", "2", "--order", "2", "--explicit", "--fix", "a21=1/2"]
    assert run(*command, "-o", str(file)).exit_code == 0
    (solved,) = json.loads(run("check", str(file), "--family", "one_slope", "--json").stdout)
    assert solved["orders"]["one_slope"]["order"] == 2
    assert "one_slope" in run("list", "families").stdout


def test_it_is_offered_for_scenes_with_a_field_after_the_built_in_families():
    assert names()[-1] == "one_slope"
    assert families_for(scenes.load("free_rigid_body"))[-1] == "one_slope"


@pytest.mark.parametrize(("tableau", "order"), [("euler", 1), ("heun", 2), ("kutta3", 2), ("rk4", 2)])
def test_its_order_is_computed_from_its_own_conditions_and_is_that_of_its_program(tableau, order):
    scene = field_scene("S^2")
    method = Method("one_slope", shipped(tableau))
    assert certified_order(method, scene).order == order
    made = compile_method(scene, method)
    for step in (made.lowered, made.program):
        error = local_error(step, problem_for(scene, method), method.ring, order + 1)
        assert valuation(error) == order + 1


def test_the_passes_find_that_two_of_its_stages_are_equal():
    counts = compile_method("free_rigid_body", "one_slope:rk4").program.counts()
    assert (counts["field"], counts["actexp"]) == (3, 3)


@pytest.mark.parametrize("target", ["c", "python"])
def test_emit_writes_it(target, tmp_path):
    options = ["free_rigid_body", "--method", "one_slope:heun", "--target", target, "-o", str(tmp_path)]
    done = CliRunner().invoke(emit, options, standalone_mode=False)
    assert done.exception is None
    manifest = json.loads((tmp_path / "manifest.json").read_text(encoding="utf-8"))
    (entry,) = manifest["modules"] if "modules" in manifest else manifest["entries"]
    assert (entry["family"], entry["order"], entry["certificate"]) == ("one_slope", 2, "exact")


def test_converge_observes_its_order():
    done = CliRunner().invoke(
        converge, ["free_rigid_body", "--method", "one_slope:heun", "--json"], standalone_mode=False
    )
    assert done.exception is None
    (result,) = json.loads(done.output)
    assert (result["stated_order"], result["verdict"]) == (2, "holds")
    assert result["observed_order"] == pytest.approx(2, abs=0.1)


def test_once_forgotten_it_is_unknown():
    unregister("one_slope")
    with pytest.raises(MethodError, match="family one_slope cannot be used on this scene"):
        parse("one_slope:heun", families_for(scenes.load("free_rigid_body")))
