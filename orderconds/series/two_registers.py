"""Series of two-register (2N) Runge-Kutta schemes, on a group and on a vector space.

The registers are y and k, where k is zero at the start of a step. Stage i replaces k by A_i k + h f(y), and
then replaces y by exp(B_i k) y. The series of a step is a linear combination of words in the letters K and D.
The letter K (kick) is the derivative along the vector field k' = f(y). The letter D (drift) is the derivative
along the vector field y' = k y. The last letter of a word acts first. Only the words that :func:`words`
returns contribute to the series (docs/explanation/two_registers.md).

Each word denotes a differential operator. A linear combination of these operators vanishes on all groups if
and only if it vanishes on all vector spaces (proof: docs/explanation/two_registers.md). Hence the order of a
2N scheme on groups equals its order on vector spaces.

On a group, a 2N scheme has a Lie-Butcher series. On a vector space, the scheme has elementary weights: one
number for each rooted tree. Each coefficient of the Lie-Butcher series is a linear combination of products of
elementary weights. This linear combination has the same coefficients for all 2N schemes.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Iterator, Mapping
from fractions import Fraction
from functools import lru_cache
from itertools import combinations_with_replacement
from typing import TypeAlias

from orderconds.ring.rational_matrix import kernel
from orderconds.trees.levels import Forest, Tree, canonical, rooted_at_new_vertex, symmetry, trees_of
from orderconds.trees.rooted import rooted_trees

Operator: TypeAlias = "tuple[Operator | None, ...]"
"""A product of derivatives along vector fields. Each entry of the tuple denotes one factor, and the first
entry denotes the leftmost factor. Let y' = f(y) y be a differential equation, and let k be a constant element
of the Lie algebra.

- The entry None denotes the derivative along the vector field of the equation y' = k y.
- The entry () denotes the derivative along the vector field of the equation y' = f(y) y.
- The entry (None,) denotes the derivative along the vector field of the equation y' = g(y) y. Here g is the
  derivative of f along the vector field of the equation y' = k y.
- In general, let the entry be a tuple e. The tuple e is a product of derivatives, too. Apply this product to
  f, and let g be the result. The entry denotes the derivative along the vector field of the equation
  y' = g(y) y.
