"""Doubles: a correct tableau keeps its order under rounding, a typo of 1e-10 lowers it, nothing is proved."""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from orderconds import Tableau, check
from orderconds.checking.exact_forms import exact_forms
from orderconds.errors import TableauError
from orderconds.tableau import dumps, find
from orderconds.tableau.doubles import UNITS, decimal_text, double_text, is_double, is_printed, radius
from orderconds.tableau.grammar import Constant, parse, spell
from orderconds.tableau.record import from_data

CORRECT = {"rk4": 4, "gauss2": 4, "gauss3": 6, "dormand_prince5": 5, "alexander2": 2, "radau2a3": 5}


def doubles(name: str) -> tuple[list[list[float]], list[float]]:
    tableau = Tableau.load(find(name))
    near = tableau.ring.nearest_float  # type: ignore[attr-defined]
    method = tableau.abelian()
    return [[near(x) for x in row] for row in method.A], [near(x) for x in method.b]


def of_doubles(A: list[list[float]], b: list[float]) -> Tableau:
    rows = [[double_text(x) for x in row] for row in A]
    return from_data({"name": "m", "family": "rk", "A": rows, "b": [double_text(x) for x in b]})


def order_of(A: list[list[float]], b: list[float], units: float | None = None) -> int:
    return check(of_doubles(A, b), order=1, tolerance=units).orders[0].order


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_the_text_of_a_double_is_read_as_the_same_double(x: float) -> None:
    text = double_text(x)
    if len(text) > 2000:
        return
    value = parse(text.lstrip("-"))
    assert isinstance(value, Constant)
    assert value.value == abs(Fraction(x))
    assert value.is_double == is_double(text)
    if value.is_double:
        assert parse(spell(value)) == value
        assert is_printed(decimal_text(text).lstrip("-"))
        assert float(decimal_text(text)) == x


@pytest.mark.parametrize("x", [math.nan, math.inf, -math.inf])
def test_a_double_that_is_not_finite_is_refused(x: float) -> None:
    with pytest.raises(TableauError, match="expected a finite number"):
        double_text(x)


@pytest.mark.parametrize(
    "text", ["0.5 d", "0.5d2", "d", "0.5dd", "1e400d", "9" * 400 + "d", "0.5~d", "(0.5)d"]
)
def test_the_suffix_d_belongs_to_one_decimal(text: str) -> None:
    with pytest.raises(TableauError):
        from_data({"name": "m", "family": "rk", "A": [[]], "b": [text]})


@pytest.mark.parametrize("name", CORRECT)
def test_a_correct_tableau_has_its_order_to_double_precision_and_no_proof(name: str) -> None:
    report = check(of_doubles(*doubles(name)), certified=True)
    (found,) = report.orders
    assert (found.order, found.certificate) == (CORRECT[name], "double")
    assert found.largest is not None
    assert found.largest < 1e-15
    assert report.broken_claims == ("rk: certificate double",)


def test_the_largest_residual_is_that_of_the_orders_that_are_reached() -> None:
    # With a tolerance of 1e-4, order 3 is undecided. Its largest residual is 3.3e-5.
    method = of_doubles([[0, 0, 0], [0.5, 0, 0], [-1, 2 + 1e-4, 0]], [1 / 6, 2 / 3, 1 / 6])
    (result,) = check(method, tolerance=1e12).orders
    assert (result.order, result.decided) == (2, False)
    assert result.largest == pytest.approx(1e-4 / 6)


