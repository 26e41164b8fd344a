"""The laws of Lie groups, one class a law: in doubles, in 40 digits, and exactly over Q[[h]]."""

from __future__ import annotations

from math import factorial

import pytest

from codegen.groups.capabilities import RightTrivialisation
from tests.strategies import ALL_GROUPS, BASE_GROUPS, ORDER, SAMPLES, inverse, sampler

EXACT = "exact, series"


def cases(groups, samples=SAMPLES):
    """Every group with every sample; half a turn is an angle, so it is drawn where there is one."""
    return [
        pytest.param((name, sample), id=f"{name}-{sample}")
        for name in groups
        for sample in samples
        if "turn" not in sample or "SO(3)" in name
    ]


each_group = pytest.mark.parametrize("s", cases(ALL_GROUPS), indirect=True)
each_base = pytest.mark.parametrize("s", cases(BASE_GROUPS), indirect=True)
exactly = pytest.mark.parametrize("s", cases(ALL_GROUPS, (EXACT,)), indirect=True)
exactly_base = pytest.mark.parametrize("s", cases(BASE_GROUPS, (EXACT,)), indirect=True)


@pytest.fixture
def s(request):
    """A sampler of its own for each test, so that what a test draws depends on nothing else."""
    name, sample = request.param
    return sampler(ALL_GROUPS[name], sample)


def minus(x):
    return tuple(-a for a in x)


def plus(*vectors):
    return tuple(sum(entries[1:], entries[0]) for entries in zip(*vectors, strict=True))


def scaled(d, p, q, x):
    return tuple(d.rational(p, q) * a for a in x)


def pairing(mu, x):
    return (sum((m * a for m, a in zip(mu[1:], x[1:], strict=True)), mu[0] * x[0]),)


def power_sum(d, coefficients, advance, x):
    """sum_k c_k advance^k x, long enough for rounding and for every power of h."""
    total, term = None, x
    for c in coefficients:
        part = tuple(c * t for t in term)
        total = part if total is None else plus(total, part)
        term = advance(term)
    return total


def dexp(s, x, y):
    """dexp_x y = sum ad_x^k y/(k+1)!, by its definition."""
    terms = [s.domain.rational(1, factorial(k + 1)) for k in range(60)]
    return power_sum(s.domain, terms, lambda v: s.group.ad(s.domain, x, v), y)


def ddh(s, values):
    """The derivative of each series by h; its last coefficient is unknown, so :func:`shortened` drops it."""
    ring = s.domain.ring
    return tuple(
        ring.from_coefficients(tuple(c * k for k, c in enumerate(v.coefficients) if k > 0)) for v in values
    )


def shortened(s, values):
    return tuple(s.domain.ring.from_coefficients(v.coefficients[:ORDER]) for v in values)


def constants(s, n):
    """Constant series with small rational values."""
    return tuple(s.domain.rational(s.rng.randint(-4, 4), s.rng.randint(1, 3)) for _ in range(n))


def at_order(values, k):
    return [v.coefficients[k] for v in values]


@each_group
class TestTheIdentityIsNeutral:
    def test_on_both_sides(self, s):
        d, g = s.domain, s.element()
        e = s.group.identity(d)
        assert s.equal(s.group.mul(d, e, g), g)
        assert s.equal(s.group.mul(d, g, e), g)

    def test_it_is_the_exponential_of_zero(self, s):
        zero = tuple(x * 0 for x in s.vector())
        assert s.equal(s.group.exp(s.domain, zero), s.group.identity(s.domain))


@each_group
class TestTheProductIsAssociative:
    def test(self, s):
        d, (a, b, c) = s.domain, (s.element() for _ in range(3))
        mul = s.group.mul
        assert s.equal(mul(d, mul(d, a, b), c), mul(d, a, mul(d, b, c)))


@each_group
class TestExpIsAOneParameterSubgroup:
    def test_exp_of_minus_x_is_the_inverse(self, s):
        d, x, group = s.domain, s.vector(), s.group
        product = group.mul(d, group.exp(d, x), group.exp(d, minus(x)))
        assert s.equal(product, group.identity(d))

    def test_parts_of_a_step_compose(self, s):
        d, x, group = s.domain, s.vector(), s.group
        parts = group.mul(d, group.exp(d, scaled(d, 1, 3, x)), group.exp(d, scaled(d, 2, 3, x)))
        assert s.equal(parts, group.exp(d, x))


@exactly
class TestVelocityIsTheDerivativeOfExp:
    def test_at_zero(self, s):
        d = s.domain
        x, g = constants(s, s.group.dim), s.element()
        g = tuple(d.ring.constant(c) for c in at_order(g, 0))
        moved = s.group.mul(d, s.group.exp(d, tuple(d.h * a for a in x)), g)
        assert at_order(moved, 1) == at_order(s.group.velocity(d, x, g), 0)

    def test_along_the_subgroup(self, s):
        d, x = s.domain, constants(s, s.group.dim)
        path = s.group.exp(d, tuple(d.h * a for a in x))
        assert s.equal(ddh(s, path), shortened(s, s.group.velocity(d, x, path)))


