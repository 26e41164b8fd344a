"""The laws of matrix groups without closed forms: in doubles, in 40 digits, and exactly over Q[[h]]."""

from __future__ import annotations

from math import factorial, isqrt

import pytest

from codegen.groups import GL, SL, SO, SU, Affine, Heisenberg, Rotation, Sp, Unitary, Unitriangular
from codegen.groups.capabilities import Projection
from codegen.groups.linear_algebra import matmul
from tests.codegen.groups.test_laws import (
    at_order,
    constants,
    ddh,
    dexp,
    minus,
    pairing,
    plus,
    power_sum,
    scaled,
    shortened,
)
from tests.strategies import Sampler, sampler

DOUBLES, DIGITS, EXACT = "doubles, uniform", "40 digits, uniform", "exact, series"
SMALL = (SO(2), SO(4), Unitary(1), SU(2), Sp(2), GL(3), SL(2), Affine(1), Heisenberg(1), Unitriangular(4))
LARGE = (SO(5), Unitary(2), SU(3), Sp(4), SL(3), Affine(2), Heisenberg(2), Unitriangular(5))

CASES = [
    pytest.param((group, sample), id=f"{group.name}-{sample}")
    for group in SMALL
    for sample in (DOUBLES, DIGITS, EXACT)
]
CASES += [
    pytest.param((group, sample), id=f"{group.name}-{sample}", marks=pytest.mark.slow)
    for group in LARGE
    for sample in (DOUBLES, DIGITS, EXACT)
]
each_group = pytest.mark.parametrize("s", CASES, indirect=True)
exactly = pytest.mark.parametrize("s", [c for c in CASES if c.values[0][1] == EXACT], indirect=True)


@pytest.fixture
def s(request):
    group, sample = request.param
    return Near(**vars(sampler(group, sample)))


class Near(Sampler):
    """Samples near the identity, where the adjoint action of a non-compact group is well-conditioned."""

    def vector(self):
        """Return an element of the algebra."""
        return tuple(self.domain.rational(1, 4) * x for x in super().vector())


def vanish(s, values):
    return s.equal(values, tuple(x * 0 for x in values))


@each_group
def test_exp_is_a_one_parameter_subgroup(s):
    d, x, group = s.domain, s.vector(), s.group
    parts = group.mul(d, group.exp(d, scaled(d, 1, 3, x)), group.exp(d, scaled(d, 2, 3, x)))
    assert s.equal(parts, group.exp(d, x))
    g = group.exp(d, x)
    assert s.equal(group.inverse(d, g), group.exp(d, minus(x)))
    assert s.equal(group.mul(d, g, group.inverse(d, g)), group.identity(d))


@each_group
def test_the_equations_of_the_group_hold_on_it(s):
    laws = s.group.laws(s.domain, s.element())
    if isinstance(s.group, GL):
        assert laws == ()  # every invertible matrix is an element
        return
    assert vanish(s, tuple(x for _, x in laws))
    off = tuple(x + s.domain.rational(1, 7) for x in s.group.identity(s.domain))
    assert not vanish(s, tuple(x for _, x in s.group.laws(s.domain, off)))


@each_group
def test_the_bracket_is_the_commutator_of_the_matrices(s):
    d, x, y = s.domain, s.vector(), s.vector()
    n = isqrt(s.group.size)
    a, b = s.group.hat(d, x), s.group.hat(d, y)
    expected = plus(matmul(a, b, n), minus(matmul(b, a, n)))
    assert s.equal(s.group.hat(d, s.group.ad(d, x, y)), expected)
    assert s.equal(s.group.vee(d, a), x)
    assert s.equal(s.group.dual_vee(d, s.group.dual_hat(d, x)), x)


@each_group
def test_the_adjoint_action_is_conjugation(s):
    d, g, x, group = s.domain, s.element(), s.vector(), s.group
    left = group.mul(d, group.velocity(d, group.Ad(d, g, x), group.identity(d)), g)
    assert s.equal(left, group.mul(d, g, group.hat(d, x)))
    y = s.vector()
    terms = [d.rational(1, factorial(k)) for k in range(80)]
    expected = power_sum(d, terms, lambda v: group.ad(d, x, v), y)
    assert s.equal(group.Ad(d, group.exp(d, x), y), expected)


