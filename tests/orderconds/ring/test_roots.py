"""Real roots of rational polynomials: isolation, order, and the decimals that name them."""

from __future__ import annotations

from fractions import Fraction

import pytest
from flint import arb, fmpq, fmpq_poly

from orderconds.ring.precision import precision
from orderconds.ring.roots import isolate, isolating, place_of_root, real_roots

X = fmpq_poly([0, 1])
CUBIC = (X - 1) * (X + 2) * (X * 3 - 1)


def fractions(polynomial: fmpq_poly) -> list[Fraction]:
    return [Fraction(int(c.p), int(c.q)) for c in polynomial.coeffs()]


def test_real_roots_rise_and_complex_ones_are_left_out() -> None:
    roots = real_roots(CUBIC * (X * X + 1), 128)
    assert [round(float(x), 12) for x in roots] == [-2.0, round(1 / 3, 12), 1.0]


@pytest.mark.parametrize("bits", [53, 200, 1000])
def test_roots_are_as_narrow_as_asked_for(bits: int) -> None:
    for root in real_roots(X**5 - X - 1, bits):
        assert root.rel_accuracy_bits() >= bits
        with precision(bits + 32):
            assert (root**5 - root - 1).contains(0)


def test_the_factor_with_the_root_is_returned() -> None:
    factor, root = isolate((CUBIC * (X * X - 2)).coeffs(), fmpq(14, 10), fmpq(1, 10))
    assert factor == X * X - 2
    with precision(100):
        assert root(100).overlaps(arb(2).sqrt())


@pytest.mark.parametrize(("near", "unit"), [(fmpq(5), fmpq(1)), (fmpq(0), fmpq(3))])
def test_an_interval_with_no_root_or_several_is_refused(near: fmpq, unit: fmpq) -> None:
    with pytest.raises(ValueError, match="real roots within"):
        isolate(CUBIC.coeffs(), near, unit)


def test_a_constant_has_no_root() -> None:
    with pytest.raises(ValueError, match="constant"):
        isolate([fmpq(3)], fmpq(0), fmpq(1))


def test_the_decimal_of_a_root_isolates_it() -> None:
    polynomial = X**4 - 10 * X**2 + 1
    for place, root in enumerate(real_roots(polynomial, 200)):

        def enclosure(bits: int, place: int = place) -> arb:
            return real_roots(polynomial, bits)[place]

        text = isolating(polynomial, enclosure)
        unit = fmpq(1, 10 ** len(text.partition(".")[2]))
        found = isolate(polynomial.coeffs(), fmpq(*Fraction(text).as_integer_ratio()), unit)[1]
        assert found(200).overlaps(root)


def test_a_place_counts_the_real_roots_of_the_irreducible_factor() -> None:
    coefficients, place = place_of_root(fractions(CUBIC * (X**3 - 2)), Fraction(126, 100), Fraction(1, 100))
    assert (coefficients, place) == ([-2, 0, 0, 1], 0)
    for place, near in enumerate(("-3.146", "-0.318", "0.318", "3.146")):
        found = place_of_root(fractions(X**4 - 10 * X**2 + 1), Fraction(near), Fraction(1, 1000))
        assert found[1] == place
