"""Matrix groups without closed forms in emitted code: every family, its order, and the symplectic form."""

from __future__ import annotations

import json
import random
import re
from functools import cache

import numpy as np
import pytest
from click.testing import CliRunner
from sympy import Matrix, Rational, Symbol, eye

from codegen import scenes
from codegen.emitter import compile_method, emit_compiled
from codegen.errors import MethodError
from codegen.groups import GL, SO, SU, Affine, Heisenberg, LeftMultiplication, Sp
from codegen.ir.domain import FloatDomain
from codegen.ir.interpret import interpret
from codegen.lab.orders.local_error import local_error, valuation
from codegen.loader import load
from codegen.scene import FieldScene, HamiltonianScene
from orderconds.cli import program
from orderconds.ring import QQ
from tests.codegen.commands.conftest import registered as registered
from tests.codegen.family_cases import CASES as FAMILIES
from tests.codegen.test_stack import LIBRARY, stated
from tests.painted_stack import painted
from tests.promises import clean_c, clean_python, ulps
from tests.strategies import quadratic

GROUPS = {
    g.name: g for g in (SO(4), SO(5), SU(2), SU(3), Sp(2), GL(2), GL(3), Affine(1), Affine(2), Heisenberg(1))
}

SHORT = (0, Rational(1, 2))
"""The span of the scenes: solutions on groups that are not compact may reach infinity soon after."""


def field(name):
    """A quadratic field without symmetry on the group, from the unit matrix."""
    group, rng = GROUPS[name], random.Random(name)
    y = [Symbol(f"y{k}", real=True) for k in range(group.size)]
    f = Matrix([quadratic(rng, y, 3) / 4 for _ in range(group.dim)])
    start = list(eye(group.n))
    return FieldScene(
        group=group, action=LeftMultiplication(), y=Matrix(y), f=f, y0=start, span=SHORT, name=name
    )


def hamiltonian(name):
    """A Hamiltonian without symmetry on T*G, from the unit matrix."""
    group, rng = GROUPS[name], random.Random(name)
    q, mu = group.point("q"), group.dual("p")
    H = mu.dot(mu) / 2 + quadratic(rng, list(q), 3) / 8 + quadratic(rng, list(mu), 3) / 8
    for _ in range(3):
        H += rng.choice(list(q)) * rng.choice(list(mu)) * rng.choice((*q, *mu)) / 8
    mu0 = [Rational(1, k + 2) for k in range(group.dim)]
    return HamiltonianScene(
        group=group, q=q, mu=mu, H=H, q0=list(eye(group.n)), mu0=mu0, span=SHORT, name=f"T*{name}"
    )


@cache
def compiled(kind, name, method):
    return compile_method(field(name) if kind == "field" else hamiltonian(name), method)


def interpreted(made, h):
    """The state after one step of the unoptimised program."""
    domain = FloatDomain(h)
    state = list(made.problem.initial(domain))
    values, first = {"t": 0.0}, 0
    for block in made.problem.state:
        values[block.name] = tuple(state[first : first + len(block.symbols)])
        first += len(block.symbols)
    after = interpret(made.lowered, made.problem, domain, values)
    return state, [x for block in made.problem.state for x in after[block.name]]


slow = pytest.mark.slow
QUICK = [
    ("field", "GL(2)", "rkmk:rk4"),
    ("field", "SO(5)", "cf:cf4"),
    ("hamiltonian", "GL(2)", "vcg:midpoint"),
]
MORE = [
    ("field", name, method)
    for name in ("SO(4)", "SO(5)", "SU(2)", "SU(3)", "Sp(2)", "GL(3)", "Aff(2)", "H(3)")
    for method in ("rkmk:rk4", "cf:cf4", "cg:cg3", "rkmk(2):gauss2")
]
MORE += [
    ("hamiltonian", name, method)
    for name in ("SO(4)", "SO(5)", "SU(2)", "Sp(2)", "GL(2)", "Aff(1)", "H(3)")
    for method in (
        *("rkmk:rk4", "cg:cg3", "cf:cf4", "vcg:midpoint", "vcg:triple_jump", "vrkmk:gauss2", "vcf:cf4"),
        *("slgi:midpoint", "rkmk(0):midpoint"),
    )
]
CASES = [pytest.param(*case, id="-".join(case)) for case in QUICK]
CASES += [pytest.param(*case, id="-".join(case), marks=slow) for case in MORE if case not in QUICK]


