"""A Hamiltonian seen from the body: what moves with it is constant there."""

from __future__ import annotations

import random

import pytest
from sympy import Max, Rational, diag, eye

from codegen import scenes
from codegen.groups import SO3
from codegen.ir.domain import PreciseDomain
from codegen.ir.expr import evaluate, walk
from codegen.ir.number import Number
from codegen.scene import HamiltonianScene
from codegen.scene.body_frame import body_field, field_in_body
from tests.strategies import hamiltonian_scene, top_scene

D = PreciseDomain(0, 40)


def somewhere(scene, rng):
    """A group element, a momentum, and the values of all symbols there."""
    draw = [D.rational(rng.randint(-99, 99), 100) for _ in range(2 * scene.group.dim)]
    q, mu = scene.group.exp(D, draw[: scene.group.dim]), tuple(draw[scene.group.dim :])
    return q, mu, scene.values(D, (*q, *mu), D.rational(1, 7))


@pytest.mark.parametrize(
    "scene",
    [hamiltonian_scene("SO(3)"), hamiltonian_scene("SO(3)", 1, time=True), top_scene(diag(1, 2, 3))]
    + [scenes.load(name) for name in ("dipole", "heavy_top", "fast_heavy_top")],
    ids=lambda scene: scene.name,
)
def test_xi_is_ad_q_of_w_and_n_is_the_transport_of_the_bodys_force(scene):
    rng, body = random.Random(1), scene.body
    for _ in range(3):
        q, mu, values = somewhere(scene, rng)
        xi, n = (lambda roots: (roots[:3], roots[3:]))(evaluate(scene.roots, D, values))
        P = scene.group.Adt(D, q, mu)
        inside = scene.values(D, (*q, *P), D.rational(1, 7))
        W, N = (evaluate(roots, D, inside) for roots in (body.velocity, body.force))
        for found, stated in ((scene.group.Ad(D, q, W), xi), (scene.group.Adtinv(D, q, N), n)):
            assert all(abs(a - b) < 1e-30 * max(1, abs(b)) for a, b in zip(found, stated, strict=True))


def test_the_dipoles_force_reads_the_vertical_seen_from_the_body_and_nothing_else_of_q():
    read = {n.payload for n in walk(scenes.load("dipole").body.force) if n.op == "sym"}
    assert read == {"g20", "g21", "g22", "mu0", "mu1", "mu2", "beta", "depth"}


def test_the_inertia_of_a_top_is_found():
    inverse = scenes.load("dipole").body.inverse
    expected = [[Rational(101, 100), 0, 0], [0, 1, 0], [0, 0, Rational(1, 100)]]
    assert inverse == tuple(
        tuple(Number.rational(int(Rational(x).p), int(Rational(x).q)) for x in row) for row in expected
    )


def test_small_energies_are_compared_too():
    """The energy of the free rigid body is below 1 at some points of the comparison."""
    body = scenes.load("free_rigid_body_attitude").body
    read = {n.payload for n in walk([*body.velocity, *body.force]) if n.op == "sym"}
    assert read == {"mu0", "mu1", "mu2"}
    assert body.inverse[0][0] == Number.rational(3, 5)


def test_a_field_without_hamiltonian_is_carried_to_the_body_frame():
    """The torques of the actuated body act in the body, so the field in the body does not depend on q."""
    scene = scenes.load("actuated_rigid_body")
    q, mu = (block.symbols for block in scene.state)
    velocity, force = field_in_body(scene.group, q, mu, scene.open_roots)
    read = {n.payload for n in walk([*velocity, *force]) if n.op == "sym"}
    assert read == {"mu0", "mu1", "mu2", "u0", "u1", "u2"}


def test_an_inertia_fixed_in_space_is_no_constant_in_the_body():
    assert scenes.load("heavy_top").body.inverse is None


def test_a_group_without_relations_has_no_body_frame():
    assert hamiltonian_scene("GL(2)").body is None


def test_a_kinetic_energy_with_a_potential_singular_at_the_neutral_element_is_still_read():
    scene = scenes.load("dipole")
    q, mu = (block.symbols for block in scene.state)
    space = scene.hamiltonian.space
    singular = scene.hamiltonian + space.one / (space.sym("g22") - 1)
    made = body_field(scene.group, q, mu, singular)
    assert len(made.velocity) == 3


@pytest.mark.parametrize(
    "term",
    [lambda q, P: q * P[0] * P[1] / 10**35, lambda q, P: Max(q * P[0] - 10, 0) ** 2],
    ids=["small units", "zero at the sample points"],
)
def test_a_kinetic_energy_that_depends_on_the_position_is_not_split_off(term):
    G = SO3()
    q, mu = G.point("q"), G.dual("mu")
    P = q.T * mu
    H = P.dot(diag(1, 2, 3) * P) / 10**35 + term(q[0, 0], P)
    scene = HamiltonianScene(group=G, q=q, mu=mu, H=H, q0=eye(3), mu0=[1, 2, 3], span=(0, 1))
    assert "q00" in {str(node.payload) for node in walk(scene.body.velocity) if node.op == "sym"}
