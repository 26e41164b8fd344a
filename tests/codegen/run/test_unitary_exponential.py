"""The exponential of su(3): against 60 digits, at equal eigenvalues, at turns, and its derivative."""

from __future__ import annotations

import math
import random

import mpmath
import pytest

from codegen.groups import SU
from codegen.ir.domain import FloatDomain
from codegen.ir.expr import Space, evaluate
from codegen.ir.unitary_exponential import (
    PLACES,
    SpecialUnitaryExponential,
    determinant,
    half_trace,
    square_of_hermitian,
)

ULP = 2.0**-52
FUNCTION = SpecialUnitaryExponential()
CONTEXT = mpmath.mp.clone()
CONTEXT.dps = 60


def hermitian(x):
    """The matrix H with X = i H."""
    h = CONTEXT.matrix(3, 3)
    for j, d in enumerate((x[6], x[7] - x[6], -x[7])):
        h[j, j] = CONTEXT.mpf(d)
    for (j, k), a, b in zip(PLACES, x[0:6:2], x[1:6:2], strict=True):
        h[j, k], h[k, j] = CONTEXT.mpc(b, -a), CONTEXT.mpc(b, a)
    return h


def coordinates(h):
    """The coordinates of i H in doubles."""
    pairs = [v for j, k in PLACES for v in (-h[j, k].imag, h[j, k].real)]
    return [float(v) for v in (*pairs, h[0, 0].real, -h[2, 2].real)]


def exact(x):
    """The exponential by mpmath's own function, with digits to spare."""
    with CONTEXT.workdps(100):
        g = CONTEXT.expm(CONTEXT.mpc(0, 1) * hermitian(x))
    entries = [g[i, j] for i in range(3) for j in range(3)]
    return [e.real for e in entries] + [e.imag for e in entries]


def norm(x):
    """The Frobenius norm of X."""
    return CONTEXT.sqrt(sum(abs(v) ** 2 for v in hermitian(x)))


def samples():
    """Coordinates of random matrices, and of matrices with given eigenvalues in a random basis."""
    rng = random.Random(3)

    def drawn(size):
        x = [rng.gauss(0, 1) for _ in range(8)]
        return [a * (size / math.sqrt(2 * half_trace(x))) for a in x]

    for size in (1e-300, 1e-160, 1e-16, 1e-8, 1e-3, 0.03, 0.2, 0.5, 0.6, 0.8, 2.0, 10.0, 100.0):
        for _ in range(4):
            yield f"random, {size}", drawn(size)
    turns = [turn + away for turn in (math.pi, 2 * math.pi) for away in (-1e-9, 0.0, 1e-9)]
    spectra = [(t, 0.0, -t) for t in turns] + [(t, t, -2 * t) for t in turns]
    spectra += [(s, s * (1 + gap), -s * (2 + gap)) for s in (1e-300, 0.1, 1.0, 40.0) for gap in (0.0, 1e-8)]
    for spectrum in spectra:
        entries = exact(drawn(3.0))
        basis = CONTEXT.matrix(3, 3)
        for k in range(9):
            basis[k // 3, k % 3] = CONTEXT.mpc(entries[k], entries[9 + k])
        yield f"eigenvalues {spectrum}", coordinates(basis * CONTEXT.diag(spectrum) * basis.H)
        first, _, last = spectrum
        yield f"diagonal {spectrum}", [0.0] * 6 + [first, -last]


@pytest.mark.parametrize(("name", "x"), [pytest.param(*s, id=f"{k}") for k, s in enumerate(samples())])
def test_the_error_is_at_most_8_times_1_plus_the_norm_ulps_of_the_norm(name, x):
    found = FUNCTION.in_doubles(x)
    error = CONTEXT.sqrt(sum((a - b) ** 2 for a, b in zip(found, exact(x), strict=True)))
    assert error <= 8 * (1 + norm(x)) * ULP * math.sqrt(3), name


def test_the_invariants_are_those_of_the_characteristic_polynomial():
    x = [3.0, -1.0, 2.0, 5.0, -4.0, 7.0, 6.0, -2.0]
    h = hermitian(x)
    square = h * h
    assert half_trace(x) == (square[0, 0] + square[1, 1] + square[2, 2]).real / 2
    assert determinant(x) == pytest.approx(float(CONTEXT.det(h).real), rel=1e-14)
    expected = [square[j, j].real for j in range(3)]
    expected += [part for j, k in PLACES for part in (square[j, k].real, square[j, k].imag)]
    assert list(square_of_hermitian(x)) == expected


@pytest.mark.parametrize("size", [2.0**46, 1e200, math.inf, math.nan])
def test_a_result_with_fewer_than_three_digits_is_nan(size):
    assert all(map(math.isnan, FUNCTION.in_doubles([0.0, size, *[0.0] * 6])))


def test_a_result_with_three_digits_is_not_nan():
    size = 2.0**35
    assert abs(FUNCTION.in_doubles([size, *[0.0] * 7])[0] - mpmath.cos(size)) < 1e-3


def test_the_derivative_is_the_limit_of_differences():
    space, rng, eps = Space(), random.Random(5), 2.0**-14
    names = [f"x{k}" for k in range(8)]
    x = [space.sym(n) for n in names]
    at = {n: rng.uniform(-1, 1) for n in names}
    for argument in range(8):
        slopes = evaluate(FUNCTION.derivative(x, argument), FloatDomain(0.0), at)
        ends = []
        for sign in (1, -1):
            moved = [v + sign * eps * (k == argument) for k, v in enumerate(at.values())]
            ends.append(FUNCTION.in_doubles(moved))
        for slope, a, b in zip(slopes, *ends, strict=True):
            assert slope == pytest.approx((a - b) / (2 * eps), abs=1e-8)


def test_the_group_has_this_exponential():
    x = [0.3, -0.2, 0.5, 0.1, -0.7, 0.4, 0.25, -0.6]
    g = SU(3).exp(FloatDomain(0.0), tuple(x))
    found = FUNCTION.in_doubles(x)
    assert [g[6 * i + j] for i in range(6) for j in range(3)] == list(found)
    assert max(abs(value) for _, value in SU(3).laws(FloatDomain(0.0), g)) < 1e-14
