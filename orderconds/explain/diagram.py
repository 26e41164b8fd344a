"""Diagrams of trees. A diagram has vertices and edges, and the branches of a vertex are ordered.

The symbols of the vertices are:

- *dot*: a vertex of a tree with one colour. In an action tree, a dot is a derivative of the Hamiltonian.
- *black* or *white*: a vertex of a tree with two colours.
- *transport*: a coadjoint action in an action tree.
- *letter*: a letter of a word.
- *bracket*: the Lie bracket of the two branches of the vertex.

An edge is *plain*, *outward* or *inward*. Outward and inward edges occur in action trees and in the trees of
:mod:`orderconds.trees.directed`. They represent the coefficients a_ij and ahat_ij of a partitioned method.

- *outward*: the edge points from the parent to the child and represents a coefficient a_ij. The child is a
  velocity: a derivative of the Hamiltonian with respect to the momentum. The momentum is called p or mu.
- *inward*: the edge points from the child to the parent and represents a coefficient ahat_ij. The child is a
  coadjoint action or a force. A force is a derivative of the Hamiltonian with respect to q.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Literal

from orderconds.series.action_trees import Force, Momentum, Velocity
from orderconds.trees import bicoloured, directed, levels
from orderconds.words.lie import Bracket, standard_bracketing
from orderconds.words.lyndon import is_lyndon
from orderconds.words.shuffle import Letter, Word

Sign = Literal["dot", "black", "white", "transport", "bracket", "letter"]
Edge = Literal["plain", "inward", "outward"]


@dataclass(frozen=True)
class Branch:
    """A branch of a vertex: an edge, and the vertex at the other end of the edge.

    >>> Branch("outward", Vertex("dot")).edge
    'outward'
    """

    edge: Edge
    vertex: Vertex


@dataclass(frozen=True)
class Vertex:
    """A vertex with its branches from left to right.

    If ``sign`` is ``letter``, ``label`` is the printed text of the letter. Otherwise ``label`` is empty.

    The module docstring defines forces and outward edges. For a force with at least one outward edge,
    ``legs`` is a pair (m, n), where n is the number of outward edges. From left to right, the force has m
    outward edges, then the edge to the parent, and then the other n - m outward edges. For all other
    vertices, ``legs`` is None.

    >>> Vertex("dot", (Branch("plain", Vertex("dot")),)).size
    2
    """

    sign: Sign
    branches: tuple[Branch, ...] = ()
    legs: tuple[int, int] | None = None
    label: str = ""

    @property
    def size(self) -> int:
        """The number of vertices in the tree whose root is this vertex."""
        return 1 + sum(branch.vertex.size for branch in self.branches)


Diagram = tuple[Vertex, ...]
"""The root vertices of a diagram, from left to right. Only the diagram of a word or forest may have several
roots."""


def plain(forest: levels.Forest) -> Diagram:
    r"""Return the diagram of a rooted or ordered tree, or of a forest of such trees.

    The argument contains the level of each vertex in one byte. Roots have level 0.

    >>> plain(b"\0\0")[1]
    Vertex(sign='dot', branches=(), legs=None, label='')
    """
    return tuple(
        Vertex("dot", tuple(Branch("plain", v) for v in plain(levels.branches(tree))))
        for tree in levels.trees_of(forest)
    )


def coloured(tree: bicoloured.BicolouredTree) -> Diagram:
    r"""Return the diagram of a tree with vertices of two colours.

    >>> coloured(b"\1")
    (Vertex(sign='white', branches=(), legs=None, label=''),)
    """
    below = tuple(Branch("plain", coloured(child)[0]) for child in bicoloured.children(tree))
    return (Vertex("white" if tree[0] else "black", below),)


def with_directions(tree: directed.DirectedTree) -> Diagram:
    r"""Return the diagram of a tree with directed edges.

    >>> [branch.edge for branch in with_directions(b"\0\2\3")[0].branches]
    ['outward', 'inward']
    """
    edges: tuple[Edge, Edge] = ("outward", "inward")
    below = (Branch(edges[kind], with_directions(child)[0]) for kind, child in directed.branches(tree))
    return (Vertex("dot", tuple(below)),)


def action(tree: Velocity) -> Diagram:
    """Return the diagram of an action tree. Branches with velocities are to the left of all other branches.

    >>> from orderconds.series.action_trees import force, velocity
    >>> [branch.edge for branch in action(velocity((velocity(),), (force(),)))[0].branches]
    ['outward', 'inward']
    """
    return (Vertex("dot", (*_letters(tree.word), *_covectors(tree.momenta))),)


def word(letters: Word, name: Callable[[Letter], str]) -> Diagram:
    """Return the diagram of a word. The diagram of a Lyndon word is the binary tree of its standard
    bracketing. The diagram of any other word is a sequence of letters.

    >>> [vertex.sign for vertex in word((1, 2), str)], [vertex.label for vertex in word((2, 1), str)]
    (['bracket'], ['2', '1'])
    """
    if is_lyndon(letters):
        return (_bracketed(standard_bracketing(letters), name),)
    return tuple(Vertex("letter", label=name(letter)) for letter in letters)


def _bracketed(bracket: Bracket, name: Callable[[Letter], str]) -> Vertex:
    if not isinstance(bracket, tuple):
        return Vertex("letter", label=name(bracket))
    return Vertex("bracket", tuple(Branch("plain", _bracketed(part, name)) for part in bracket))


def _letters(trees: Iterable[Velocity]) -> Iterator[Branch]:
    for tree in trees:
        yield Branch("outward", action(tree)[0])


def _covectors(trees: Iterable[Momentum]) -> Iterator[Branch]:
    for tree in trees:
        if isinstance(tree, Force):
            letters = tree.before + tree.after
            place = (len(tree.before), len(letters)) if letters else None
            branches = (*_letters(letters), *_covectors(tree.momenta))
            yield Branch("inward", Vertex("dot", branches, place))
        else:
            yield Branch("inward", Vertex("transport", tuple(_letters(tree.word))))
