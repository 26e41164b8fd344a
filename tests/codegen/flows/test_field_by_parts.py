"""The field of a Hamiltonian by its parts: equal on the group, and never longer."""

from __future__ import annotations

from dataclasses import replace

import pytest
from sympy import diag

from codegen import scenes
from codegen.flows.field_by_parts import with_field_by_parts
from codegen.ir.expr import walk
from codegen.scene.orbit import orbit_of
from tests.strategies import hamiltonian_scene, top_scene


def operations(problem):
    return sum(node.op not in ("const", "sym", "neg") for node in walk(problem.roots))


@pytest.mark.parametrize(
    "problem", [top_scene(diag(2, 3, 2)), scenes.load("fast_heavy_top")], ids=["top", "fast"]
)
def test_a_symmetric_top_gets_a_shorter_field_that_is_equal_on_the_group(problem):
    shorter = with_field_by_parts(problem)
    assert operations(shorter) < operations(problem)
    assert orbit_of(problem).vanish([a - b for a, b in zip(shorter.roots, problem.roots, strict=True)])


def test_the_field_of_a_top_reads_its_axis_alone():
    shorter = with_field_by_parts(top_scene(diag(2, 3, 2)))
    xi = shorter.roots[:3]
    read = {n.payload for n in walk(xi) if n.op == "sym" and n.payload.startswith("g")}
    assert read == {"g01", "g11", "g21"}


@pytest.mark.parametrize(
    "problem",
    [
        hamiltonian_scene("SO(3)"),
        scenes.load("free_rigid_body"),
        scenes.load("actuated_rigid_body"),
        replace(top_scene(diag(2, 3, 2)), stated={"T": ()}),
    ],
    ids=["without parts", "field", "wrench", "stated"],
)
def test_other_problems_stay_as_they_are(problem):
    assert with_field_by_parts(problem) is problem