@pytest.mark.parametrize(("kind", "name", "method"), CASES)
def test_emitted_steps_are_those_of_the_interpreter(kind, name, method):
    made = compiled(kind, name, method)
    state, expected = interpreted(made, 1 / 64)
    for target in ("c", "python"):
        assert ulps(load(emit_compiled(made, target)).step(state, 1 / 64), expected) <= 64


def test_a_step_on_a_cotangent_bundle_computes_each_exponential_once():
    """The exponential of a matrix is a part of the exponential with its derivative."""
    made = compiled("hamiltonian", "Sp(2)", "rkmk:rk4")
    source = "".join(emit_compiled(made, "python").files.values())
    assert source.count("expm2_d1(v_") == 4  # three stages and the end of the step
    assert "expm2(" not in source


@pytest.mark.parametrize("target", ["c", "python"])
def test_the_matrix_of_a_large_state_is_passed_tested_and_stored_as_a_whole(target):
    artifact = emit_compiled(compiled("field", "SO(5)", "rkmk(0):euler"), target)
    source = "".join(artifact.files.values())
    assert re.search(r"product5\(v_1(\[0:25\])?, state, v_2\)", source)
    stored = "memcpy(state, v_2, sizeof v_2);" if target == "c" else "state[:] = v_2\n"
    assert stored in source
    assert ("all_finite(v_2, 25)" if target == "c" else "isfinite, v_2)") in source


@slow
@pytest.mark.parametrize("method", ["rkmk(0):euler", "rkmk:rk4"])
def test_the_text_grows_at_most_linearly_with_the_number_of_entries(method):
    """Each coordinate of the field has a formula; functions of matrices are loops."""
    sizes, lengths = (6, 8, 10), []
    for n in sizes:
        group = SO(n)
        y = [Symbol(f"y{k}", real=True) for k in range(n * n)]
        f = [y[k] - y[k + n] / 3 for k in range(group.dim)]
        scene = FieldScene(
            group=group, action=LeftMultiplication(), y=y, f=f, y0=list(eye(n)), span=(0, 1), name="turns"
        )
        files = emit_compiled(compile_method(scene, method), "c").files
        lengths.append(sum(map(len, files.values())))
    first, second = ((lengths[i + 1] - lengths[i]) / (sizes[i + 1] ** 2 - sizes[i] ** 2) for i in (0, 1))
    assert 0 < second <= 1.1 * first


ON_GROUPS = {"rkmk", "cg", "cf", "ambient", "taylor"}
ON_BUNDLES = ON_GROUPS | {"vcg", "vrkmk", "vcf", "vrkmk_pade", "slgi", "discrete_gradient"}
PROMISED = [("field", "SO(5)", "cf:cf4"), ("hamiltonian", "SO(4)", "vcg:midpoint")]
METHODS = [(family, case.method) for family, cases in FAMILIES.items() for case in cases]


@slow
@pytest.mark.parametrize(("family", "method"), METHODS)
@pytest.mark.parametrize(("kind", "families"), [("field", ON_GROUPS), ("hamiltonian", ON_BUNDLES)])
@pytest.mark.parametrize("name", ["SO(4)", "Aff(1)"])
def test_every_family_emits_or_names_the_families_that_do(name, kind, families, family, method):
    if family not in families:
        with pytest.raises(MethodError) as refusal:
            compiled(kind, name, method)
        found, _, expected = str(refusal.value).partition("; expected ")
        assert found.startswith(f"the family {family} cannot be used on ")
        named = set(re.findall(r"\w+", expected)) & set(FAMILIES)
        assert named <= families
        assert named or "write parts=" in expected
        return
    steps = []
    for target in ("c", "python"):
        emission = emit_compiled(compiled(kind, name, method), target)
        steps.append(load(emission).step(emission.manifest["initial"], 1 / 64))
    assert ulps(*steps) <= 4


@slow
@pytest.mark.parametrize("level", ["-O0", "-O2", "-O3"])
@pytest.mark.parametrize(
    ("kind", "name", "method"), [("field", "SO(5)", "cf:cf4"), ("hamiltonian", "SO(4)", "vcg:midpoint")]
)
def test_calls_stay_within_the_stated_stack(compiler, level, kind, name, method, tmp_path):
    artifact = emit_compiled(compiled(kind, name, method), "c")
    assert max(painted(artifact, compiler, level, tmp_path).values()) <= stated(artifact) + LIBRARY


