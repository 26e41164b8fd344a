"""exp(A) y without exp(A): against many digits and exact series, alike in every bit in C and in Python."""

from __future__ import annotations

import math
import random
from contextlib import nullcontext

import mpmath
import pytest

from codegen.ir.ball_domain import BallDomain
from codegen.ir.domain import ExprDomain, FloatDomain, PreciseDomain, SeriesDomain
from codegen.ir.exponential_action import HALVINGS, ExponentialAction, degrees
from codegen.ir.expr import evaluate
from codegen.ir.matrix_functions import MatrixExponential
from codegen.ir.precision import DOUBLE, SINGLE
from codegen.ir.tangent import tangents
from codegen.run.language import Unit
from codegen.run.matrix_functions import matrix_functions, matrix_tables
from orderconds.ring import QQ
from tests.codegen.run.test_matrix_functions import (
    ULP,
    by_executor,
    exact,
    frobenius,
    in_c,
    in_python,
    same,
    samples,
)

ROWS = (2, 5, pytest.param(8, marks=pytest.mark.slow))
TRIDIAGONAL = sum(1 << (6 * i + j) for i in range(6) for j in range(6) if abs(i - j) < 2)


def column(n, rng):
    return [rng.gauss(0, 1) for _ in range(n)]


def times(n, a, y):
    return [mpmath.fdot(a[n * i : n * i + n], y) for i in range(n)]


@pytest.mark.parametrize("n", ROWS)
def test_the_error_is_at_most_8_times_1_plus_the_norm_ulps_of_the_norm(n):
    rng = random.Random(n)
    for name, a in samples(n):
        y = column(n, rng)
        with mpmath.workdps(60):
            expected = exact(n, a)
            error = frobenius(
                [
                    x - z
                    for x, z in zip(
                        ExponentialAction(n).in_doubles([*a, *y]), times(n, expected, y), strict=True
                    )
                ]
            )
            bound = 8 * n * (1 + frobenius(a)) * ULP * frobenius(y)
            # The intermediate values may be as large as the exponential of the norm of the symmetric part.
            growth = 1 if name.startswith(("skew", "angle")) else mpmath.exp(min(frobenius(a), 3))
            assert error <= bound * max(growth, frobenius(expected)), name


def test_the_length_of_a_vector_does_not_drift_in_many_rotations():
    n, rng = 6, random.Random(3)
    a = [0.0] * n * n
    for i in range(n):
        for j in range(i):
            a[n * i + j] = rng.gauss(0, 1) / 4
            a[n * j + i] = -a[n * i + j]
    y = column(n, rng)
    length = math.hypot(*y)
    drift = []
    for _ in range(2000):
        y = list(ExponentialAction(n).in_doubles([*a, *y]))
        drift.append(math.hypot(*y) / length - 1)
    # Rounding errors of either sign add up like a random walk.
    assert max(map(abs, drift)) < 4 * math.sqrt(len(drift)) * 2.0**-53


@pytest.mark.parametrize("carried_out", [by_executor, in_python, in_c])
@pytest.mark.parametrize(
    "function",
    [ExponentialAction(3), ExponentialAction(6, TRIDIAGONAL), ExponentialAction(13)],
    ids=lambda f: f.name,
)
def test_emitted_functions_agree_with_the_domain_in_every_bit(function, carried_out):
    listed = matrix_functions([function], DOUBLE)
    call = carried_out(Unit((), (), matrix_tables([function], DOUBLE), tuple(listed)), function)
    rng = random.Random(1)
    for scale in (1e-300, 1e-5, 1e-2, 0.1, 1.0, 4.0, 1e20):
        a = [rng.gauss(0, 1) * scale for _ in range(function.arrays[0])]
        y = column(function.n, rng)
        assert same(call([*a, *y]), function.in_doubles([*a, *y])), scale


def test_a_pattern_gives_the_same_bits_as_the_matrix_with_its_zeros():
    sparse, dense, rng = ExponentialAction(6, TRIDIAGONAL), ExponentialAction(6), random.Random(5)
    a, y = column(sparse.arrays[0], rng), column(6, rng)
    assert sparse.in_doubles([*a, *y]) == dense.in_doubles([*sparse.matrix(a, 0.0), *y])


