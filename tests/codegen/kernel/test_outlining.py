"""Outlining: equal functions of a long step are one function, and the step is the same."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import pytest
from sympy import Matrix, symbols

from codegen import scenes
from codegen.emitter import compile_method, emit_compiled
from codegen.groups import SO3, Rotation
from codegen.ir.domain import ExprDomain
from codegen.ir.interpret import flatten
from codegen.ir.number import Number
from codegen.ir.operations import Linear
from codegen.ir.program import Assign, Builder, Program
from codegen.ir.scene_operations import Field
from codegen.ir.values import Coefficient, Kind, Var
from codegen.ir.verify import IllFormed
from codegen.kernel import outlining, translate
from codegen.kernel.outlined_functions import calls
from codegen.kernel.outlining import Outline
from codegen.kernel.repeated_trees import Trees
from codegen.loader import load
from codegen.lower import lowering
from codegen.scene import FieldScene, param
from codegen.scene.run_time import with_runtime
from orderconds.errors import InputError
from orderconds.tableau import available
from tests.compilations import compiled
from tests.strategies import hamiltonian_scene

SPECS = [("dipole", "vcg:gauss4")]

EXPLICIT = ("dipole", "cg:cg4a")

LONGEST = ["vcf:hairer_wanner4", pytest.param("slgi:kahan_li8", marks=pytest.mark.slow)]

MANY_BLOCKS = ("rkmk:kahan_li8",)
"""Seventeen blocks, one after the other."""

ALL = [
    f"{family}:{tableau}"
    for family in ("vcf", "vcg", "vrkmk", "slgi", "vrkmk_pade", "rkmk", "cg", "cf", "ambient")
    for tableau in available()
]


@cache
def unoutlined(scene, method):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(translate, "LONG", 10**9)
        patch.setattr(translate, "LONG_EXPLICIT", 10**9)
        return compile_method(scene, method)


# gcc needs most of a minute for the step without outlined functions.
@pytest.mark.parametrize("target", [pytest.param("c", marks=pytest.mark.slow), "python"])
@pytest.mark.parametrize(("scene", "method"), SPECS, ids=lambda x: x)
def test_the_step_is_the_same_to_rounding_in_far_fewer_lines(scene, method, target):
    short, long = (emit_compiled(make(scene, method), target) for make in (compiled, unoutlined))
    lines = [max(text.count("\n") for text in e.files.values()) for e in (short, long)]
    assert lines[0] < 0.85 * lines[1]
    start = short.manifest["initial"]
    span = scenes.load(scene).span
    h = float(span[1] - span[0]) / 100
    assert load(short).run(start, h, 3) == pytest.approx(load(long).run(start, h, 3), rel=1e-12, abs=1e-12)


@pytest.mark.parametrize(("scene", "method"), SPECS, ids=lambda x: x)
def test_every_piece_is_called_more_than_once_and_takes_what_it_reads(scene, method):
    made = compiled(scene, method)
    source = next(text for name, text in emit_compiled(made, "c").files.items() if name.endswith(".c"))
    assert len(made.kernel.outlined) > 3
    for function in made.kernel.outlined:
        assert source.count(f"{function.name}(") > 2  # its definition, and two calls
        read = {n for let in function.body for n in symbols_of(let.value)} | {
            n for x in function.outputs for n in symbols_of(x)
        }
        assert set(function.inputs) <= read
        assert read <= set(function.inputs) | {let.name for let in function.body}


def symbols_of(root):
    return {root.payload} if root.op == "sym" else {s for a in root.args for s in symbols_of(a)}


def test_short_steps_have_no_functions():
    for spec in (("dipole", "vcg:midpoint"), ("dipole", "vcf:cf4"), ("free_rigid_body", "rkmk:rk4")):
        assert compiled(*spec).kernel.outlined == ()


def twice(c1, c2):
    """A program that applies exp(c h x) to its state twice; its execution, noted."""
    scene = hamiltonian_scene("SO(3)")
    q, x = Var("q", Kind.GROUP), Var("x", Kind.ALG)
    do = Builder({"q", "x", "h"})
    y = q
    for c in (c1, c2):
        step = do.lin("s", Kind.ALG, [(Coefficient(c, 1), x)])
        y = do.mul("g", do.exp("e", step), y)
    program = Program("twice", (q, x), do.take(), (("q", y),))
    domain = ExprDomain()
    outline = Outline(program, scene, domain)
    env = {v: tuple(domain.space.sym(f"{v.name}{k}") for k in range(n)) for v, n in ((q, 9), (x, 3))}
    execute(outline, env)
    return outline, flatten(Kind.GROUP, env[y])


def execute(outline, env):
    """Execute the program of an outline with symbols, and note the assignments."""
    for assign in outline.program.body:
        assert isinstance(assign, Assign)
        args = [env[a] for a in assign.args]
        results = assign.operation.evaluate(outline.scene, outline.domain, tuple(args))
        outline.trees.note(assign, args, results, -1)
        env.update(zip(assign.targets, results, strict=True))


def test_trees_with_other_coefficients_are_one_function_of_them():
    outline, roots = twice(Number.rational(1, 3), Number.rational(2, 5))
    assert outline.run(roots, {}) is not None
    (function,) = outline.outlined
    assert function.about == "mul(exp(c1 h x1), g1)"
    assert len(function.inputs) == 3 + 9 + 1 + 1
    assert len(function.outputs) == 9


def test_equal_coefficients_stay_folded():
    outline, roots = twice(Number.rational(1, 3), Number.rational(1, 3))
    outline.run(roots, {})
    assert all("c1" not in name for function in outline.outlined for name in function.inputs)


def test_a_wrong_piece_is_caught(monkeypatch):
    outline, roots = twice(Number.rational(1, 3), Number.rational(2, 5))
    right = outlining.function

    def wrong(*args):
        made, *arguments = right(*args)
        spoilt = (made.outputs[0] + made.outputs[1], *made.outputs[1:])
        return replace(made, outputs=spoilt), *arguments

    monkeypatch.setattr(outlining, "function", wrong)
    with pytest.raises(IllFormed, match="outlining changed the results"):
        outline.run(roots, {})


def noted(*assigns):
    """Trees of assignments, noted as they are executed over symbols."""
    scene, domain = hamiltonian_scene("SO(3)"), ExprDomain()
    inputs = {v for a in assigns for v in a.args} - {v for a in assigns for v in a.targets}
    trees = Trees(Program("some", tuple(inputs), assigns, ()), domain)
    env = {v: tuple(domain.space.sym(f"{v.name}{k}") for k in range(3)) for v in inputs}
    for assign in assigns:
        args = tuple(env[v] for v in assign.args)
        env |= zip(assign.targets, assign.operation.evaluate(scene, domain, args), strict=True)
        trees.note(assign, args, [env[v] for v in assign.targets], -1)
    return trees


def multiple(target, c, of):
    return Assign((target,), Linear((Coefficient(Number.rational(*c), 1),)), (of,))


def test_a_multiple_of_a_multiple_is_one_of_the_whole():
    x, y, z = (Var(name, Kind.ALG) for name in "xyz")
    trees = noted(multiple(y, (1, 3), x), multiple(z, (-3, 2), y))
    last = trees.executions[-1].assign
    assert last.args == (x,)
    assert last.operation.coefficients == (Coefficient(Number.rational(-1, 2), 2),)


def test_what_was_made_otherwise_is_joined_with_nothing():
    x, y = Var("x", Kind.ALG), Var("y", Kind.ALG)
    trees = noted(multiple(y, (1, 3), x))
    assert [tree.members for tree in trees.joined()] == [[0]]
    trees.executions = [replace(made, joined=False) for made in trees.executions]
    assert trees.joined() == []


def longest(scene, method):
    made = compile_method(scene, method)
    files = [text for target in ("c", "python") for text in emit_compiled(made, target).files.values()]
    return max(text.count("\n") for text in files)


@pytest.mark.parametrize("method", LONGEST)
def test_the_longest_modules_have_two_thousand_lines_at_most(method):
    """The longest with a matrix, and of one block that a fixed point solves, where formulas are longest."""
    assert longest("dipole", method) <= 2000


@pytest.mark.slow
@pytest.mark.parametrize(
    ("scene", "method"),
    [("dipole", method) for method in ALL]
    + [
        ("heavy_top", method)
        for method in ALL
        if lowering(method.partition(":")[0].partition("(")[0]).hamiltonian
    ],
)
def test_no_module_of_the_library_has_more_than_two_thousand_lines(scene, method):
    try:
        lines = longest(scene, method)
    except InputError:
        pytest.skip("the family does not serve the tableau")
    assert lines <= (2200 if method in MANY_BLOCKS else 2000)


def test_an_explicit_step_calls_what_it_repeats():
    short, long = (make(*EXPLICIT) for make in (compiled, unoutlined))
    assert "field(y1)" in [function.about for function in short.kernel.outlined]
    assert len(list(short.kernel.lets())) < 0.4 * len(list(long.kernel.lets()))
    start = emit_compiled(short, "c").manifest["initial"]
    found = [
        load(emit_compiled(made, target, prefix=prefix)).run(start, 0.01, 3)
        for made, target, prefix in (
            (short, "c", "short_"),
            (short, "python", "short_python_"),
            (long, "c", "long_"),
        )
    ]
    assert found[0] == pytest.approx(found[1], rel=1e-13, abs=1e-13)
    assert found[0] == pytest.approx(found[2], rel=1e-12, abs=1e-12)


def test_calls_are_counted_by_place():
    made = compiled(*EXPLICIT)
    emission = emit_compiled(made, "c", "my")
    for name, often in calls(made.kernel).items():
        assert emission.files["my.c"].count(f" my_{name}(") == 1 + often  # its definition, and the calls


def test_single_precision_takes_functions_too():
    made = compiled("dipole", "vcg:gauss4")
    emission = emit_compiled(made, "c", precision="single", prefix="single_gauss4_")
    exact = load(emit_compiled(made, "c", prefix="double_gauss4_"))
    start = emission.manifest["initial"]
    assert load(emission).run(start, 0.01, 1) == pytest.approx(exact.run(start, 0.01, 1), abs=1e-5)
    python = load(emit_compiled(made, "python", precision="single", prefix="python_gauss4_"))
    assert python.run(start, 0.01, 1) == pytest.approx(exact.run(start, 0.01, 1), abs=1e-5)


def test_functions_have_the_parameters_of_the_scene_that_they_read():
    compiled = compile_method("stiff_driven_spin", "cg:cg5", parameters=("nu",))
    assert any("nu" in function.inputs for function in compiled.kernel.outlined)
    integrators = [load(emit_compiled(compiled, target)) for target in ("c", "python")]
    folded = load(emit_compiled(compile_method("stiff_driven_spin", "cg:cg5"), "c"))
    state = [1.0, 0.0, 0.0]
    expected = folded.run(state, 1e-4, 10)
    for integrator in integrators:
        assert integrator.run(state, 1e-4, 10, nu=2.0) == pytest.approx(expected, rel=0, abs=1e-15)
        assert integrator.run(state, 1e-4, 10, nu=3.0) != pytest.approx(expected, rel=0, abs=1e-12)


def test_a_call_does_not_read_a_symbol_that_simplification_removed():
    """Unknown k5_6 is an input of a repeated tree, but no expression of this step depends on it."""
    kernel = compile_method("lyapunov_exponents", "cg:lobatto3d5").kernel
    assert kernel.name


def test_only_the_function_that_reads_a_removed_parameter_is_given_up():
    """The field multiplies the parameter c by y0 - y1, which is zero at both points of this program."""
    y = symbols("y:3", real=True)
    first = param("c", 1) * (y[0] - y[1]) + sum((k + 1) * y[2] ** (k + 2) for k in range(8))
    scene = FieldScene(
        title="A field with a parameter",
        group=SO3(),
        action=Rotation(),
        y=Matrix(y),
        f=Matrix([first, y[1], y[2]]),
        y0=[1, 0, 0],
        span=(0, 1),
    )
    points, others = (
        [Var(f"{x}{k}", kind) for k in range(2)] for x, kind in (("p", Kind.POINT), ("x", Kind.ALG))
    )
    do = Builder({"p0", "p1", "x0", "x1", "h"})
    ends = [do.add(Field(), f"f{k}", p) for k, p in enumerate(points)]
    ends += [do.exp(f"e{k}", x) for k, x in enumerate(others)]
    program = Program("removed", (*points, *others), do.take(), tuple(zip("abcd", ends, strict=True)))
    domain = ExprDomain()
    outline = Outline(program, with_runtime(scene, ["c"]), domain)
    symbol = domain.space.sym
    env = {p: (symbol(f"a{k}"), symbol(f"a{k}"), symbol(f"b{k}")) for k, p in enumerate(points)}
    env |= {x: tuple(symbol(f"x{k}_{i}") for i in range(3)) for k, x in enumerate(others)}
    execute(outline, env)
    roots = [x for end in ends for x in env[end]]
    assert "c" not in set().union(*map(symbols_of, roots))
    assert outline.run(roots, {}) is not None
    assert [function.about for function in outline.outlined] == ["exp(x1)"]
