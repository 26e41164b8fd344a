"""SLGI: the theta-method as printed, VRKMK(0) for any tableau, and the energies of thesis Table 2.1."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from codegen.certify import certified_order
from codegen.emitter import compile_method, emit
from codegen.groups import SO3
from codegen.ir.domain import PreciseDomain, SeriesDomain
from codegen.ir.interpret import interpret
from codegen.loader import load
from codegen.method import Method
from codegen.passes import optimise
from orderconds.errors import ZeroWeight
from orderconds.ring import QQ
from tests.strategies import butcher, full, hamiltonian_scene, lowered, shipped, starting

D = PreciseDomain(Fraction(1, 64), 40)
G = SO3()


def scaled(c, x):
    return tuple(c * a for a in x)


def added(x, y):
    return tuple(a + b for a, b in zip(x, y, strict=True))


def theta_step(scene, theta, q, mu):
    """One step as printed on page 55, where f carries h.

    The printed update is the product (exp xi, Ad*_{exp(-(1 - theta) xi)} n).(g0, mu0) of G x g*.
    """
    xi, n = (0,) * 3, (0,) * 3
    for _ in range(80):
        Q = G.mul(D, G.exp(D, scaled(theta, xi)), q)
        free = G.dexpt(D, scaled(-1, xi), mu)
        forced = scaled(1 - theta, G.dexpt(D, scaled(theta - 1, xi), n))
        f = scene.apply(D, "hamilton", None, (Q, added(free, forced)))
        xi, n = (scaled(D.h, x) for x in f)
    g = G.exp(D, xi)
    moved = G.Adt(D, G.exp(D, scaled(theta - 1, xi)), n)
    return G.mul(D, g, q), added(moved, G.Adtinv(D, g, mu))


@pytest.mark.parametrize("theta", [0, Fraction(1, 3), Fraction(1, 2), 1])
@pytest.mark.parametrize("optimised", [False, True])
def test_one_stage_is_the_theta_method_as_printed(theta, optimised):
    scene = hamiltonian_scene("SO(3)")
    view, program = lowered("slgi", butcher("theta", [[theta]], [1]), scene)
    if optimised:
        program, _ = optimise(program, view)
    inputs = starting(view, D)
    found = interpret(program, view, D, inputs)
    number = D.rational(*Fraction(theta).as_integer_ratio())
    q, mu = theta_step(view, number, inputs["q"], inputs["mu"])
    pairs = zip((*found["q"], *found["mu"]), (*q, *mu), strict=True)
    assert max(abs(x - y) for x, y in pairs) < 1e-36


@pytest.mark.parametrize("group", ["SO(3)", "GL(2)", "S^3", "SE(2)", "SO(3) x R^2"])
@pytest.mark.parametrize("tableau", ["midpoint", "kutta3", full(2), butcher("theta", [["1/3"]], ["2"])])
def test_it_is_vrkmk_without_brackets(tableau, group):
    """Exactly, over power series in h; also for a weight that is not one."""
    scene, d = hamiltonian_scene(group), SeriesDomain(QQ, 3)
    ends = []
    for family, cutoff in (("slgi", None), ("vrkmk", 0)):
        view, program = lowered(family, tableau, scene, cutoff)
        ends.append(interpret(program, view, d, starting(view, d)))
    for name in ("q", "mu"):
        pairs = zip(*(end[name] for end in ends), strict=True)
        assert all(d.ring.is_zero(x - y) is True for x, y in pairs)


@pytest.mark.parametrize(("name", "order"), [("euler", 1), ("midpoint", 2), ("radau2a1", 1), ("gauss2", 2)])
def test_its_order_is_two_at_most(name, order):
    assert certified_order(Method("slgi", shipped(name))).order == order


def test_a_weight_that_is_zero_is_refused():
    with pytest.raises(ZeroWeight, match=r"slgi:.*b_1 = 0"):
        lowered("slgi", butcher("zero", [[0, 0], [1, 0]], [0, 1]), hamiltonian_scene("SO(3)"))


@pytest.mark.parametrize(("tableau", "count"), [("euler", 1), ("midpoint", 2), ("radau2a1", 1)])
def test_the_theta_method_needs_one_dexp_for_mu_and_one_for_n_where_they_differ(tableau, count):
    assert compile_method("heavy_top", f"slgi:{tableau}").program.counts()["dexp*"] == count


SYMMETRIC = {"rkmk(0):euler": False, "rkmk(0):midpoint": True, "slgi:euler": False, "slgi:midpoint": True}
"""Thesis Table 2.1: which theta-methods are symmetric; only those of SLGI are symplectic (test_structure)."""


@pytest.mark.parametrize("method", SYMMETRIC)
def test_table_2_1_says_which_are_symmetric(method):
    emission = emit("heavy_top", method, "c")
    integrator, start = load(emission), np.array(emission.manifest["initial"])
    back = np.array(integrator.step(integrator.step(list(start), 0.01), -0.01))
    defect = np.abs(back - start).max() / np.abs(start).max()
    assert (defect < 1e-14) == SYMMETRIC[method]
    assert SYMMETRIC[method] or defect > 1e-9


def energies(method, h, steps):
    """The relative error of the energy every hundredth step."""
    emission = emit("heavy_top", method, "c")
    rows = np.array(load(emission).trajectory(emission.manifest["initial"], h, steps, 100))
    energy = (rows[:, 9:] ** 2 / np.array([1e3, 5e3, 6e3])).sum(axis=1) / 2 + rows[:, 8]
    return energy / energy[0] - 1


def test_the_explicit_munthe_kaas_method_drifts_to_four_times_the_energy():
    """Table 2.1, RKMK with theta = 0: h = 0.05, 1e5 steps."""
    found = energies("rkmk(0):euler", 0.05, 100_000)
    assert found[-1] == pytest.approx(4.2, abs=0.05)


@pytest.mark.parametrize("method", ["slgi:euler", "slgi:midpoint", "slgi:radau2a1", "rkmk(0):midpoint"])
def test_the_others_do_not_drift(method):
    """Table 2.1, h = 0.05, 1e5 steps: the errors of the second half of the run are those of the first."""
    first, second = np.split(np.abs(energies(method, 0.05, 100_000)[1:]), 2)
    assert second.max() < 1.1 * first.max() < 0.03
