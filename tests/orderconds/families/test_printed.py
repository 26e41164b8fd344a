"""What is printed is what the engine computes, and what the literature prints."""

import pytest

from orderconds import families
from orderconds.families.cf import coefficient_tables
from orderconds.formula import coefficients
from orderconds.ring import QQ
from tests.oracles.index_sums import runge_kutta_value, value


def printed(family, order):
    return [str(condition) for condition in families.get(family).conditions(order)]


def test_classical_conditions_to_order_four_are_printed_as_in_textbooks():
    assert [line for n in range(1, 5) for line in printed("rk", n)] == [
        "sum_i b_i = 1",
        "sum_i b_i c_i = 1/2",
        "sum_{i,j} b_i a_ij c_j = 1/6",
        "sum_i b_i c_i^2 = 1/3",
        "sum_{i,j,k} b_i a_ij a_jk c_k = 1/24",
        "sum_{i,j} b_i a_ij c_j^2 = 1/12",
        "sum_{i,j} b_i c_i a_ij c_j = 1/8",
        "sum_i b_i c_i^3 = 1/4",
    ]


def test_crouch_grossman_conditions_of_order_three_are_hlw_8_7():
    assert printed("cg", 3) == [
        "sum_{i,j} b_i a_ij c_j = 1/6",
        "sum_i b_i c_i^2 = 1/3",
        "sum_i b_i^2 c_i + 2 sum_{i<j} b_i c_i b_j = 1/3",
    ]


def test_symplectic_partitioned_conditions_of_order_three_are_printed_with_hats():
    assert printed("sprk", 3) == [
        "sum_i b_i c_i^2 = 1/3",
        "sum_i b_i chat_i^2 = 1/3",
        "sum_{i,j} b_i a_ij c_j = 1/6",
    ]


def test_latex_is_ready_for_a_paper():
    condition = families.get("cg").conditions(3)[2]
    assert condition.latex_equation == (
        r"\sum_{i} b_{i}^{2} c_{i} + 2 \sum_{i<j} b_{i} c_{i} b_{j} = \tfrac{1}{3}"
    )
    assert families.get("sprk").conditions(3)[1].latex == r"\sum_{i} b_{i} \hat{c}_{i}^{2}"


def test_json_has_the_fields_of_derive():
    assert families.get("rk").conditions(3)[0].as_json() == {
        "order": 3,
        "tree": "[[.]]",
        "expression": "sum_{i,j} b_i a_ij c_j",
        "latex": r"\sum_{i,j} b_{i} a_{ij} c_{j}",
        "rhs": "1/6",
    }


@pytest.mark.parametrize(
    ("name", "highest"),
    [("rk", 6), ("sprk", 5), ("cg", 5), ("rkmk(0)", 4), ("rkmk(1)", 4), ("rkmk(2)", 4), ("rkmk", 5)],
)
def test_every_printed_formula_is_what_the_engine_evaluates(name, highest, random_tableau):
    family, method = families.get(name), random_tableau(2)
    for n in range(1, highest + 1):
        conditions = family.all_conditions(n)
        found = family.evaluate(method, QQ, conditions)
        for condition, x in zip(conditions, found, strict=True):
            assert runge_kutta_value(condition.formula, QQ, method.A, method.b) == x, condition


def test_every_printed_commutator_free_formula_is_what_the_engine_evaluates(random_commutator_free):
    family, tables = families.get("cf"), coefficient_tables(random_commutator_free, QQ)
    for n in range(1, 5):
        conditions = family.all_conditions(n)
        found = family.evaluate(random_commutator_free, QQ, conditions)
        for condition, x in zip(conditions, found, strict=True):
            assert value(condition.formula, QQ, tables) == x, condition


def test_sympy_sums_have_the_value_of_the_formula(random_tableau):
    import sympy

    from orderconds.formula.sympy_form import expand_sums

    method = random_tableau(3)
    for name, n in (("rk", 3), ("cg", 3), ("cg", 4)):
        for condition in families.get(name).conditions(n):
            found = expand_sums(condition.sympy().lhs, stages=3)
            known = {
                "a": lambda i, j: method.A[i][j],
                "b": lambda i: method.b[i],
                "c": lambda i: method.c[i],
            }
            for symbol in found.atoms(sympy.Indexed):
                x = known[str(symbol.base)](*(int(i) - 1 for i in symbol.indices))
                found = found.subs(symbol, sympy.Rational(int(x.p), int(x.q)))
            expected = runge_kutta_value(condition.formula, QQ, method.A, method.b)
            assert found == sympy.Rational(int(expected.p), int(expected.q))


def test_a_dropped_term_is_noticed(random_tableau):
    # The oracle itself: without its second term HLW 8.7 has another value.
    method, condition = random_tableau(2), families.get("cg").conditions(3)[2]
    (_, first), _second = condition.formula.terms
    values = [runge_kutta_value(x, QQ, method.A, method.b) for x in (first, condition.formula)]
    assert values[0] != values[1]


def test_formulas_name_only_coefficients_that_the_tableau_has():
    for name, known in (("rk", "abc"), ("cg", "abc"), ("rkmk(2)", "abc")):
        for condition in families.get(name).conditions(4):
            assert {found.name for found in coefficients(condition.formula)} <= set(known)
