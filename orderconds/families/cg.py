"""Crouch-Grossman methods: y1 = exp(h b_s k_s) ... exp(h b_1 k_1) y0 (HLW IV.8.1).

Here k_j is the value of the vector field at stage j. In stage i, the coefficients a_ij replace b_j.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from itertools import pairwise
from math import factorial, prod
from typing import ClassVar, Self

from orderconds.families.base import expect
from orderconds.families.ordered_forests import OrderedForestFamily
from orderconds.families.registry import register
from orderconds.families.rk import has_weights
from orderconds.formula import Formula, coefficient, fresh, index_sum, one, product, total
from orderconds.ring.protocol import Ring
from orderconds.series.b_series import sparse
from orderconds.series.lie_butcher import ExponentialsSeries
from orderconds.tableau.methods import RungeKutta
from orderconds.tableau.palindromes import symmetric_paths
from orderconds.tableau.products import Method
from orderconds.tableau.record import Tableau
from orderconds.tableau.work import Work, crouch_grossman_work
from orderconds.trees.levels import Forest, Tree, branches, trees_of
from orderconds.words.compositions import compositions


@register
class CrouchGrossmanFamily(OrderedForestFamily):
    """Crouch-Grossman methods, given by a Runge-Kutta tableau.

    >>> [str(condition) for condition in CrouchGrossmanFamily().conditions(3)][2]
    'sum_i b_i^2 c_i + 2 sum_{i<j} b_i c_i b_j = 1/3'
    """

    name = "cg"
    description = (
        "Crouch-Grossman methods: stage i is exp(h a_is k_s) ... exp(h a_i1 k_1) y0, and the update is "
        "exp(h b_s k_s) ... exp(h b_1 k_1) y0 (HLW IV.8.1)."
    )
    formats = ("rk",)
    illustrates = ("ordered", "forests", "lyndon")
    implies: ClassVar[Mapping[str, str]] = {
        "rk": "a vector space is a Lie group under addition",
        "cf": "every Crouch-Grossman method is a commutator-free method with one k_j in each exponential",
    }
    unknowns = "rk"

    def series(self, method: Method, ring: Ring) -> ExponentialsSeries:
        """Return the Lie-Butcher series of one step of a tableau (A, b)."""
        return crouch_grossman_series(method, ring)

    @classmethod
    def claimable(cls, tableau: Tableau) -> Self | None:
        """Return this family if ``has_weights(tableau)`` is true. Otherwise return None."""
        return cls() if has_weights(tableau) else None

    def is_symmetric(self, method: Method, ring: Ring) -> bool:
        """Return True if :func:`symmetric_crouch_grossman` proves that the method is symmetric."""
        return symmetric_crouch_grossman(method, ring)

    def work(self, tableau: Tableau) -> Work | None:
        """Return the numbers of field evaluations and exponentials in one step."""
        return crouch_grossman_work(tableau)

    def formula(self, forest: Forest) -> Formula:
        """Return the left-hand side of the condition of a forest as an index sum."""
        return _word(forest, lambda i: coefficient("b", i), None)


def crouch_grossman_series(method: Method, ring: Ring) -> ExponentialsSeries:
    """Return the Lie-Butcher series of the Crouch-Grossman method with the given Runge-Kutta tableau.

    >>> from orderconds.ring import QQ
    >>> from orderconds.tableau import Tableau, find
    >>> from orderconds.trees.levels import parse
    >>> str(crouch_grossman_series(Tableau.load(find("cg3")).method, QQ)(parse("[..]")))
    '1/6'
    """
    tableau = expect(method, RungeKutta)
    single = [[((j, x),) for j, x in sparse(ring, row)] for row in (*tableau.A, tableau.b)]
    return ExponentialsSeries(ring, single[:-1], single[-1])


def symmetric_crouch_grossman(method: Method, ring: Ring) -> bool:
    """Return True if the tableau (A, b) of a Crouch-Grossman method is proved to define a symmetric method.

    If the result is True, the variational Crouch-Grossman method of the same tableau is symmetric, too. If
    the result is False, the methods may still be symmetric.

    >>> from orderconds.tableau import find
    >>> triple_jump = Tableau.load(find("triple_jump"))
    >>> symmetric_crouch_grossman(triple_jump.read_as(("rk",)), triple_jump.ring)
    True
    """
    if not isinstance(method, RungeKutta):
        return False
    return symmetric_paths(method.as_crouch_grossman(ring), ring) is True


def _word(word: Forest, row: Callable[[str], Formula], row_sum: Formula | None) -> Formula:
    """Return n! times the coefficient of a word of n letters in a product of exponentials.

    The product consists of the exponentials of ``row(1)`` k_1, ``row(2)`` k_2, .... Here k_i is the value of
    the vector field at stage i. The symbol ``row_sum`` denotes the sum of ``row(i)`` over i.
    """
    letters = trees_of(word)
    if len(set(letters)) == 1:
        # Exponentials of multiples of one letter commute, so their product is the exponential of the sum of
        # the exponents.
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