WITH_RATES = [name for name, group in BASE_GROUPS.items() if group.offers(RightTrivialisation)]


@pytest.mark.parametrize("s", cases(WITH_RATES, (EXACT,)), indirect=True)
class TestRateInvertsVelocity:
    def test_where_a_group_has_one(self, s):
        x, g = s.vector(), s.element()
        assert s.equal(s.group.rate(s.domain, s.group.velocity(s.domain, x, g), g), x)


@exactly
class TestTheBracketIsThatOfTheGroup:
    def test_it_is_the_leading_term_of_the_commutator(self, s):
        d, group = s.domain, s.group
        x, y = constants(s, group.dim), constants(s, group.dim)
        hx, hy = (tuple(d.h * a for a in v) for v in (x, y))
        word = [group.exp(d, v) for v in (hx, hy, minus(hx), minus(hy))]
        commutator = word[0]
        for g in word[1:]:
            commutator = group.mul(d, commutator, g)
        e = group.identity(d)
        assert at_order(commutator, 1) == [c * 0 for c in at_order(e, 0)]
        assert at_order(commutator, 2) == at_order(group.velocity(d, group.ad(d, x, y), e), 0)

    def test_it_is_antisymmetric(self, s):
        x, y = s.vector(), s.vector()
        assert s.equal(s.group.ad(s.domain, x, y), minus(s.group.ad(s.domain, y, x)))

    def test_it_satisfies_the_jacobi_identity(self, s):
        x, y, z = s.vector(), s.vector(), s.vector()

        def ad(a, b):
            return s.group.ad(s.domain, a, b)

        total = plus(ad(x, ad(y, z)), ad(y, ad(z, x)), ad(z, ad(x, y)))
        assert s.equal(total, tuple(a * 0 for a in x))


@exactly
class TestDexpIsTheDifferentialOfExp:
    """d/dh exp(x(h)) = dexp_x(x').exp(x): right trivialised, with the sign of [A, B] = AB - BA."""

    def test(self, s):
        d, x = s.domain, s.vector()
        slope = ddh(s, x)
        path = s.group.exp(d, x)
        expected = s.group.velocity(d, dexp(s, x, slope), path)
        assert s.equal(shortened(s, ddh(s, path)), shortened(s, expected))


@exactly
class TestDexpinvInvertsDexp:
    def test_on_the_left(self, s):
        x, y = s.vector(), s.vector()
        assert s.equal(dexp(s, x, s.group.dexpinv(s.domain, x, y, ORDER)), y)

    def test_on_the_right(self, s):
        x, y = s.vector(), s.vector()
        assert s.equal(s.group.dexpinv(s.domain, x, dexp(s, x, y), ORDER), y)

    def test_order_zero_is_the_identity(self, s):
        x, y = s.vector(), s.vector()
        assert s.group.dexpinv(s.domain, x, y, 0) == y

    def test_order_three_is_order_two(self, s):
        x, y = s.vector(), s.vector()
        assert s.equal(s.group.dexpinv(s.domain, x, y, 3), s.group.dexpinv(s.domain, x, y, 2))

    def test_the_first_bracket_has_minus_one_half(self, s):
        d, x, y = s.domain, s.vector(), s.vector()
        expected = plus(y, scaled(d, -1, 2, s.group.ad(d, x, y)))
        assert s.equal(s.group.dexpinv(d, x, y, 1), expected)


@exactly_base
class TestDexpTakesDexpinvOfMinusXToAd:
    """dexp_x o dexp^{-1}_{-x} = Ad_{exp x}."""

    def test(self, s):
        d, x, y = s.domain, s.vector(), s.vector()
        left = dexp(s, x, s.group.dexpinv(d, minus(x), y, ORDER))
        assert s.equal(left, s.group.Ad(d, s.group.exp(d, x), y))


@each_base
class TestAdIsAHomomorphism:
    def test_into_linear_maps(self, s):
        d, g, k, x = s.domain, s.element(), s.element(), s.vector()
        Ad = s.group.Ad
        assert s.equal(Ad(d, s.group.mul(d, g, k), x), Ad(d, g, Ad(d, k, x)))

    def test_into_automorphisms_of_the_bracket(self, s):
        d, g, x, y = s.domain, s.element(), s.vector(), s.vector()
        Ad, ad = s.group.Ad, s.group.ad
        assert s.equal(Ad(d, g, ad(d, x, y)), ad(d, Ad(d, g, x), Ad(d, g, y)))

    def test_it_is_conjugation(self, s):
        d, g, x = s.domain, s.element(), s.vector()
        group = s.group
        left = group.mul(d, group.exp(d, group.Ad(d, g, x)), g)
        assert s.equal(left, group.mul(d, g, group.exp(d, x)))

    def test_on_the_exponential_it_is_the_exponential_of_ad(self, s):
        d, x, y = s.domain, s.vector(), s.vector()
        terms = [d.rational(1, factorial(k)) for k in range(80)]
        expected = power_sum(d, terms, lambda v: s.group.ad(d, x, v), y)
        assert s.equal(s.group.Ad(d, s.group.exp(d, x), y), expected)


