"""A pass that breaks a program is caught: by meaning where its types are right."""

from __future__ import annotations

from dataclasses import replace

import pytest
from sympy import Integer, Matrix, sqrt, symbols

from codegen import passes, scenes
from codegen.emitter import compile_method
from codegen.errors import SceneError
from codegen.ir.domain import FloatDomain, NotConverged
from codegen.ir.number import Number
from codegen.ir.operations import Adjoint, DualDexp, InverseDexp, Linear, Multiply
from codegen.ir.program import Solve
from codegen.ir.values import Coefficient
from codegen.ir.verify import IllFormed
from codegen.lower import method_for
from codegen.passes.equivalence import Reference
from codegen.scene import param
from codegen.scene.run_time import with_runtime
from tests.strategies import field_scene, full, hamiltonian_scene, lowered, same


def mapped(program, change):
    """The program with one function applied to every assignment, inside blocks as well."""

    def inside(s):
        return replace(s, body=tuple(map(change, s.body))) if isinstance(s, Solve) else change(s)

    return replace(program, body=tuple(map(inside, program.body)))


def fewer_brackets(assign):
    if isinstance(assign.operation, InverseDexp):
        return replace(assign, operation=replace(assign.operation, order=assign.operation.order - 1))
    return assign


def slightly_off(assign):
    if not isinstance(assign.operation, Linear):
        return assign
    first, *rest = assign.operation.coefficients
    wrong = Coefficient(first.value + Number.rational(1, 2**28), first.power)
    return replace(assign, operation=Linear((wrong, *rest)))


def other_way_round(assign):
    return replace(assign, args=assign.args[::-1]) if isinstance(assign.operation, Multiply) else assign


def inverse(assign):
    if isinstance(assign.operation, Adjoint) and assign.operation.dual:
        return replace(assign, operation=assign.operation.opposite())
    return assign


def without_dexpt(assign):
    if isinstance(assign.operation, DualDexp):
        one = Coefficient(Number.rational(1))
        return replace(assign, operation=Linear((one,)), args=assign.args[1:])
    return assign


CASES = [
    ("rkmk", full(2), field_scene("S^2"), 1, fewer_brackets),
    ("rkmk", "rk4", field_scene("S^2"), 2, fewer_brackets),
    ("rkmk", "rk4", field_scene("GL(2)"), 4, fewer_brackets),
    ("cg", "cg3", field_scene("S^2"), None, slightly_off),
    ("vcg", "midpoint", hamiltonian_scene("SO(3)"), None, slightly_off),
    ("vcg", full(2), hamiltonian_scene("SO(3)"), None, other_way_round),
    ("vcg", "midpoint", hamiltonian_scene("GL(2)"), None, inverse),
    ("vcg", "midpoint", hamiltonian_scene("SO(3)"), None, without_dexpt),
]


@pytest.mark.parametrize(("family", "tableau", "scene", "cutoff", "break_it"), CASES)
def test_a_wrong_rewriting_is_seen(family, tableau, scene, cutoff, break_it):
    view, program = lowered(family, tableau, scene, cutoff)
    wrong = mapped(program, break_it)
    assert wrong != program
    assert Reference(program, view).differs(program) == ""
    assert "differs by" in Reference(program, view).differs(wrong)


def test_a_program_at_an_equilibrium_is_judged_elsewhere():
    """Where the field vanishes every program stands still; the second point tells them apart."""
    from codegen.groups import SO3, Rotation
    from codegen.scene import FieldScene

    y = Matrix(symbols("y0:3", real=True))
    scene = FieldScene(
        group=SO3(), action=Rotation(), y=y, f=Matrix([y[1], y[2], y[1] * y[2]]), y0=[1, 0, 0], span=(0, 1)
    )
    view, program = lowered("rkmk", full(2), scene, 1)
    assert "differs by" in Reference(program, view).differs(mapped(program, fewer_brackets))


@pytest.mark.parametrize(
    "name",
    ["abelian", "fold_zeros", "value_numbering", "equal_unknowns", "blocks", "factor_linear", "fuse"],
)
@pytest.mark.parametrize("tableau", ["midpoint", pytest.param(full(2), marks=pytest.mark.slow)])
def test_a_broken_pass_is_the_compilers_fault(monkeypatch, name, tableau):
    view, program = lowered("vcg", tableau, hamiltonian_scene("SO(3)"))
    broken = getattr(passes, name).run
    monkeypatch.setattr(getattr(passes, name), "run", lambda p, *args: mapped(broken(p, *args), inverse))
    with pytest.raises(IllFormed, match="changed the results"):
        passes.optimise(program, view)


def test_a_pass_that_breaks_the_types_is_caught_by_the_verifier(monkeypatch):
    view, program = lowered("cg", "heun", field_scene("S^2"))
    monkeypatch.setattr(passes.value_numbering, "run", lambda p: replace(p, body=p.body[1:]))
    with pytest.raises(IllFormed, match=r"before it is defined|the starts"):
        passes.optimise(program, view)


