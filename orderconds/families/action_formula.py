"""The conditions of action trees as sums over indices, such as ``sum_i b_i c_i^2 = 1/3``.

The conditions contain coefficients of words in a product of exponentials. The letters of a word are trees.
Let u = t_1 ... t_k be a word of k letters. Let phi_j(t) be the coefficient of the letter t in the exponent of
exponential j. The coefficient of u is a sum over all indices with ``j_1 <= ... <= j_k``. In each term, the
letter t_1 comes from exponential j_1, and so on. The term is ``phi_{j_1}(t_1) ... phi_{j_k}(t_k)``. If r
letters come from the same exponential, the term has the additional factor 1/r!.

This sum is split into sums whose indices increase strictly. A run consists of all letters that come from one
exponential. Each way to cut u into runs gives one sum. This sum has one index for each run.

If the k letters are equal, the coefficient of u is S^k/k!, where S is the sum of the letter's coefficients in
all exponents. The function :func:`multiplier` returns the factor that removes such denominators k! from a
condition.
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
"""A word. At most one letter of the word is a string, the name of a stage. Every other letter is an action
tree."""


def multiplier(tree: Velocity) -> int:
    """Return the factor by which both sides of the condition of a tree are multiplied.

    Each node of type :class:`Velocity` has a word: the tuple of trees ``node.word``. If a word consists of k
    equal trees, the coefficient of the word has the denominator k!, and the node gives the factor k!. If the
    trees are not all equal, the coefficient is a sum whose terms have different denominators, and the node
    gives the factor 1. The result is the product of the factors of all nodes.

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
    """The base class of objects that write the conditions of action trees as sums over indices.

    Both sides of each condition are multiplied by an integer (:func:`multiplier`), which removes factors such
    as 1/2 from the left-hand side. For example, ``1/2 sum_i b_i c_i^2 = 1/6`` becomes
    ``sum_i b_i c_i^2 = 1/3``.

    >>> from orderconds.formula import named
    >>> from orderconds.series.action_trees import force, velocity
    >>> named(CrouchGrossmanFormula().condition(velocity((), (force(), force())))).text()
    'sum_i b_i^-1 (sum_j b_j a_ji)^2'
    """

    @abstractmethod
    def word(self, row: str, word: Word) -> Formula:
        """Return the coefficient of a word in the series of the group element of stage ``row``.

        If the word consists of k equal letters, return k! times the coefficient instead (see
        :func:`multiplier`).
        """

    @abstractmethod
    def through(self, row: str | None, stage: str, before: Word, after: Word) -> Formula:
        """Return the coefficient of a word in the series of a group element.

        The group element belongs to stage ``row``. If ``row`` is None, the group element is the update.

        The word consists of the letters of ``before``, a new letter x, and the letters of ``after``. The
        letter x denotes a perturbation of the velocity of stage ``stage``.
        """

    def condition(self, tree: Velocity) -> Formula:
        """Return ``sum_i b_i tau_t(i)``, the left-hand side of the condition of the tree t = ``tree``.

        Here ``tau_t(i)`` is the result of :meth:`tau` for the tree t and stage i.
        """
        stage = fresh("i")
        return index_sum((stage,), (), product(coefficient("b", stage), self.tau(tree, stage)))

    def tau(self, tree: Velocity, stage: str) -> Formula:
        """The velocity of ``stage`` is a series of trees. Return the coefficient of ``tree`` in this series,
        times ``multiplier(tree)``."""
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
    """The conditions of Crouch-Grossman methods and commutator-free methods as sums over indices.

    >>> from orderconds.formula import named
    >>> from orderconds.series.action_trees import transport, velocity
    >>> named(CrouchGrossmanFormula().condition(velocity((), (transport((velocity(),)),)))).text()
    'sum_i b_i (sum_{j>i} b_j + 1/2 b_i)'
    """

    @abstractmethod
    def place(self) -> str:
        """Return an unused name for the index of an exponential."""

    @abstractmethod
    def exponent(self, row: str | None, place: str, tree: Velocity) -> Formula:
        """Return the coefficient of ``tree`` in the exponent with the index ``place``. The exponent belongs
        to stage ``row``, or to the update if ``row`` is None."""

    def word(self, row: str, word: Word) -> Formula:
        """Return the coefficient of a word in the series of the group element of stage ``row``.

        If the word consists of k equal letters, return k! times the coefficient instead (see
        :func:`multiplier`).
        """
        if len(set(word)) > 1:
            return self.between(row, word, None, None)
        return product(*(self._whole_exponent(row, letter) for letter in word))

    def _whole_exponent(self, row: str, tree: Velocity) -> Formula:
        """Return the sum of the coefficients of ``tree`` in all exponents of stage ``row``."""
        if tree.vertices == 1:
            return coefficient("c", row)
        place = self.place()
        return index_sum((place,), (), self.exponent(row, place, tree))

    def between(self, row: str | None, word: Word, above: str | None, below: str | None) -> Formula:
        """Return the coefficient of a word in a product of consecutive exponentials.

        The product contains the exponentials whose index j satisfies ``above < j < below``. For ``above`` and
        ``below``, None means no bound.
        """
        if not word:
            return one()
        # Reversed: the printed formula begins with the index sum that has the most indices.
        lengths = reversed(list(compositions(len(word))))
        return total(*(self._runs(row, word, parts, above, below) for parts in lengths))

    def _runs(
        self, row: str | None, word: Word, lengths: tuple[int, ...], above: str | None, below: str | None
    ) -> tuple[Fraction, Formula]:
        places = [self.place() for _ in lengths]
        bounds = [*([above] if above else []), *places, *([below] if below else [])]
        relations: list[Relation] = [(low, "<", high) for low, high in pairwise(bounds)]
        letters, factors = iter(word), []
        for place, length in zip(places, lengths, strict=True):
            factors += [self.exponent(row, place, next(letters)) for _ in range(length)]
        return Fraction(1, prod(map(factorial, lengths))), index_sum(places, relations, product(*factors))

    def around(self, row: str | None, place: str, before: Word, after: Word) -> Formula:
        """Return the coefficient of the word (``before``, x, ``after``) in a product of exponentials.

        Here x is a new letter. Each exponent in the product is a linear combination of letters. The letter x
        has the coefficient one in the exponent with index ``place``, and the coefficient zero in all other
        exponents.

        The product of exponentials belongs to stage ``row``. If ``row`` is None, the product of exponentials
        belongs to the update.
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
    """The index sums of Crouch-Grossman methods.

    Stage i has one exponential for each coefficient a_ij, and the update has one for each weight b_j. In both
    cases, j is the index of the exponential.

    >>> from orderconds.formula import named
    >>> from orderconds.series.action_trees import velocity
    >>> named(CrouchGrossmanFormula().condition(velocity((velocity(), velocity())))).text()
    'sum_i b_i c_i^2'
    """

    def place(self) -> str:
        """Return an unused name for the index of an exponential."""
        return fresh("i")

    def exponent(self, row: str | None, place: str, tree: Velocity) -> Formula:
        """Return ``a_ij tau_t(j)``: the coefficient of the tree t in exponent j of stage i.

        Here i = ``row``, j = ``place`` and t = ``tree``. If ``row`` is None, the exponent belongs to the
        update, and the result is ``b_j tau_t(j)``. The method :meth:`tau` returns ``tau_t(j)``.
        """
        return product(_runge_kutta(row, place), self.tau(tree, place))

    def through(self, row: str | None, stage: str, before: Word, after: Word) -> Formula:
        """Return the coefficient of a word in the series of a group element.

        The group element belongs to stage ``row``. If ``row`` is None, the group element is the update.

        The word consists of the trees in ``before``, a new letter x, and the trees in ``after``. The letter x
        denotes a perturbation that is added to the velocity of stage ``stage``.
        """
        return product(_runge_kutta(row, stage), self.around(row, stage, before, after))


class CommutatorFreeFormula(ExponentialsFormula):
    """The index sums of commutator-free methods. The stages and the update are products of exponentials.

    The exponent of exponential J is ``sum_j alpha_iJj xi_j`` in stage i, and ``sum_j beta_Jj xi_j`` in the
    update. Here xi_j is the velocity of stage j, and alpha_iJj and beta_Jj are the coefficients of the
    method. The weights are ``b_j = sum_J beta_Jj``.

    >>> from orderconds.formula import named
    >>> from orderconds.series.action_trees import velocity
    >>> named(CommutatorFreeFormula().condition(velocity((velocity((velocity(),)),)))).text()
    'sum_{i,I,j} b_i alpha_iIj c_j'
    """

    def place(self) -> str:
        """Return an unused name for the index of an exponential."""
        return fresh("J")

    def exponent(self, row: str | None, place: str, tree: Velocity) -> Formula:
        """Return the coefficient of ``tree`` in one exponent of stage ``row``.

        If ``row`` is None, the exponent belongs to the update. ``place`` is the index of the exponent.
        """
        stage = fresh("i")
        return index_sum((stage,), (), product(self._entry(row, place, stage), self.tau(tree, stage)))

    def through(self, row: str | None, stage: str, before: Word, after: Word) -> Formula:
        """Return the coefficient of a word in the series of a group element.

        The group element belongs to stage ``row``. If ``row`` is None, the group element is the update.

        The word consists of the trees in ``before``, a new letter x, and the trees in ``after``. The letter x
        denotes a perturbation that is added to the velocity of stage ``stage``.
        """
        place = self.place()
        inner = product(self._entry(row, place, stage), self.around(row, place, before, after))
        return index_sum((place,), (), inner)

    def _entry(self, row: str | None, place: str, stage: str) -> Formula:
        if row is None:
            return coefficient("beta", place, stage)
        return coefficient("alpha", row, place, stage)


class MuntheKaasFormula(ActionFormula):
    """The conditions of Munthe-Kaas methods as sums over indices.

    Stage i has the exponential exp(X_i), and the update has exp(Y). The exponents are
    ``X_i = sum_j a_ij v_j`` and ``Y = sum_j b_j v_j``. Here ``v_j = dexpinv_{X_j} xi_j``, and xi_j is the
    velocity of stage j. The power series of dexpinv in ad is truncated after the power ``cutoff``, or not at
    all if ``cutoff`` is None.

    >>> from orderconds.formula import named
    >>> from orderconds.series.action_trees import velocity
    >>> named(MuntheKaasFormula(0).condition(velocity((velocity((velocity(),)),)))).text()
    'sum_{i,j} b_i a_ij c_j'
    """

    def __init__(self, cutoff: int | None) -> None:
        self._cutoff = cutoff
        self._known: dict[tuple[bool, int, Marked], tuple[list[str], Formula]] = {}

    def word(self, row: str, word: Word) -> Formula:
        """Return the coefficient of a word in the series of the group element of stage ``row``.

        If the word consists of k equal letters, return k! times the coefficient instead (see
        :func:`multiplier`).
        """
        if len(set(word)) > 1:
            return self._exponential(row, word)
        return product(*(self._power(row, 1, (letter,)) for letter in word))

    def through(self, row: str | None, stage: str, before: Word, after: Word) -> Formula:
        """Return the coefficient of a word in the series of an exponential.

        The exponential belongs to stage ``row``, or to the update if ``row`` is None.

        The word consists of the trees in ``before``, a new letter x, and the trees in ``after``. The letter x
        denotes a perturbation that is added to the velocity of stage ``stage``.
        """
        return self._exponential(row, (*before, stage, *after))

    def _exponential(self, row: str | None, word: Marked) -> Formula:
        return total(
            *((Fraction(1, factorial(n)), self._power(row, n, word)) for n in range(1, len(word) + 1))
        )

    def _power(self, row: str | None, n: int, word: Marked) -> Formula:
        """Return the coefficient of ``word`` in X_i^n for i = ``row``, or in Y^n if ``row`` is None.

        The class docstring defines X_i and Y.
        """
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
        """Return the coefficient of ``word`` in X_i for i = ``row``, or in Y if ``row`` is None.

        The class docstring defines the exponents X_i and Y.
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
        """Return the terms ``q X^n xi X^m`` of the truncated series dexpinv_X xi, as triples (q, m, n).

        In a triple, m precedes n, because the right factor X^m acts first. The sum m + n is at most
        ``letters``.
        """
        return dexpinv_terms(letters if self._cutoff is None else min(letters, self._cutoff))

    def _dexpinv(self, stage: str, before: Marked, behind: Marked) -> Iterator[tuple[Fraction, Formula]]:
        letters = len(before) + len(behind)
        for q, m, n in self._terms(letters):
            if m <= len(before) and n <= len(behind) and bool(m) is bool(before) and bool(n) is bool(behind):
                inner = product(self._power(stage, m, before), self._power(stage, n, behind))
                if isinstance(inner, Total):
                    yield from ((q * scale, term) for scale, term in inner.terms)
                else:
                    yield q, inner


class PadeFormula(MuntheKaasFormula):
    """The conditions of a variant of Munthe-Kaas methods as sums over indices.

    The methods truncate the series of dexp, not the series of dexpinv.

    Stage i has the exponential exp(X_i), and the update has exp(Y). The exponents are
    ``X_i = sum_j a_ij v_j`` and ``Y = sum_j b_j v_j``. Here v_j is the solution of ``dexp_{X_j} v_j = xi_j``,
    and xi_j is the velocity of stage j. The series of dexp in powers of ad is truncated after the power
    ``cutoff``.

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
