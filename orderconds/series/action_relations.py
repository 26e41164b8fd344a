"""Relations between the order conditions of variational Lie group methods: each dependent condition is a
polynomial in independent conditions.

The polynomial is the same for all methods of a family and for the exact flow. The coefficients of the
polynomial are computed from random methods and from the exact flow.

Three relations of order 4 hold for variational Crouch-Grossman methods, but not for variational
commutator-free methods. Let psi_p be the coefficient of a g*-valued tree p in the momentum of a stage
(:mod:`orderconds.series.action`). A g-valued tree ``o(w|M)`` contains a word w of g-valued trees and a
multiset M of g*-valued trees. A g*-valued tree ``L(w)`` contains a word w of g-valued trees
(:mod:`orderconds.series.action_trees`). Let s be the g-valued tree ``o`` with one vertex, and let t be the
g-valued tree ``o(|L(o))``. Each stage of a variational Crouch-Grossman method satisfies
``psi_{L(t)} = 3 psi_{L(s s)} - psi_{L(s)}^2``. This equation implies the three relations.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import cache
from itertools import chain
from math import prod

import numpy as np

from orderconds.ring.protocol import Element, RandomRing
from orderconds.ring.rank import combinations
from orderconds.ring.rationals import Rationals
from orderconds.ring.reconstruct import rational_number
from orderconds.ring.residues import PRIMES
from orderconds.series import action_exact
from orderconds.series.action import ActionSeries
from orderconds.series.action_rank import RandomSeries, sample
from orderconds.series.action_switching import classes
from orderconds.series.action_trees import Velocity

Polynomial = tuple[tuple[Fraction, tuple[Velocity, ...]], ...]
"""A polynomial in the left-hand sides of order conditions, as a tuple of terms. For example, let x and y be
the left-hand sides of the order conditions of the trees s and t. The term 3 x y is the pair (3, (s, t))."""


def relations(family: RandomSeries, independent: Sequence[Sequence[Velocity]]) -> dict[Velocity, Polynomial]:
    """Return formulas for the left-hand sides of dependent order conditions.

    ``independent`` contains one tuple of trees for each of the orders 1, ..., n. These trees have independent
    order conditions. The last tuple ``independent[-1]`` belongs to the order n. The function
    :func:`orderconds.series.action_rank.independent_trees` returns such a sequence of tuples.

    The result is a map. The keys are the trees with n vertices that are not in ``independent[-1]``. The value
    of a key is a formula for the left-hand side of the order condition of this tree. The formula is a
    polynomial (:data:`Polynomial`) in the left-hand sides of the order conditions of the trees in
    ``independent``. The coefficients of the polynomials are computed from random methods, and are wrong with
    a probability of about 10^-8. If the coefficients are correct, the formulas hold for each method of the
    family.

    >>> from functools import partial
    >>> from orderconds.families import get
    >>> from orderconds.series.action_rank import independent_trees
    >>> family = partial(get("vcg").random_series, order=2)
    >>> for tree, polynomial in relations(family, independent_trees(family, 2)).items():
    ...     print(tree, [(str(q), trees) for q, trees in polynomial])
    o(|f(*)) [('1', (o(o),))]
    o(|L(o)) [('1/2', (o, o))]
    """
    order = len(independent)
    representatives = [of_class[0] for of_class in classes(order)]
    monomials = tuple(_monomials(tuple(chain.from_iterable(independent)), order))
    others = tuple(tree for tree in representatives if (tree,) not in set(monomials))
    modular = [_coefficients(family, order, monomials, others, prime) for prime in PRIMES]
    polynomials: dict[Velocity, Polynomial] = {tree: ((Fraction(1), (tree,)),) for tree in independent[-1]}
    for place, tree in enumerate(others):
        both = [values[place] for values in modular]
        polynomials[tree] = tuple(
            (rational_number([values.get(k, 0) for values in both], PRIMES), monomial)
            for k, monomial in enumerate(monomials)
            if any(k in values for values in both)
        )
    return {
        tree: polynomials[of_class[0]]
        for of_class in classes(order)
        for tree in of_class
        if tree not in independent[-1]
    }


SEED = 61
"""The seed of the random numbers in :func:`hold_over_rationals`."""


class _Drawn(Rationals):
    """The ring Q of rational numbers, with a method that returns random elements. The numerators and
    denominators of the random elements have at most 61 bits."""

    def random(self, generator: np.random.Generator) -> Element:
        """Return a random non-zero fraction."""
        numerator, denominator = (int(n) for n in generator.integers(1, 2**61, 2))
        return self.rational(numerator, denominator)


def hold_over_rationals(
    series: Callable[[RandomRing, np.random.Generator], ActionSeries],
    polynomials: Mapping[Velocity, Polynomial],
) -> bool:
    """Return True if the formulas in ``polynomials`` hold for the exact flow and for one method with random
    rational coefficients. The function :func:`relations` returns such formulas.

    The function ``series(ring, generator)`` returns the series of a random method with coefficients in
    ``ring``. Assume that a formula is false for some method of the family. Then it is very unlikely that the
    formula holds for the random method (Schwartz-Zippel lemma).

    >>> from functools import partial
    >>> from orderconds.families import get
    >>> from orderconds.series.action_rank import independent_trees
    >>> random_series = get("vcg").random_series
    >>> family = partial(random_series, order=2)
    >>> right = relations(family, independent_trees(family, 2))
    >>> wrong = {tree: ((q + 1, trees),) for tree, ((q, trees),) in right.items()}
    >>> [hold_over_rationals(partial(random_series, order=4), x) for x in (right, wrong)]
    [True, False]
    """
    ring = _Drawn()
    method = series(ring, np.random.default_rng(SEED))

    def flow(tree: Velocity) -> Element:
        exact = action_exact.condition(tree)
        return ring.rational(exact.numerator, exact.denominator)

    for value in (cache(method.condition), cache(flow)):
        for tree, polynomial in polynomials.items():
            total = ring.zero
            for q, trees in polynomial:
                total += ring.rational(q.numerator, q.denominator) * prod(map(value, trees))
            if total != value(tree):
                return False
    return True


def _coefficients(
    family: RandomSeries,
    order: int,
    monomials: Sequence[tuple[Velocity, ...]],
    trees: Sequence[Velocity],
    prime: int,
) -> list[dict[int, int]]:
    """Express the left-hand side of the condition of each tree as a linear combination of ``monomials``.
    Return, for each tree, a map from indices of monomials to coefficients modulo ``prime``."""
    values = sample(family, order, [*dict.fromkeys(chain.from_iterable(monomials)), *trees], prime)
    columns = []
    for first, *rest in monomials:
        column = values[first]
        for tree in rest:
            column = column * values[tree]
        columns.append(column)
    dependent = combinations([*columns, *(values[tree] for tree in trees)])
    return [dependent[len(monomials) + place] for place in range(len(trees))]


def _monomials(trees: Sequence[Velocity], vertices: int, start: int = 0) -> Iterator[tuple[Velocity, ...]]:
    """Yield all multisets of trees from ``trees[start:]`` in which the total number of vertices is
    ``vertices``."""
    if vertices == 0:
        yield ()
    for place in range(start, len(trees)):
        if trees[place].vertices <= vertices:
            for rest in _monomials(trees, vertices - trees[place].vertices, place):
                yield (trees[place], *rest)
