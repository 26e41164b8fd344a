"""The laws of groups at 1e-300, and at angles within 1e-9 of half a turn and of a turn.

The laws hold with 60 digits at these samples. In doubles each operation has the value with 60 digits up to
rounding errors, so the laws hold in doubles as well.
"""

from __future__ import annotations

import math
import random
from fractions import Fraction
from functools import cache
from math import factorial

import numpy as np
import pytest

from codegen.groups import GL, SE2, SE3, SE23, SL2, SO, SO2, SO3, SU, SU2, Affine, Heisenberg, Sp
from codegen.ir.domain import FloatDomain, PreciseDomain
from tests.codegen.groups import test_closed_forms as closed_forms
from tests.codegen.groups.test_laws import minus, pairing, plus, power_sum, scaled
from tests.strategies import inverse

SHARP, DOUBLES = PreciseDomain(Fraction(1), 60), FloatDomain(1.0)
LAW = 1e-48
"""The largest error of a law with 60 digits, relative to the largest value."""

UNITS = 16
"""The largest error of an operation in doubles: units in the last place of the largest value, times 1 + the
angle."""

CLOSED = {
    "SO(2)": SO2(),
    "SO(3)": SO3(),
    "SE(2)": SE2(),
    "SE(3)": SE3(),
    "SE_2(3)": SE23(),
    "SU(2)": SU2(),
}
"""Groups whose coordinates begin with those of a rotation."""

MATRICES = {
    "SL(2)": SL2(),
    "SO(4)": SO(4),
    "SO(5)": SO(5),
    "SU(3)": SU(3),
    "Sp(4)": Sp(4),
    "GL(3)": GL(3),
    "affine": Affine(2),
}
NILPOTENT = {"Heisenberg": Heisenberg(1)}
GROUPS = CLOSED | MATRICES | NILPOTENT

ANGLES = tuple(turn + away for turn in (math.pi, 2 * math.pi) for away in (-1e-9, 0.0, 1e-9))
SIZES = (1e-300, *ANGLES)
QUICK = {("SO(2)", 1e-300), ("SU(2)", ANGLES[0]), ("SO(2)", ANGLES[-1]), ("Heisenberg", 1e-300)}
CASES = [
    pytest.param(name, size, id=f"{name}-{size}", marks=() if (name, size) in QUICK else pytest.mark.slow)
    for name in GROUPS
    for size in SIZES
]
each_sample = pytest.mark.parametrize(("name", "size"), CASES)


def of_size(name, size):
    """An element of the algebra whose exponential turns by the angle ``size``, in doubles."""
    group, rng = GROUPS[name], random.Random(name)
    if name in CLOSED:
        return tuple(closed_forms.point(group, size)[0])
    x = tuple(rng.uniform(-1, 1) for _ in range(group.dim))
    if name in MATRICES:
        # Skew matrices generate rotations. The translations of the affine group remain.
        n = math.isqrt(group.size)
        a = np.array(group.hat(DOUBLES, x)).reshape(n, n)
        x = group.vee(DOUBLES, tuple((a - a.T).ravel().tolist()))
        x = tuple(c / angle(group, x) for c in x)
    return tuple(size * c for c in x)


def angle(group, x):
    """The largest angle of the rotation exp(x): the largest imaginary part of an eigenvalue."""
    n = math.isqrt(group.size)
    a = np.array([float(c) for c in group.hat(DOUBLES, x)]).reshape(n, n)
    return float(np.abs(np.linalg.eigvals(a).imag).max())


@cache
def sample(name, size):
    """The element, two further elements of the algebra, two of the dual, and one of the group, in doubles."""
    group, rng = GROUPS[name], random.Random(f"{name} {size}")
    others = [tuple(rng.uniform(-1, 1) for _ in range(group.dim)) for _ in range(4)]
    g = group.exp(DOUBLES, tuple(c / 2 for c in others[0]))
    return of_size(name, size), *others, g


def sharp(values):
    return tuple(SHARP.context.mpf(v) for v in values)


def series(group, x, y, shift):
    """The sum of ad_x^k y/(k + shift)!."""
    weights = [SHARP.rational(1, factorial(k + shift)) for k in range(110)]
    return power_sum(SHARP, weights, lambda v: group.ad(SHARP, x, v), y)


def near(found, expected):
    scale = max(1, *map(abs, found), *map(abs, expected))
    return all(abs(a - b) <= LAW * scale for a, b in zip(found, expected, strict=True))


