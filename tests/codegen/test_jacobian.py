"""The derivative of a step: against differences, against exact matrices, and symplectic where the step is."""

from __future__ import annotations

import math
from fractions import Fraction
from functools import cache

import numpy as np
import pytest

from codegen.build import Compiler
from codegen.emitter import compile_method, emit_compiled
from codegen.errors import SceneError
from codegen.integrator import Status, StepFailed
from codegen.ir.domain import FloatDomain
from codegen.ir.expr import Space, evaluate
from codegen.ir.tangent import tangents
from codegen.kernel.variations import Variations
from codegen.loader import load
from codegen.lower import problem_for
from codegen.scene import FieldScene
from tests import compilations
from tests.promises import clean_c, clean_python
from tests.strategies import hamiltonian_scene

WEIGHTS = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}
"""Central differences of order 8."""
EPS = 2.0**-9

CASES = [
    ("free_rigid_body", "cf:cf4"),
    ("driven_spin", "cg:cg3"),
    ("driven_spin", "rkmk(2):gauss2"),
    ("linear_oscillator", "rk:gauss2"),
    ("dipole", "vcg:triple_jump"),
    ("dipole", "vrkmk(2):gauss2"),
    ("dipole", "rkmk:rk4"),
    ("dipole", "splitting:ruth3"),
    ("dipole", "ambient:rk4"),
    ("fast_heavy_top", "splitting:strang"),
    ("free_rigid_body_s3", "rkmk:rk4"),
    ("free_rigid_body_product", "cf:cf4"),
    ("duffing_sl2", "cg:cg3"),
]
LONG = (("driven_spin", "cg:cg3"), ("dipole", "vrkmk(2):gauss2"), ("dipole", "ambient:rk4"))
"""Cases like others of :data:`CASES`, for the slow run."""

TRIED = [pytest.param(*case, marks=pytest.mark.slow if case in LONG else ()) for case in CASES]

H = {"fast_heavy_top": 0.002}


def compiled(scene, method, inputs=(), frame="space", jacobian=True):
    return compilations.compiled(scene, method, "auto", frame, inputs, jacobian)


@cache
def emitted(scene, method, target="c", precision="double", **options):
    return emit_compiled(compiled(scene, method, **options), target, "derived_", precision=precision)


def somewhere(scene, method):
    """A state after some steps: what is special at first is over."""
    emission = emitted(scene, method)
    return load(emission).run(emission.manifest["initial"], H.get(scene, 0.03), 5, 0.1)


def moved(view, state, variation):
    """The state at the end of a variation, by the exponential where a group moves it."""
    d, found, rest = FloatDomain(0.0), [], list(variation)
    for group, symbols in Variations.of(view).parts:
        part, state = state[: len(symbols)], state[len(symbols) :]
        if group is None:
            own, rest = rest[: len(symbols)], rest[len(symbols) :]
            found += [a + b for a, b in zip(part, own, strict=True)]
        else:
            own, rest = rest[: group.dim], rest[group.dim :]
            found += group.mul(d, group.exp(d, tuple(own)), tuple(part))
    return found


def rates(view, state, change):
    """The variation that a change of coordinates is."""
    d, found = FloatDomain(0.0), []
    for group, symbols in Variations.of(view).parts:
        n = len(symbols)
        own, part, change, state = change[:n], state[:n], change[n:], state[n:]
        found += own if group is None else group.rate(d, tuple(own), tuple(part))
    return found


def differences(scene, method, state, h, t, **more):
    made, integrator = compiled(scene, method), load(emitted(scene, method))
    view, size = (
        problem_for(made.scene, made.method),
        emitted(scene, method).manifest["interface"]["variations"],
    )
    new, columns = integrator.step(state, h, t), []
    for k in range(size):
        total = np.zeros(len(state))
        for n, w in WEIGHTS.items():
            for sign in (1, -1):
                unit = [sign * n * EPS * (i == k) for i in range(size)]
                total += sign * w / EPS * np.array(integrator.step(moved(view, state, unit), h, t))
        columns.append(rates(view, new, list(total)))
    return np.array(columns).T


