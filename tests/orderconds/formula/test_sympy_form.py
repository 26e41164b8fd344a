"""Formulas as SymPy expressions: expanded sums have the values of the index sums."""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy

from orderconds.formula import Formula, coefficient, index_sum, product, total
from orderconds.formula.sympy_form import expand_sums, export
from orderconds.ring import QQ
from tests.oracles.index_sums import value

STAGES = 3
B = [Fraction(1, 2), Fraction(-3), Fraction(2, 5)]
A = [[Fraction(i - 2 * j, i + j + 1) for j in range(STAGES)] for i in range(STAGES)]
b, c = (coefficient("b", i) for i in "ij")
a = coefficient("a", "i", "j")


@pytest.mark.parametrize(
    "formula",
    [
        index_sum(("i",), (), b),
        index_sum(("i", "j"), (), product(b, a, c)),
        index_sum(("i", "j"), (("i", "<", "j"),), product(b, a)),
        index_sum(("i", "j"), (("j", "<=", "i"),), product(b, a, a)),
        index_sum(("i", "j", "k"), (("i", "<", "j"), ("j", "<=", "k")), product(b, c, coefficient("b", "k"))),
        index_sum(("i",), (), product(b, index_sum(("j",), (("i", "<", "j"),), a))),
        total((Fraction(2, 3), index_sum(("i",), (), product(b, b))), (-1, index_sum(("i",), (), b))),
    ],
    ids=lambda formula: formula.text(),
)
def test_expanded_sums_have_the_value_of_the_formula(formula: Formula) -> None:
    tables = {"b": [QQ.rational(x.numerator, x.denominator) for x in B]}
    tables["a"] = [[QQ.rational(x.numerator, x.denominator) for x in row] for row in A]
    numbers = {
        sympy.IndexedBase("b")[i + 1]: sympy.Rational(x.numerator, x.denominator) for i, x in enumerate(B)
    }
    numbers |= {
        sympy.IndexedBase("a")[i + 1, j + 1]: sympy.Rational(x.numerator, x.denominator)
        for i, row in enumerate(A)
        for j, x in enumerate(row)
    }
    expanded = expand_sums(export(formula), STAGES)
    assert not expanded.has(sympy.Sum)
    assert str(expanded.subs(numbers)) == str(value(formula, QQ, tables))


def test_exponentials_run_to_a_limit_of_their_own() -> None:
    formula = index_sum(("J", "j"), (), coefficient("beta", "J", "j"))
    expanded = expand_sums(export(formula), STAGES, exponentials=2)
    assert len(expanded.args) == 2 * STAGES
