"""Duffing's equation in three frames: the published errors, the closed form, the orders."""

from __future__ import annotations

import math
from fractions import Fraction

import mpmath
import pytest

from codegen.certify import certified_order
from codegen.emitter import compile_method, emit
from codegen.groups import SL2
from codegen.ir.domain import FloatDomain, PreciseDomain, SeriesDomain
from codegen.lab.orders.convergence import converge
from codegen.lab.reference import reference
from codegen.lab.runner import Emitted
from codegen.loader import load as load_module
from codegen.run.floats import EmittedFloats
from codegen.scenes import load
from codegen.snippets.graph import needed
from orderconds.ring import QQ

FRAMES = {"duffing": 9.2008e-2, "duffing_sl2": 1.0708e-2, "duffing_se2": 1.6325e-2}
"""Errors of Lie-Euler with 50 steps to t = 2."""


def closed_form(t):
    """x = A cn(w t + u, k): A^2 from the energy, w^2 = 1 + A^2, k^2 = A^2/(2 w^2), by Jacobi's functions."""
    with mpmath.workdps(40):
        start = mpmath.mpf(3) / 4
        energy = start**2 / 2 + start**2 / 2 + start**4 / 4
        amplitude = mpmath.sqrt(mpmath.sqrt(1 + 4 * energy) - 1)
        w = mpmath.sqrt(1 + amplitude**2)
        m = amplitude**2 / (2 * w**2)
        shift = mpmath.ellipf(mpmath.acos(start / amplitude), m)  # at t = 0 the velocity is positive
        u = w * t - shift
        cn, sn, dn = (mpmath.ellipfun(name, u, m=m) for name in ("cn", "sn", "dn"))
        return amplitude * cn, -amplitude * w * sn * dn


@pytest.mark.parametrize("name", FRAMES)
def test_every_frame_has_the_solution_in_jacobis_functions(name):
    pairs = zip(reference(load(name)).state, closed_form(2), strict=True)
    assert max(abs(x - y) for x, y in pairs) < 1e-28


@pytest.mark.parametrize("target", ["c", "python"])
@pytest.mark.parametrize("name", FRAMES)
def test_lie_euler_has_the_published_error(name, target):
    emission = emit(name, "rkmk(0):euler", target)
    found = load_module(emission).run(emission.manifest["initial"], 0.04, 50)
    error = math.dist(found, map(float, closed_form(2)))
    assert error == pytest.approx(FRAMES[name], rel=1e-4)


@pytest.mark.parametrize(("method", "order"), [("rkmk:rk4", 4), ("cg:cg3", 3), ("rkmk(2):gauss2", 4)])
@pytest.mark.parametrize("name", FRAMES)
def test_the_stated_order_is_observed(name, method, order):
    made = compile_method(name, method)
    stated = certified_order(made.method, made.scene)
    assert stated.order == order
    found = converge(Emitted(made, "c", stated), stated, reference(load(name)))
    assert found.verdict == "holds", found.sentence()


def test_the_exponential_of_a_traceless_matrix_has_determinant_one():
    """Elliptic, hyperbolic, of determinant zero."""
    d, group = FloatDomain(0.0), SL2()
    for x in ([1.0, -1.5625, 0.0], [1.0, 2.0, 0.25], [3.0, -3.0, 3.0], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0]):
        a, b, c, e = group.exp(d, tuple(x))
        assert a * e - b * c == pytest.approx(1, abs=1e-14)


@pytest.fixture(scope="module")
def emitted_functions():
    names = [*(f"signed_stumpff{k}" for k in range(4)), *(f"signed_slope{k}" for k in (1, 2, 3))]
    found = needed("python", names)
    space = {name: getattr(math, name) for name in found.library}
    exec("\n\n".join(found.texts), space)
    return {name: space[name] for name in names}


SIGNED = [-700.0, -9.5, math.nextafter(-4, -5), -4.0, -1.0, -0.01, -1e-12, -5e-324, 0.0, 1e-9, 0.8, 30.0]


@pytest.mark.parametrize("z", SIGNED)
def test_stumpff_functions_continue_to_negative_arguments(z, emitted_functions):
    exact = PreciseDomain(Fraction(1), 40)
    for k in range(4):
        expected = exact.call(f"signed_stumpff{k}", exact.context.mpf(z))
        close = float(4 * math.ulp(float(expected)) + abs(expected) * abs(z) ** 0.5 * 2.0**-52)
        assert FloatDomain(0.0).call(f"signed_stumpff{k}", z) == pytest.approx(float(expected), abs=close)
        value = emitted_functions[f"signed_stumpff{k}"](z)
        assert value == pytest.approx(float(expected), abs=close)
        assert EmittedFloats().call(f"signed_stumpff{k}", z) == value


@pytest.mark.parametrize("z", [*SIGNED, math.nextafter(-1, -2), math.nextafter(1, 2)])
@pytest.mark.parametrize("k", [1, 2, 3])
def test_the_derivatives_of_stumpff_functions_continue_to_negative_arguments(z, k, emitted_functions):
    exact, name = PreciseDomain(Fraction(1), 40), f"signed_slope{k}"
    expected = exact.call(name, exact.context.mpf(z))
    before = exact.call(f"signed_stumpff{k - 1}", exact.context.mpf(z))
    close = 8 * 2.0**-53 * float(abs(expected) + abs(before) * (1 + abs(z) ** 0.5) / max(1, abs(z)))
    assert FloatDomain(0.0).call(name, z) == pytest.approx(float(expected), abs=close)
    value = emitted_functions[name](z)
    assert value == pytest.approx(float(expected), abs=close)
    assert EmittedFloats().call(name, z) == value


def test_over_power_series_both_signs_are_one_function():
    d = SeriesDomain(QQ, 4)
    z = -(d.h * d.h) * 3
    text = d.ring.text
    assert text(d.call("signed_stumpff0", z)) == "1 + 3/2*h^2 + 3/8*h^4"
    assert text(d.call("signed_stumpff1", z)) == "1 + 1/2*h^2 + 3/40*h^4"
