"""Compositions of a method Phi and its adjoint Phi*, or of symmetric methods.

The basic method is Phi_h = exp(h X_1 + h^2 X_2 + ...), where X_1 is the vector field of the problem. If Phi_h
is symmetric, X_2, X_4, ... are zero. For the step size alpha h, the method is Phi_{alpha h} = exp(alpha h X_1
+ alpha^2 h^2 X_2 + ...). The logarithm of the adjoint Phi*_{beta h} is the sum of -(-beta)^k h^k X_k over k.

A word is a product of letters. The letter k denotes X_k and has the weight k. The condition of a word states
that the word has the same coefficient in the series of one step as in the series of the exact flow (HLW
III.3.1; Murua and Sanz-Serna, Phil. Trans. R. Soc. A 357 (1999) 1079).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from fractions import Fraction
from itertools import pairwise
from math import factorial, prod
from typing import TYPE_CHECKING, ClassVar, Self

from orderconds.families.base import Family, expect
from orderconds.families.registry import get, register
from orderconds.families.stage_form import StageForm, refuse_explicit
from orderconds.families.word_family import WordFamily
from orderconds.formula import Formula, coefficient, fresh, index_sum, product, refreshed, total
from orderconds.ring.protocol import Element, Ring
from orderconds.series.exponentials import ProductOfExponentials
from orderconds.tableau.methods import Composition
from orderconds.tableau.products import AdjointComposition, Method
from orderconds.tableau.record import Tableau
from orderconds.words.compositions import compositions
from orderconds.words.expansions import words_of_weight
from orderconds.words.shuffle import Word

if TYPE_CHECKING:
    import numpy as np

    from orderconds.ring.residues import Residues


@register
class CompositionFamily(WordFamily):
    """Compositions Phi_{alpha_s h} Phi*_{beta_s h} ... Phi_{alpha_1 h} Phi*_{beta_1 h}.

    Here Phi_h is a method with step size h, and Phi*_h is the adjoint method. The example prints the
    one-letter word 2 and the condition of this word.

    >>> for condition in CompositionFamily().conditions(2):
    ...     print(condition.tree, condition)
    2 sum_i (alpha_i^2 - beta_i^2) = 0
    """

    name = "composition"
    description = "Compositions of a method Phi and its adjoint Phi*, or of symmetric methods."
    formats = ("composition",)
    symbols: ClassVar[Mapping[str, str]] = {
        "alpha": r"$\alpha_i$ are the step sizes of the method, as fractions of $h$",
        "beta": r"$\beta_i$ are the step sizes of the adjoint method, as fractions of $h$",
        "gamma": r"$\gamma_i$ are the step sizes of the symmetric method, as fractions of $h$",
    }
    illustrates: ClassVar[tuple[str, ...]] = ("graded",)
    implies: ClassVar[Mapping[str, str]] = {
        **dict.fromkeys(
            ("rk", "symplectic_rk", "sprk", "cg", "cf", "vcg", "vcf"),
            "the method is a composition of midpoint rules (Bogfjellmo and Marthinsen, Lemma 3.5.4) or of "
            "Euler methods",
        ),
        "symmetric_composition": "every symmetric composition is a composition",
        "splitting": (
            "if the basic method is a product of two flows, the composition is a splitting of the same order "
            "(McLachlan 1995)"
        ),
    }
    bounds_others = True
    unknowns = "composition"

    def words(self, order: int) -> tuple[Word, ...]:
        """Return all words of weight ``order``. The weight of a word is the sum of its letters."""
        return tuple(words_of_weight(order))

    def exact(self, word: Word) -> Fraction:
        """Return the coefficient of a word in the exact flow exp(h X_1).

        Here X_1 is the vector field of the problem, and the letter 1 denotes X_1. The coefficient is 1/n! for
        the word 1 1 ... 1 with n letters. The coefficient is zero for a word with another letter.
        """
        return Fraction(1, factorial(len(word))) if set(word) == {1} else Fraction(0)

    def scale(self, word: Word) -> int:
        """Return n! for a word of n letters. Both sides of the condition are multiplied by n!."""
        return factorial(len(word))

    def formula(self, word: Word) -> Formula:
        """Return the left-hand side of the condition of a word: an index sum with the step sizes alpha_i and
        beta_i."""
        return composition_formula(word, _pair)

    def series(self, method: Method, ring: Ring) -> ProductOfExponentials:
        """Return a function that maps each word to its coefficient in the series of one step."""
        if isinstance(method, Composition):
            steps = method.gamma
            return ProductOfExponentials(
                ring, len(steps), lambda J, k: power(steps[J], k, ring) if k % 2 else None
            )
        pairs = expect(method, AdjointComposition)
        both = [step for pair in zip(pairs.beta, pairs.alpha, strict=True) for step in pair]

        def letter(J: int, k: int) -> Element:
            value = power(both[J], k, ring)
            return value if J % 2 or k % 2 else -value

        return ProductOfExponentials(ring, len(both), letter)

    def in_stages(self, stages: int, *, explicit: bool = False) -> StageForm:
        """Return the unknowns of a search: the step sizes alpha_i and beta_i for i = 1, ..., ``stages``."""
        refuse_explicit(self.label(), explicit)
        names = tuple((x, (str(i),)) for x in ("alpha", "beta") for i in range(1, stages + 1))
        return StageForm(
            names, lambda values, ring: AdjointComposition(tuple(values[:stages]), tuple(values[stages:]))
        )

    @classmethod
    def claimable(cls, tableau: Tableau) -> Self | None:
        """Return this family if the method of ``tableau`` is a composition, else None.

        If the family is returned, the tableau file should state which order the method has in this family.
        """
        return cls() if isinstance(tableau.method, Composition | AdjointComposition) else None

    def symmetric_family(self, method: Method) -> Family | None:
        """Return the family ``symmetric_composition`` if ``method`` is a composition of symmetric methods.
        Otherwise return None."""
        return get("symmetric_composition") if isinstance(method, Composition) else None

    def solved_as(self, nystroem: bool) -> str:
        """Return ``symmetric_composition``. The command ``orderconds solve`` uses the conditions of that
        family."""
        return "symmetric_composition"

    def random_method(self, ring: Residues, generator: np.random.Generator, order: int) -> Method:
        """Return a composition with random step sizes."""
        pairs = 1 + sum(len(self.independent(n)) for n in range(1, order + 1))
        alpha, beta = (tuple(ring.random(generator) for _ in range(pairs)) for _ in range(2))
        return AdjointComposition(alpha, beta)


def power(x: Element, n: int, ring: Ring) -> Element:
    """Return x^n, computed by repeated multiplication in ``ring``.

    >>> from orderconds.ring import QQ
    >>> power(QQ.rational(2, 3), 2, QQ)
    4/9
    """
    result = ring.one
    for _ in range(n):
        result = result * x
    return result


BlockFormula = Callable[[Word, str], tuple[Formula, int]]
"""A function (word, index) -> (formula, divisor).

