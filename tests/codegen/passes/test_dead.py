from __future__ import annotations

from dataclasses import replace

import pytest

from codegen.ir.operations import ActExp, Bracket, Exp
from codegen.ir.program import Assign, Solve
from codegen.ir.scene_operations import Field, HamiltonianDerivatives
from codegen.ir.values import Kind, Var
from codegen.ir.verify import verify
from codegen.passes import dead
from tests.strategies import butcher, field_scene, full, hamiltonian_scene, lowered, same

UNUSED = butcher("unused", [[0, 0, 0], ["1/2", 0, 0], ["1/3", "1/3", 0]], ["1/4", "3/4", 0])


def extended(program, *assigns):
    return replace(program, body=(*program.body, *assigns))


def test_a_stage_that_nothing_reads_goes_with_its_equation():
    scene, program = lowered("cg", UNUSED, field_scene("S^2"))
    new = verify(dead.run(program))
    (block,) = [s for s in new.body if isinstance(s, Solve)]
    assert [v.name for v in block.unknowns] == ["k1", "k2"]
    assert same(scene, program, new)


def test_values_that_nothing_reads_go():
    _, program = lowered("cg", "heun", field_scene("S^2"))
    y = program.inputs[0]
    k, x = Var("spare", Kind.ALG), Var("spare2", Kind.GROUP)
    more = extended(program, Assign((k,), Field(), (y,)), Assign((x,), Exp(), (k,)))
    assert dead.run(verify(more)) == dead.run(program)


def test_one_result_of_two_is_enough_to_live():
    _, program = lowered("vcg", "midpoint", hamiltonian_scene("SO(3)"))
    new = dead.run(program)
    assert sum(isinstance(a.operation, HamiltonianDerivatives) for a in new.assigns()) == 2


@pytest.mark.parametrize("tableau", ["midpoint", full(2)])
def test_a_program_without_dead_values_stays(tableau):
    scene, program = lowered("vcg", tableau, hamiltonian_scene("GL(2)"))
    new = verify(dead.run(program))
    assert same(scene, program, new)
    assert dead.run(new) == new


def test_a_block_whose_unknowns_nothing_reads_leaves_its_other_values():
    """Body values that depend on no unknown need no block."""
    y, y1 = Var("y", Kind.POINT), Var("y1", Kind.POINT)
    k0, v, w, f = (Var(name, Kind.ALG) for name in ("k0", "v", "w", "f"))
    inside = (
        Assign((y1,), ActExp(), (k0, y)),
        Assign((w,), Bracket(), (v, k0)),
    )
    _, template = lowered("cg", "euler", field_scene("S^2"))
    body = (Assign((k0,), Field(), (y,)), Solve("b", (v,), (k0,), inside, (w,)))
    new = verify(dead.run(verify(replace(template, body=body, outputs=(("y", y1),)))))
    assert [type(s) for s in new.body] == [Assign, Assign]
    assert f not in [t for a in new.assigns() for t in a.targets]


def test_a_block_that_nothing_reads_vanishes():
    scene, program = lowered("cg", "heun", field_scene("S^2"))
    idle = replace(program, outputs=(("y", program.inputs[0]),))
    assert dead.run(idle).body == ()
    assert same(scene, idle, dead.run(idle))
