"""Methods for y' = A(t).y: the printed formulas, orders in emitted code, and clear refusals."""

from __future__ import annotations

import math
import re
from fractions import Fraction
from itertools import product

import mpmath
import pytest
from sympy import Matrix, Rational, Symbol, atan, cos, diff, sin, symbols

from codegen.certify import certified_order
from codegen.emitter import compile_method, emit_compiled
from codegen.errors import MethodError, SceneError
from codegen.groups import (
    GL,
    SL2,
    SO2,
    SO3,
    Columns,
    LeftMultiplication,
    Linear,
    Product,
    RightMultiplication,
    Rn,
)
from codegen.ir.domain import PreciseDomain
from codegen.ir.interpret import interpret
from codegen.lab.long_runs.symplecticity import symplectic_defect
from codegen.lab.orders.convergence import converge
from codegen.lab.reference import cached_reference
from codegen.lab.runner import Emitted
from codegen.loader import load as loaded
from codegen.lower import lower, method_for, problem_for
from codegen.lower.linear import LinearLowering
from codegen.lower.registry import lowering, names
from codegen.scene import (
    FieldScene,
    HamiltonianScene,
    LinearScene,
    StiefelScene,
    banded,
    param,
    signal,
    unknown,
)
from codegen.scenes import load
from orderconds.errors import InputError
from orderconds.tableau import Tableau
from tests.strategies import linear_scene

t = Symbol("t")
FAMILIES = [name for name in names() if isinstance(lowering(name), LinearLowering)]
DOMAIN = PreciseDomain(Fraction(1, 20), 40)


def matrix(time):
    """The generator of the oscillator of Paper 3."""
    stiffness = 1 + DOMAIN.rational(1, 10) * mpmath.sin(DOMAIN.rational(123, 1000) * time)
    return mpmath.matrix([[0, 1], [-stiffness, 0]])


def step(method):
    """One step from the initial state at the time 1/3, by the interpreter with 40 digits."""
    scene = load("linear_oscillator_sl2")
    chosen = method_for(scene, method)
    problem = problem_for(scene, chosen)
    inputs = {"y": scene.initial(DOMAIN), "t": DOMAIN.rational(1, 3)}
    return interpret(lower(scene, chosen), problem, DOMAIN, inputs)["y"]


def printed(name):
    """The same step by the formulas of the literature, in matrices."""
    h, root = DOMAIN.h, mpmath.sqrt(3)
    first, second = (h * matrix(DOMAIN.rational(1, 3) + h * (3 + s * root) / 6) for s in (-1, 1))
    bracket = second * first - first * second
    s = (first + second) / 2
    one = mpmath.eye(2)
    match name:
        case "magnus4":
            g = mpmath.expm(s + root / 12 * bracket)
        case "cf_magnus4":
            a, b = mpmath.mpf(1) / 4 - root / 6, mpmath.mpf(1) / 4 + root / 6
            g = mpmath.expm(a * first + b * second) * mpmath.expm(b * first + a * second)
        case "fer4":
            inner = root / 12 * bracket
            g = mpmath.expm(s) * mpmath.expm(inner - (s * inner - inner * s) / 2)
        case _:
            x = s + root / 12 * bracket - s * s * s / 12
            g = (one - x / 2) ** -1 * (one + x / 2)
    y = load("linear_oscillator_sl2").initial(DOMAIN)
    rows = g * mpmath.matrix([list(y[:4]), list(y[4:])])
    return list(rows)


@pytest.mark.parametrize("method", ["magnus4", "cf_magnus4", "fer4", "cayley4"])
def test_a_step_is_the_printed_formula(method):
    with mpmath.workdps(45):
        pairs = zip(step(f"{method.removesuffix('4')}:{method}"), printed(method), strict=True)
        assert all(abs(x - y) < 1e-37 for x, y in pairs)


