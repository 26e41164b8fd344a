"""The conditions of action trees as readable index sums.

Let u be a word of k letters. Its coefficient in a product of exponentials is a sum over indices ``j_1 <= ...
<= j_k``, where j_n is the index of the exponential from which letter n comes. Each term is the product of the
coefficients of the letters in the exponents, with a factor 1/r! for each run of r equal indices. This module
writes the coefficient as several sums with strict inequalities, one for each division of u into runs. If all
letters are equal, one term suffices: S^k/k!, where S is the sum of the letter's coefficients in all
exponents. The printed condition is multiplied by the number k! (:func:`multiplier`), as in
``sum_i b_i c_i^2 = 1/3``.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise
from math import factorial, prod

from orderconds.formula import (
    Formula,
    Power,
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
from orderconds.formula.notation import Relation
from orderconds.series.action_lie import Terms, pade_terms
from orderconds.series.action_trees import Force, Momenta, Momentum, Velocity, Word
from orderconds.series.dexpinv import dexpinv_terms
from orderconds.words.compositions import compositions

Marked = tuple[Velocity | str, ...]
"""A word whose letters are action trees. One letter may be a string instead: the index of a stage. It marks
the letter x that is added to the velocity of this stage (:meth:`ActionFormula.through`)."""


def multiplier(tree: Velocity) -> int:
    """Return the factor by which both sides of the condition of a tree are multiplied.

    The formula of a word of k equal letters contains the denominator k!. The factor is the product of k! over
    all g-valued subtrees (w, M) whose word w consists of k equal letters.

    >>> from orderconds.series.action_trees import velocity
    >>> multiplier(velocity((velocity(), velocity())))
    2
    """
    repeated = factorial(len(tree.word)) if len(set(tree.word)) == 1 else 1
    return repeated * prod(map(multiplier, tree.word)) * prod(map(_momentum_multiplier, tree.momenta))


def _momentum_multiplier(tree: Momentum) -> int:
    if isinstance(tree, Force):
        letters = tree.before + tree.after
        return prod(map(multiplier, letters)) * prod(map(_momentum_multiplier, tree.momenta))
    return prod(map(multiplier, tree.word))


class ActionFormula(ABC):
    """Index sums for the conditions of action trees. Subclasses define how the stages and the update depend
    on the velocities of the stages.

    The argument ``row`` of the functions in this class is the index of a stage, or None for the update.

    >>> from orderconds.formula import named
    >>> from orderconds.series.action_trees import force, velocity
    >>> named(CrouchGrossmanFormula().condition(velocity((), (force(), force())))).text()
    'sum_i b_i^-1 (sum_j b_j a_ji)^2'
    """

    @abstractmethod
    def word(self, row: str, word: Word) -> Formula:
        """Return the coefficient of a word in the group element of stage ``row``, times a factor.

        The factor is k! if the word consists of k equal letters, and one otherwise.
        """

    @abstractmethod
    def through(self, row: str | None, stage: str, before: Word, after: Word) -> Formula:
        """Return the coefficient of the word u x v in the group element of stage ``row``, or of the update if
        ``row`` is None.

        Here u is ``before``, and v is ``after``. The letter x is added to the velocity of ``stage``, and all
        other velocities are unchanged.
        """

    def condition(self, tree: Velocity) -> Formula:
        """Return the left-hand side of the condition of t = ``tree``: the sum ``sum_i b_i tau_t(i)``,
        multiplied by ``multiplier(tree)``.

        The number ``tau_t(i)`` is the coefficient of t in the velocity of stage i.
        """
        stage = fresh("i")
        return index_sum((stage,), (), product(coefficient("b", stage), self.tau(tree, stage)))

    def tau(self, tree: Velocity, stage: str) -> Formula:
        """Return the coefficient of a tree in the velocity of ``stage``, times :func:`multiplier` of the
        tree.
        """
        return product(self.word(stage, tree.word), self._psi_product(tree.momenta, stage))

    def _psi_product(self, momenta: Momenta, stage: str) -> Formula:
        return product(*(self._psi(p, stage) for p in momenta))

    def _psi(self, tree: Momentum, stage: str) -> Formula:
        weight = Power(coefficient("b", stage), -1)
        if not isinstance(tree, Force):
            return product(weight, self.through(None, stage, (), tree.word[::-1]))
        other = fresh("i")
        inner = product(
            coefficient("b", other),
            self._psi_product(tree.momenta, other),
            self.through(other, stage, tree.before, tree.after),
        )
        return product(weight, index_sum((other,), (), inner))


class ExponentialsFormula(ActionFormula):
    """Index sums for methods whose stages and update are products of exponentials. If a function has an
    argument ``place``, this argument is the index of an exponential.

    >>> from orderconds.formula import named
    >>> from orderconds.series.action_trees import transport, velocity
    >>> named(CrouchGrossmanFormula().condition(velocity((), (transport((velocity(),)),)))).text()
    'sum_i b_i (sum_{j>i} b_j + 1/2 b_i)'
    """

    @abstractmethod
    def place(self) -> str:
        """Return a new index that runs over exponentials."""

    @abstractmethod
    def exponent(self, row: str | None, place: str, tree: Velocity) -> Formula:
        """Return the coefficient of ``tree`` in the exponent with index ``place`` of stage ``row``."""

    def word(self, row: str, word: Word) -> Formula:
        """Return the coefficient of a word in the group element of stage ``row``, times a factor.

        The factor is k! if the word consists of k equal letters, and one otherwise.
        """
        if len(set(word)) > 1:
            return self.between(row, word, None, None)
        return product(*(self._whole_exponent(row, letter) for letter in word))

    def _whole_exponent(self, row: str, tree: Velocity) -> Formula:
        """Return the sum of a tree's coefficients in all exponents of stage ``row``."""
        if tree.vertices == 1:
            return coefficient("c", row)
        place = self.place()
        return index_sum((place,), (), self.exponent(row, place, tree))

    def between(self, row: str | None, word: Word, above: str | None, below: str | None) -> Formula:
        """Return a word's coefficient in the product of the exponentials J with ``above`` < J < ``below``.

        A bound that is None imposes no condition.
        """
        if not word:
            return one()
        # Divisions of the word into many runs come first. In the first term, each run has one letter.
        lengths = reversed(list(compositions(len(word))))
        return total(*(self._runs(row, word, parts, above, below) for parts in lengths))

    def _runs(
        self, row: str | None, word: Word, lengths: tuple[int, ...], above: str | None, below: str | None
    ) -> tuple[Fraction, Formula]:
        """Return one term of :meth:`between`, as a pair of a factor and an index sum.

        The term belongs to a division of the word into runs of the given ``lengths`` r_1, r_2, .... All
        letters of a run come from the same exponential. The factor is 1/(r_1! r_2! ...).
        """
        places = [self.place() for _ in lengths]
        bounds = [*([above] if above else []), *places, *([below] if below else [])]
        relations: list[Relation] = [(low, "<", high) for low, high in pairwise(bounds)]
        letters, factors = iter(word), []
        for place, length in zip(places, lengths, strict=True):
            factors += [self.exponent(row, place, next(letters)) for _ in range(length)]
        return Fraction(1, prod(map(factorial, lengths))), index_sum(places, relations, product(*factors))

    def around(self, row: str | None, place: str, before: Word, after: Word) -> Formula:
        """Return the contribution of one exponential to the coefficient of the word u x v.

        Here u is ``before``, v is ``after``, and the letter x comes from the exponential with index ``place``
        in stage ``row``. In the exponent of this exponential, x has the coefficient one.
        """
        terms = []
        for r in range(len(before) + 1):
            for q in range(len(after) + 1):
                run = before[len(before) - r :] + after[:q]
                inside = [self.exponent(row, place, letter) for letter in run]
                earlier = self.between(row, before[: len(before) - r], None, place)
                later = self.between(row, after[q:], place, None)
                terms.append((Fraction(1, factorial(1 + len(run))), product(earlier, *inside, later)))
        return total(*terms)


