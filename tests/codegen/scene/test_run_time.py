"""Emitted code reads run-time parameters, so the formulas of a scene must agree for all their values."""

from __future__ import annotations

import pytest
from sympy import Matrix, Symbol, cos, diag, pi, sin, symbols

from codegen.errors import SceneError
from codegen.groups import SO3, LeftMultiplication, Rn, Rotation
from codegen.scene import (
    Bond,
    FieldScene,
    HamiltonianScene,
    HamiltonianSiteScene,
    SemilinearScene,
    SiteScene,
    StiefelScene,
    banded,
    neighbour,
    param,
    unknown,
)
from codegen.scene.run_time import with_runtime

ZERO, ONE = param("k", 0), param("k", 1)


def oscillator(H, parts, flows=None):
    q, p = Rn(1).point("q"), Rn(1).dual("p")
    return HamiltonianScene(
        group=Rn(1),
        q=q,
        mu=p,
        H=H(q[0], p[0]),
        parts={name: part(q[0], p[0]) for name, part in parts.items()},
        flows={name: flow(q[0], p[0]) for name, flow in (flows or {}).items()},
        q0=[1],
        mu0=Matrix([0]),
        span=(0, 1),
    )


def stated_flow():
    tau = Symbol("tau")
    return oscillator(
        lambda q, p: (p**2 + ONE * q**2) / 2 + q**4 / 4,
        {"A": lambda q, p: (p**2 + ONE * q**2) / 2, "B": lambda q, p: q**4 / 4},
        {"A": lambda q, p: ([cos(tau) * q + sin(tau) * p], [cos(tau) * p - sin(tau) * q])},
    )


def parts_without_a_term():
    return oscillator(
        lambda q, p: p**2 / 2 + q**2 / 2 + ZERO * q**4,
        {"T": lambda q, p: p**2 / 2, "V": lambda q, p: q**2 / 2},
    )


def spinning_body():
    m = Matrix(symbols("m0:3", real=True))
    f = -diag(1, 2, 3) * m + Matrix([0, 0, ZERO])
    return FieldScene(
        group=SO3(),
        action=Rotation(),
        y=m,
        f=f,
        y0=[1, 0, 1],
        span=(0, 1),
        invariants={"E": m.dot(diag(1, 2, 3) * m)},
    )


def orthonormal_columns(rows=4):
    X, A = unknown(rows, 2), banded(rows, {-1: -1, 0: 2, 1: -1})
    return StiefelScene(x=X, velocity=ONE * (A @ X) - X @ X.T @ A @ X, span=(0, 1))


def chain_with_parts():
    q, p = Rn(1).point("q"), Rn(1).dual("p")
    T, V = p[0] ** 2 / 2, q[0] ** 2 / 2
    bonds = [Bond((1,), (neighbour(q, (1,))[0] - q[0]) ** 2 / 2)]
    return HamiltonianSiteScene(
        group=Rn(1),
        q=q,
        mu=p,
        H=T + (1 + ZERO) * V,
        parts={"T": T, "V": V},
        bonds=bonds,
        q0=[1],
        mu0=[0],
        span=(0, 1),
    )


def damped_chain():
    y = x, p = symbols("x p", real=True)
    left, right = neighbour(y, (-1,))[0], neighbour(y, (1,))[0]
    return SiteScene(
        group=Rn(2),
        action=LeftMultiplication(),
        y=y,
        f=[p, left + right - 2 * x - ZERO * p],
        y0=[1, 0],
        span=(0, 1),
        energy=p**2 / 2,
        bonds=[Bond((1,), (right - x) ** 2 / 2)],
    )


def damped_wave():
    """The symbol of L is real, but it is an even function only if the parameter is 0."""
    u, wave, x = symbols("u wave x", real=True)
    L, N = -(wave**2) + ZERO * wave, -(u**3)
    return SemilinearScene(u=u, k=wave, x=x, L=L, N=N, length=2 * pi, u0=cos(x), span=(0, 1))


SCENES = {
    "in the flow of A, the formula for p0 is wrong": stated_flow,
    "the parts T, V add up to": parts_without_a_term,
    "the invariant E changes": spinning_body,
    "the velocity is not tangent": orthonormal_columns,
    "the sum of the fields of all parts": chain_with_parts,
    "the total energy of": damped_chain,
    "L does not map real functions": damped_wave,
}


@pytest.mark.parametrize("request_", ["k", "k=2"])
@pytest.mark.parametrize("message", SCENES)
def test_formulas_that_agree_for_the_default_of_a_parameter_only_are_refused(message, request_):
    scene = SCENES[message]()
    with pytest.raises(SceneError, match=message):
        with_runtime(scene, (request_,))


def test_the_message_names_the_value_of_the_parameter():
    with pytest.raises(SceneError, match=r"k = 0\.0"):
        with_runtime(parts_without_a_term(), ("k",))


@pytest.mark.parametrize("request_", ["k", "k=2"])
def test_a_parameter_of_a_scene_with_large_matrices_can_be_set(request_):
    """The check of coordinates needs formulas of coordinates, which large matrices do not have."""
    X, A = unknown(20, 2), banded(20, {-1: -1, 0: 2, 1: -1})
    scene = StiefelScene(x=X, velocity=ONE * (A @ X - X @ X.T @ A @ X), span=(0, 1))
    assert "k" in with_runtime(scene, (request_,)).parameters