@each_group
def test_the_coadjoint_action_is_its_dual(s):
    d, g, x, mu, group = s.domain, s.element(), s.vector(), s.covector(), s.group
    assert s.equal(pairing(group.Adt(d, g, mu), x), pairing(mu, group.Ad(d, g, x)))
    assert s.equal(group.Adtinv(d, g, group.Adt(d, g, mu)), mu)
    y = s.vector()
    assert s.equal(pairing(group.adt(d, x, mu), y), pairing(mu, group.ad(d, x, y)))


@each_group
def test_dexp_star_is_the_dual_of_dexp(s):
    d, x, y, mu = s.domain, s.vector(), s.vector(), s.covector()
    assert s.equal(pairing(s.group.dexpt(d, x, mu), y), pairing(mu, dexp(s, x, y)))


@each_group
def test_the_transported_momentum_is_the_sum_of_its_parts(s):
    d, x, n, mu, group = s.domain, s.vector(), s.covector(), s.covector(), s.group
    expected = plus(group.Adtinv(d, group.exp(d, x), mu), group.dexpt(d, minus(x), n))
    assert s.equal(group.transport(d, x, n, mu), expected)


@each_group
def test_the_rate_of_the_velocity_of_x_is_x(s):
    d, x, g = s.domain, s.vector(), s.element()
    assert s.equal(s.group.rate(d, s.group.velocity(d, x, g), g), x)


@exactly
def test_velocity_is_the_derivative_of_exp(s):
    d, x = s.domain, constants(s, s.group.dim)
    path = s.group.exp(d, tuple(d.h * a for a in x))
    assert s.equal(ddh(s, path), shortened(s, s.group.velocity(d, x, path)))
    assert at_order(path, 0) == at_order(s.group.identity(d), 0)


@exactly
def test_dexp_is_the_differential_of_exp(s):
    d, x = s.domain, s.vector()
    path = s.group.exp(d, x)
    expected = s.group.velocity(d, dexp(s, x, ddh(s, x)), path)
    assert s.equal(shortened(s, ddh(s, path)), shortened(s, expected))


@pytest.mark.parametrize("group", [g for g in (*SMALL, *LARGE) if g.offers(Projection)], ids=lambda g: g.name)
def test_a_projection_leaves_a_quadratic_error(group):
    s = sampler(group, DOUBLES)
    d, g = s.domain, s.element()
    sizes = []
    for eps in (1e-3, 1e-5):
        off = tuple(x + eps * s.scalar() for x in g)
        laws = [x for name, x in group.laws(d, group.project(d, off)) if name.startswith("g^T")]
        sizes.append(max(map(abs, laws)))
    assert sizes[0] < 1e-3
    assert sizes[1] < 1e-7
    assert s.equal(group.project(d, g), g)


@pytest.mark.parametrize(
    ("group", "dim", "rows"),
    [
        (SO(10), 45, 10),
        (Unitary(3), 9, 6),
        (SU(4), 15, 8),
        (Sp(6), 21, 6),
        (SL(4), 15, 4),
        (Affine(3), 12, 4),
        (Heisenberg(3), 7, 5),
        (Unitriangular(5), 10, 5),
    ],
    ids=lambda x: getattr(x, "name", str(x)),
)
def test_the_dimension_is_that_of_the_group(group, dim, rows):
    assert (group.dim, group.size) == (dim, rows**2)


def test_the_symbols_of_the_entries_differ():
    for group in (SO(10), SO(12)):
        assert len(set(group.symbols("q"))) == group.size


@pytest.mark.parametrize("group", [SO(4), SO(5), SU(2)], ids=lambda g: g.name)
def test_a_rotation_preserves_the_length_of_a_point(group):
    s = sampler(group, DIGITS)
    d, y = s.domain, tuple(s.scalar() for _ in range(group.n))
    moved = Rotation().actexp(d, group, s.vector(), y)
    assert s.equal(pairing(moved, moved), pairing(y, y))
    drifted = tuple(x * (1 + d.rational(1, 10**8)) for x in y)
    back = Rotation().to_orbit(d, group, drifted, y)
    assert abs(pairing(back, back)[0] - pairing(y, y)[0]) < 1e-20
