"""Selection of independent order conditions of variational Lie group methods. Each condition belongs to one
tree (:mod:`orderconds.series.action`). For many random methods, the left-hand sides of the conditions are
evaluated modulo a prime. The right-hand sides are numbers that do not depend on the method.

A condition L_0 = R_0 of order n is dependent if there are other conditions L_1 = R_1, ..., L_m = R_m up to
order n, and a polynomial P, such that L_0 = P(L_1, ..., L_m) for every method, **and R_0 = P(R_1, ...,
R_m)**.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from orderconds.ring.rank import pivot_columns
from orderconds.ring.residues import PRIMES, Residue, Residues
from orderconds.series import action_exact
from orderconds.series.action import ActionSeries
from orderconds.series.action_counts import tree_counts
from orderconds.series.action_switching import representatives
from orderconds.series.action_trees import Velocity
from orderconds.series.monomials import products

RandomSeries = Callable[[Residues, np.random.Generator], ActionSeries]
"""A function that creates many random methods (samples) of a family and returns one action series for all
these methods. Each value of the series is a vector with one residue for each method."""

SPARE_SAMPLES = 24
"""The left-hand sides of conditions, and products of left-hand sides, are evaluated for random methods
(samples). The values for one sample form one row of a matrix. The number of samples is ``SPARE_SAMPLES`` plus
an upper bound for the rank of this matrix (:func:`_largest_rank`). With fewer samples, independent conditions
would be more likely to seem dependent."""

BLOCK = 256
"""The number of samples that are evaluated together. A larger number would require more memory."""


def independent_trees(family: RandomSeries, order: int) -> tuple[tuple[Velocity, ...], ...]:
    """Return the trees with independent conditions, as one tuple for each of the orders 1, ..., ``order``.

    The conditions of the selected trees are independent over Q. The selection is very probably complete. The
    function :func:`~orderconds.series.action_counts.tree_counts` returns an upper bound for each order. If
    the selection reaches all bounds, it is certainly complete.

    >>> from functools import partial
    >>> from orderconds.families import get
    >>> independent_trees(partial(get("vcg").random_series, order=2), 2)
    ((o,), (o(o),))
    """
    by_prime = [_independent(family, order, prime) for prime in PRIMES]
    return max(by_prime, key=lambda trees: [len(of_order) for of_order in trees])


def _independent(family: RandomSeries, order: int, prime: int) -> tuple[tuple[Velocity, ...], ...]:
    chosen: list[tuple[Velocity, ...]] = []
    generators: list[tuple[int, Residue]] = []
    values = sample(family, order, [t for n in range(1, order + 1) for t in representatives(n)], prime)
    for n in range(1, order + 1):
        decomposable = list(products(generators, n))
        trees = representatives(n)
        pivots = pivot_columns([*decomposable, *(values[t] for t in trees)])
        kept = tuple(trees[p - len(decomposable)] for p in pivots if p >= len(decomposable))
        chosen.append(kept)
        generators += [(n, values[t]) for t in kept]
    return tuple(chosen)


def sample(
    family: RandomSeries, order: int, trees: Sequence[Velocity], prime: int
) -> dict[Velocity, Residue]:
    """Return a map from each tree to a vector of numbers modulo ``prime``. The last entry is the right-hand
    side of the order condition of the tree. All other entries are left-hand sides, one for each random
    method.

    Calls with the same ``family``, ``order`` and ``prime`` use the same random methods, even if ``trees``
    differs.

    >>> from functools import partial
    >>> from orderconds.families import get
    >>> from orderconds.series.action_trees import velocity
    >>> values = sample(partial(get("vcg").random_series, order=1), 1, [velocity()], 101)[velocity()].values
    >>> values.size, int(values[-1])  # the last entry is the right-hand side
    (26, 1)
    """
    count = _largest_rank(order) + SPARE_SAMPLES
    blocks: list[list[NDArray[np.int64]]] = []
    generator = np.random.default_rng(prime)
    for start in range(0, count, BLOCK):
        series = family(Residues(prime, min(BLOCK, count - start)), generator)
        blocks.append([series.condition(t).values for t in trees])
    one = Residues(prime, 1)
    blocks.append([_rational(one, action_exact.condition(t)) for t in trees])
    ring = Residues(prime, count + 1)
    return {t: ring.element(np.concatenate(parts)) for t, *parts in zip(trees, *blocks, strict=True)}


def _rational(ring: Residues, q: Fraction) -> NDArray[np.int64]:
    return ring.rational(q.numerator, q.denominator).values


def _largest_rank(order: int) -> int:
    """Return an upper bound for the number of independent monomials of order ``order``. A monomial is a
    product of conditions whose trees have ``order`` vertices in total.
    """
    unknowns = tree_counts(order)
    count = [1] + [0] * order
    for degree, number in enumerate(unknowns, start=1):
        for _ in range(number):
            for n in range(degree, order + 1):
                count[n] += count[n - degree]
    return count[order]