def on_the_line(field, start):
    from codegen.groups import LeftMultiplication, Rn
    from codegen.scene import FieldScene

    y = Matrix(symbols("y0:1", real=True))
    f = [field(y[0])]
    return FieldScene(group=Rn(1), action=LeftMultiplication(), y=y, f=f, y0=[start], span=(0, 1))


@pytest.mark.parametrize("field", [lambda y: sqrt(y - 2), lambda y: y * 10**400], ids=["root", "overflow"])
def test_a_field_that_is_not_there_around_the_initial_state_is_bad_input(field):
    """The scene's own check sees it first where the field is not real there."""

    def compared():
        view, program = lowered("rk", "euler", on_the_line(field, 1))
        return Reference(program, view)

    with pytest.raises(
        SceneError, match=r"no step of the method can be computed from|f at the initial state is not a finite"
    ):
        compared()


@pytest.mark.parametrize("power", [-200, -35, -12, 0, 9, 12, 200])
def test_a_field_of_any_speed_is_compared_at_steps_that_show_a_difference(power):
    scene = on_the_line(lambda y: y * Integer(10) ** power, 1)
    view, program = lowered("rk", "rk4", scene)
    other = lowered("rk", "heun", scene)[1]
    assert Reference(program, view).differs(program) == ""
    assert "differs by" in Reference(program, view).differs(other)


def test_programs_that_agree_for_the_default_of_a_run_time_parameter_only_differ():
    scene = with_runtime(on_the_line(lambda y: param("k", 0) * y, 1), ("k",))
    view, program = lowered("rk", "rk4", scene)
    other = lowered("rk", "euler", scene)[1]
    assert Reference(program, view).differs(program) == ""
    assert "differs by" in Reference(program, view).differs(other)


@pytest.mark.parametrize("group", ["SO(3)", "R^3", "GL(2)", "Heisenberg"])
@pytest.mark.parametrize("tableau", ["midpoint", "kutta3", full(2)])
def test_all_passes_together_keep_vcg_exactly(group, tableau):
    view, program = lowered("vcg", tableau, hamiltonian_scene(group))
    new, reports = passes.optimise(program, view)
    assert same(view, program, new, order=3)
    assert reports


@pytest.mark.parametrize("place", ["R^3", "S^2", "GL(2)"])
@pytest.mark.parametrize(
    ("family", "tableau", "cutoff"), [("cg", "cg3", None), ("cf", "cf4", None), ("rkmk", "rk4", 2)]
)
def test_all_passes_together_keep_field_methods_exactly(place, family, tableau, cutoff):
    view, program = lowered(family, tableau, field_scene(place), cutoff)
    new, _ = passes.optimise(program, view)
    assert same(view, program, new)


def test_reports_add_up():
    view, program = lowered("vcg", "triple_jump", hamiltonian_scene("SO(3)"))
    new, reports = passes.optimise(program, view)
    counts = dict(program.counts())
    for report in reports:
        assert report.before == {k: v for k, v in counts.items() if v}
        for name, k in report.removed.items():
            counts[name] = counts.get(name, 0) - k
    assert {k: v for k, v in counts.items() if v} == new.counts()
    assert reports[-1].program == new


@pytest.mark.parametrize("tableau", ["midpoint", "suzuki4", "gauss2", "kutta3", full(3)])
def test_passes_leave_nothing_for_a_second_round(tableau):
    view, program = lowered("vcg", tableau, hamiltonian_scene("SO(3)"))
    once, _ = passes.optimise(program, view)
    assert passes.optimise(once, view) == (once, ())


@pytest.mark.slow
def test_a_slow_iteration_that_only_seems_to_converge_is_replaced_by_newtons_method():
    """In doubles the reference converges at the moved point; with 60 digits, 400 sweeps are too few."""
    scene = scenes.load("heavy_top")
    compiled = compile_method(scene, method_for(scene, "discrete_gradient:gill4"))
    assert compiled.method.label == "discrete_gradient:gill4"


@pytest.mark.parametrize(("break_it", "found"), [(slightly_off, True), (lambda assign: assign, False)])
def test_newtons_method_decides_where_the_iteration_converges_only_by_rounding(monkeypatch, break_it, found):
    view, program = lowered("vcg", "midpoint", hamiltonian_scene("SO(3)"))
    reference = Reference(program, view)
    # The compared program fails in doubles, and the reference counts as unsolved in many digits.
    run = Reference._run

    def fails_in_doubles(self, given, domain, *rest):
        if given is not program and isinstance(domain, FloatDomain):
            raise NotConverged
        return run(self, given, domain, *rest)

    monkeypatch.setattr(Reference, "_run", fails_in_doubles)
    monkeypatch.setattr(Reference, "_is_solved", lambda self, step: False)
    compared = replace(mapped(program, break_it))
    assert ("differs by" in reference.differs(compared)) is found
