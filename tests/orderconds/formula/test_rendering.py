"""Formulas as text and as LaTeX."""

from fractions import Fraction

import pytest

from orderconds.formula import (
    IndexSum,
    Power,
    Product,
    coefficient,
    fresh,
    index_sum,
    named,
    one,
    product,
    total,
    zero,
)


def b(i):
    return coefficient("b", i)


def a(i, j):
    return coefficient("a", i, j)


def test_order_relations_are_written_as_chains():
    names = tuple(fresh() for _ in range(4))
    body = product(*(b(x) for x in names))
    chain = ((names[0], "<", names[1]), (names[1], "<=", names[2]))
    formula = named(index_sum(names, chain, body))
    assert formula.text() == "sum_{i<j<=k,l} b_i b_j b_k b_l"
    assert formula.latex() == r"\sum_{i<j\le k,l} b_{i} b_{j} b_{k} b_{l}"


def test_two_lower_bounds_of_one_index_are_both_written():
    formula = IndexSum(("i", "j", "k"), (("i", "<", "k"), ("j", "<", "k")), product(b("i"), b("j"), b("k")))
    assert formula.text() == "sum_{i<k,j<k} b_i b_j b_k"


@pytest.mark.parametrize(
    ("formula", "text", "latex"),
    [
        (one(), "1", "1"),
        (zero(), "0", "0"),
        (total((Fraction(-1, 2), b("i")), (1, one())), "-1/2 b_i + 1", r"-\tfrac{1}{2} b_{i} + 1"),
        (Power(b("i"), -1), "b_i^-1", "b_{i}^{-1}"),
        (
            product(b("i"), total((1, b("i")), (-2, a("i", "i")))),
            "b_i (b_i - 2 a_ii)",
            r"b_{i} \Bigl(b_{i} - 2 a_{ii}\Bigr)",
        ),
        (Power(Product((b("i"), b("j"))), 2), "(b_i b_j)^2", r"\Bigl(b_{i} b_{j}\Bigr)^{2}"),
    ],
)  # fmt: skip
def test_formulas_are_spelled(formula, text, latex):
    assert formula.text() == text
    assert formula.latex() == latex
