"""Selection of independent order conditions for a family of methods.

Each ordered forest gives one order condition. Independent conditions are selected from these conditions. The
left-hand sides for random methods form a matrix with one row for each method and one column for each
condition. A condition is omitted if two requirements are met. First, its left-hand side is a linear
combination of earlier left-hand sides and of products of left-hand sides of lower order. Second, the
right-hand sides (coefficients of the exact flow) satisfy the same relation.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from orderconds.ring.rank import pivot_columns
from orderconds.ring.residues import PRIMES, Residue, Residues
from orderconds.series.lie_butcher import ForestSeries, exact_value
from orderconds.series.monomials import products
from orderconds.trees.counts import ordered_forest_count
from orderconds.trees.levels import Forest

RandomSeries = Callable[[Residues, np.random.Generator], ForestSeries]
"""A function that chooses random methods (samples) of a family and returns one series for all samples. Each
coefficient of the series is a vector of residues modulo one prime, with one residue for each sample."""

SPARE_SAMPLES = 20
"""The left-hand sides of the order conditions form a matrix with one row for each random method (sample). The
number of rows is ``SPARE_SAMPLES`` plus the largest possible rank of the matrix. The additional rows make
accidental linear dependences improbable."""


def independent_forests(
    family: RandomSeries, candidates: Sequence[Sequence[Forest]], *, with_exact_flow: bool = True
) -> tuple[tuple[Forest, ...], ...]:
    """Return the forests whose order conditions are independent, as one tuple for each order.

    ``candidates`` contains a sequence of forests for each order 1, 2, .... A forest is omitted if its
    condition follows from the conditions of earlier forests. The right-hand sides of the conditions are
    coefficients of the exact flow. If ``with_exact_flow`` is false, the right-hand sides are ignored.

    The forests are selected modulo two primes, and the larger selection is returned, because the rank modulo
    a prime can be too small.

    >>> from orderconds.trees.ordered import ordered_forests
    >>> from orderconds.series.dexpinv import DexpinvSeries
    >>> def random_series(ring, generator):
    ...     A, b = ([ring.random(generator) for _ in range(2)] for _ in range(2))
    ...     return DexpinvSeries(ring, [A, b], b)
    >>> independent_forests(random_series, [[*ordered_forests(1)], [*ordered_forests(2)]])
    ((b'\\x00',), (b'\\x00\\x01',))
    """
    by_prime = [_independent(family, candidates, prime, with_exact_flow) for prime in PRIMES]
    return max(by_prime, key=lambda forests: [len(of_order) for of_order in forests])


def _independent(
    family: RandomSeries, candidates: Sequence[Sequence[Forest]], prime: int, with_exact_flow: bool
) -> tuple[tuple[Forest, ...], ...]:
    ring = Residues(prime, ordered_forest_count(len(candidates)) + SPARE_SAMPLES)
    series = family(ring, np.random.default_rng(prime))

    def column(forest: Forest) -> Residue:
        values = series(forest).values.copy()
        if with_exact_flow:
            exact = exact_value(forest)
            values[-1] = ring.rational(exact.numerator, exact.denominator).values[-1]
        return ring.element(values)

    chosen: list[tuple[Forest, ...]] = []
    generators: list[tuple[int, Residue]] = []
    for order, forests in enumerate(candidates, start=1):
        decomposable = list(products(generators, order))
        values = [column(forest) for forest in forests]
        pivots = pivot_columns([*decomposable, *values])
        kept = [place - len(decomposable) for place in pivots if place >= len(decomposable)]
        chosen.append(tuple(forests[place] for place in kept))
        generators += [(order, values[place]) for place in kept]
    return tuple(chosen)