def test_the_angles_of_the_samples():
    for name in MATRICES:
        for size in ANGLES:
            assert abs(angle(GROUPS[name], of_size(name, size)) - size) < 1e-12


@each_sample
def test_exp_is_a_one_parameter_subgroup(name, size):
    group, d = GROUPS[name], SHARP
    x = sharp(sample(name, size)[0])
    whole, e = group.exp(d, x), group.identity(d)
    parts = [group.exp(d, scaled(d, k, 3, x)) for k in (1, 2)]
    assert near(group.mul(d, *parts), whole)
    assert near(group.mul(d, whole, group.exp(d, minus(x))), e)
    assert near(inverse(group, d, whole), group.exp(d, minus(x)))
    # Every invertible matrix is an element of GL(n), so the list of equations is empty there.
    assert all(near((a,), (a * 0,)) for _, a in group.laws(d, whole))


@each_sample
def test_the_adjoint_action_of_an_exponential_is_a_series_and_has_its_dual(name, size):
    group, d = GROUPS[name], SHARP
    x, y, _, mu, _, _ = map(sharp, sample(name, size))
    g = group.exp(d, x)
    assert near(group.Ad(d, g, y), series(group, x, y, 0))
    assert near(pairing(group.Adt(d, g, mu), y), pairing(mu, group.Ad(d, g, y)))
    assert near(group.Adtinv(d, g, group.Adt(d, g, mu)), mu)
    assert near(pairing(group.adt(d, x, mu), y), pairing(mu, group.ad(d, x, y)))


@each_sample
def test_dexp_star_is_the_dual_of_the_series_of_dexp(name, size):
    group, d = GROUPS[name], SHARP
    x, y, _, mu, nu, _ = map(sharp, sample(name, size))
    assert near(pairing(group.dexpt(d, x, mu), y), pairing(mu, series(group, x, y, 1)))
    moved = group.Adtinv(d, group.exp(d, x), mu)
    assert near(group.dexpt(d, x, moved), group.dexpt(d, minus(x), mu))
    assert near(group.transport(d, x, nu, mu), plus(moved, group.dexpt(d, minus(x), nu)))


@each_sample
def test_the_inverse_of_dexp_after_some_brackets_has_its_dual(name, size):
    group, d = GROUPS[name], SHARP
    x, y, _, mu, _, _ = map(sharp, sample(name, size))
    for order in range(5):
        left = pairing(group.dexpinvt(d, x, mu, order), y)
        assert near(left, pairing(mu, group.dexpinv(d, x, y, order)))


def operations(group, d, x, y, z, mu, nu, g):
    """Yield the results of all operations, by name."""
    e = group.exp(d, x)
    yield "exp", e
    yield "mul", group.mul(d, e, g)
    yield "expmul", group.expmul(d, x, g)
    yield "velocity", group.velocity(d, x, g)
    yield "ad", group.ad(d, x, y)
    yield "dexpinv", group.dexpinv(d, x, z, 4)
    yield "Ad", group.Ad(d, e, y)
    yield "Adt", group.Adt(d, e, mu)
    yield "Adtinv", group.Adtinv(d, e, mu)
    yield "adt", group.adt(d, x, mu)
    yield "dexpt", group.dexpt(d, x, mu)
    yield "transport", group.transport(d, x, nu, mu)


@each_sample
def test_operations_in_doubles_have_the_values_with_60_digits(name, size):
    group, given = GROUPS[name], sample(name, size)
    expected = dict(operations(group, SHARP, *map(sharp, given)))
    for operation, found in operations(group, DOUBLES, *given):
        values = expected[operation]
        # At a turn some directions are in the kernel of dexp*, so the result can be much smaller than mu.
        scale = max(map(abs, (*values, *(given[3] if operation == "dexpt" else ()))))
        allowed = UNITS * 2.0**-52 * (1 + size) * scale
        gap = max(abs(a - b) for a, b in zip(found, values, strict=True))
        assert gap <= allowed, (operation, float(gap / (2.0**-52 * (1 + size) * scale)))


@pytest.mark.parametrize("name", GROUPS)
def test_the_smallest_elements_do_not_vanish_in_exp(name):
    group = GROUPS[name]
    x = of_size(name, 1e-300)
    e = group.identity(DOUBLES)
    moved, linear = group.exp(DOUBLES, x), group.velocity(DOUBLES, x, e)
    compared = [(a, b) for a, b, c in zip(moved, linear, e, strict=True) if not c]
    assert any(b for _, b in compared)
    assert all(abs(a - b) <= 1e-13 * abs(b) for a, b in compared)