A = Matrix([sin(2 * t) + 1, t * cos(t) - 2, Rational(1, 2) + cos(3 * t)])
TURN = [0, -1, 0, Rational(3, 5), 0, Rational(-4, 5), Rational(4, 5), 0, Rational(3, 5)]
ON_ITSELF = {
    side.__name__: LinearScene(
        group=SO3(), action=side(), A=A, y0=TURN, span=(0, 2), name=f"linear on SO(3), {side.__name__}"
    )
    for side in (LeftMultiplication, RightMultiplication)
}
ORDERS = {
    **{"magnus:magnus4": 4, "magnus:magnus6": 6, "magnus:magnus8": 8},
    **{"cf_magnus:cf_magnus4": 4, "cf_magnus:cf_magnus6": 6, "cf_magnus:cf_magnus8": 8},
    **{"fer:fer4": 4, "fer:fer6": 6, "cayley:cayley4": 4, "cayley:cayley6": 6},
}
TRIED = [
    pytest.param(*case, marks=() if case[1] == "RightMultiplication" and case[2] == "c" else pytest.mark.slow)
    for case in product(ORDERS, ON_ITSELF, ("c", "python"))
]


@pytest.mark.parametrize(("method", "side", "target"), TRIED)
def test_emitted_code_has_its_order_from_below_and_above_under_left_and_right_actions(method, side, target):
    scene = ON_ITSELF[side]
    made = compile_method(scene, method)
    stated = certified_order(made.method, made.scene)
    assert stated.order == ORDERS[method]
    found = converge(Emitted(made, target), stated, cached_reference(scene))
    assert found.verdict == "holds", found.sentence()
    assert found.observed == pytest.approx(stated.order, abs=0.25)


def test_left_and_right_actions_are_inverse_to_each_other():
    left = LinearScene(group=SO3(), action=LeftMultiplication(), A=A, y0=TURN, span=(0, 1))
    inverse = [TURN[3 * j + i] for i in range(3) for j in range(3)]
    right = LinearScene(group=SO3(), action=RightMultiplication(), A=A, y0=inverse, span=(0, 1))
    for method in ("magnus:magnus6", "cf_magnus:cf_magnus4", "fer:fer4", "cayley:cayley4"):
        ends = []
        for scene in (left, right):
            chosen = method_for(scene, method)
            inputs = {"y": scene.initial(DOMAIN), "t": DOMAIN.rational(0)}
            ends.append(interpret(lower(scene, chosen), scene, DOMAIN, inputs)["y"])
        moved = [ends[1][3 * j + i] for i in range(3) for j in range(3)]
        assert all(abs(x - y) < 1e-37 for x, y in zip(ends[0], moved, strict=True))


def test_a_constant_generator_is_integrated_exactly():
    scene = LinearScene(
        group=GL(2), action=Linear(), A=Matrix([[1, 2], [-3, Rational(1, 2)]]), y0=[1, 2], span=(0, 1)
    )
    with mpmath.workdps(45):
        g = mpmath.expm(DOMAIN.h * mpmath.matrix([[1, 2], [-3, mpmath.mpf(1) / 2]]))
        expected = list(g * mpmath.matrix([1, 2]))
        for method in ("magnus:magnus6", "cf_magnus:cf_magnus4", "fer:fer6"):
            chosen = method_for(scene, method)
            found = interpret(lower(scene, chosen), scene, DOMAIN, {"y": scene.initial(DOMAIN)})["y"]
            # Coefficients of a proved tableau are exact, so the weights of the values add up to 1.
            assert all(abs(x - y) < 1e-37 for x, y in zip(found, expected, strict=True))


def test_a_generator_may_contain_parameters_and_signals():
    u = signal("u", sin(t))
    scene = LinearScene(
        group=SL2(), action=Columns(2), A=[1, -param("k", 2) - u, t], y0=[1, 0, 0, 1], span=(0, 1)
    )
    plain = loaded(emit_compiled(compile_method(scene, "magnus4"), "python"))
    opened = compile_method(scene, "magnus4", parameters=["k"], inputs=["u"])
    module = loaded(emit_compiled(opened, "python"))
    start = [1.0, 0.0, 0.0, 1.0]
    expected = plain.run(start, 0.1, 3, 0.2)
    found = module.run(start, 0.1, 3, 0.2, inputs=lambda s: [math.sin(s)], k=2.0)
    assert all(abs(x - y) < 1e-14 for x, y in zip(found, expected, strict=True))


