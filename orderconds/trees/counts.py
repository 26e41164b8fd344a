"""Numbers of trees, computed from generating functions without enumerating the trees.

The sequences are A000055, A000081, A000108, A000151 and A000238 of the OEIS. HLW denotes Hairer, Lubich and
Wanner, *Geometric Numerical Integration*.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import comb


def euler_transform(counts: Sequence[int]) -> tuple[int, ...]:
    """Return the Euler transform of a sequence. Entry k - 1 of ``counts`` is the number of different elements
    of weight k. Entry k - 1 of the result is the number of multisets of these elements with the total weight
    k.

    >>> euler_transform([1, 1, 1, 1])
    (1, 2, 3, 5)
    """
    divided = [
        sum(d * counts[d - 1] for d in range(1, n + 1) if n % d == 0) for n in range(1, len(counts) + 1)
    ]
    multisets = [1]
    for n in range(1, len(counts) + 1):
        multisets.append(sum(divided[k - 1] * multisets[n - k] for k in range(1, n + 1)) // n)
    return tuple(multisets[1:])


def rooted_tree_count(vertices: int, kinds: int = 1) -> int:
    """Return the number of rooted trees with ``vertices`` vertices and ``kinds`` kinds of edges. The
    sequences are A000081 of the OEIS for one kind, and A000151 for two kinds.

    >>> [rooted_tree_count(n) for n in range(1, 9)], [rooted_tree_count(n, kinds=2) for n in range(1, 7)]
    ([1, 1, 2, 4, 9, 20, 48, 115], [1, 2, 7, 26, 107, 458])
    """
    counts = [1]
    while len(counts) < vertices:
        counts = [1, *euler_transform([kinds * count for count in counts])]
    return counts[vertices - 1] if vertices > 0 else 0


def ordered_tree_count(vertices: int) -> int:
    """Return the number of ordered trees, a Catalan number (A000108).

    >>> [ordered_tree_count(n) for n in range(1, 9)]
    [1, 1, 2, 5, 14, 42, 132, 429]
    """
    return comb(2 * vertices - 2, vertices - 1) // vertices if vertices > 0 else 0


def ordered_forest_count(vertices: int) -> int:
    """Return the number of ordered forests with ``vertices`` vertices. The result is also the number of
    ordered trees with one more vertex, because a forest becomes a tree if a common root is added.

    >>> [ordered_forest_count(n) for n in range(6)]
    [1, 1, 2, 5, 14, 42]
    """
    return ordered_tree_count(vertices + 1)


def free_tree_count(vertices: int) -> int:
    """Return the number of free trees with n = ``vertices`` vertices (A000055).

    Let r(n) be the number of rooted trees with n vertices, and let r(n/2) be zero for odd n. Otter's formula
    for the number of free trees is r(n) - 1/2 (sum_{0<k<n} r(k) r(n - k) - r(n/2)).

    >>> [free_tree_count(n) for n in range(1, 11)]
    [1, 1, 1, 2, 3, 6, 11, 23, 47, 106]
    """
    rooted = [rooted_tree_count(n) for n in range(vertices + 1)]
    at_edges = sum(rooted[k] * rooted[vertices - k] for k in range(1, vertices))
    return rooted[vertices] - (at_edges - _in_equal_halves(vertices)) // 2


def essential_free_tree_count(vertices: int) -> int:
    """Return the number of free trees with the given number of vertices. Trees that consist of two equal
    rooted trees and an edge between their roots are not counted (Hairer, Lubich and Wanner, *Geometric
    Numerical Integration*, VI.7.1, Table 7.1).

    >>> [essential_free_tree_count(n) for n in range(1, 11)]
    [1, 0, 1, 1, 3, 4, 11, 19, 47, 97]
    """
    return free_tree_count(vertices) - _in_equal_halves(vertices)


def alternating_free_tree_count(vertices: int) -> int:
    """Return the number of free trees with two colours in which neighbours differ in colour.

    The two colourings of a tree count as one if a symmetry of the tree exchanges the colours.

    >>> [alternating_free_tree_count(n) for n in range(1, 9)]
    [2, 1, 2, 3, 6, 10, 22, 42]
    """
    return 2 * free_tree_count(vertices) - _in_equal_halves(vertices)


def _in_equal_halves(vertices: int) -> int:
    """Return the number of free trees that consist of two equal rooted trees and an edge between the two
    roots."""
    return rooted_tree_count(vertices // 2) if vertices % 2 == 0 else 0


def directed_free_tree_count(vertices: int) -> int:
    """Return the number of free trees with directed edges (A000238). By Otter's theorem, the result is
    the number of trees with a distinguished vertex minus the number of trees with a distinguished edge.

    >>> [directed_free_tree_count(n) for n in range(1, 9)]
    [1, 1, 3, 8, 27, 91, 350, 1376]
    """
    rooted = [rooted_tree_count(n, kinds=2) for n in range(vertices + 1)]
    return rooted[vertices] - sum(rooted[k] * rooted[vertices - k] for k in range(1, vertices))


def lyndon_word_count(weight: int, letters: Callable[[int], int]) -> int:
    """Return the number of Lyndon words of a given weight. ``letters(k)`` is the number of letters of weight
    k.

    Let L(n) be the number of Lyndon words of weight n. The product of (1 - x^n)^(-L(n)) over all n is equal
    to 1/(1 - sum_k letters(k) x^k), the generating function of all words.

    >>> [lyndon_word_count(n, ordered_tree_count) for n in range(1, 10)]
    [1, 1, 3, 8, 25, 75, 245, 800, 2700]
    """
    words = [1]
    for n in range(1, weight + 1):
        words.append(sum(letters(k) * words[n - k] for k in range(1, n + 1)))
    lyndon: list[int] = []
    for n in range(1, weight + 1):
        lyndon.append(words[n] - euler_transform([*lyndon, 0])[-1])
    return lyndon[-1] if lyndon else 0
