"""Samples as polynomials: the same ring, the same ranks as vectors of residues."""

from __future__ import annotations

from random import Random

import pytest

from orderconds.ring.samples import Sample, Samples, echelon

PRIME = 2147483647


def values(x: Sample) -> list[int]:
    return [int(x.polynomial(k)) for k in range(x.ring.count)]


def test_arithmetic_is_that_of_every_sample() -> None:
    ring, generator = Samples(PRIME, 7), Random(0)
    x, y = ring.random(generator), ring.random(generator)
    for found, of in [
        (x + y, lambda a, b: a + b),
        (x - y, lambda a, b: a - b),
        (3 - x * y, lambda a, b: 3 - a * b),
        (x / y, lambda a, b: a * pow(b, -1, PRIME)),
        (1 / -x + 2 * y, lambda a, b: 2 * b - pow(a, -1, PRIME)),
        (x**3 / 5 + y**-1, lambda a, b: a**3 * pow(5, -1, PRIME) + pow(b, -1, PRIME)),
    ]:
        assert values(found) == [of(a, b) % PRIME for a, b in zip(values(x), values(y), strict=True)]
    assert ring.element(values(x)) == x
    assert hash(ring.element(values(x))) == hash(x)
    assert ring.is_zero(x - x)
    assert ring.text(ring.one) == ring.approximate(ring.one) == str([1] * 7)


def test_a_constant_is_told_from_samples_that_differ() -> None:
    ring = Samples(101, 3)
    assert ring.constant(ring.rational(-1, 2)) == 50
    assert ring.constant(ring.zero) == 0
    assert ring.constant(ring.element([1, 1, 2])) is None


def test_what_cannot_be_divided_by_is_refused() -> None:
    ring = Samples(101, 3)
    with pytest.raises(ZeroDivisionError, match="modulo 101"):
        ring.one / ring.element([1, 0, 2])
    with pytest.raises(ValueError, match="not invertible"):
        ring.rational(1, 101)
    with pytest.raises(ValueError, match="the prime 101 must be larger than the number of samples, 200"):
        Samples(101, 200)


def test_pivots_are_the_first_independent_columns_in_any_coordinates() -> None:
    ring, generator = Samples(PRIME, 6), Random(1)
    x, y = ring.random(generator), ring.random(generator)
    columns = [ring.zero, x, 2 * x, y, x * y, x - y, ring.one]
    assert echelon([ring.coordinates(c) for c in columns], PRIME)[0] == (1, 3, 4, 6)
    assert echelon([values(c) for c in columns], PRIME)[0] == (1, 3, 4, 6)
    assert echelon([], PRIME)[0] == ()
