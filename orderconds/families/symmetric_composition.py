"""Symmetric compositions of a symmetric method of order two.

One step of the basic method is the exponential of a power series in the step size h. The series contains only
odd powers of h, because the basic method is symmetric. There is one condition for each word in the letters 1,
3, 5, .... The letter k denotes the term with h^k in the series.

The step sizes form a palindrome, so the conditions of even order follow from conditions of lower order (HLW
III.3.3; Suzuki, J. Math. Phys. 32 (1991) 400).
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from functools import lru_cache
from math import factorial
from typing import TYPE_CHECKING, ClassVar, Self

from orderconds.errors import InputError
from orderconds.families.base import Family
from orderconds.families.composition import CompositionFamily, composition_formula
from orderconds.families.registry import register
from orderconds.families.relations import Polynomial, add, multiply
from orderconds.families.stage_form import StageForm, refuse_explicit
from orderconds.formula import Formula, coefficient, product
from orderconds.ring.protocol import Ring
from orderconds.tableau.method_properties import reads_backwards
from orderconds.tableau.methods import Composition
from orderconds.tableau.products import Method
from orderconds.tableau.record import Tableau
from orderconds.words.compositions import compositions
from orderconds.words.convolution import logarithm_scales
from orderconds.words.expansions import words_of_weight
from orderconds.words.lyndon import lyndon_words
from orderconds.words.radford import in_lyndon_words
from orderconds.words.shuffle import Word

if TYPE_CHECKING:
    import numpy as np

    from orderconds.ring.residues import Residues


@register
class SymmetricCompositionFamily(CompositionFamily):
    """Compositions of a symmetric method. The step sizes gamma_1, ..., gamma_s form a palindrome.

    >>> for n in (1, 2, 3, 4):
    ...     for condition in SymmetricCompositionFamily().conditions(n):
    ...         print(condition.tree, condition)
    1 sum_i gamma_i = 1
    3 sum_i gamma_i^3 = 0
    """

    name = "symmetric_composition"
    description = (
        "Symmetric compositions of a symmetric method of order two; all independent conditions have odd "
        "order."
    )
    illustrates = ()
    implies: ClassVar[Mapping[str, str]] = {"composition": "every symmetric composition is a composition"}
    bounds_others = False

    def require(self, method: Method, ring: Ring) -> None:
        """Raise :class:`~orderconds.errors.InputError` if the basic method is not symmetric, or if the step
        sizes are not a palindrome."""
        expected = 'base = "symmetric-2", and step sizes that form a palindrome'
        if not isinstance(method, Composition):
            raise InputError('base = "adjoint-pair"', where=f"family {self.name}", expected=expected)
        for i, (x, y) in enumerate(zip(method.gamma, method.gamma[::-1], strict=True)):
            if x is not y and ring.is_zero(x - y) is False:
                raise InputError(
                    f"gamma[{i + 1}] and gamma[{method.s - i}] differ",
                    where=f"family {self.name}",
                    expected=expected,
                    hint="use the family 'composition'",
                )

    def words(self, order: int) -> tuple[Word, ...]:
        """Return all words whose letters are odd integers with the sum ``order``."""
        return tuple(word for word in words_of_weight(order) if all(letter % 2 for letter in word))

    def independent(self, order: int) -> tuple[Word, ...]:
        """Return the Lyndon words whose letters are odd numbers with the sum ``order``. Return no words for
        even ``order``, because conditions of even order follow from conditions of lower order."""
        return tuple(lyndon_words(range(1, order + 1, 2), order, int)) if order % 2 else ()

    def polynomial(self, word: Word) -> Polynomial:
        """Return the coefficient of ``word`` in the series of one step, as a polynomial.

        The weight of a word is the sum of its letters. The variables of the polynomial are the coefficients
        of Lyndon words of odd weight. Each variable is denoted by its Lyndon word.
        """
        return dict(_polynomial(word))

    def formula(self, word: Word) -> Formula:
        """Return the left-hand side of the condition of a word as a sum over indices. The terms of the sum
        are products of step sizes gamma_i, gamma_j, ...."""
        return composition_formula(word, _step)

    def in_stages(self, stages: int, *, explicit: bool = False) -> StageForm:
        """Return the unknowns of a method with ``stages`` stages: the first half of the step sizes.

        For odd ``stages``, the middle step size is also an unknown.
        """
        refuse_explicit(self.label(), explicit)
        names = tuple(("gamma", (str(i),)) for i in range(1, (stages + 1) // 2 + 1))
        return StageForm(
            names, lambda values, ring: Composition("symmetric-2", (*values, *values[: stages // 2][::-1]))
        )

    @classmethod
    def claimable(cls, tableau: Tableau) -> Self | None:
        """Return this family if ``tableau`` contains a composition with palindromic step sizes, else None."""
        method = tableau.method
        if not isinstance(method, Composition):
            return None
        return cls() if reads_backwards(method.gamma, tableau.ring) else None

    def symmetric_family(self, method: Method) -> Family | None:
        """Return None. For symmetric compositions, no family with fewer conditions is known."""
        return None

    def random_method(self, ring: Residues, generator: np.random.Generator, order: int) -> Method:
        """Return a composition whose step sizes are random elements of ``ring`` and form a palindrome."""
        steps = 1 + sum(len(self.independent(n)) for n in range(1, order + 1))
        half = [ring.random(generator) for _ in range(steps)]
        return Composition("symmetric-2", (*half, *half[:-1][::-1]))


def _step(letters: Word, i: str) -> tuple[Formula, int]:
    return product(*[coefficient("gamma", i)] * sum(letters)), factorial(len(letters))


@lru_cache(maxsize=1 << 12)
def _polynomial(word: Word) -> tuple[tuple[tuple[Word, ...], Fraction], ...]:
    factors = in_lyndon_words(word)
    if set(factors) != {(word,)}:
        result: Polynomial = {}
        for monomial, value in factors.items():
            product_of_values: Polynomial = {(): value}
            for factor in monomial:
                product_of_values = multiply(product_of_values, dict(_polynomial(factor)))
            result = add(result, product_of_values)
        return tuple(result.items())
    if sum(word) % 2:
        return (((word,), Fraction(1)),)
    # In the logarithm of the series, words of even weight have the coefficient zero, because the step is
    # symmetric.
    result = {}
    for lengths in compositions(len(word)):
        if len(lengths) > 1:
            values: Polynomial = {(): logarithm_scales(len(lengths))[-1]}
            start = 0
            for length in lengths:
                values = multiply(values, dict(_polynomial(word[start : start + length])))
                start += length
            result = add(result, values, -1)
    return tuple(result.items())
