"""The action series of commutator-free methods: group-like words, and rows written in several ways."""

from __future__ import annotations

from itertools import product

from orderconds.ring import QQ
from orderconds.series.action import CommutatorFreeSeries, crouch_grossman_rows
from orderconds.series.action_enumeration import velocities, words
from orderconds.series.action_trees import force, transport, velocity
from orderconds.words.shuffle import shuffle


def crouch_grossman(method):
    return CommutatorFreeSeries(QQ, crouch_grossman_rows(QQ, method.A, method.b))


def test_words_in_every_group_element_multiply_over_shuffles(random_tableau):
    series = crouch_grossman(random_tableau(2))
    for row in range(3):
        for u, v in product(words(1), words(2)):
            shuffled = sum(
                (times * series.coefficient(row, word) for word, times in shuffle(u, v).items()), QQ.zero
            )
            assert shuffled == series.coefficient(row, u) * series.coefficient(row, v)


def test_zero_coefficients_and_missing_ones_agree(random_tableau):
    method = random_tableau(2)
    A = ((QQ.zero, method.A[0][1]), method.A[1])
    sparse = CommutatorFreeSeries(QQ, crouch_grossman_rows(QQ, A, method.b))
    full = CommutatorFreeSeries(QQ, [tuple(((j, a),) for j, a in enumerate(row)) for row in (*A, method.b)])
    for n in range(1, 4):
        assert all(sparse.condition(tree) == full.condition(tree) for tree in velocities(n))


def test_an_exponential_split_in_two_of_the_same_stage_changes_nothing(random_tableau):
    method = random_tableau(2)
    rows = crouch_grossman_rows(QQ, method.A, method.b)
    halves = tuple(
        tuple(((stage, value / 2),) for ((stage, value),) in row for _ in range(2)) for row in rows
    )
    whole, split = CommutatorFreeSeries(QQ, rows), CommutatorFreeSeries(QQ, halves)
    for n in range(1, 4):
        assert all(whole.condition(tree) == split.condition(tree) for tree in velocities(n))


def test_the_first_trees_have_the_sums_of_their_definition(random_tableau):
    method = random_tableau(3)
    series, stages = crouch_grossman(method), range(3)
    b, A = method.b, method.A
    c = [sum(row, QQ.zero) for row in A]
    leaf = velocity()
    assert series.tau(velocity((leaf,))) == c
    # A force passes from stage j to stage i with the weight b_j a_ji / b_i.
    forces = [sum((b[j] * A[j][i] for j in stages), QQ.zero) / b[i] for i in stages]
    assert series.psi(force()) == forces
    # A transport by one letter sees the stages behind i, and half of stage i.
    behind = [sum(b[i + 1 :], QQ.zero) + b[i] / 2 for i in stages]
    assert series.psi(transport((leaf,))) == behind


def test_weights_are_the_sums_over_the_exponentials_of_the_update():
    one = QQ.one
    rows = ((), (), (((0, one), (1, -one)), ((1, 3 * one),)))
    assert CommutatorFreeSeries(QQ, rows).weights == (1, 2)
