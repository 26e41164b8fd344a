"""Enumeration of the action trees with a given number of vertices, simplest trees first.

A g-valued tree denotes an element of the Lie algebra g. A g*-valued tree denotes an element of the dual g*.
Each vertex of a tree represents a derivative of the Hamiltonian H.

The cost of a tree measures how difficult its order condition is to read. The cost of a subtree is at most the
cost of the whole tree. The trees are enumerated in several passes with increasing limits on the cost. Later
passes are rarely necessary.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cache

from orderconds.series.action_trees import (
    Momenta,
    Momentum,
    Velocity,
    Word,
    canonical_force,
    canonical_velocity,
    force_cost,
    mixing,
    transport,
    transport_cost,
)

LIMITS = (8, 16, 32, 64, math.inf)
"""The trees are enumerated in several passes. For each pass, the tuple contains an upper bound of the cost of
a tree. The cost measures how difficult the order condition of the tree is to read."""


def velocities_in_turn(vertices: int) -> Iterator[Velocity]:
    """Yield all g-valued trees with ``vertices`` vertices, simplest first.

    >>> next(velocities_in_turn(12)).vertices
    12
    """
    reached = -1.0
    for limit in LIMITS:
        band = [tree for tree in _velocities(vertices, limit) if tree.cost > reached]
        yield from sorted(band, key=lambda tree: tree.key)
        reached = limit


@cache
def velocities(vertices: int) -> tuple[Velocity, ...]:
    """Return all g-valued trees with ``vertices`` vertices, sorted by the attribute ``key``.

    >>> [len(velocities(n)) for n in range(1, 5)]
    [1, 3, 17, 111]
    >>> velocities(2)
    (o(o), o(|f(*)), o(|L(o)))
    """
    return tuple(sorted(_velocities(vertices, math.inf), key=lambda tree: tree.key))


def words(vertices: int) -> tuple[Word, ...]:
    """Return all words with ``vertices`` vertices in total, simplest first. A word is a sequence of g-valued
    trees.

    >>> words(2)
    ((o, o), (o(o),), (o(|f(*)),), (o(|L(o)),))
    """
    return tuple(word for _, word in _words(vertices, math.inf))


def momenta(vertices: int) -> Momenta:
    """Return all g*-valued trees with ``vertices`` vertices, simplest first.

    >>> [len(momenta(n)) for n in range(1, 5)]
    [2, 8, 48, 328]
    """
    return _momenta(vertices, math.inf)


def multisets(vertices: int) -> tuple[Momenta, ...]:
    """Return all multisets of g*-valued trees with ``vertices`` vertices in total. The trees of each multiset
    are in canonical order.

    >>> multisets(1)
    ((f(*),), (L(o),))
    """
    return tuple(chosen for _, chosen in _multisets(vertices, math.inf))


@cache
def _velocities(vertices: int, limit: float) -> tuple[Velocity, ...]:
    trees = []
    for k in range(vertices):
        for cost, word in _words(k, limit):
            rest = limit - cost - mixing(word)
            for more, chosen in _multisets(vertices - 1 - k, limit) if rest >= 0 else ():
                if more > rest:
                    break
                trees.append(canonical_velocity(word, chosen))
    return tuple(trees)


@cache
def _words(vertices: int, limit: float) -> tuple[tuple[int, Word], ...]:
    """Return pairs (cost, word), sorted by cost. A word is a sequence of g-valued trees with ``vertices``
    vertices in total. The cost of a word is the sum of the attributes ``nesting`` of its trees, and is at
    most ``limit``."""
    if vertices == 0:
        return ((0, ()),)
    words = []
    for k in range(1, vertices + 1):
        letters = _letters(k, limit)
        for cost, start in _words(vertices - k, limit):
            for more, letter in letters:
                if cost + more > limit:
                    break
                words.append((cost + more, (*start, letter)))
    return tuple(sorted(words, key=lambda item: item[0]))


@cache
def _letters(vertices: int, limit: float) -> tuple[tuple[int, Velocity], ...]:
    """Return pairs (added cost, tree) for g-valued trees with ``vertices`` vertices, sorted by cost. The
    added cost is the amount that the tree adds to the cost of a word. It is at most ``limit``."""
    inner = limit if vertices == 1 else (limit - 2) / 2
    if inner < 0:
        return ()
    letters = sorted(_velocities(vertices, inner), key=lambda tree: tree.key)
    return tuple((letter.nesting, letter) for letter in letters)


@cache
def _momenta(vertices: int, limit: float) -> Momenta:
    """Return all g*-valued trees with ``vertices`` vertices whose cost (the attribute ``cost``) is at most
    ``limit``, sorted by cost."""
    trees: list[Momentum] = []
    for j in range(vertices):
        for nested, before in _words(j, limit):
            if nested + 3 > limit:
                break
            for k in range(vertices - j):
                for _, after in _words(k, limit):
                    rest = limit - force_cost(before, after)
                    for cost, others in _multisets(vertices - 1 - j - k, limit) if rest >= 0 else ():
                        if cost > rest:
                            break
                        trees.append(canonical_force(before, after, others))
    trees += [transport(word) for _, word in _words(vertices, limit) if transport_cost(word) <= limit]
    return tuple(sorted(trees, key=lambda tree: tree.key))


@cache
def _multisets(vertices: int, limit: float) -> tuple[tuple[int, Momenta], ...]:
    """Return pairs (cost, multiset), sorted by cost. The cost is at most ``limit``. The trees in a
    multiset have ``vertices`` vertices in total. The cost of a multiset is the sum of the costs of its
    trees."""
    return tuple(sorted(_chosen(vertices, vertices, None, limit, limit), key=lambda item: item[0]))


def _chosen(
    vertices: int, largest: int, bound: int | None, limit: float, rest: float
) -> Iterator[tuple[int, Momenta]]:
    """Yield pairs (cost, multiset), without repetitions.

    The elements of each multiset are g*-valued trees that have ``vertices`` vertices in total. The cost of a
    multiset is at most ``rest``. Each element has at most ``largest`` vertices, and its cost is at most
    ``limit``.
    """
    if vertices == 0:
        yield 0, ()
        return
    for size in range(1, min(vertices, largest) + 1):
        places = _momenta(size, limit)
        stop = len(places) if bound is None or size < largest else bound + 1
        for place, last in enumerate(places[:stop]):
            if last.cost > rest:
                break
            for cost, others in _chosen(vertices - size, size, place, limit, rest - last.cost):
                yield cost + last.cost, (*others, last)
