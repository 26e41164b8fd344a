"""Crouch-Grossman methods: exp(h b_s k_s) ... exp(h b_1 k_1) y0, stages alike with a_ij (HLW IV.8.1).

The first stage acts first, in the stages and in the update; exponentials with coefficient zero are left out.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from itertools import pairwise
from math import factorial, prod
from typing import Any

from orderconds.families.ordered_forests import OrderedForestFamily
from orderconds.formula import Formula, coefficient, fresh, index_sum, one, product, total
from orderconds.ring.protocol import Ring
from orderconds.series.b_series import sparse
from orderconds.series.lie_butcher import ExponentialsSeries
from orderconds.trees.levels import Forest, Tree, branches, trees_of
from orderconds.words.compositions import compositions


class CrouchGrossmanFamily(OrderedForestFamily):
    """Crouch-Grossman methods, given by a Runge-Kutta tableau.

    >>> [str(condition) for condition in create().conditions(3)][2]
    'sum_i b_i^2 c_i + 2 sum_{i<j} b_i c_i b_j = 1/3'
    """

    name = "cg"
    formats: tuple[str, ...] = ("rk",)
    search_limit = 7

    def label(self) -> str:
        """Return ``cg``."""
        return self.name

    def series(self, method: Any, ring: Ring) -> ExponentialsSeries:
        """Return the series of a step; ``method`` has ``A`` and ``b`` over ``ring``."""
        return crouch_grossman_series(method, ring)

    def formula(self, forest: Forest) -> Formula:
        """Return the index sum of the scaled value on a forest."""
        return _word(forest, lambda i: coefficient("b", i), None)


def create() -> CrouchGrossmanFamily:
    """Return the family.

    >>> create().label()
    'cg'
    """
    return CrouchGrossmanFamily()


def crouch_grossman_series(method: Any, ring: Ring) -> ExponentialsSeries:
    """Return the series of a Runge-Kutta tableau read as a Crouch-Grossman method.

    >>> from orderconds.ring import QQ
    >>> from orderconds.tableau import Tableau, find
    >>> from orderconds.trees.levels import parse
    >>> str(crouch_grossman_series(Tableau.load(find("cg3")).method, QQ)(parse("[..]")))
    '1/6'
    """
    single = [[((j, x),) for j, x in sparse(ring, row)] for row in (*method.A, method.b)]
    return ExponentialsSeries(ring, single[:-1], single[-1])


def _word(word: Forest, row: Callable[[str], Formula], row_sum: Formula | None) -> Formula:
    """Return length! times the coefficient of a word in the product of exponentials of ``row``."""
    letters = trees_of(word)
    if len(set(letters)) == 1:
        # The coefficient of t^k is the k-th power of that of t, by k!: exponentials of one letter commute.
        i = fresh()
        alone = row_sum if row_sum is not None and len(letters[0]) == 1 else None
        first = alone or index_sum((i,), (), product(row(i), _stage(letters[0], i)))
        return product(*([first] * len(letters)))
    terms = []
    for runs in compositions(len(letters)):
        indices = [fresh() for _ in runs]
        waiting, factors = list(letters), []
        for i, length in zip(indices, runs, strict=True):
            run, waiting = waiting[:length], waiting[length:]
            factors += [row(i)] * length + [_stage(tree, i) for tree in run]
        order = [(i, "<", j) for i, j in pairwise(indices)]
        weight = Fraction(factorial(len(letters)), prod(map(factorial, runs)))
        terms.append((weight, index_sum(indices, order, product(*factors))))
    return total(*terms)


def _stage(tree: Tree, i: str) -> Formula:
    if len(tree) == 1:
        return one()
    return _word(branches(tree), lambda j: coefficient("a", i, j), coefficient("c", i))
