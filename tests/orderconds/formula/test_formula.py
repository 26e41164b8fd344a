from fractions import Fraction

import pytest

from orderconds.formula import (
    Coefficient,
    IndexSum,
    Power,
    Product,
    Total,
    coefficient,
    free_indices,
    fresh,
    index_sum,
    named,
    one,
    product,
    refreshed,
    total,
    zero,
)
from orderconds.ring import QQ
from tests.oracles.index_sums import runge_kutta_value


def b(i):
    return coefficient("b", i)


def a(i, j):
    return coefficient("a", i, j)


def test_sums_inside_products_are_drawn_to_the_front():
    formula = index_sum(("x",), (), product(b("x"), index_sum(("y",), (), product(a("x", "y"), b("y")))))
    assert named(formula).text() == "sum_{i,j} b_i a_ij b_j"


def test_equal_sums_become_powers_whatever_their_indices_are_called():
    one_sum, other = index_sum(("x",), (), b("x")), index_sum(("y",), (), b("y"))
    assert named(product(one_sum, other)).text() == "(sum_i b_i)^2"
    assert named(product(one_sum, product(other, b("z")))).text() == "(sum_i b_i)^2 b_z"


def test_equal_terms_are_collected_and_cancel():
    one_sum, other = index_sum(("x",), (), b("x")), index_sum(("y",), (), b("y"))
    assert named(total((1, one_sum), (2, other))).text() == "3 sum_i b_i"
    assert total((1, one_sum), (-1, other)) == zero()
    assert index_sum(("x",), (), total((1, b("x")), (-1, b("x")))) == zero()
    assert product(b("x"), zero()) == zero()


def test_numbers_leave_products_and_sums():
    formula = index_sum(("x",), (), product(b("x"), total((Fraction(1, 2), b("x")))))
    assert named(formula) == Total(
        ((Fraction(1, 2), IndexSum(("i",), (), Power(Coefficient("b", ("i",)), 2))),)
    )


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


def test_bound_names_never_capture_free_ones():
    formula = index_sum(("x",), (), product(a("i", "x"), b("x")))
    assert named(formula).text() == "sum_j a_ij b_j"
    assert free_indices(formula) == ("i",)


def test_names_run_on_when_the_alphabet_is_used_up():
    names = [fresh() for _ in range(14)]
    formula = named(index_sum(names, (), product(*(b(x) for x in names))))
    assert formula.text().endswith("b_w b_{i1} b_{i2}") or "i1" in formula.text()


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


def test_brute_force_sums_straight_from_the_definition():
    A = [[QQ.rational(1), QQ.rational(2)], [QQ.rational(3), QQ.rational(4)]]
    weights = [QQ.rational(1, 2), QQ.rational(-1, 3)]
    strict = index_sum(("x", "y"), (("x", "<", "y"),), product(b("x"), a("x", "y")))
    assert runge_kutta_value(strict, QQ, A, weights) == QQ.rational(1)
    weak = index_sum(("x", "y"), (("x", "<=", "y"),), product(b("x"), a("x", "y")))
    assert runge_kutta_value(weak, QQ, A, weights) == QQ.rational(1) + QQ.rational(1, 2) - QQ.rational(4, 3)
    inverse = index_sum(("x",), (), Power(b("x"), -1))
    assert runge_kutta_value(inverse, QQ, A, weights) == QQ.rational(-1)


def test_derived_coefficients_are_those_of_the_symplectic_partner():
    A = [[QQ.rational(1), QQ.rational(2)], [QQ.rational(3), QQ.rational(4)]]
    weights = [QQ.rational(1, 2), QQ.rational(1, 4)]
    # b_i ahat_ij + b_j a_ji = b_i b_j, summed over i and j.
    left = index_sum(("x", "y"), (), product(b("x"), coefficient("ahat", "x", "y")))
    right = index_sum(("x", "y"), (), product(b("y"), a("y", "x")))
    both = runge_kutta_value(left, QQ, A, weights) + runge_kutta_value(right, QQ, A, weights)
    assert both == QQ.rational(9, 16)
    by_nodes = index_sum(("x",), (), product(b("x"), coefficient("chat", "x")))
    assert runge_kutta_value(by_nodes, QQ, A, weights) == runge_kutta_value(left, QQ, A, weights)


def test_terms_are_collected_when_bound_names_alone_differ():
    def pair(i, j, first, second):
        return index_sum((i, j), ((i, "<", j),), product(coefficient("b", first), coefficient("c", second)))

    one_way, same, other = pair("i", "j", "i", "j"), pair("k", "l", "k", "l"), pair("i", "j", "j", "i")
    assert total((1, one_way), (2, same)) == total((3, one_way))
    assert len(total((1, one_way), (1, other)).terms) == 2
    exponentials = index_sum(("J",), (), coefficient("b", "J"))
    assert len(total((1, exponentials), (1, index_sum(("j",), (), coefficient("b", "j")))).terms) == 2
    assert len(total((1, coefficient("b", "i")), (1, coefficient("b", "j"))).terms) == 2


def test_a_refreshed_formula_has_names_of_its_own():
    i = fresh()
    inner = index_sum((i,), (), product(coefficient("a", "row", i), coefficient("c", i)))
    once, twice = refreshed(inner, {"row": "k"}), refreshed(inner, {"row": "k"})
    assert named(once) == named(twice)
    assert once.indices != twice.indices
    assert free_indices(once) == ("k",)
    joined = index_sum(("k",), (), product(once, coefficient("b", "k"), refreshed(inner, {"row": "k"})))
    assert named(joined).text() == "sum_i (sum_j a_ij c_j)^2 b_i"