def roundings(
    A: list[list[float]], b: list[float], steps: int
) -> Iterator[tuple[list[list[float]], list[float]]]:
    """Yield the tableau with all entries rounded up or down by some units in the last place."""

    def moved(x: float, k: int) -> float:
        for _ in range(steps if x else 0):
            x = math.nextafter(x, math.inf if k % 2 else -math.inf)
        return x

    for pattern in (1, 2, 3, 5, 7):
        rows = [[moved(x, (i * len(b) + j) // pattern) for j, x in enumerate(row)] for i, row in enumerate(A)]
        yield rows, [moved(x, j // pattern) for j, x in enumerate(b)]


@pytest.mark.parametrize("name", ["rk4", "gauss3", "dormand_prince5"])
def test_rounding_errors_of_the_coefficients_do_not_lower_the_order(name: str) -> None:
    for A, b in roundings(*doubles(name), 3):
        assert order_of(A, b) == CORRECT[name]


@pytest.mark.parametrize("name", ["rk4", "gauss2", "dormand_prince5", "alexander2"])
@pytest.mark.parametrize("typo", [1e-10, -1e-10])
def test_a_typo_of_1e_10_in_any_coefficient_lowers_the_order(name: str, typo: float) -> None:
    A, b = doubles(name)
    for i, row in enumerate(A):
        for j, x in enumerate(row):
            if x and b[i]:  # a last stage without weight occurs in the embedded method only
                wrong = [[y + typo * ((k, m) == (i, j)) for m, y in enumerate(r)] for k, r in enumerate(A)]
                assert order_of(wrong, b) < CORRECT[name], (i, j)
    for j, x in enumerate(b):
        if x:
            assert order_of(A, [y + typo * (k == j) for k, y in enumerate(b)]) < CORRECT[name], j


def test_a_typo_in_the_embedded_row_breaks_its_order() -> None:
    data = dict(Tableau.load(find("dormand_prince5")).file.data)  # type: ignore[union-attr]
    rows = [[double_text(x) for x in row] for row in doubles("dormand_prince5")[0]]
    data |= {"A": rows, "claims": {"rk": 5}}
    assert check(from_data(data)).verdict == "holds"
    rows[6][0] = double_text(doubles("dormand_prince5")[0][6][0] + 1e-10)
    assert "the embedded method has order" in check(from_data(data)).broken_claims[0]


def large(size: float) -> tuple[list[list[float]], list[float]]:
    """Return a method of order 2 with a coefficient of this size: b_2 = 1/(2 c_2) for c_2 = 1/size."""
    return [[0.0, 0.0], [1 / size, 0.0]], [1 - size / 2, size / 2]


@pytest.mark.parametrize("size", [3.0, 1e3 / 3, 1e6 / 7])
def test_rounding_of_large_coefficients_does_not_lower_the_order_and_a_typo_does(size: float) -> None:
    A, b = large(size)
    assert order_of(A, b) == 2
    assert order_of([[0.0, 0.0], [A[1][0] + 1e-10, 0.0]], b) == 1
    assert order_of(A, [b[0] + 1e-10 * size, b[1]]) == 0


def test_the_tolerance_is_counted_in_units_of_rounding() -> None:
    A, b = doubles("rk4")
    b[1] += 1e-14
    assert (order_of(A, b), order_of(A, b, 100)) == (0, 4)
    assert order_of(*doubles("rk4"), 0) == 0  # the doubles themselves, exactly, do not sum to one
    assert radius(Fraction(3)) == 3 * UNITS * Fraction(1, 2**53)


def test_doubles_of_few_bits_are_exact() -> None:
    report = check(of_doubles([[0.0, 0.0], [0.5, 0.0]], [0.0, 1.0]), family="rk")
    assert [(f.order, f.certificate) for f in report.orders] == [(2, "exact")]


def test_a_tableau_of_doubles_is_written_and_read_back_as_doubles() -> None:
    tableau = of_doubles(*doubles("gauss2"))
    again = Tableau.loads(dumps(tableau))
    assert again.doubles
    assert again.method == tableau.method


@pytest.mark.parametrize("name", ["rk4", "gauss2", "gauss3", "alexander2", "dormand_prince5", "lobatto3a3"])
def test_the_exact_forms_of_doubles_are_recognised(name: str) -> None:
    forms = exact_forms(of_doubles(*doubles(name)))
    assert forms is not None
    original = Tableau.load(find(name)).abelian()
    ring = forms.tableau.ring
    assert [[ring.text(x) for x in row] for row in forms.tableau.abelian().A] == [
        [Tableau.load(find(name)).ring.text(x) for x in row] for row in original.A
    ]


def test_the_exact_forms_of_a_wrong_tableau_are_not_recognised() -> None:
    A, b = doubles("gauss2")
    b[0] += 1e-10
    assert exact_forms(of_doubles(A, b)) is None