@each_base
class TestAdStarIsTheDualOfAd:
    def test_pairing(self, s):
        d, g, mu, x = s.domain, s.element(), s.covector(), s.vector()
        assert s.equal(pairing(s.group.Adt(d, g, mu), x), pairing(mu, s.group.Ad(d, g, x)))

    def test_products_turn_round(self, s):
        d, g, k, mu = s.domain, s.element(), s.element(), s.covector()
        Adt = s.group.Adt
        assert s.equal(Adt(d, s.group.mul(d, g, k), mu), Adt(d, k, Adt(d, g, mu)))

    def test_adtinv_is_its_inverse(self, s):
        d, g, mu = s.domain, s.element(), s.covector()
        assert s.equal(s.group.Adtinv(d, g, s.group.Adt(d, g, mu)), mu)
        assert s.equal(s.group.Adtinv(d, g, mu), s.group.Adt(d, inverse(s.group, d, g), mu))


@each_base
class TestAdtIsTheDualOfTheBracket:
    def test_pairing(self, s):
        d, x, y, mu = s.domain, s.vector(), s.vector(), s.covector()
        assert s.equal(pairing(s.group.adt(d, x, mu), y), pairing(mu, s.group.ad(d, x, y)))


@each_base
class TestDexptIsTheDualOfDexp:
    def test_pairing(self, s):
        d, x, y, mu = s.domain, s.vector(), s.vector(), s.covector()
        assert s.equal(pairing(s.group.dexpt(d, x, mu), y), pairing(mu, dexp(s, x, y)))

    def test_it_absorbs_ad_star_of_the_exponential(self, s):
        """dexp*_x Ad*_{exp(-x)} = dexp*_{-x}: what lets one factor merge in (3.19)."""
        d, x, mu = s.domain, s.vector(), s.covector()
        moved = s.group.Adtinv(d, s.group.exp(d, x), mu)
        assert s.equal(s.group.dexpt(d, x, moved), s.group.dexpt(d, minus(x), mu))


@each_base
class TestDexpinvtIsTheDualOfDexpinv:
    @pytest.mark.parametrize("order", range(5))
    def test_pairing(self, s, order):
        d, x, y, mu = s.domain, s.vector(), s.vector(), s.covector()
        left = pairing(s.group.dexpinvt(d, x, mu, order), y)
        assert s.equal(left, pairing(mu, s.group.dexpinv(d, x, y, order)))


@exactly_base
class TestPIsTheDualOfTheDerivativeOfDexpinv:
    """d/dh <mu, dexp^{-1}_(r),x(h) y> = <P*_(r)(x, y) mu, x'> for constant mu and y."""

    @pytest.mark.parametrize("order", range(5))
    def test_pairing(self, s, order):
        d, x = s.domain, s.vector()
        y = tuple(d.rational(k - 1, k + 2) for k in range(s.group.dim))
        mu = tuple(d.rational(2 * k + 1, 3) for k in range(s.group.dim))
        value = ddh(s, pairing(mu, s.group.dexpinv(d, x, y, order)))
        slope = pairing(s.group.P(d, x, y, mu, order), ddh(s, x))
        assert s.equal(shortened(s, value), shortened(s, slope))
        assert order == 0 or s.group.abelian or not s.equal(slope, tuple(a * 0 for a in slope))


@each_base
class TestTheCotangentGroupExtendsItsBase:
    """(g, mu)(k, nu) = (g k, mu + Ad*_{g^-1} nu); exp(xi, n) = (exp xi, dexp*_{-xi} n)."""

    def test_g_is_a_subgroup_and_covectors_are_normal(self, s):
        from codegen.groups import Cotangent

        d, lifted = s.domain, Cotangent(s.group)
        g, k, mu = s.element(), s.element(), s.covector()
        zero = tuple(m * 0 for m in mu)
        e = s.group.identity(d)
        assert s.equal(lifted.mul(d, g + zero, k + zero), s.group.mul(d, g, k) + zero)
        conjugated = lifted.mul(d, lifted.mul(d, g + zero, e + mu), inverse(lifted, d, g + zero))
        assert s.equal(conjugated, e + s.group.Adtinv(d, g, mu))

    def test_inverse(self, s):
        from codegen.groups import Cotangent

        d, lifted = s.domain, Cotangent(s.group)
        z = s.element() + s.covector()
        assert s.equal(lifted.mul(d, z, inverse(lifted, d, z)), lifted.identity(d))
