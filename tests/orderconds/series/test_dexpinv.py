"""Bernoulli numbers, and the series of steps with dexpinv."""

from itertools import product
from math import factorial, prod

import pytest

from orderconds.ring import QQ
from orderconds.series.dexpinv import DexpinvSeries, bernoulli
from orderconds.trees.levels import trees_of
from orderconds.trees.ordered import ordered_forests
from orderconds.words.shuffle import shuffle


def test_bernoulli_numbers_have_the_denominators_of_von_staudt_and_clausen():
    """The product of the primes p with p - 1 | n; each of 200 numbers is found from those before it, once."""
    primes = [p for p in range(2, 202) if all(p % q for q in range(2, p))]
    for n in range(2, 201):
        divisors = prod(p for p in primes if n % (p - 1) == 0)
        assert bernoulli(n).denominator == (1 if n % 2 else divisors)


def is_group_like(series, order):
    """Values multiply over shuffles."""
    for total in range(2, order + 1):
        for size in range(1, total // 2 + 1):
            for u, v in product(ordered_forests(size), ordered_forests(total - size)):
                words = shuffle(trees_of(u), trees_of(v))
                shuffled = sum(
                    (times * series(b"".join(word)) for word, times in words.items()), 0 * series(u)
                )
                if shuffled != series(u) * series(v):
                    return False
    return True


def test_arguments_of_munthe_kaas_steps_are_lie_series(random_tableau):
    # A Lie series vanishes on proper shuffles.
    series = DexpinvSeries(QQ, random_tableau(2).A, random_tableau(2).b, cutoff=2)
    for total in range(2, 6):
        for u, v in product(ordered_forests(1), ordered_forests(total - 1)):
            words = shuffle(trees_of(u), trees_of(v))
            for i in range(3):
                value = sum((n * series.argument(i, b"".join(word)) for word, n in words.items()), QQ.zero)
                assert value == 0


@pytest.mark.parametrize("cutoff", [0, 1, 2, None])
def test_steps_are_group_like_whatever_the_cut(cutoff, random_tableau):
    method = random_tableau(2)
    assert is_group_like(DexpinvSeries(QQ, method.A, method.b, cutoff), 5)


def test_a_cut_after_the_third_power_is_one_after_the_second(random_tableau):
    method = random_tableau(2)
    second, third, fourth = (DexpinvSeries(QQ, method.A, method.b, cutoff) for cutoff in (2, 3, 4))
    forests = [forest for n in range(1, 7) for forest in ordered_forests(n)]
    assert all(second(forest) == third(forest) for forest in forests)
    assert any(fourth(forest) != third(forest) for forest in forests)


def test_without_a_cut_trees_without_order_have_the_elementary_weights(random_tableau):
    # On commuting fields RKMK is the Runge-Kutta method: shuffles of one letter are powers of sum b_i c_i^k.
    method = random_tableau(3)
    series = DexpinvSeries(QQ, method.A, method.b)
    for n in range(1, 6):
        forest = b"\0" * n
        total = sum(method.b, QQ.zero)
        assert series(forest) * factorial(n) == total**n
