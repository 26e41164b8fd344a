"""Runge-Kutta-Munthe-Kaas methods. The family ``rkmk(r)`` truncates the series of dexpinv, the inverse of the
differential of exp, after the term with ad^r. The family ``rkmk`` does not truncate the series.

There is one condition for each Lyndon word over ordered trees. The left-hand side of the condition is a
multiple of the coefficient of the word in the Lie-Butcher series of the method.

Let p be the order of the tableau as a Runge-Kutta method. If r >= 2 is even, let R = r + 1. Otherwise let
R = r. A method of ``rkmk(r)`` has the order min(p, R + 2). For even r >= 2 the Bernoulli number B_{r+1} is
zero, so ``rkmk(r)`` and ``rkmk(r + 1)`` are the same method.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from functools import lru_cache
from math import factorial
from typing import TYPE_CHECKING, ClassVar, Self

from orderconds.conditions import OrderCondition
from orderconds.families.base import Key, expect
from orderconds.families.dexpinv_cut import DexpinvCut
from orderconds.families.ordered_forests import OrderedForestFamily, longest_word, lyndon_forests, scale
from orderconds.families.registry import register
from orderconds.families.rk import has_weights
from orderconds.formula import (
    Formula,
    Total,
    coefficient,
    fresh,
    index_sum,
    one,
    product,
    refreshed,
    total,
    zero,
)
from orderconds.ring.protocol import Ring
from orderconds.series.dexpinv import DexpinvSeries, dexpinv_terms
from orderconds.series.lie_butcher import ForestSeries
from orderconds.tableau.methods import RungeKutta
from orderconds.tableau.products import Method
from orderconds.tableau.record import Tableau
from orderconds.trees.counts import rooted_tree_count
from orderconds.trees.levels import Forest, branches, trees_of

if TYPE_CHECKING:
    import numpy as np

    from orderconds.ring.residues import Residues


RANKED = 8
"""The highest order at which :meth:`MuntheKaasFamily.essential_conditions` computes ranks of matrices to find
independent conditions. At higher orders this computation takes too long."""


@register
class MuntheKaasFamily(DexpinvCut, OrderedForestFamily):
    """Runge-Kutta-Munthe-Kaas methods, given by a Runge-Kutta tableau.

    >>> for condition in MuntheKaasFamily(cutoff=1).conditions(3):
    ...     print(condition.tree, "   ", condition)
    [[.]]     sum_{i,j} b_i a_ij c_j = 1/6
    [..]     sum_i b_i c_i^2 = 1/3
    [.] .     -sum_i b_i c_i^2 + sum_{i,j} b_i a_ij c_j + (sum_i b_i c_i) (sum_i b_i) = 1/3
    """

    name = "rkmk"
    description = (
        "Runge-Kutta-Munthe-Kaas methods; rkmk(r) truncates dexpinv after the power r of ad, and rkmk "
        "does not truncate dexpinv."
    )
    formats = ("rk",)
    implies: ClassVar[Mapping[str, str]] = {
        "rk": "a vector space is a Lie group; on a vector space, an RKMK method is a Runge-Kutta method"
    }
    unknowns = "rk"
    minimal_brackets = 6

    def series(self, method: Method, ring: Ring) -> ForestSeries:
        """Return the Lie-Butcher series of one step of a method with a tableau (A, b)."""
        tableau = expect(method, RungeKutta)
        return DexpinvSeries(ring, tableau.A, tableau.b, self.cutoff)

    @classmethod
    def claimable(cls, tableau: Tableau) -> Self | None:
        """Return this family for a Runge-Kutta tableau or a composition, else None."""
        return cls() if has_weights(tableau) else None

    def longest_word(self, key: Key) -> int:
        """Return the length of the longest word in the forest ``key``. The letters of a word are trees. The
        trees of the forest form a word, and the branches at each vertex form a word."""
        assert isinstance(key, bytes)
        return longest_word(key)

    def first_unmet(self, order: int) -> OrderCondition | None:
        """Return the condition of the word that consists of the tree with two vertices, followed by
        ``order`` - 2 trees with one vertex.

        If dexpinv is not truncated or ``order`` < 3, return None.

        Let r be ``self.cutoff``, and let p be the highest order of a method of ``rkmk(r)``: p is r + 3 for
        even r >= 2, and r + 2 for all other r. No method has order p + 1, because the condition that is
        returned for ``order`` = p + 1 contradicts the other conditions of orders 1, ..., p + 1.
        """
        if self.cutoff is None or order < 3:
            return None
        return self._of([b"\0\1" + b"\0" * (order - 2)])[0]

    def essential_conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return independent conditions of the given order. If all conditions of lower order hold, the
        returned conditions imply all other conditions of the given order.

        Without truncation of dexpinv, there is one independent condition for each rooted tree.

        With truncation, let r be ``self.cutoff``. Let R = r + 1 for even r >= 2, and R = r for all other r.
        Up to order R + 2, there is again one independent condition for each rooted tree. Order R + 3 has one
        additional condition (:meth:`first_unmet`). The additional condition contradicts the other conditions
        of orders 1, ..., R + 3. Therefore no method has order R + 3.

        The computation requires NumPy. If ``order`` is above :data:`RANKED`, return all :meth:`conditions`.

        >>> [len(MuntheKaasFamily().essential_conditions(n)) for n in (1, 2, 3, 4, 5)]
        [1, 1, 2, 4, 9]
        """
        return self.conditions(order) if order > RANKED else self._of(_essential(self.cutoff, order)[-1])

    def remark(self, order: int) -> str:
        """Return a remark that explains why :meth:`conditions` returns more conditions than
        :meth:`essential_conditions`. Up to order 2 both functions return the same conditions, and the remark
        is empty.
        """
        if order < 3:
            return ""
        counts = ", ".join(str(len(lyndon_forests(n))) for n in range(1, min(order, RANKED) + 1))
        beyond = (
            f" Above order {RANKED} the conditions of all Lyndon words are listed." if order > RANKED else ""
        )
        return (
            f"A method on a group has order p if the conditions of orders 1 to p hold for all Lyndon words "
            f"over ordered trees. Starting with order 1, the numbers of these conditions are {counts}. "
            f"For {self.label()} methods, the conditions in the list above are sufficient, because they "
            f"imply the conditions of all Lyndon words.{beyond}"
        )

    def highest_order(self, limit: int) -> int:
        """Return the highest order of methods that truncate dexpinv after the term with ad^r, where r is
        ``self.cutoff``. The result is at most ``limit``. Raises ValueError if ``limit`` is above
        :data:`RANKED`.

        >>> [MuntheKaasFamily(cutoff).highest_order(5) for cutoff in (0, 1, 2)]
        [2, 3, 5]
        """
        if limit > RANKED:
            raise ValueError(f"the limit is {limit}; expected at most {RANKED}")
        for n in range(1, limit + 1):
            if len(self.essential_conditions(n)) > rooted_tree_count(n):
                return n - 1
        return limit

    def formula(self, forest: Forest) -> Formula:
        """Return the left-hand side of the condition of a forest as an index sum."""
        return total((scale(forest), _Words(self.cutoff).exponential(None, trees_of(forest))))