def test_expressions_call_the_function_of_their_zeros():
    d = ExprDomain()
    zero = d.rational(0)
    a = [d.space.sym(f"a{k}") if TRIDIAGONAL >> k & 1 else zero for k in range(36)]
    y = [d.space.sym(f"y{k}") for k in range(6)]
    results = d.vector("expmv6", (*a, *y))
    assert all(x.payload.startswith(f"expmv6_{TRIDIAGONAL:x}.") for x in results)
    assert d.vector("expmv6", (*[zero] * 36, *y)) == tuple(y)


@pytest.mark.parametrize("size", [2.0 ** (HALVINGS + 1), 1e200, math.inf, math.nan])
def test_a_matrix_that_would_take_too_long_gives_nan(size):
    assert all(map(math.isnan, ExponentialAction(2).in_doubles([0.0, size, -size, 0.0, 1.0, 0.0])))


@pytest.mark.parametrize("place", range(4))
def test_a_matrix_with_a_nan_has_no_exponential_in_digits(place):
    domain = PreciseDomain(0.1, 30)
    args = [domain.context.mpf(1)] * 6
    args[place] = domain.context.nan
    with pytest.raises(OverflowError):
        ExponentialAction(2).in_digits(domain.context, 30, args)


@pytest.mark.parametrize("precision", [DOUBLE, SINGLE], ids=lambda p: p.name)
def test_the_coefficients_of_the_polynomials_are_exact(precision):
    for m in degrees(precision.bits):
        weight = 1.0
        for k in range(m, 1, -1):
            weight = precision.round(weight * k)
            assert weight == math.factorial(m) // math.factorial(k - 1)


def test_series_and_digits_agree_with_the_exponential():
    n = 3
    d = SeriesDomain(QQ, 5)
    a = [d.h * d.rational(k - 4, 3) for k in range(9)]
    y = [d.rational(k + 1, 2) for k in range(3)]
    found = d.vector("expmv3", (*a, *y))
    g = d.vector("expm3", a)
    for i, x in enumerate(found):
        total = sum((p * q for p, q in zip(g[n * i : n * i + n], y, strict=True)), d.rational(0))
        assert d.ring.is_zero(x - total) is True
    for sharp in (PreciseDomain(0, 40), BallDomain(0, 45)):
        with getattr(sharp, "precision", nullcontext)():
            b = [sharp.rational(7 * k - 30, 3) for k in range(9)]
            z = [sharp.rational(k + 1, 2) for k in range(3)]
            found, g = sharp.vector("expmv3", (*b, *z)), sharp.vector("expm3", b)
            for i, x in enumerate(found):
                total = sum(p * q for p, q in zip(g[n * i : n * i + n], z, strict=True))
                assert abs(float((x - total) / total)) < 1e-34


def test_the_derivative_is_the_rate_of_the_action():
    n, d, rng = 5, ExprDomain(), random.Random(9)
    names = [f"x{k}" for k in range(n * n + n)]
    symbols = [d.space.sym(x) for x in names]
    keep = {k for k in range(n * n) if (k // n + k) % 3}
    args = [x if k in keep or k >= n * n else d.space.zero for k, x in enumerate(symbols)]
    results = d.vector(f"expmv{n}", args)
    rates = {x: d.space.sym(f"rate_{x}") for x in names}
    slopes = tangents(list(results), rates)
    values = {x: rng.gauss(0, 0.5) for x in names} | {f"rate_{x}": rng.gauss(0, 1) for x in names}
    found = evaluate(list(slopes), FloatDomain(0.0), values)
    dense = [values[x] if k in keep or k >= n * n else 0.0 for k, x in enumerate(names)]
    moved = [values[f"rate_{x}"] if k in keep or k >= n * n else 0.0 for k, x in enumerate(names)]
    both = MatrixExponential(n, 1).in_doubles([*dense[: n * n], *moved[: n * n]])
    g, slope = both[: n * n], both[n * n :]
    for i, x in enumerate(found):
        row = slice(n * i, n * i + n)
        expected = math.fsum(p * q for p, q in zip(slope[row], dense[n * n :], strict=True))
        expected += math.fsum(p * q for p, q in zip(g[row], moved[n * n :], strict=True))
        assert abs(x - expected) < 1e-12 * max(1, abs(expected))
