"""Negatives of sums are taken from the sums, and only where those are known."""

from __future__ import annotations

from codegen.emitter import compile_method
from codegen.ir.operations import Linear
from codegen.ir.program import Solve
from codegen.ir.verify import verify
from codegen.passes import shared_negatives
from tests.strategies import full, hamiltonian_scene, lowered, same

SCENE = hamiltonian_scene("SO(3)")


def sums(body):
    return [a.operation.coefficients for a in body if isinstance(a.operation, Linear)]


def test_steps_mean_the_same_and_sum_less():
    scene, program = lowered("vcg", full(2), SCENE)
    new = verify(shared_negatives.run(program))
    assert new != program
    assert same(scene, program, new)


def test_a_negative_is_taken_from_a_sum_of_the_same_block_alone():
    program = compile_method("dipole", "vcf:cf4").program
    (block,) = (s for s in program.body if isinstance(s, Solve))
    taken = [
        a
        for a in block.body
        if isinstance(a.operation, Linear) and a.operation.coefficients == (shared_negatives.MINUS_ONE,)
    ]
    made = {v for a in block.body for v in a.targets}
    assert len(taken) == 4
    assert all(a.args[0] in made for a in taken)
    assert shared_negatives.run(program) == program