class CrouchGrossmanFormula(ExponentialsFormula):
    """Index sums for methods with one exponential for each a_ij in stage i, and one for each b_j in the
    update. The index of the exponential is j.

    >>> from orderconds.formula import named
    >>> from orderconds.series.action_trees import velocity
    >>> named(CrouchGrossmanFormula().condition(velocity((velocity(), velocity())))).text()
    'sum_i b_i c_i^2'
    """

    def place(self) -> str:
        """Return a new index that runs over stages."""
        return fresh("i")

    def exponent(self, row: str | None, place: str, tree: Velocity) -> Formula:
        """Return the coefficient of the tree t = ``tree`` in the exponent with index j = ``place``.

        The result is ``a_ij tau_t(j)`` in stage i = ``row``, and ``b_j tau_t(j)`` in the update. Here
        ``tau_t(j)`` is the result of :meth:`tau` for the tree t and stage j.
        """
        return product(_runge_kutta(row, place), self.tau(tree, place))

    def through(self, row: str | None, stage: str, before: Word, after: Word) -> Formula:
        """Return the coefficient of the word u x v in the group element of stage ``row``, or of the update if
        ``row`` is None.

        Here u is ``before``, and v is ``after``. The letter x is added to the velocity of ``stage``, and all
        other velocities are unchanged. Only the exponential with index ``stage`` contains the velocity of
        ``stage``.
        """
        return product(_runge_kutta(row, stage), self.around(row, stage, before, after))


