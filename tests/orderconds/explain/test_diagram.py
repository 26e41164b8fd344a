"""Diagrams keep the vertices, edges and branches of the trees they are made from."""

from __future__ import annotations

import pytest

from orderconds.explain.diagram import Diagram, Vertex, action, coloured, plain, with_directions, word
from orderconds.series.action_enumeration import velocities
from orderconds.series.action_trees import force, transport, velocity
from orderconds.trees.bicoloured import bicoloured_rooted_trees
from orderconds.trees.directed import directed_rooted_trees
from orderconds.trees.ordered import ordered_forests
from orderconds.words.lyndon import lyndon_words

LEAF = velocity()


def vertices(diagram: Diagram) -> list[Vertex]:
    return [v for root in diagram for v in (root, *vertices(tuple(b.vertex for b in root.branches)))]


def levels(diagram: Diagram, level: int = 0) -> bytes:
    """The level sequence of a forest, read back from its diagram."""
    below = (levels(tuple(b.vertex for b in root.branches), level + 1) for root in diagram)
    return b"".join(bytes((level,)) + rest for rest in below)


@pytest.mark.parametrize("order", range(1, 7))
def test_level_sequences_are_read_back_from_diagrams(order: int) -> None:
    for forest in ordered_forests(order):
        assert levels(plain(forest)) == forest


@pytest.mark.parametrize("order", range(1, 5))
def test_colours_and_directions_are_those_of_the_encoding(order: int) -> None:
    for tree in bicoloured_rooted_trees(order):
        signs = [vertex.sign for vertex in vertices(coloured(tree))]
        assert signs == ["white" if level % 2 else "black" for level in tree]
    for tree in directed_rooted_trees(order):
        edges = [branch.edge for vertex in vertices(with_directions(tree)) for branch in vertex.branches]
        assert edges.count("inward") == sum(level % 2 for level in tree[1:])
        assert edges.count("outward") == sum(1 - level % 2 for level in tree[1:])


def test_transports_are_no_copies_of_the_hamiltonian() -> None:
    for tree in velocities(4):
        signs = [vertex.sign for vertex in vertices(action(tree))]
        assert signs.count("dot") == 4
        assert signs.count("transport") == str(tree).count("L(")


def test_the_place_of_a_force_counts_the_letters_before_it() -> None:
    tree = velocity((), (force((LEAF,), (LEAF, LEAF), (transport((LEAF,)),)),))
    (branch,) = action(tree)[0].branches
    assert (branch.edge, branch.vertex.legs) == ("inward", (1, 3))
    assert [inner.edge for inner in branch.vertex.branches] == ["outward", "outward", "outward", "inward"]
    assert action(velocity((), (force(),)))[0].branches[0].vertex.legs is None


def test_lyndon_words_become_binary_trees_of_brackets() -> None:
    for letters in lyndon_words((0, 1), 6):
        (root,) = word(letters, "AB".__getitem__)
        every = vertices((root,))
        assert "".join(v.label for v in every if v.sign == "letter") == "".join("AB"[k] for k in letters)
        assert all(len(v.branches) == 2 for v in every if v.sign == "bracket")
        assert root.size == 2 * len(letters) - 1
