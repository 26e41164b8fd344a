"""Root switching: equal conditions for every method and for the flow."""

from flint import fmpq

from orderconds.ring import QQ
from orderconds.series import action_exact
from orderconds.series.action import CommutatorFreeSeries, crouch_grossman_rows
from orderconds.series.action_counts import class_count
from orderconds.series.action_enumeration import velocities
from orderconds.series.action_switching import representatives, switched


def test_switching_the_root_changes_neither_method_nor_flow():
    A = [[fmpq(1, 3), fmpq(-2), fmpq(3, 5)], [fmpq(4), fmpq(1, 7), fmpq(-1)], [fmpq(2, 9), fmpq(5), fmpq(1)]]
    series = CommutatorFreeSeries(QQ, crouch_grossman_rows(QQ, A, [fmpq(1, 2), fmpq(-3), fmpq(2, 7)]))
    for n in range(1, 5):
        for tree in velocities(n):
            for other in switched(tree):
                assert other.vertices == n
                assert series.condition(other) == series.condition(tree)
                assert action_exact.condition(other) == action_exact.condition(tree)


def test_switching_is_symmetric():
    for tree in velocities(4):
        assert all(tree in switched(other) for other in switched(tree))


def test_representatives_are_simplest_of_their_classes_and_few():
    assert [len(representatives(n)) for n in range(1, 7)] == [1, 2, 10, 58, 398, 2946]
    assert [class_count(n) for n in range(1, 7)] == [len(representatives(n)) for n in range(1, 7)]
    for n in range(1, 5):
        assert all(tree.key <= other.key for tree in representatives(n) for other in switched(tree))
