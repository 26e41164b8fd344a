from fractions import Fraction

from orderconds.formula import (
    Coefficient,
    IndexSum,
    Power,
    Total,
    coefficient,
    free_indices,
    fresh,
    index_sum,
    named,
    product,
    refreshed,
    total,
    zero,
)


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


def test_bound_names_never_capture_free_ones():
    formula = index_sum(("x",), (), product(a("i", "x"), b("x")))
    assert named(formula).text() == "sum_j a_ij b_j"
    assert free_indices(formula) == ("i",)


def test_names_run_on_when_the_alphabet_is_used_up():
    names = [fresh() for _ in range(14)]
    formula = named(index_sum(names, (), product(*(b(x) for x in names))))
    assert formula.text().endswith("b_w b_{i1} b_{i2}") or "i1" in formula.text()


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
