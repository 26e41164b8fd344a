"""The order of a scheme with two registers (2N) on a group is its order on a vector space.

The proof is in docs/explanation/two_registers.md. These tests check its steps by machine, and its result by
the series of random schemes, which are computed without words.
"""

from fractions import Fraction
from math import prod

import numpy as np
import pytest

from orderconds.families.ordered_forests import lyndon_forests
from orderconds.ring import QQ, Residues
from orderconds.ring.rational_matrix import rank
from orderconds.series.b_series import runge_kutta_series
from orderconds.series.lie_butcher import ExponentialsSeries, exact_value
from orderconds.series.lie_butcher_rank import independent_forests
from orderconds.series.two_registers import (
    in_rooted_forests,
    independent_trees,
    on_group,
    on_vector_space,
    rooted_forests,
    words,
)
from orderconds.trees.levels import density, trees_of
from orderconds.trees.ordered import ordered_forests
from orderconds.trees.rooted import rooted_trees
from orderconds.words.lyndon import lyndon_words

ORDERS = [1, 2, 3, 4, 5, pytest.param(6, marks=pytest.mark.slow), pytest.param(7, marks=pytest.mark.slow)]


def registers(ring, A, B):
    """The rows B_i (A_i ... A_(j+1)) of the exponentials of a 2N scheme."""
    register, rows = [], []
    for a, b in zip(A, B, strict=True):
        register = [*(a * x for x in register), ring.one]
        rows.append([b * x for x in register])
    return rows


def group_series(ring, rows):
    sparse = [tuple(enumerate(row)) for row in rows]
    return ExponentialsSeries(ring, [sparse[:i] for i in range(len(rows))], sparse)


def vector_space_series(ring, rows):
    """The elementary weights of the tableau (A, b) that the exponentials have on a vector space."""
    s, total, sums = len(rows), [ring.zero] * len(rows), []
    for row in rows:
        sums.append(total)
        total = [x + (row[j] if j < len(row) else ring.zero) for j, x in enumerate(total)]
    weights = runge_kutta_series(ring, sums, total)
    assert len(sums) == s
    return lambda forest: prod((weights(tree) for tree in trees_of(forest)), start=ring.one)


def random_rows(ring, generator, stages, zeros=()):
    A = [ring.zero if i in zeros else ring.random(generator) for i in range(stages)]
    return registers(ring, A, [ring.random(generator) for _ in range(stages)])


def violations(ring, rows, order):
    """The ordered forests on which a scheme does not have the value that the theorem states."""
    group, space = group_series(ring, rows), vector_space_series(ring, rows)
    return [
        forest
        for forest, row in in_rooted_forests(order).items()
        if ring.is_zero(
            group(forest)
            - sum((space(u) * ring.rational(x.numerator, x.denominator) for u, x in row.items()), ring.zero)
        )
        is not True
    ]


@pytest.mark.parametrize("order", ORDERS)
def test_the_same_combinations_of_words_vanish_on_groups_and_on_vector_spaces(order):
    """A combination that vanishes on every group vanishes on vector spaces, which are groups. The converse is
    the equality of the ranks, which are exact, over Q."""
    ranks = []
    for operator, forests in ((on_vector_space, rooted_forests(order)), (on_group, ordered_forests(order))):
        columns, operators = tuple(forests), map(operator, words(order))
        ranks.append(rank([[found.get(forest, 0) for forest in columns] for found in operators]))
    assert ranks[0] == ranks[1] == products_of_monomials(order)


def monomials(order):
    """The numbers of commutative monomials, which are not associative, in one letter (Wedderburn 1922)."""
    counts = [0, 1]
    for n in range(2, order + 1):
        pairs = sum(counts[k] * counts[n - k] for k in range(1, (n + 1) // 2))
        half = counts[n // 2]
        counts.append(pairs + (half * (half + 1) // 2 if n % 2 == 0 else 0))
    return counts


def products_of_monomials(order):
    counts, products = monomials(order), [1]
    for n in range(1, order + 1):
        products.append(sum(counts[k] * products[n - k] for k in range(1, n + 1)))
    return products[order]


@pytest.mark.parametrize("order", ORDERS)
def test_the_independent_trees_are_as_many_as_lyndon_words_in_monomials(order):
    counts = monomials(order)
    letters = [(n, k) for n in range(order, 0, -1) for k in range(counts[n])]
    expected = sum(1 for _ in lyndon_words(letters, order, weigh=lambda letter: letter[0]))
    assert len(independent_trees(order)) == expected


def test_at_order_six_two_rooted_trees_follow_from_the_others():
    assert [len(independent_trees(n)) for n in range(1, 7)] == [1, 1, 2, 4, 9, 18]
    assert len(tuple(rooted_trees(6))) == 20


@pytest.mark.parametrize("order", ORDERS)
def test_the_values_of_random_schemes_on_ordered_forests_follow_from_rooted_forests(order):
    ring, generator = Residues(samples=4), np.random.default_rng(order)
    assert not violations(ring, random_rows(ring, generator, order + 2), order)
    assert not violations(ring, random_rows(ring, generator, order + 2, zeros=(2,)), order)


@pytest.mark.parametrize("order", ORDERS)
def test_the_exact_flow_has_the_same_relations(order):
    for forest, row in in_rooted_forests(order).items():
        assert exact_value(forest) == sum(x * Fraction(1, density(u)) for u, x in row.items())


def test_a_method_with_other_exponentials_violates_the_relations():
    """A 2N scheme with one coefficient of one exponential changed."""
    ring, generator = Residues(samples=4), np.random.default_rng(3)
    rows = random_rows(ring, generator, 5)
    rows[3][1] = rows[3][1] + ring.one
    assert [len(violations(ring, rows, n)) > 0 for n in (1, 2, 3)] == [False, False, True]


def test_the_ranks_of_random_schemes_agree_with_the_independent_trees():
    """Ranks modulo a prime of the values of random 2N schemes on Lyndon words of ordered trees."""

    def series(ring, generator):
        return group_series(ring, random_rows(ring, generator, 9))

    found = independent_forests(series, [lyndon_forests(n) for n in range(1, 6)])
    assert [len(of_order) for of_order in found] == [1, 1, 2, 4, 9]


def test_the_weights_of_a_scheme_of_order_three_are_exact_on_ordered_forests():
    """Williamson's scheme with A = (0, -5/9, -153/128), B = (1/3, 15/16, 8/15)."""

    def rationals(*pairs):
        return [QQ.rational(p, q) for p, q in pairs]

    A, B = rationals((0, 1), (-5, 9), (-153, 128)), rationals((1, 3), (15, 16), (8, 15))
    series = group_series(QQ, registers(QQ, A, B))
    for n in (1, 2, 3):
        for forest in ordered_forests(n):
            expected = exact_value(forest)
            assert series(forest) == QQ.rational(expected.numerator, expected.denominator)