class CommutatorFreeFormula(ExponentialsFormula):
    """Index sums for products of exponentials. The exponent with index J is ``sum_j alpha_iJj xi_j`` in stage
    i, and ``sum_j beta_Jj xi_j`` in the update. Here xi_j is the velocity of stage j.

    >>> from orderconds.formula import named
    >>> from orderconds.series.action_trees import velocity
    >>> named(CommutatorFreeFormula().condition(velocity((velocity((velocity(),)),)))).text()
    'sum_{i,I,j} b_i alpha_iIj c_j'
    """

    def place(self) -> str:
        """Return a new index that runs over exponentials."""
        return fresh("J")

    def exponent(self, row: str | None, place: str, tree: Velocity) -> Formula:
        """Return the coefficient of the tree t = ``tree`` in the exponent with index J = ``place``.

        The result is ``sum_j alpha_iJj tau_t(j)`` in stage i = ``row``, and ``sum_j beta_Jj tau_t(j)`` in the
        update. Here ``tau_t(j)`` is the result of :meth:`tau` for the tree t and stage j.
        """
        stage = fresh("i")
        return index_sum((stage,), (), product(self._entry(row, place, stage), self.tau(tree, stage)))

    def through(self, row: str | None, stage: str, before: Word, after: Word) -> Formula:
        """Return the coefficient of the word u x v in the group element of stage ``row``, or of the update if
        ``row`` is None.

        Here u is ``before``, and v is ``after``. The letter x is added to the velocity of ``stage``, and all
        other velocities are unchanged.
        """
        place = self.place()
        inner = product(self._entry(row, place, stage), self.around(row, place, before, after))
        return index_sum((place,), (), inner)

    def _entry(self, row: str | None, place: str, stage: str) -> Formula:
        if row is None:
            return coefficient("beta", place, stage)
        return coefficient("alpha", row, place, stage)


