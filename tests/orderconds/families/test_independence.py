"""Independent sets are independent, and complete: ranks over a large prime on random methods."""

import numpy as np
import pytest

from orderconds import families
from orderconds.families.ordered_forests import lyndon_forests
from orderconds.ring import Residues
from orderconds.ring.rank import pivot_columns
from orderconds.ring.residues import PRIMES
from orderconds.series.lie_butcher_rank import independent_forests
from orderconds.series.monomials import products
from orderconds.tableau import CommutatorFree, RungeKutta, Stage
from orderconds.trees.counts import (
    directed_free_tree_count,
    lyndon_word_count,
    ordered_tree_count,
    rooted_tree_count,
)
from orderconds.trees.levels import text
from orderconds.trees.ordered import ordered_forests


def random_tableau(ring, generator, stages):
    A = tuple(tuple(ring.random(generator) for _ in range(stages)) for _ in range(stages))
    return RungeKutta(A, tuple(ring.random(generator) for _ in range(stages)))


def random_commutator_free(ring, generator):
    def product(exponentials):
        return Stage(
            None, tuple(tuple(ring.random(generator) for _ in range(3)) for _ in range(exponentials))
        )

    return CommutatorFree(tuple(product(2) for _ in range(3)), product(3))


def ranks(name, order, stages, samples):
    """Count, modulo products of lower ones, independent values among those listed and among all."""
    ring, family = Residues(PRIMES[0], samples), families.get(name)
    method = random_tableau(ring, np.random.default_rng(7), stages)
    generators, found, listed = [], [], []
    for n in range(1, order + 1):
        lower = list(products(generators, n))
        independent = family.evaluate(method, ring, family.conditions(n))
        everything = family.evaluate(method, ring, family.all_conditions(n))
        below = len(pivot_columns(lower))
        listed.append(len(pivot_columns([*lower, *independent])) - below)
        found.append(len(pivot_columns([*lower, *independent, *everything])) - below)
        generators += [(n, x) for x in independent]
    return listed, found


def test_rooted_trees_are_independent():
    count = [rooted_tree_count(n) for n in range(1, 7)]
    assert ranks("rk", 6, stages=6, samples=120) == (count, count)


def test_directed_free_trees_are_independent_and_give_all_symplectic_partitioned_conditions():
    count = [directed_free_tree_count(n) for n in range(1, 6)]
    assert ranks("sprk", 5, stages=5, samples=200) == (count, count)


def test_lyndon_words_are_independent_and_give_all_crouch_grossman_conditions():
    count = [lyndon_word_count(n, ordered_tree_count) for n in range(1, 6)]
    assert ranks("cg", 5, stages=5, samples=100) == (count, count)


def test_lyndon_words_are_independent_for_commutator_free_methods():
    family = families.get("cf")
    found = independent_forests(
        lambda ring, generator: family.series(random_commutator_free(ring, generator), ring),
        [lyndon_forests(n) for n in range(1, 6)],
    )
    assert list(map(len, found)) == [lyndon_word_count(n, ordered_tree_count) for n in range(1, 6)]


def test_lyndon_words_give_every_ordered_forest():
    family = families.get("cf")
    found = independent_forests(
        lambda ring, generator: family.series(random_commutator_free(ring, generator), ring),
        [[*lyndon_forests(n), *ordered_forests(n)] for n in range(1, 5)],
    )
    assert found == tuple(lyndon_forests(n) for n in range(1, 5))


@pytest.mark.parametrize(
    ("name", "unmet"),
    [("rkmk(0)", 3), ("rkmk(1)", 4), ("rkmk(2)", 6), ("rkmk(3)", 6), ("rkmk(4)", None), ("rkmk", None)],
)
def test_munthe_kaas_conditions_are_those_of_rooted_trees_and_one_that_no_tableau_meets(name, unmet):
    # Of the Lyndon words' conditions as many are essential as there are rooted trees; the one more, at order
    # R + 3 with R = 0, 1, 3, 3, 5, is where the cut of dexpinv shows, for every tableau.
    family = families.get(name)
    found = [len(family.essential_conditions(n)) for n in range(1, 7)]
    assert found == [rooted_tree_count(n) + (n == unmet) for n in range(1, 7)]
    assert {c.key for c in family.essential_conditions(5)} <= {c.key for c in family.conditions(5)}


def test_the_condition_that_rkmk_zero_cannot_meet_is_that_of_a_commutator():
    extra = families.get("rkmk(0)").essential_conditions(3)[-1]
    assert text(extra.key) == "[.] ."
    # The left-hand side is 1/2 for every tableau of order two.
    assert str(extra) == "(sum_i b_i c_i) (sum_i b_i) = 1/3"


@pytest.mark.parametrize(("cutoff", "order"), [(0, 2), (1, 3), (2, 5), (3, 5), (4, 7), (5, 7)])
def test_cutting_dexpinv_allows_no_higher_order_than_r_plus_two(cutoff, order):
    assert families.get("rkmk", cutoff=cutoff).highest_order(min(order + 1, 7)) == order


@pytest.mark.slow
@pytest.mark.parametrize("cutoff", [4, 5])
def test_cutting_dexpinv_after_the_fourth_or_fifth_power_leaves_order_seven(cutoff):
    assert families.get("rkmk", cutoff=cutoff).highest_order(8) == 7
    assert families.get("rkmk", cutoff=6).highest_order(8) == 8
    with pytest.raises(ValueError, match="expected at most 8"):
        families.get("rkmk", cutoff=6).highest_order(9)
