"""Classical forms: exactly the motion of the scene in other coordinates, in fewer operations."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import isqrt

import pytest
from sympy import Matrix, Rational, diag

from codegen import scenes
from codegen.errors import SceneError
from codegen.groups import S3, SO3
from codegen.groups.product import Product
from codegen.groups.rn import Rn
from codegen.ir.differentiate import gradient
from codegen.ir.domain import FloatDomain, PreciseDomain
from codegen.ir.expr import evaluate, walk
from codegen.ir.number import Number
from codegen.lab.straight_line_field import velocity
from codegen.scene import HamiltonianScene
from codegen.scene.classical_forms import ClassicalForm, classical_forms, find_form
from codegen.scene.problem import Problem
from codegen.scene.run_time import with_inputs

BODY = ("actuated_rigid_body", "dipole", "fast_heavy_top", "free_rigid_body_attitude")
"""Scenes on T*SO(3) with inertia that is fixed in the body."""

FIELDS = ("free_rigid_body_product", "free_rigid_body_quaternion", "free_rigid_body_s3")


class Rationals:
    """Exact arithmetic with fractions; functions have values where these are rational."""

    h = Fraction(0)

    def number(self, value: Number) -> Fraction:
        return value.fraction()

    def rational(self, p: int, q: int = 1) -> Fraction:
        return Fraction(p, q)

    def call(self, function: str, x: Fraction) -> Fraction:
        if function == "sqrt":
            root = Fraction(isqrt(x.numerator), isqrt(x.denominator))
            if root * root == x:
                return root
        if function in ("sin", "cos") and x == 0:
            return Fraction(int(function == "cos"))
        raise ArithmeticError(f"{function}({x}) is not rational")


def coupled_top() -> Problem:
    """A top that moves along a line: a configuration space with two factors. It starts after half a turn."""
    G = Product(SO3(), Rn(1))
    q, mu = G.symbols("q"), G.dual("mu")
    g, x = Matrix(3, 3, q[:9]), q[9]
    P = g.T * Matrix(mu[:3])
    H = P.dot(diag(1, Rational(1, 2), Rational(1, 3)) * P) / 2 + mu[3] ** 2 / 2 + x * g[2, 2] + x**2
    return HamiltonianScene(
        group=G, q=q, mu=mu, H=H, q0=[*diag(1, -1, -1), 1], mu0=[1, 2, 3, 0], span=(0, 1), name="coupled"
    )


def problem(name: str) -> Problem:
    return coupled_top() if name == "coupled" else scenes.load(name)


def points(form: ClassicalForm) -> list[list[Fraction]]:
    """Rational states of a form, on the manifold: products of unit quaternions, their matrices, momenta."""
    d, states = Rationals(), []
    for k in range(1, 4):
        a = (Fraction(k, 7), Fraction(2, 5 + k), Fraction(-1, 3))
        size = 1 + sum(x * x for x in a)
        q = [(2 - size) / size, *(2 * x / size for x in a)]
        rest = [Fraction(j + 2, k + 3) for j in range(12)]
        matrix = form.problem.symbols[0].endswith("00")
        block = list(SO3().covering(d, tuple(q))) if matrix else q  # type: ignore[arg-type]
        states.append([*block, *rest][: len(form.problem.symbols)])
    return states


def pushed(form: ClassicalForm, d: object, state: Sequence[object]) -> tuple[list[object], list[object]]:
    """The field of the form, mapped by the derivative of the map to the scene, and the field of the scene."""
    own = form.problem.velocity(d, state)  # type: ignore[arg-type]
    values = form.problem.values(d, state)  # type: ignore[arg-type]
    left = []
    for formula in form.to_scene:
        slopes = evaluate(gradient(formula, form.problem.symbols), d, values)  # type: ignore[arg-type]
        left.append(sum((a * b for a, b in zip(slopes, own, strict=True)), start=0 * own[0]))
    return left, list(form.scene.velocity(d, form.scene_state(d, state)))  # type: ignore[arg-type]


@pytest.mark.parametrize("name", [*(n for n in BODY if n != "dipole"), *FIELDS, "heavy_top", "coupled"])
def test_the_field_of_a_form_pushed_forward_is_the_ambient_field_exactly(name: str) -> None:
    for form in classical_forms(problem(name)):
        for state in points(form):
            left, right = pushed(form, Rationals(), state)
            assert left == right


def test_the_field_of_the_dipole_is_the_ambient_field_to_forty_digits() -> None:
    """Its roots are irrational at rational points."""
    d = PreciseDomain(0, 50)
    for form in classical_forms(scenes.load("dipole")):
        for state in points(form):
            left, right = pushed(form, d, [d.rational(x.numerator, x.denominator) for x in state])
            assert max(abs(a - b) for a, b in zip(left, right, strict=True)) < 1e-40  # type: ignore[operator]


@pytest.mark.parametrize("name", [*(n for n in BODY if n != "dipole"), *FIELDS, "heavy_top", "coupled"])
def test_the_initial_state_maps_back_exactly(name: str) -> None:
    d = Rationals()
    for form in classical_forms(problem(name)):
        initial = form.problem.initial(d)
        assert form.scene_state(d, initial) == form.scene.initial(d)
        assert form.form_state(d, form.scene.initial(d)) == initial


def test_the_dipole_starts_at_a_quarter_turn() -> None:
    """Its quaternion is irrational: (1, 1, 0, 0)/sqrt 2."""
    d = PreciseDomain(0, 50)
    form = find_form(scenes.load("dipole"), "quaternion")
    initial = form.problem.initial(d)
    assert max(abs(x * x * 2 - y) for x, y in zip(initial[:4], (1, 1, 0, 0), strict=True)) < 1e-45
    back = zip(form.scene_state(d, initial), form.scene.initial(d), strict=True)
    assert max(abs(a - b) for a, b in back) < 1e-45


@pytest.mark.parametrize("name", BODY)
def test_body_forms_need_a_few_dozen_operations(name: str) -> None:
    printed, *others = classical_forms(scenes.load(name))
    assert [form.key for form in others] == ["body-matrix", "quaternion"]
    assert [len(form.problem.symbols) for form in others] == [12, 7]
    for form in others:
        assert len(velocity(form.problem).lines) < min(80, len(velocity(printed.problem).lines) / 2)


def test_a_top_whose_inertia_is_fixed_in_space_keeps_its_momentum_in_space() -> None:
    forms = classical_forms(scenes.load("heavy_top"))
    assert [form.name for form in forms] == ["as printed", "space momentum and unit quaternion"]


@pytest.mark.parametrize("name", ["free_rigid_body", "driven_spin", "duffing_sl2", "linear_oscillator"])
def test_vector_spaces_and_spheres_have_only_the_printed_form(name: str) -> None:
    (form,) = classical_forms(scenes.load(name))
    assert form.printed
    assert form.problem.velocity(
        FloatDomain(0.0), [0.5, 0.25, 1.0, 2.0, 1.5, 3.0, 0.125, 1.0][: len(form.to_scene)]
    )


def test_invariants_of_a_form_are_those_of_the_scene_for_quaternions_of_any_length() -> None:
    d = Rationals()
    form = find_form(scenes.load("fast_heavy_top"), "quaternion")
    state = [3 * x for x in points(form)[0][:4]] + points(form)[0][4:]
    for name in form.scene.invariants:
        expected = form.scene.invariant(d, name, form.scene_state(d, state))  # type: ignore[arg-type]
        assert form.problem.invariant(d, name, state) == expected  # type: ignore[arg-type]


def test_an_unknown_form_is_refused_with_the_known_ones() -> None:
    with pytest.raises(SceneError, match=r"unknown form 'euler'.*printed, body-matrix, quaternion"):
        find_form(scenes.load("dipole"), "euler")


def test_inputs_of_a_scene_are_inputs_of_its_forms() -> None:
    """The torques act in the body frame, so P' contains them alone."""
    form = find_form(with_inputs(scenes.load("actuated_rigid_body"), ["u1"]), "quaternion")
    read = [
        {n.payload for n in walk([root]) if n.op == "sym"} & {"u0", "u1", "u2"}
        for root in form.problem.open_roots
    ]
    assert read == [set()] * 4 + [{"u0"}, {"u1"}, {"u2"}]
    assert form.problem.inputs == ("u1",)


@pytest.mark.parametrize("trace", [3, -1])
def test_every_rotation_has_a_quaternion(trace: int) -> None:
    """Half turns have trace -1, where the formula with the real part fails."""
    d, G = Rationals(), SO3()
    g = (1, 0, 0, 0, (trace - 1) // 2, 0, 0, 0, (trace - 1) // 2)
    exact = tuple(map(Fraction, g))
    pivots = G.pivots(d, exact)  # type: ignore[arg-type]
    q = G.lift(d, exact, pivots.index(max(pivots)))  # type: ignore[arg-type]
    assert G.covering(d, q) == G.projected_covering(d, q) == exact  # type: ignore[arg-type]
    assert isinstance(G.cover, S3)
