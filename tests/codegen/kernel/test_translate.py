"""Kernels mean what their programs mean: carried out in doubles and, exactly, over Q[[h]]."""

from __future__ import annotations

import pytest

from codegen.ir.domain import FloatDomain, SeriesDomain
from codegen.ir.expr import evaluate, walk
from codegen.ir.interpret import interpret
from codegen.ir.kernel import FIXED_POINT, NEWTON, SIMPLIFIED_NEWTON, Let, Loop, Start
from codegen.ir.program import Solve
from codegen.kernel.assignments import INLINE
from codegen.kernel.outlined_functions import WithFunctions
from codegen.kernel.translate import to_kernel
from codegen.passes import optimise
from orderconds.ring import QQ
from tests.strategies import field_scene, full, hamiltonian_scene, lowered, starting


def carried_out(kernel, scene, domain, inputs):
    """Run a kernel over a domain: assignments in order, loops until the domain says they stand still."""
    domain = WithFunctions(domain, kernel.outlined)
    known = {"h": domain.h, "t": inputs["t"]}
    for block in scene.state:
        known.update(zip(block.symbols, inputs[block.name], strict=True))

    def let(statement):
        assert statement.name not in known or statement.name in inside
        (known[statement.name],) = evaluate([statement.value], domain, known)

    inside = {
        x.name for loop in kernel.loops for x in (*loop.body, *(loop.newton.body if loop.newton else ()))
    }
    for statement in kernel.body:
        if isinstance(statement, Let):
            let(statement)
            continue
        if isinstance(statement, Start):
            for x in statement.body:
                let(x)
            known.update(zip(statement.unknowns, evaluate(statement.values, domain, known), strict=True))
            continue
        assert statement.starts == ()
        size = None
        while True:
            for x in statement.body:
                let(x)
            now = [known[u] for u in statement.unknowns]
            new = evaluate(statement.images, domain, known)
            if statement.newton is not None:
                for x in statement.newton.body:
                    let(x)
                rows = [evaluate(row, domain, known) for row in statement.newton.matrix]
                correction = eliminated(rows, [a - b for a, b in zip(new, now, strict=True)])
                new = [a + b for a, b in zip(now, correction, strict=True)]
            done, size = domain.settled(now, new, size)
            if not done or statement.newton is not None:
                known.update(zip(statement.unknowns, new, strict=True))
            if done:
                break
    return evaluate(kernel.outputs, domain, known)


def eliminated(rows, right):
    """Solve a linear system near the unit matrix: no rows are exchanged."""
    rows = [[*row, r] for row, r in zip(rows, right, strict=True)]
    n = len(rows)
    for k in range(n):
        rows[k] = [x / rows[k][k] for x in rows[k]]
        for i in range(n):
            if i != k:
                rows[i] = [x - rows[i][k] * y for x, y in zip(rows[i], rows[k], strict=True)]
    return [row[n] for row in rows]


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


@pytest.mark.parametrize("how", ["as lowered", "after all passes", "by Newton's method"])
@pytest.mark.parametrize(("family", "tableau", "scene", "cutoff"), CASES)
class TestAKernelMeansItsProgram:
    def both(self, family, tableau, scene, cutoff, how, domain):
        view, program = lowered(family, tableau, scene, cutoff)
        if how != "as lowered":
            program, _ = optimise(program, view)
        inputs = starting(view, domain)
        state = interpret(program, view, domain, inputs)
        flat = [x for block in view.state for x in state[block.name]]
        labels = [s.label for s in program.body if isinstance(s, Solve)]
        if how == "by Newton's method" and not labels:
            pytest.skip("nothing is implicit")
        kernel = to_kernel(
            program, view, dict.fromkeys(labels, NEWTON) if how == "by Newton's method" else {}
        )
        return carried_out(kernel, view, domain, inputs), flat

    def test_exactly(self, family, tableau, scene, cutoff, how):
        domain = SeriesDomain(QQ, 3)
        found, expected = self.both(family, tableau, scene, cutoff, how, domain)
        assert all(domain.ring.is_zero(a - b) is True for a, b in zip(found, expected, strict=True))

    def test_in_doubles(self, family, tableau, scene, cutoff, how):
        found, expected = self.both(family, tableau, scene, cutoff, how, FloatDomain(2.0**-8))
        assert max(abs(a - b) for a, b in zip(found, expected, strict=True)) < 1e-13


@pytest.fixture(params=[FIXED_POINT, NEWTON, SIMPLIFIED_NEWTON])
def kernel(request):
    view, program = lowered("vcg", "triple_jump", hamiltonian_scene("SO(3)"))
    program, _ = optimise(program, view)
    labels = [s.label for s in program.body if isinstance(s, Solve)]
    return to_kernel(program, view, dict.fromkeys(labels, request.param))


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
        if isinstance(statement, Start):
            outside = set(known)
            for x in statement.body:
                let(x)
            read(statement.values)
            assert not known & set(statement.unknowns)
            known &= outside
            known.update(statement.unknowns)
            continue
        for x in statement.body:
            let(x)
        read(statement.images)
        if statement.newton is not None:
            outside = set(known)
            for x in statement.newton.body:
                let(x)
            for row in statement.newton.matrix:
                read(row)
            known &= outside
        if statement.only_unknowns_read:
            known -= {x.name for x in statement.body}
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