def test_a_matrix_of_formulas_is_read_in_the_basis_of_the_algebra():
    skew = Matrix([[0, -t, 2], [t, 0, -3 * t], [-2, 3 * t, 0]])
    scene = LinearScene(group=SO3(), action=Linear(), A=skew, y0=[1, 0, 0], span=(0, 1))
    column = LinearScene(group=SO3(), action=Linear(), A=[3 * t, 2, t], y0=[1, 0, 0], span=(0, 1))
    d = PreciseDomain(Fraction(0), 30)
    values = [p.apply(d, "fieldt", None, (p.initial(d), d.rational(2, 7))) for p in (scene, column)]
    assert values[0] == values[1]


@pytest.mark.parametrize(
    ("A", "message"),
    [
        (Matrix([[0, t], [t, 0]]), "A is a 2 x 2 matrix; expected a column of 3 formulas, or a 3 x 3 matrix"),
        (Matrix([[0, t, 0], [t, 0, 0], [0, 0, 0]]), "A is not in the Lie algebra; expected a matrix of the"),
        ([Symbol("y0", real=True), 0, 0], "A depends on the state; expected formulas in t and parameters"),
    ],
)
def test_a_generator_that_cannot_be_used_is_refused(A, message):
    with pytest.raises(SceneError, match=re.escape(message)):
        LinearScene(group=SO3(), action=Linear(), A=A, y0=[1, 0, 0], span=(0, 1))


@pytest.mark.parametrize("scene", ["dipole", "driven_spin", "linear_oscillator", "free_rigid_body"])
@pytest.mark.parametrize("family", FAMILIES)
def test_a_field_that_depends_on_the_state_is_refused_with_the_reason(family, scene):
    expected = (
        f"{family} cannot be used on {scene}, whose field depends on the state; expected an equation y' = A"
    )
    for spelling in (f"{family}:{family}4", f"{family}4"):
        with pytest.raises(MethodError) as caught:
            compile_method(scene, spelling)
        named = "magnus" if family in ("cf_magnus", "fer") and ":" not in spelling else family
        assert expected.removeprefix(family) in str(caught.value)
        assert re.match(f"the family ({family}|{named}|cf_magnus|fer) cannot be used on", str(caught.value))


def test_an_oscillator_with_a_state_in_its_field_is_no_linear_problem():
    x, y = Symbol("x", real=True), Symbol("y", real=True)
    scene = FieldScene(group=SL2(), action=Linear(), y=[x, y], f=[1, -1 - t - x, 0], y0=[1, 0], span=(0, 1))
    assert not scene.linear
    with pytest.raises(MethodError, match="depends on the state"):
        compile_method(scene, "magnus4")


@pytest.mark.parametrize("n", [6, 60])
def test_a_field_by_formulas_of_matrices_is_no_linear_problem(n):
    X, A = unknown(n, 2), banded(n, {-1: -1, 0: 2, 1: -1})
    scene = StiefelScene(x=X, velocity=A @ X - X @ (X.T @ A @ X), span=(0, 1))
    assert not scene.linear
    with pytest.raises(MethodError, match="depends on the state"):
        compile_method(scene, "magnus4")


def test_a_hamiltonian_field_of_the_time_alone_is_a_linear_problem():
    q, p = Rn(2).point("q"), Rn(2).dual("p")
    H = (1 + t) * p[0] - t**2 * q[1] + 3 * p[1]
    scene = HamiltonianScene(group=Rn(2), q=q, mu=p, H=H, q0=[1, 2], mu0=Matrix([3, 4]), span=(0, 1))
    module = loaded(emit_compiled(compile_method(scene, "magnus:magnus4"), "python"))
    found = module.step([1.0, 2.0, 3.0, 4.0], 0.5, 0.0)
    expected = [1 + 0.5 + 0.125, 2 + 1.5, 3.0, 4 + 0.125 / 3]
    assert all(abs(x - y) < 1e-14 for x, y in zip(found, expected, strict=True))