@slow
@pytest.mark.parametrize(
    ("kind", "name", "method"), [("field", "SO(5)", "cf:cf4"), ("hamiltonian", "GL(2)", "vcg:midpoint")]
)
def test_the_module_keeps_the_promises_of_emitted_code(compiler, kind, name, method, tmp_path):
    made = compiled(kind, name, method)
    in_c = clean_c(emit_compiled(made, "c"), compiler, tmp_path)
    in_python = clean_python(emit_compiled(made, "python"), tmp_path)
    assert in_c[-len(in_python) :] == pytest.approx(in_python[-len(in_c) :], rel=1e-12)


ORDERS = [
    *(
        ("field", name, method)
        for name in ("SO(5)", "SU(3)", "GL(3)", "Aff(2)")
        for method in ("rkmk:rk4", "cf:cf4", "cg:cg4")
    ),
    *(("hamiltonian", "SO(4)", method) for method in ("vcg:triple_jump", "vrkmk:gauss2", "vcf:cf4")),
    *(
        (kind, "SO(5)", method)
        for kind in ("field", "hamiltonian")
        for method in ("taylor(4)", "ambient:rk4")
    ),
]


@slow
@pytest.mark.parametrize("target", ["c", "python"])
@pytest.mark.parametrize(("kind", "name", "method"), ORDERS)
def test_emitted_steps_have_order_4(kind, name, method, target):
    scenes.register("matrices", field(name) if kind == "field" else hamiltonian(name))
    try:
        arguments = ["converge", "matrices", "-m", method, "-t", target, "--json"]
        done = CliRunner().invoke(program, arguments, catch_exceptions=False)
        rows = json.loads(done.output)
        assert [row["verdict"] for row in rows] == ["holds"], done.output
    finally:
        scenes.unregister("matrices")


@pytest.mark.parametrize(
    ("name", "method", "order"),
    [("GL(2)", "rkmk:rk4", 4), ("H(3)", "cg:cg3", 3), pytest.param("SO(4)", "cf:cf4", 4, marks=slow)],
)
def test_the_order_of_the_program_is_exact(name, method, order):
    made = compiled("field", name, method)
    assert valuation(local_error(made.program, made.problem, QQ, order + 1)) == order + 1


def symplectic_form(group, mu):
    """The matrix of the form (2.26) of Marthinsen's thesis at a momentum, in right trivialisation."""
    n, units = group.dim, np.eye(group.dim)
    form = np.zeros((2 * n, 2 * n))
    form[:n, n:], form[n:, :n] = units, -units
    for i in range(n):
        for j in range(n):
            bracket = group.ad(FloatDomain(0.0), tuple(units[i]), tuple(units[j]))
            form[i, j] = -np.dot(mu, bracket)
    return form


@pytest.mark.parametrize(
    ("name", "method"),
    [
        ("Sp(2)", "vcg:midpoint"),
        *(pytest.param("SO(4)", m, marks=slow) for m in ("vcg:triple_jump", "vrkmk:gauss2", "vcf:cf4")),
        *(pytest.param(g, "vcg:midpoint", marks=slow) for g in ("SU(2)", "GL(2)", "Aff(1)", "H(3)")),
    ],
)
def test_variational_steps_keep_the_symplectic_form(name, method):
    made = compile_method(hamiltonian(name), method, jacobian=True)
    group = GROUPS[name]
    for target in ("c", "python"):
        emission = emit_compiled(made, target)
        module, start = load(emission), emission.manifest["initial"]
        jacobian = np.array(module.jacobian(start, 1 / 16))
        before, after = (symplectic_form(group, y[group.size :]) for y in (start, module.step(start, 1 / 16)))
        assert np.abs(jacobian.T @ after @ jacobian - before).max() < 1e-12


def test_a_step_that_turns_too_far_has_a_status():
    """The angle of the exponential is so large that none of its digits is known."""
    made = compiled("field", "SO(5)", "cf:cf4")
    for target in ("c", "python"):
        module = load(emit_compiled(made, target))
        start = list(made.problem.initial(FloatDomain(0.0)))
        with pytest.raises(ArithmeticError, match="the step is too long"):
            module.step(start, 1e30)
        with pytest.raises(ArithmeticError, match="not finite"):
            module.step([float("nan"), *start[1:]], 0.1)


def test_single_precision_emits_the_exponential():
    made = compiled("field", "GL(2)", "rkmk:rk4")
    state, expected = interpreted(made, 1 / 64)
    for target in ("c", "python"):
        found = load(emit_compiled(made, target, precision="single")).step(state, 1 / 64)
        assert found == pytest.approx(expected, abs=1e-5)
