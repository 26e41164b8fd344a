"""Kernels mean what their programs mean: carried out in doubles and, exactly, over Q[[h]]."""

from __future__ import annotations

import pytest

from codegen.ir.domain import FloatDomain, SeriesDomain
from codegen.ir.expr import evaluate, walk
from codegen.ir.interpret import interpret
from codegen.ir.kernel import Let, Loop
from codegen.lower.kernel import INLINE, to_kernel
from codegen.passes import optimise
from orderconds.ring import QQ
from tests.strategies import field_scene, full, hamiltonian_scene, lowered, starting


def carried_out(kernel, scene, domain, inputs):
    """Run a kernel over a domain: assignments in order, loops until the domain says they stand still."""
    known = {"h": domain.h, "t": inputs["t"]}
    for block in scene.state:
        known.update(zip(block.symbols, inputs[block.name], strict=True))

    def let(statement):
        assert statement.name not in known or statement.name in inside
        (known[statement.name],) = evaluate([statement.value], domain, known)

    inside = {x.name for s in kernel.body if isinstance(s, Loop) for x in s.body}
    for statement in kernel.body:
        if isinstance(statement, Let):
            let(statement)
            continue
        known.update(zip(statement.unknowns, evaluate(statement.starts, domain, known), strict=True))
        size = None
        while True:
            for x in statement.body:
                let(x)
            images = evaluate(statement.images, domain, known)
            done, size = domain.settled([known[u] for u in statement.unknowns], images, size)
            if done:
                break
            known.update(zip(statement.unknowns, images, strict=True))
    return evaluate(kernel.outputs, domain, known)


CASES = [
    *[
        ("vcg", t, hamiltonian_scene(g), None)
        for t in ("midpoint", "kutta3", full(2))
        for g in ("SO(3)", "R^3")
    ],
    *[("cg", t, field_scene(p), None) for t in ("cg3", full(2)) for p in ("S^2", "SO(3)", "Heisenberg")],
    *[("rkmk", t, field_scene("S^2", time=time), 2) for t in ("rk4", full(2)) for time in (False, True)],
    ("rkmk", "rk4", hamiltonian_scene("SO(3)"), 2),
    ("vcg", "midpoint", hamiltonian_scene("SO(3)", time=True), None),
    ("vcf", "cf4", hamiltonian_scene("SO(3)"), None),
    ("vrkmk", "kutta3", hamiltonian_scene("SO(3)"), 1),
    ("vrkmk", full(2), hamiltonian_scene("SO(3)"), 2),
    ("cf", "cf4", field_scene("S^2"), None),
    ("rk", "rk4", field_scene("R^3"), None),
]


@pytest.mark.parametrize("after", [False, True], ids=["as lowered", "after all passes"])
@pytest.mark.parametrize(("family", "tableau", "scene", "cutoff"), CASES)
class TestAKernelMeansItsProgram:
    def both(self, family, tableau, scene, cutoff, after, domain):
        view, program = lowered(family, tableau, scene, cutoff)
        if after:
            program, _ = optimise(program, view)
        inputs = starting(view, domain)
        state = interpret(program, view, domain, inputs)
        flat = [x for block in view.state for x in state[block.name]]
        return carried_out(to_kernel(program, view), view, domain, inputs), flat

    def test_exactly(self, family, tableau, scene, cutoff, after):
        domain = SeriesDomain(QQ, 3)
        found, expected = self.both(family, tableau, scene, cutoff, after, domain)
        assert all(domain.ring.is_zero(a - b) is True for a, b in zip(found, expected, strict=True))

    def test_in_doubles(self, family, tableau, scene, cutoff, after):
        found, expected = self.both(family, tableau, scene, cutoff, after, FloatDomain(2.0**-8))
        assert max(abs(a - b) for a, b in zip(found, expected, strict=True)) < 1e-13


@pytest.fixture
def kernel():
    view, program = lowered("vcg", "triple_jump", hamiltonian_scene("SO(3)"))
    program, _ = optimise(program, view)
    return to_kernel(program, view)


def test_names_are_assigned_once_and_before_use(kernel):
    known = {*(s for f in kernel.state for s in f.symbols), *kernel.scalars}

    def read(roots):
        assert {n.payload for n in walk(roots) if n.op == "sym"} <= known

    def let(x):
        read([x.value])
        assert x.name not in known
        known.add(x.name)

    for statement in kernel.body:
        if isinstance(statement, Let):
            let(statement)
            continue
        read(statement.starts)
        assert not known & set(statement.unknowns)
        known.update(statement.unknowns)
        for x in statement.body:
            let(x)
        read(statement.images)
    read(kernel.outputs)


def test_a_loop_holds_only_what_depends_on_its_unknowns(kernel):
    loops = [s for s in kernel.body if isinstance(s, Loop)]
    assert len(loops) == 3
    for loop in loops:
        varying = set(loop.unknowns)
        for x in loop.body:
            assert {n.payload for n in walk([x.value]) if n.op == "sym"} & varying
            varying.add(x.name)


def test_no_part_of_an_expression_in_a_loop_stands_still(kernel):
    """What does not depend on the unknowns is computed before the loop, down to single operations."""
    for loop in (s for s in kernel.body if isinstance(s, Loop)):
        varying = set(loop.unknowns) | {x.name for x in loop.body}
        for node in walk([*(x.value for x in loop.body), *loop.images]):
            if node.args and not (node.op == "neg" and not node.args[0].args):
                assert {n.payload for n in walk([node]) if n.op == "sym"} & varying, node


def test_everything_assigned_is_read(kernel):
    read = {n.payload for n in walk(kernel.expressions()) if n.op == "sym"}
    assert [x.name for x in kernel.lets() if x.name not in read] == []


def test_no_assignment_is_longer_than_people_read(kernel):
    def operations(e):
        return 1 + sum(map(operations, e.args)) if e.args else 0

    assert max(operations(x.value) for x in kernel.lets()) <= 3 * INLINE


def test_the_time_is_read_only_by_scenes_that_depend_on_it(kernel):
    assert kernel.used_scalars() == ("h",)
    view, program = lowered("rkmk", "rk4", field_scene("S^2", time=True), 2)
    assert to_kernel(program, view).used_scalars() == ("t", "h")