@pytest.mark.parametrize(("scene", "method"), TRIED)
def test_the_jacobian_is_the_limit_of_differences(scene, method):
    state, h = somewhere(scene, method), H.get(scene, 0.03)
    found = np.array(load(emitted(scene, method)).jacobian(state, h, 0.1))
    expected = differences(scene, method, state, h, 0.1)
    assert np.abs(found - expected).max() < 1e-9 * max(1, np.abs(expected).max())
    assert np.abs(found - np.eye(len(found))).max() > 1e-3


@pytest.mark.parametrize(("scene", "method"), TRIED)
def test_c_and_python_have_the_same_jacobian(scene, method):
    state, h = somewhere(scene, method), H.get(scene, 0.03)
    c, python = (np.array(load(emitted(scene, method, t)).jacobian(state, h, 0.1)) for t in ("c", "python"))
    assert np.abs(c - python).max() < 1e-12 * max(1, np.abs(c).max())


def test_of_a_linear_method_on_a_linear_field_it_is_the_stability_matrix():
    """Implicit midpoint on y' = (y1, -y0): (1 - hA/2)^-1 (1 + hA/2)."""
    from sympy import Matrix, symbols

    from codegen.groups import LeftMultiplication, Rn

    y = Matrix(symbols("y0:2", real=True))
    turning = FieldScene(
        group=Rn(2), action=LeftMultiplication(), y=y, f=Matrix([y[1], -y[0]]), y0=[1, 0], span=(0, 1)
    )
    made = load(emit_compiled(compile_method(turning, "rk:midpoint", jacobian=True), "c"))
    A, one = 0.25 * np.array([[0, 1], [-1, 0]]), np.eye(2)
    assert np.abs(np.array(made.jacobian([3.0, 1.0], 0.5)) - np.linalg.solve(one - A, one + A)).max() < 1e-15


def form(mu):
    """The canonical form on T*SO(3), right-trivialised: <nu2, xi1> - <nu1, xi2> - <mu, [xi1, xi2]>."""
    bracket = np.array([[mu @ np.cross(a, b) for b in np.eye(3)] for a in np.eye(3)])
    return np.block([[-bracket, np.eye(3)], [-np.eye(3), np.zeros((3, 3))]])


def defect(method):
    state = np.array(somewhere("dipole", method))
    integrator = load(emitted("dipole", method))
    J, new = np.array(integrator.jacobian(state, 0.03)), np.array(integrator.step(state, 0.03))
    return np.abs(J.T @ form(new[9:]) @ J - form(state[9:])).max()


@pytest.mark.parametrize(
    "method",
    ["vcg:triple_jump", pytest.param("vrkmk(2):gauss2", marks=pytest.mark.slow), "splitting:ruth3"],
)
def test_jacobians_of_symplectic_steps_are_symplectic(method):
    assert defect(method) < 1e-12


@pytest.mark.parametrize("method", ["rkmk:rk4", pytest.param("cf:cf4", marks=pytest.mark.slow)])
def test_those_of_others_are_not(method):
    assert defect(method) > 1e-9


def test_jacobians_of_the_sphere_turn_tangents_into_tangents():
    state = somewhere("free_rigid_body", "cf:cf4")
    integrator = load(emitted("free_rigid_body", "cf:cf4"))
    J, new = np.array(integrator.jacobian(state, 0.03)), np.array(integrator.step(state, 0.03))
    tangent = np.cross(state, [0.3, -0.2, 0.5])
    assert abs(new @ (J @ tangent)) < 1e-15
    assert isinstance(integrator.jacobian(np.array(state), 0.03), np.ndarray)


