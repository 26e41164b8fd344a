"""The time and its momentum as coordinates: carried where that is asked for, and nowhere else."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from sympy import Matrix, Rational, Symbol, cos, eye

from codegen.certify import certified_order
from codegen.emitter import compile_method, emit
from codegen.errors import SceneError
from codegen.groups import SO3
from codegen.ir.domain import FloatDomain, PreciseDomain
from codegen.ir.expr import evaluate
from codegen.lab.orders.convergence import converge
from codegen.lab.reference import reference
from codegen.lab.runner import Emitted
from codegen.loader import load
from codegen.scene import HamiltonianScene
from codegen.scene.extended_phase_space import extended
from codegen.scenes import about
from codegen.scenes import load as scene
from orderconds.errors import UnknownName

EPS, ALPHA, H = 0.1, 0.123, 0.3


def driven_top():
    """A top in a field that turns, with coordinates called tau and u."""
    G = SO3()
    g, mu = G.point("tau"), G.dual("u")
    H = mu.dot(mu) / 2 + cos(Symbol("t")) * g[2, 2] + g[0, 1] * mu[2]
    start = {"q0": eye(3), "mu0": Matrix([1, Rational(1, 2), 0])}
    return HamiltonianScene(group=G, q=g, mu=mu, H=H, **start, span=(Rational(1, 3), 2), name="driven")


def energy(z):
    """H of the oscillator at (q, tau, p, u), without u."""
    stiffness = 1 + EPS * math.sin(ALPHA * z[4])
    return (stiffness * sum(a * a for a in z[:4]) + sum(a * a for a in z[5:9])) / 2


def test_u_starts_at_minus_the_energy_and_the_time_at_the_beginning():
    d = FloatDomain(0.0)
    start = scene("linear_oscillator+u").initial(d)
    assert start == (1, 2, 3, 4, 0, 4, 1, 2, 3, -30)
    made = extended(driven_top())
    found = dict(zip(made.symbols, made.initial(d), strict=True))
    assert found["tau"] == 1 / 3
    assert found["u"] == pytest.approx(-(0.625 + math.cos(1 / 3)), rel=1e-15)


def test_names_that_the_scene_has_are_left_to_it():
    plain = extended(driven_top())
    assert (plain.state[0].symbols[-1], plain.state[1].symbols[-1]) == ("tau", "u")
    G = SO3()
    g, mu = G.point("g"), Matrix([Symbol(s, real=True) for s in ("tau", "u", "w")])
    H = mu.dot(mu) / 2 + Symbol("t") * g[0, 0]
    made = extended(HamiltonianScene(group=G, q=g, mu=mu, H=H, q0=eye(3), mu0=[1, 0, 0], span=(0, 1)))
    assert (made.state[0].symbols[-1], made.state[1].symbols[-1]) == ("tau_", "u_")


def test_the_extended_field_is_that_of_the_scene_and_minus_the_rate_of_h():
    """Along the flow u' = -dH/dt at fixed state, tau' = 1, and the rest as before."""
    d = PreciseDomain(0, 40)
    base = driven_top()
    made = extended(base)
    t, y = d.rational(7, 5), base.initial(d)
    inside = (*y[:9], t, *y[9:], d.rational(0))
    moved = made.velocity(d, inside)
    rest = base.velocity(d, y, t)
    assert (*moved[:9], *moved[10:13]) == pytest.approx(rest, abs=1e-38)
    assert moved[9] == 1
    assert abs(moved[13] - d.call("sin", t) * y[8]) < 1e-38


def test_without_a_request_there_is_no_u():
    emission = emit("linear_oscillator", "vcg:midpoint", "c")
    assert emission.manifest["interface"]["size"] == 8
    assert all("cos" not in text for text in emission.files.values())
    asked = emit("linear_oscillator+u", "vcg:midpoint", "c")
    assert asked.manifest["interface"]["size"] == 10
    assert not asked.manifest["interface"]["time"]
    assert asked.manifest["command"].startswith("orderconds emit linear_oscillator+u ")


def test_u_is_carried_by_the_sum_of_the_stages():
    """Example 4.4.5 for the midpoint: u1 = u0 - h dH/dt at the stage; q and p are as without u."""
    asked, plain = (emit(name, "vcg:midpoint", "c") for name in ("linear_oscillator+u", "linear_oscillator"))
    start = asked.manifest["initial"]
    z = load(asked).step(start, H)
    y = load(plain).step(plain.manifest["initial"], H)
    assert [*z[:4], *z[5:9]] == pytest.approx(y, abs=1e-14)
    middle = [(a + b) / 2 for a, b in zip(start[:4], z[:4], strict=True)]
    rate = EPS * ALPHA * math.cos(ALPHA * H / 2) * sum(a * a for a in middle) / 2
    assert z[9] == pytest.approx(start[9] - H * rate, abs=1e-13)
    assert z[4] == H


@pytest.mark.parametrize(
    ("method", "close"),
    [("discrete_gradient:midpoint", 3e-11), ("splitting:blanes_moan4", 1e-4), ("vrkmk(2):gauss2", 2e-4)],
)
def test_h_plus_u_is_kept_by_discrete_gradients_and_nearly_by_symplectic_methods(method, close):
    emission = emit("linear_oscillator+u", method, "c")
    rows = load(emission).trajectory(emission.manifest["initial"], H, 20_000, 10)
    assert max(abs(energy(z) + z[9]) for z in rows) < close
    assert max(abs(energy(z) - 30) for z in rows) > 1


@pytest.mark.parametrize(("method", "order"), [("vcg:midpoint", 2), ("rkmk:rk4", 4)])
def test_the_order_is_that_of_the_method(method, order):
    made = compile_method(extended(driven_top()), method)
    stated = certified_order(made.method, made.scene)
    found = converge(Emitted(made, "c", stated), stated, reference(made.scene))
    assert (stated.order, found.verdict) == (order, "holds"), found.sentence()


def test_a_part_without_time_takes_u():
    made = scene("linear_oscillator+u")
    d = FloatDomain(0.0)
    T, V = (evaluate([made.parts[k]], d, made.values(d, [0.5] * 10))[0] for k in ("T", "V"))
    assert T == 0.5 + 0.5
    assert pytest.approx((1 + EPS * math.sin(ALPHA / 2)) / 2) == V


@pytest.mark.parametrize(
    ("name", "why"),
    [
        (
            "driven_spin+u",
            "driven_spin cannot be extended by a momentum u conjugate to the time; expected a Hamiltonian",
        ),
        ("dipole+u", "the Hamiltonian of dipole does not depend on time"),
    ],
)
def test_what_has_no_u_is_refused(name, why):
    with pytest.raises(SceneError, match=why):
        scene(name)


def test_an_extended_scene_is_described_as_the_scene_is():
    assert about("linear_oscillator+u") == about("linear_oscillator") != ""


def test_an_unknown_scene_is_named_without_the_request():
    with pytest.raises(UnknownName, match="unknown scene 'nowhere'"):
        scene("nowhere+u")


def test_a_beginning_that_is_not_zero_is_the_first_time():
    made = extended(driven_top())
    assert made.span == (Fraction(1, 3), 2)
    assert made.autonomous
