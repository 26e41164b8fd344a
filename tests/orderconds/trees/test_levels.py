"""Level sequences: texts, density, symmetry, roots."""

from itertools import permutations, product

import pytest

from orderconds.errors import InputError
from orderconds.trees.levels import (
    branches,
    canonical,
    children,
    density,
    parse,
    rooted_at_new_vertex,
    symmetry,
    text,
    trees_of,
)
from orderconds.trees.ordered import ordered_forests, ordered_trees
from orderconds.trees.rooted import rooted_trees


def test_adding_and_removing_a_root_are_inverse():
    for forest in ordered_forests(6):
        assert b"".join(children(rooted_at_new_vertex(forest))) == forest


@pytest.mark.parametrize("vertices", range(8))
def test_brackets_are_read_as_they_are_written(vertices):
    for forest in ordered_forests(vertices):
        assert parse(text(forest)) == forest


@pytest.mark.parametrize("written", ["[", "]", "[]", "[.", ".]", "[[.]", "a", "[.]]", "." * 2000])
def test_anything_but_balanced_brackets_is_refused(written):
    with pytest.raises(InputError):
        parse(written)


@pytest.mark.parametrize("written", ["[" * 249 + "." + "]" * 249, ", ".join(["."] * 250)])
def test_a_tree_has_at_most_250_vertices(written):
    assert len(parse(written)) == 250
    with pytest.raises(InputError, match="at most 250 vertices"):
        parse(f"[{written}]")


@pytest.mark.parametrize("vertices", range(1, 8))
def test_density_is_the_number_of_vertices_times_that_of_the_branches(vertices):
    for tree in ordered_trees(vertices):
        assert density(tree) == vertices * density(branches(tree))


@pytest.mark.parametrize("vertices", range(1, 7))
def test_symmetry_counts_the_orderings_of_branches_that_change_nothing(vertices):
    def listed(tree):
        """Every order of the branches at every vertex, repeated where equal branches change places."""
        below = [list(listed(child)) for child in children(tree)]
        for order in permutations(range(len(below))):
            for chosen in product(*(below[place] for place in order)):
                yield rooted_at_new_vertex(b"".join(chosen))

    for tree in rooted_trees(vertices):
        assert sum(1 for drawing in listed(tree) if drawing == tree) == symmetry(tree)


def test_canonical_is_the_greatest_of_all_orderings_and_idempotent():
    for tree in ordered_trees(6):
        assert canonical(canonical(tree)) == canonical(tree)
        assert canonical(tree) == max(t for t in ordered_trees(6) if canonical(t) == canonical(tree))


def test_trees_of_a_forest_join_to_the_forest():
    for forest in ordered_forests(6):
        assert b"".join(trees_of(forest)) == forest
        assert all(tree[0] == 0 and tree.count(0) == 1 for tree in trees_of(forest))