class _Words:
    """Formulas for the coefficients of the series u_i and exp(u_i).

    Let u_i be the exponent of stage i, and let k_j be the value of the vector field at stage j. Then
    u_i = sum_j a_ij dexpinv_{u_j}(k_j). If the index ``i`` is None, u_i is the exponent of the whole step,
    and b_j replaces a_ij.
    """

    def __init__(self, cutoff: int | None) -> None:
        self._cutoff = cutoff
        self._known: dict[tuple[int, tuple[Forest, ...]], tuple[str, Formula]] = {}

    def exponential(self, i: str | None, word: tuple[Forest, ...]) -> Formula:
        """Return the coefficient of a word in exp(u_i), where u_i is the exponent of stage ``i``."""
        if len(set(word)) == 1:
            first = self._power(i, 1, word[:1])
            return total((Fraction(1, factorial(len(word))), product(*([first] * len(word)))))
        powers = [(Fraction(1, factorial(n)), self._power(i, n, word)) for n in range(1, len(word) + 1)]
        return total(*powers) if word else one()

    def _power(self, i: str | None, n: int, word: tuple[Forest, ...]) -> Formula:
        """Return the coefficient of a word in the n-th power of u_i, the exponent of stage ``i``."""
        if n == 0 or len(word) < n:
            return zero() if n or word else one()
        if i is None:
            return self._written(None, n, word)
        if (n, word) not in self._known:
            stage = fresh()
            self._known[n, word] = stage, self._written(stage, n, word)
        stage, formula = self._known[n, word]
        return refreshed(formula, {stage: i})

    def _written(self, i: str | None, n: int, word: tuple[Forest, ...]) -> Formula:
        if n == 1:
            return self._argument(i, word)
        cuts = range(1, len(word) - n + 2)
        return total(
            *((1, product(self._power(i, 1, word[:cut]), self._power(i, n - 1, word[cut:]))) for cut in cuts)
        )

    def _argument(self, i: str | None, word: tuple[Forest, ...]) -> Formula:
        """Return the coefficient of ``word`` in the series u_i, the exponent of stage ``i``."""
        if i is not None and word == (b"\0",):
            return coefficient("c", i)
        j = fresh()
        weight = coefficient("b", j) if i is None else coefficient("a", i, j)
        inner = self._dexpinv(j, word)
        terms = inner.terms if isinstance(inner, Total) else ((Fraction(1), inner),)
        return total(*((q, index_sum((j,), (), product(weight, term))) for q, term in terms))

    def _dexpinv(self, j: str, word: tuple[Forest, ...]) -> Formula:
        longest = len(word) - 1 if self._cutoff is None else min(len(word) - 1, self._cutoff)
        terms = []
        for place, tree in enumerate(word):
            for q, m, n in dexpinv_terms(longest):
                behind = len(word) - 1 - place
                if m <= place and n <= behind and bool(m) is bool(place) and bool(n) is bool(behind):
                    first, last = self._power(j, m, word[:place]), self._power(j, n, word[place + 1 :])
                    value = self.exponential(j, trees_of(branches(tree)))
                    terms.append((q, product(first, value, last)))
        return total(*terms)


@lru_cache(maxsize=64)
def _essential(cutoff: int | None, order: int) -> tuple[tuple[Forest, ...], ...]:
    from orderconds.series.lie_butcher_rank import independent_forests

    def random_series(ring: Residues, generator: np.random.Generator) -> DexpinvSeries:
        # With too few stages, independent conditions would seem to be dependent.
        A = [[ring.random(generator) for _ in range(order)] for _ in range(order)]
        return DexpinvSeries(ring, A, [ring.random(generator) for _ in range(order)], cutoff)

    return independent_forests(random_series, [lyndon_forests(n) for n in range(1, order + 1)])
