"""The enumeration of action trees: every tree once, simplest first."""

from orderconds.series.action_enumeration import (
    momenta,
    multisets,
    velocities,
    velocities_in_turn,
    words,
)
from orderconds.series.action_trees import multiset


def test_counts_of_velocities_and_momenta_are_the_reference_counts():
    assert [len(velocities(n)) for n in range(1, 7)] == [1, 3, 17, 111, 813, 6331]
    assert [len(momenta(n)) for n in range(1, 6)] == [2, 8, 48, 328, 2456]


def test_enumeration_satisfies_the_functional_equation_of_words():
    # W = 1 / (1 - T)
    sizes = [len(words(n)) for n in range(6)]
    letters = [0, *(len(velocities(n)) for n in range(1, 6))]
    assert all(sizes[n] == sum(letters[k] * sizes[n - k] for k in range(1, n + 1)) for n in range(1, 6))


def test_every_tree_is_enumerated_once_and_has_its_own_text():
    for n in range(1, 6):
        for family in (velocities(n), momenta(n)):
            assert len({tree.text for tree in family}) == len(set(family)) == len(family)
            assert all(tree.vertices == n for tree in family)
        assert len(set(multisets(n))) == len(multisets(n))


def test_multisets_are_made_in_canonical_order():
    assert all(chosen == multiset(chosen) for n in range(6) for chosen in multisets(n))


def test_trees_in_turn_are_all_trees_in_the_same_order():
    for n in range(1, 6):
        assert tuple(velocities_in_turn(n)) == velocities(n)
        assert list(velocities(n)) == sorted(velocities(n), key=lambda tree: tree.key)


def test_the_cost_of_a_tree_bounds_that_of_its_parts():
    # What an enumeration up to a limit rests on.
    for tree in velocities(5):
        assert all(p.cost <= tree.cost for p in tree.momenta)
        assert all(t.nesting == (2 + 2 * t.cost if t.vertices > 1 else 0) <= tree.cost for t in tree.word)
