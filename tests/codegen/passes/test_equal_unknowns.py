from __future__ import annotations

import pytest

from codegen.ir.program import Solve
from codegen.ir.verify import verify
from codegen.passes import equal_unknowns, fold_zeros, optimise, value_numbering
from tests.strategies import butcher, field_scene, full, lowered, same

TWINS = butcher("twins", [["1/4", "1/4"], ["1/4", "1/4"]], ["1/2", "1/2"])
"""The midpoint rule with its stage written twice."""


def unknowns(program):
    return [len(s.unknowns) for s in program.body if isinstance(s, Solve)]


@pytest.mark.parametrize("family", ["cg", "rkmk"])
@pytest.mark.parametrize("place", ["S^2", "SO(3)", "GL(2)"])
def test_stages_with_equal_rows_are_one_stage(family, place):
    scene, program = lowered(family, TWINS, field_scene(place), 1 if family == "rkmk" else None)
    shared = value_numbering.run(fold_zeros.run(program))
    new = verify(equal_unknowns.run(shared))
    assert (unknowns(shared), unknowns(new)) == ([2], [1])
    assert same(scene, program, new)


def test_a_stage_written_twice_costs_what_it_costs_once():
    once = butcher("once", [["1/2"]], ["1"])
    counts = [
        optimise(p, s)[0].counts()
        for s, p in (lowered("rkmk", t, field_scene("S^2"), 1) for t in (TWINS, once))
    ]
    assert counts[0] == counts[1]


def test_stages_that_differ_stay_apart():
    _, program = lowered("rkmk", full(2), field_scene("S^2"), 1)
    shared = value_numbering.run(fold_zeros.run(program))
    assert equal_unknowns.run(shared) == shared
