"""Monomials in graded generators."""

from __future__ import annotations

import pytest

from orderconds.series.monomials import products
from orderconds.trees.counts import euler_transform


@pytest.mark.parametrize("degree", range(1, 11))
def test_monomials_in_one_generator_a_degree_are_partitions(degree: int) -> None:
    generators = [(n, 1) for n in range(1, degree + 1)]
    assert len(list(products(generators, degree))) == euler_transform([1] * degree)[-1]


def test_every_multiset_of_generators_is_multiplied_once() -> None:
    # Values are distinct primes, so that a product tells its factors.
    values = list(products([(1, 2), (1, 3), (2, 5), (3, 7)], 3))
    assert sorted(values) == sorted([8, 12, 18, 27, 2 * 5, 3 * 5, 7])


def test_there_is_no_monomial_of_degree_zero() -> None:
    assert list(products([(1, 2)], 0)) == []