A step is a product of factors, and ``index`` is the index of one factor. In the series of this factor, the
coefficient of ``word`` is ``formula / divisor``.
"""


def composition_formula(word: Word, block: BlockFormula, kind: str = "i") -> Formula:
    """Return a formula for n! c. Here n is the number of letters in ``word``, and c is the coefficient of
    ``word`` in the series of a step. The step is a composition of basic steps, and ``block`` returns the
    coefficient of a word in the series of one basic step (:data:`BlockFormula`). The formula is a sum over
    indices. The indices are printed as i, j, k, ... if ``kind`` is a lower-case letter, and as I, J, K, ...
    if ``kind`` is an upper-case letter.

    >>> from orderconds.formula import named
    >>> step = lambda letters, i: (coefficient("gamma", i), factorial(len(letters)))
    >>> named(composition_formula((1, 3), step)).text()
    'sum_i gamma_i + 2 sum_{i<j} gamma_i gamma_j'
    """
    terms = []
    stage = fresh(kind)
    known: dict[Word, tuple[Formula, int]] = {}
    for lengths in compositions(len(word)):
        indices = [fresh(kind) for _ in lengths]
        factors, divisor = [], 1
        for i, letters in zip(indices, _cut(word, lengths), strict=True):
            if letters not in known:
                known[letters] = block(letters, stage)
            factor, repeats = known[letters]
            factors.append(refreshed(factor, {stage: i}))
            divisor *= repeats
        weight = Fraction(factorial(len(word)), divisor)
        relations = [(i, "<", j) for i, j in pairwise(indices)]
        terms.append((weight, index_sum(indices, relations, product(*factors))))
    return total(*terms)


def _pair(letters: Word, i: str) -> tuple[Formula, int]:
    """Return the pair (r! x, r!), where r is the number of letters. Here x is the coefficient of the word
    ``letters`` in Phi_{alpha_i h} Phi*_{beta_i h}."""
    r, terms = len(letters), []
    for m in range(r, -1, -1):
        late, early = sum(letters[r - m :]), letters[: r - m]
        sign = prod((-1) ** (k + 1) for k in early)
        factors = [coefficient("beta", i)] * sum(early) + [coefficient("alpha", i)] * late
        terms.append((sign * factorial(r) // factorial(m) // factorial(r - m), product(*factors)))
    return total(*terms), factorial(r)


def _cut(word: Word, lengths: tuple[int, ...]) -> Iterator[Word]:
    start = 0
    for length in lengths:
        yield word[start : start + length]
        start += length
