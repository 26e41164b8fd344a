"""The exact flow's action series: shuffles, and the limit of many small steps."""

from __future__ import annotations

from fractions import Fraction
from itertools import product

from orderconds.ring import QQ
from orderconds.series import action_exact
from orderconds.series.action import CommutatorFreeSeries, crouch_grossman_rows
from orderconds.series.action_enumeration import velocities, words
from orderconds.series.action_trees import velocity
from orderconds.words.shuffle import shuffle


def test_words_of_the_flow_multiply_over_shuffles():
    for n, m in ((1, 1), (1, 2), (2, 2), (1, 3)):
        for u, v in product(words(n), words(m)):
            shuffled = sum(
                (times * action_exact.update(word) for word, times in shuffle(u, v).items()), Fraction(0)
            )
            assert shuffled == action_exact.update(u) * action_exact.update(v)


def test_leaves_alone_have_the_values_of_the_exponential():
    leaf, factorial = velocity(), 1
    for n in range(1, 8):
        factorial *= n
        assert action_exact.update((leaf,) * n) == Fraction(1, factorial)


def test_trees_without_momenta_have_the_values_of_iterated_integrals():
    # o(o o ... o) is the integral of s^n / n! over the unit interval.
    leaf, factorial = velocity(), 1
    for n in range(1, 7):
        factorial *= n
        assert action_exact.condition(velocity((leaf,) * n)) == Fraction(1, factorial * (n + 1))


def test_many_midpoint_steps_approach_the_flow():
    """A composition of N equal steps of a method of order 2 differs from the flow by O(1/N^2)."""

    def error(steps, tree):
        h = QQ.rational(1, steps)
        A = [[h if j < i else h / 2 if j == i else QQ.zero for j in range(steps)] for i in range(steps)]
        series = CommutatorFreeSeries(QQ, crouch_grossman_rows(QQ, A, [h] * steps))
        exact = action_exact.condition(tree)
        return abs(series.condition(tree) - QQ.rational(exact.numerator, exact.denominator))

    for tree in velocities(3):
        coarse, fine = error(3, tree), error(6, tree)
        # One term of the expansion in 1/N^2 suffices for trees with three vertices.
        assert fine * 4 == coarse
