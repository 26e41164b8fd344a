"""The action series of single exponentials: group-like words, cuts beyond the word, the order of VRKMK."""

from __future__ import annotations

from itertools import product

import pytest

from orderconds.ring import QQ
from orderconds.series import action_exact
from orderconds.series.action_enumeration import velocities, words
from orderconds.series.action_lie import MuntheKaasActionSeries, PadeActionSeries, pade_terms
from orderconds.series.dexpinv import dexpinv_terms
from orderconds.tableau import Tableau, find
from orderconds.words.shuffle import shuffle


@pytest.mark.parametrize("kind", [MuntheKaasActionSeries, PadeActionSeries])
@pytest.mark.parametrize("cutoff", [0, 1, 2])
def test_words_in_every_group_element_multiply_over_shuffles(kind, cutoff, random_tableau):
    method = random_tableau(2)
    series = kind(QQ, method.A, method.b, cutoff)
    for row in range(3):
        for u, v in product(words(1), words(2)):
            shuffled = sum(
                (times * series.coefficient(row, word) for word, times in shuffle(u, v).items()), QQ.zero
            )
            assert shuffled == series.coefficient(row, u) * series.coefficient(row, v)


def test_a_cut_beyond_the_length_of_every_word_is_none(random_tableau):
    method = random_tableau(2)
    cut = MuntheKaasActionSeries(QQ, method.A, method.b, 4)
    whole = MuntheKaasActionSeries(QQ, method.A, method.b, None)
    for n in range(1, 5):
        assert all(cut.condition(tree) == whole.condition(tree) for tree in velocities(n))
    early = MuntheKaasActionSeries(QQ, method.A, method.b, 0)
    assert any(early.condition(tree) != whole.condition(tree) for tree in velocities(3))


def test_insertions_are_derivatives_of_words_in_the_velocity_of_a_stage(random_tableau):
    """Varying a letter that has the value one at every stage writes that letter between u and v."""
    method = random_tableau(2)
    series = MuntheKaasActionSeries(QQ, method.A, method.b, 1)
    leaf = velocities(1)[0]
    for before, after in ((0, 0), (1, 0), (0, 1), (1, 1)):
        u, v = (leaf,) * before, (leaf,) * after
        for row in range(3):
            varied = sum((series.insertion(row, stage, u, v) for stage in range(2)), QQ.zero)
            assert varied == series.coefficient(row, (*u, leaf, *v))


@pytest.mark.parametrize(("name", "cutoff", "order"), [("gauss2", 0, 2), ("gauss2", 1, 3), ("gauss2", 2, 4)])
def test_vrkmk_has_the_order_that_its_cut_allows(name, cutoff, order):
    tableau = Tableau.load(find(name))
    ring, method = tableau.ring, tableau.method
    series = MuntheKaasActionSeries(ring, method.A, method.b, cutoff)

    def agrees(n):
        exact = ((tree, action_exact.condition(tree)) for tree in velocities(n))
        return all(series.condition(t) == ring.rational(q.numerator, q.denominator) for t, q in exact)

    assert all(agrees(n) for n in range(1, order + 1))
    assert not agrees(order + 1)


def test_the_inverse_of_dexp_cut_after_many_powers_has_the_coefficients_of_dexpinv():
    for most in range(1, 6):
        assert pade_terms(most, most) == dexpinv_terms(most)
    assert pade_terms(1, 2) != dexpinv_terms(2)