@pytest.mark.parametrize("target", ["c", "python"])
def test_inputs_are_held_and_momenta_are_those_of_the_frame(target):
    names = ("u0", "u1", "u2")
    driven = load(emitted("actuated_rigid_body", "rkmk:rk4", target, inputs=names))
    start = emitted("actuated_rigid_body", "rkmk:rk4", target, inputs=names).manifest["initial"]
    J = np.array(driven.jacobian(start, 0.05, inputs=[0.1, 0.2, 0.3]))
    up, down = (
        np.array(driven.step([*start[:9], start[9] + e, *start[10:]], 0.05, inputs=[0.1, 0.2, 0.3]))
        for e in (1e-5, -1e-5)
    )
    assert np.abs(J[3:, 3] - (up - down)[9:] / 2e-5).max() < 1e-9
    with pytest.raises(TypeError, match="expected values for u0, u1, u2"):
        driven.jacobian(start, 0.05)
    for few in ([], [0.1, 0.2]):
        with pytest.raises(TypeError, match=f"expected 3 inputs, found {len(few)}"):
            driven.jacobian(start, 0.05, inputs=few)
    space = np.array(
        load(emitted("dipole", "vcg:midpoint", target)).jacobian(
            emitted("dipole", "vcg:midpoint").manifest["initial"], 0.05
        )
    )
    body = emitted("dipole", "vcg:midpoint", target, frame="body")
    g = np.array(body.manifest["initial"][:9]).reshape(3, 3)
    turned = np.array(load(body).jacobian(body.manifest["initial"], 0.05))
    assert np.abs(turned[:3, 3:] - space[:3, 3:] @ g).max() < 1e-12


@pytest.mark.parametrize(
    ("scene", "method", "precision"),
    [
        (*CASES[0], "double"),
        pytest.param(*CASES[0], "single", marks=pytest.mark.slow),
        (*CASES[2], "double"),
        pytest.param(*CASES[2], "single", marks=pytest.mark.slow),
        pytest.param(*CASES[9], "double", marks=pytest.mark.slow),
        (*CASES[9], "single"),
    ],
)
def test_modules_with_a_jacobian_are_clean(scene, method, precision, compiler: Compiler, tmp_path):
    (tmp_path / "c").mkdir()
    emission = emitted(scene, method, "c", precision=precision)
    clean_c(emission, compiler, tmp_path / "c")
    assert "derived_jacobian(" in emission.files["derived.h"]
    if compiler.command[0] == "gcc" and precision == "double":
        clean_python(emitted(scene, method, "python"), tmp_path)


@pytest.mark.parametrize("target", ["c", "python"])
def test_floats_have_a_jacobian_too(target):
    state = somewhere("dipole", "vcg:triple_jump")
    exact = np.array(load(emitted("dipole", "vcg:triple_jump")).jacobian(state, 0.03))
    rough = np.array(
        load(emitted("dipole", "vcg:triple_jump", target, precision="single")).jacobian(state, 0.03)
    )
    assert np.abs(rough - exact).max() < 1e-4


@pytest.mark.parametrize("target", ["c", "python"])
def test_a_step_that_cannot_be_made_has_no_jacobian(target):
    integrator = load(emitted("free_rigid_body", "cf:cf4", target))
    for state, h, status in (
        ([math.nan, 0, 1], 0.1, Status.NOT_FINITE),
        ([1, 0, 0], math.inf, Status.BAD_STEP),
    ):
        with pytest.raises(StepFailed) as failure:
            integrator.jacobian(state, h)
        assert failure.value.status == status


def test_without_a_request_there_is_none():
    for target in ("c", "python"):
        emission = emitted("free_rigid_body", "cf:cf4", target, jacobian=False)
        assert "jacobian" not in "".join(emission.files.values())
    with pytest.raises(TypeError, match="emit it with jacobian=True"):
        load(emission).jacobian([1, 0, 0], 0.1)
    assert "--jacobian" in emitted("free_rigid_body", "cf:cf4").manifest["command"]


def test_a_group_whose_elements_have_no_rates_is_refused():
    with pytest.raises(SceneError, match=r"right trivialisation, which is not implemented for SE\(2\)"):
        Variations.of(hamiltonian_scene("SE(2)"))


def test_tangents_are_exact():
    """d(x^3 y / (1 + x)) along (dx, dy), in rational numbers."""

    class Rationals:
        def number(self, value):
            return value.fraction()

    s = Space()
    x, y, dx, dy = (s.sym(name) for name in ("x", "y", "dx", "dy"))
    (found,) = tangents([x**3 * y / (1 + x)], {"x": dx, "y": dy})
    values = {"x": Fraction(2), "y": Fraction(3), "dx": Fraction(5), "dy": Fraction(7)}
    (value,) = evaluate([found], Rationals(), values)
    assert value == (Fraction(36, 3) - Fraction(24, 9)) * 5 + Fraction(8, 3) * 7
    assert tangents([y], {"x": dx}) == (s.zero,)