"""

Combination = dict[Operator, int]


def words(order: int) -> tuple[str, ...]:
    """Return all words in the letters K (kick) and D (drift) with two properties: each letter occurs
    ``order`` times, and no suffix contains more letters K than letters D.

    >>> words(2)
    ('KKDD', 'KDKD')
    """

    def extend(suffix: str, drifts: int, kicks: int) -> Iterator[str]:
        if drifts == kicks == order:
            yield suffix
        if drifts < order:
            yield from extend("D" + suffix, drifts + 1, kicks)
        if kicks < drifts:
            yield from extend("K" + suffix, drifts, kicks + 1)

    return tuple(extend("", 0, 0))


def on_group(word: str) -> dict[Forest, int]:
    """Return the series of ``word`` on a group, as a map from ordered forests to coefficients. The letters
    of ``word`` are K (kick) and D (drift).

    >>> from orderconds.trees.levels import text
    >>> {text(forest): n for forest, n in on_group("KDKD").items()}
    {'. .': 1, '[.]': 1}
    """
    return {_levels(product): n for product, n in _applied(word, True).items()}


def on_vector_space(word: str) -> dict[Forest, int]:
    """Apply :func:`unordered` to the keys of ``on_group(word)``, and add the coefficients of equal forests.
    Return the resulting map. On a vector space, the order of branches and trees has no effect.

    >>> from orderconds.trees.levels import text
    >>> {text(forest): n for forest, n in on_vector_space("KDKDKD").items()}
    {'. . .': 1, '[.] .': 3, '[..]': 1, '[[.]]': 1}
    """
    return {unordered(_levels(product)): n for product, n in _applied(word, False).items()}


def unordered(forest: Forest) -> Forest:
    r"""Sort the branches and the trees of an ordered forest. The resulting trees are canonical and sorted by
    level sequence, the greatest first.

    >>> unordered(b"\0\0\1")
    b'\x00\x01\x00'
    """
    return b"".join(sorted(map(canonical, trees_of(forest)), reverse=True))


def rooted_forests(order: int) -> tuple[Forest, ...]:
    """Return the forests of rooted trees with ``order`` vertices in total. The forests are sorted by the
    number of trees, the largest number first.

    >>> from orderconds.trees.levels import text
    >>> [text(forest) for forest in rooted_forests(3)]
    ['. . .', '[.] .', '[[.]]', '[..]']
    """

    def extend(left: int, largest: int) -> Iterator[Forest]:
        if left == 0:
            yield b""
        for vertices in range(min(left, largest), 0, -1):
            trees = tuple(rooted_trees(vertices))
            for count in range(left // vertices, 0, -1):
                for chosen in combinations_with_replacement(trees, count):
                    for rest in extend(left - count * vertices, vertices - 1):
                        yield b"".join(chosen) + rest

    forests = {unordered(forest): None for forest in extend(order, order)}
    return tuple(sorted(forests, key=lambda forest: -len(trees_of(forest))))


@lru_cache(maxsize=16)
def independent_trees(order: int) -> tuple[Tree, ...]:
    """Return a selection of the rooted trees with ``order`` vertices. For two-register (2N) schemes, the
    elementary weights of all other trees with ``order`` vertices are functions of the elementary weights of
    the selected trees and of the trees with fewer vertices.

    >>> [len(independent_trees(n)) for n in range(1, 6)], len(tuple(rooted_trees(5)))
    ([1, 1, 2, 4, 9], 9)
    """
    forests = rooted_forests(order)
    rows = [[operator.get(u, 0) for u in forests] for operator in map(on_vector_space, words(order))]
    dependent = {vector[0][0] for vector in kernel(rows, len(forests))}
    trees = {u for place, u in enumerate(forests) if place not in dependent and len(trees_of(u)) == 1}
    return tuple(tree for tree in rooted_trees(order) if tree in trees)


@lru_cache(maxsize=16)
def in_rooted_forests(order: int) -> Mapping[Forest, Mapping[Forest, Fraction]]:
    """Return formulas for the Lie-Butcher series of two-register (2N) schemes: one formula for the
    coefficient of each ordered forest with ``order`` vertices.

    The value of a rooted forest is the product of the elementary weights of its trees. A formula is a map
    from rooted forests u to numbers x_u. The formula denotes the sum of x_u times the value of u. The result
    is valid for every 2N scheme and for the exact flow. Raises ValueError if a coefficient is not a linear
    combination of values.

    >>> from orderconds.trees.levels import text
    >>> {text(w): {text(u): str(x) for u, x in row.items()} for w, row in in_rooted_forests(2).items()}
    {'[.]': {'[.]': '1'}, '. .': {'. .': '1/2'}}
    """
    from orderconds.trees.ordered import ordered_forests

    rooted, ordered, both = rooted_forests(order), tuple(ordered_forests(order)), words(order)
    left, right = [on_vector_space(word) for word in both], [on_group(word) for word in both]
    rows = [
        [*(x.get(u, 0) for u in rooted), *(y.get(w, 0) for w in ordered)]
        for x, y in zip(left, right, strict=True)
    ]
    relations: dict[Forest, dict[Forest, Fraction]] = {}
    for (place, _), *rest in kernel(rows, len(rooted) + len(ordered)):
        if place >= len(rooted):
            if any(pivot >= len(rooted) for pivot, _ in rest):
                raise ValueError(
                    f"a Lie-Butcher coefficient of order {order} is not a polynomial in the elementary"
                    " weights"
                )
            relations[ordered[place - len(rooted)]] = {rooted[p]: -x / _symmetry(rooted[p]) for p, x in rest}
    if len(relations) < len(ordered):
        raise ValueError(
            f"only {len(relations)} of {len(ordered)} Lie-Butcher coefficients are polynomials in the"
            " elementary weights"
        )
    return {forest: relations[forest] for forest in ordered}


def _symmetry(forest: Forest) -> int:
    """Return the order of the symmetry group of a forest."""
    return symmetry(rooted_at_new_vertex(forest))


@lru_cache(maxsize=1 << 12)
def _applied(word: str, ordered: bool) -> Combination:
    """Return the operator that ``word`` denotes, as a linear combination of products of derivatives.
    ``ordered`` is false if the derivatives commute, as on a vector space."""
    result: dict[Operator, int] = defaultdict(int)
    if not word:
        return {(): 1}
    act = _drift if word[0] == "D" else _kick
    for product, n in _applied(word[1:], ordered).items():
        for image, m in act(product, ordered).items():
            result[image] += n * m
    return dict(result)


@lru_cache(maxsize=1 << 16)
def _drift(product: Operator, ordered: bool) -> Combination:
    """Apply the operator D (drift) to ``product``, a product of derivatives along vector fields
    (:data:`Operator`). D is the derivative along the vector field y' = k y. Each factor of ``product`` is the
    derivative along a vector field y' = g(y) y. By the product rule, the result is a sum. In the first term,
    all functions g are treated as constants, and D becomes a new leftmost factor. In each other term, D is
    applied to the function g of one factor."""
    result = Counter({_arranged((None, *product), ordered): 1})
    result.update(_within(product, _drift, ordered))
    return dict(result)


@lru_cache(maxsize=1 << 16)
def _kick(product: Operator, ordered: bool) -> Combination:
    """Apply the operator K (kick) to ``product``, a product of derivatives along vector fields
    (:data:`Operator`). K is the derivative along the vector field k' = f(y). The factors can be nested
    tuples. At every depth, None denotes the derivative along the vector field y' = k y, and () denotes the
    derivative along the vector field y' = f(y) y. By the product rule, the result is a sum with one term for
    each None: ``product`` with () instead of this None. For example, (None, (None,)) gives
    ((), (None,)) + (None, ((),))."""
    result: Counter[Operator] = Counter()
    for place, factor in enumerate(product):
        if factor is None:
            result[_arranged((*product[:place], (), *product[place + 1 :]), ordered)] += 1
    result.update(_within(product, _kick, ordered))
    return dict(result)


def _within(product: Operator, act: Callable[[Operator, bool], Combination], ordered: bool) -> Combination:
    result: Counter[Operator] = Counter()
    for place, factor in enumerate(product):
        if factor is not None:
            for image, n in act(factor, ordered).items():
                result[_arranged((*product[:place], image, *product[place + 1 :]), ordered)] += n
    return result


def _arranged(product: Operator, ordered: bool) -> Operator:
    return product if ordered else tuple(sorted(product, key=repr))


def _levels(product: Operator) -> Forest:
    return b"".join(rooted_at_new_vertex(_levels(factor)) for factor in product if factor is not None)