def test_cayley_methods_need_a_group_with_a_cayley_map():
    scene = linear_scene("T*SO(3)")
    with pytest.raises(
        MethodError,
        match=r"cayley cannot be used on .* whose group is T\*SO\(3\); expected a group whose Lie algebra",
    ):
        compile_method(scene, "cayley4")


def test_a_product_outside_of_the_algebra_is_refused():
    text = """
        name = "x"
        family = "magnus"
        map = "cay"
        c = ["0", "1/2", "1"]
        exponents = [{ "1" = "1", "1*2*3" = "1", "3*2*1" = "1" }]
    """
    scene = ON_ITSELF["LeftMultiplication"]
    with pytest.raises(
        MethodError, match=r"the product 1\*2\*3 is in general not .*; expected an odd number of factors"
    ):
        compile_method(scene, Tableau.loads(text), family="cayley")


HINTED = [
    ("dipole", "vcg:magnus4"),
    ("dipole", "splitting:magnus4"),
    ("dipole", "rkmk:cf4"),
    ("driven_spin", "vcf:magnus6"),
    ("driven_spin", "cf:ruth3"),
    ("linear_oscillator", "slgi:cayley4"),
    ("linear_oscillator_sl2", "magnus:rk4"),
    ("linear_oscillator_sl2", "cayley:cf4"),
    ("linear_oscillator_sl2", "fer:gauss2"),
    ("linear_oscillator_sl2", "fer:magnus4"),
    ("linear_oscillator_sl2", "cf_magnus:magnus4"),
    ("linear_oscillator_sl2", "cayley:magnus4"),
    ("linear_oscillator_sl2", "magnus:cayley4"),
]


@pytest.mark.parametrize(("scene", "method"), HINTED)
def test_a_hint_names_a_method_that_works(scene, method):
    with pytest.raises(InputError) as caught:
        compile_method(scene, method)
    hint = caught.value.hint
    family = re.fullmatch(r"use the family '(\w+)'", hint)
    named = re.search(r"write (?:for example )?(\S+)$", hint)
    families = re.match(r"use one of ([\w, ]+)$", hint)
    if families is not None:
        assert all(lowering(name).objection(load(scene)) is None for name in families[1].split(", "))
        return
    assert family is not None or named is not None, hint
    spelling = f"{family[1]}:{method.partition(':')[2]}" if family else named[1]
    lower(load(scene), method_for(load(scene), spelling))


def coupled_rotors():
    """Two rotors with the Hamiltonian H = p0^2 p1. The group is abelian."""
    group = Product(SO2(), SO2())
    q, p = group.point("q"), group.dual("p")
    start = {"q0": [1, 0, 1, 0], "mu0": [Rational(1, 2), Rational(1, 3)]}
    return HamiltonianScene(name="rotors", group=group, q=q, mu=p, H=p[0] ** 2 * p[1], span=(0, 1), **start)


def test_products_of_exponentials_are_symplectic_on_abelian_groups():
    made = compile_method(coupled_rotors(), "magnus:magnus4")
    assert lowering("magnus").symplectic(made.scene, made.method)
    assert symplectic_defect(made, [1.0, 0.0, 1.0, 0.0, 0.5, 1 / 3], 0.25) < 1e-40


def test_cayley_steps_are_not_symplectic_on_abelian_groups():
    scene = coupled_rotors()
    assert not lowering("cayley").symplectic(scene, method_for(scene, "magnus:magnus4"))
    # A step with cay adds these angles to q, and does not change p. It is symplectic if and only if their
    # Jacobian with respect to p is symmetric.
    h, p0, p1 = symbols("h p0 p1")
    angles = [2 * atan(h * diff(p0**2 * p1, p) / 2) for p in (p0, p1)]
    difference = diff(angles[0], p1) - diff(angles[1], p0)
    assert difference.subs({h: Rational(1, 4), p0: Rational(1, 2), p1: Rational(1, 3)}) != 0