class MuntheKaasFormula(ActionFormula):
    """Index sums for methods with one exponential exp(X_i) in stage i and exp(Y) in the update.

    The exponents are ``X_i = sum_j a_ij dexpinv^(r)(X_j) xi_j`` and ``Y = sum_j b_j dexpinv^(r)(X_j) xi_j``.
    Here xi_j is the velocity of stage j. The operator dexpinv^(r)(X_j) acts on xi_j. It is the series of
    dexpinv at X_j, truncated after the power r = ``cutoff`` of ad. If ``cutoff`` is None, the series is not
    truncated.

    >>> from orderconds.formula import named
    >>> from orderconds.series.action_trees import velocity
    >>> named(MuntheKaasFormula(0).condition(velocity((velocity((velocity(),)),)))).text()
    'sum_{i,j} b_i a_ij c_j'
    """

    def __init__(self, cutoff: int | None) -> None:
        self._cutoff = cutoff
        self._known: dict[tuple[bool, int, Marked], tuple[list[str], Formula]] = {}

    def word(self, row: str, word: Word) -> Formula:
        """Return the coefficient of a word in exp(X_i), times a factor. Here i is ``row``.

        The class docstring defines X_i. The factor is k! if the word consists of k equal letters, and one
        otherwise.
        """
        if len(set(word)) > 1:
            return self._exponential(row, word)
        return product(*(self._power(row, 1, (letter,)) for letter in word))

    def through(self, row: str | None, stage: str, before: Word, after: Word) -> Formula:
        """Return the coefficient of the word u x v in exp(X_i) with i = ``row``, or in exp(Y) if ``row`` is
        None. The class docstring defines X_i and Y.

        Here u is ``before``, and v is ``after``. The letter x is added to the velocity of ``stage``, and all
        other velocities are unchanged.
        """
        return self._exponential(row, (*before, stage, *after))

    def _exponential(self, row: str | None, word: Marked) -> Formula:
        return total(
            *((Fraction(1, factorial(n)), self._power(row, n, word)) for n in range(1, len(word) + 1))
        )

    def _power(self, row: str | None, n: int, word: Marked) -> Formula:
        """Return the coefficient of ``word`` in X_i^n with i = ``row``, or in Y^n if ``row`` is None. The
        class docstring defines X_i and Y."""
        if n == 0 or len(word) < n:
            return one() if n == len(word) else zero()
        stages = [letter for letter in word if isinstance(letter, str)] + ([] if row is None else [row])
        key = (row is None, n, tuple("" if isinstance(letter, str) else letter for letter in word))
        if key not in self._known:
            new = {stage: fresh("i") for stage in stages}
            renamed = tuple(new.get(letter, "") if isinstance(letter, str) else letter for letter in word)
            written = self._written(None if row is None else new[row], n, renamed)
            self._known[key] = list(new.values()), written
        names, formula = self._known[key]
        return refreshed(formula, dict(zip(names, stages, strict=True)))

    def _written(self, row: str | None, n: int, word: Marked) -> Formula:
        if n == 1:
            return self._argument(row, word)
        return total(
            *(
                (1, product(self._power(row, 1, word[:cut]), self._power(row, n - 1, word[cut:])))
                for cut in range(1, len(word) - n + 2)
            )
        )

    def _argument(self, row: str | None, word: Marked) -> Formula:
        """Return the coefficient of ``word`` in X_i with i = ``row``, or in Y if ``row`` is None.

        The class docstring defines X_i and Y. Each is a linear combination of the elements dexpinv^(r)(X_j)
        xi_j. The coefficient is a sum over the letters of the word: one letter comes from xi_j, and all other
        letters come from X_j.
        """
        if row is not None and len(word) == 1 and isinstance(word[0], Velocity) and word[0].vertices == 1:
            return coefficient("c", row)
        terms = []
        for place, letter in enumerate(word):
            varied = isinstance(letter, str)
            stage = letter if isinstance(letter, str) else fresh("i")
            for q, inner in self._dexpinv(stage, word[:place], word[place + 1 :]):
                value = one() if isinstance(letter, str) else self.tau(letter, stage)
                term = product(_runge_kutta(row, stage), inner, value)
                terms.append((q, term if varied else index_sum((stage,), (), term)))
        return total(*terms)

    def _terms(self, letters: int) -> Terms:
        """Return the terms of the truncated series dexpinv_X xi with at most ``letters`` factors X in a term.

        The triple (q, m, n) denotes the term q X^n xi X^m.
        """
        return dexpinv_terms(letters if self._cutoff is None else min(letters, self._cutoff))

    def _dexpinv(self, stage: str, before: Marked, behind: Marked) -> Iterator[tuple[Fraction, Formula]]:
        letters = len(before) + len(behind)
        for q, m, n in self._terms(letters):
            # X^0 = 1 contains only the empty word. X^m with m > 0 contains only non-empty words.
            if m <= len(before) and n <= len(behind) and bool(m) is bool(before) and bool(n) is bool(behind):
                inner = product(self._power(stage, m, before), self._power(stage, n, behind))
                if isinstance(inner, Total):
                    yield from ((q * scale, term) for scale, term in inner.terms)
                else:
                    yield q, inner


class PadeFormula(MuntheKaasFormula):
    """Index sums for methods with one exponential exp(X_i) in stage i and exp(Y) in the update.

    The exponents are ``X_i = sum_j a_ij v_j`` and ``Y = sum_j b_j v_j``. Here v_j is the solution of the
    equation dexp^(r)(X_j) v_j = xi_j, where xi_j is the velocity of stage j. The operator dexp^(r) is dexp,
    truncated after the power r = ``cutoff`` of ad.

    >>> from orderconds.formula import named
    >>> from orderconds.series.action_trees import velocity
    >>> named(PadeFormula(0).condition(velocity((velocity((velocity(),)),)))).text()
    'sum_{i,j} b_i a_ij c_j'
    """

    def __init__(self, cutoff: int) -> None:
        super().__init__(cutoff)
        self._power_of_dexp = cutoff

    def _terms(self, letters: int) -> Terms:
        return pade_terms(self._power_of_dexp, letters)


def _runge_kutta(row: str | None, stage: str) -> Formula:
    return coefficient("b", stage) if row is None else coefficient("a", row, stage)
