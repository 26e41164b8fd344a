"""Tableaux from Python: numbers of every kind give the same method, and wrong input has one clear message."""

from __future__ import annotations

import math
import pickle
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
import sympy

from orderconds import Tableau, check, convert, refine
from orderconds.errors import TableauError, UnknownName
from orderconds.tableau import available

A4 = [[0, 0, 0, 0], [0.5, 0, 0, 0], [0, 0.5, 0, 0], [0, 0, 1, 0]]
ROOT = sympy.sqrt(3) / 6
QUARTER = sympy.Rational(1, 4)


@pytest.mark.parametrize(
    "half",
    [
        Fraction(1, 2),
        "1/2",
        "0.5",
        0.5,
        Decimal("0.5"),
        np.float64(0.5),
        np.float32(0.5),
        sympy.Rational(1, 2),
        sympy.Float(0.5),
    ],
    ids=lambda x: type(x).__name__,
)
def test_every_kind_of_number_gives_the_same_exact_tableau(half: object) -> None:
    tableau = Tableau.rk([[0, 0], [half, 0]], [np.int64(0), sympy.Integer(1)])
    rows = tableau.A
    assert rows == ((0, 0), (Fraction(1, 2), 0))
    assert not tableau.doubles
    assert check(tableau, family="rk").orders[0].certificate == "exact"


@pytest.mark.parametrize("form", [list, tuple, np.array, sympy.Matrix])
def test_every_kind_of_array_gives_the_same_tableau(form: Any) -> None:
    tableau = Tableau.rk(form([[0, 0], [1, 0]]), form([1, 0]))
    assert (tableau.A, tableau.b) == (((0, 0), (1, 0)), (1, 0))


def test_radicals_of_sympy_stay_exact() -> None:
    rows = sympy.Matrix([[QUARTER, QUARTER - ROOT], [QUARTER + ROOT, QUARTER]])
    tableau = Tableau.rk(rows, sympy.Matrix([1, 1]) / 2)
    assert check(tableau, family="rk").orders[0].certificate == "exact"
    assert tableau.orders["rk"] == 4
    assert sympy.simplify(sympy.Matrix(tableau.A) - rows) == sympy.zeros(2)


def test_floats_of_computed_radicals_have_the_order_of_the_radicals() -> None:
    root = np.sqrt(3) / 6
    tableau = Tableau.rk([[0.25, 0.25 - root], [0.25 + root, 0.25]], [0.5, 0.5])
    assert tableau.doubles
    assert tableau.orders["rk"] == 4
    assert tableau.A[0][1] == 0.25 - root


@pytest.mark.parametrize("at", range(4))
def test_a_wrong_digit_in_floats_is_found(at: int) -> None:
    weights = np.array([1, 2, 2, 1]) / 6
    assert Tableau.rk(A4, weights).orders["rk"] == 4
    weights[at] += 1e-12
    assert Tableau.rk(A4, weights).orders["rk"] == 0


@pytest.mark.parametrize("name", ["rk4", "dormand_prince5", "gauss2", "kutta3"])
def test_the_floats_of_a_tableau_have_its_orders(name: str) -> None:
    exact = Tableau.load(name)
    bhat = None if exact.bhat is None else np.array(exact.bhat, dtype=float)
    floats = Tableau.rk(np.array(exact.A, dtype=float), np.array(exact.b, dtype=float), bhat)
    assert floats.orders["rk"] == exact.orders["rk"]
    assert (floats.embedded is None) == (exact.embedded is None)
    if exact.embedded is not None and floats.embedded is not None:
        assert floats.embedded.order == exact.embedded.order


def test_the_order_of_embedded_weights_is_computed() -> None:
    pair = Tableau.rk([[0, 0], [1, 0]], ["1/2", "1/2"], bhat=[1, 0])
    assert pair.embedded is not None
    assert (pair.embedded.order, pair.bhat) == (1, (1, 0))


def test_a_commutator_free_method_equals_the_one_of_the_library() -> None:
    cf4 = Tableau.cf(
        [[], [["1/2"]], [[0, "1/2"]], [["-1/2", 0, 1]]],
        [["1/4", "1/6", "1/6", "-1/12"], ["-1/12", "1/6", "1/6", "1/4"]],
        starts={4: 2},
    )
    assert cf4.method == Tableau.load("cf4").method


@pytest.mark.parametrize(
    ("claims", "verdict"),
    [({"rk": 2, "vcg": 2, "explicit": True}, "fails"), (1, "holds"), ({"rk": 2}, "fails")],
)
def test_claims_are_compared(claims: Any, verdict: str) -> None:
    assert check(Tableau.rk([[0]], [1], claims=claims)).verdict == verdict


@pytest.mark.parametrize("name", ["rk4", "gauss2", "cf4", "triple_jump", "blanes_moan4", "cg4a"])
def test_a_pickle_is_the_same_tableau(name: str) -> None:
    tableau = Tableau.load(name)
    assert repr(pickle.loads(pickle.dumps(tableau))) == repr(tableau)
    assert convert(pickle.loads(pickle.dumps(tableau)), "toml") == convert(tableau, "toml")


@pytest.mark.parametrize("to", ["toml", "json", "csv", "latex", "c", "sympy", "numpy"])
def test_doubles_survive_every_format(to: str, tmp_path: Any) -> None:
    tableau = Tableau.rk(A4, np.array([1, 2, 2, 1]) / 6)
    content = convert(tableau, to)
    suffix = {"latex": "tex", "sympy": "py", "numpy": "npz"}.get(to, to)
    file = tmp_path / f"t.{suffix}"
    file.write_bytes(content if isinstance(content, bytes) else content.encode())
    assert np.array_equal(np.array(Tableau.load(file).b, dtype=float), np.array(tableau.b, dtype=float))


@pytest.mark.parametrize("name", available())
def test_every_tableau_of_the_library_has_a_short_name_and_a_display(name: str) -> None:
    tableau = Tableau.load(name)
    assert len(repr(tableau)) < 80
    latex = tableau._repr_latex_()
    assert latex.count("{") == latex.count("}")
    assert tableau._repr_html_()


@pytest.mark.parametrize(
    ("A", "b", "message"),
    [
        ([[0, 0], [1]], [0, 1], "A: row lengths 2, 1; expected 2 rows of 2 entries"),
        ([[0, 0]], [0, 1], "A: A has 1 rows, b has 2 entries"),
        (np.zeros((2, 3)), [0, 1], "A: row lengths 3, 3"),
        (np.zeros(2), [0, 1], "A[1]: np.float64(0.0) of type float64; expected a sequence"),
        ([[0, 0], [1j, 0]], [0, 1], "A[2][1]: the complex number 1j; expected a real number"),
        (np.array([[0, 0], [1, 1j]]), [0, 1], "A[1][1]: the complex number 0j"),
        (np.array([[0, None], [1, 0]], dtype=object), [0, 1], "A[1][2]: None of type NoneType"),
        ([[0, 0], [math.nan, 0]], [0, 1], "A[2][1]: the number nan; expected a finite number"),
        ([[0, 0], ["one", 0]], [0, 1], "tableau: A[2][1]: the name 'one'"),
        ([[0, 0], ["1/", 0]], [0, 1], "tableau: A[2][1]:"),
        ([[0, 0], [sympy.Symbol("x"), 0]], [0, 1], "A[2][1]: the SymPy object x"),
        ([[0, 0], [sympy.I, 0]], [0, 1], "A[2][1]: the complex number I"),
        ([[0, 0], [True, 0]], [0, 1], "A[2][1]: the truth value True"),
        ("rk4", [0, 1], "A: 'rk4' of type str; expected a sequence of numbers"),
        ([[0, 0], [1, 0]], 1, "b: 1 of type int; expected a sequence of numbers"),
        ([], [], "tableau: b: 0 stages"),
    ],
)
def test_wrong_arrays_have_a_message_with_the_entry(A: Any, b: Any, message: str) -> None:
    with pytest.raises(TableauError) as error:
        Tableau.rk(A, b)
    assert str(error.value).startswith(message)


def test_wrong_embedded_rows_and_abscissae_have_a_message() -> None:
    with pytest.raises(TableauError, match="bhat has 1 entries, b has 2 entries"):
        Tableau.rk([[0, 0], [1, 0]], [0, 1], bhat=[1])
    with pytest.raises(TableauError, match="the sum of row 2 of A is 1"):
        Tableau.rk([[0, 0], [1, 0]], [0, 1], c=[0, 2])


def test_unknown_names_and_missing_files_have_a_message() -> None:
    with pytest.raises(UnknownName, match="no tableau 'rk44'"):
        Tableau.load("rk44")
    with pytest.raises(TableauError, match="no such file"):
        Tableau.load("nowhere/rk4.csv")


def test_a_tableau_without_claims_is_never_said_to_hold() -> None:
    report = check(Tableau.rk(A4, ["1/6", "1/3", "1/3", "1/6"]))
    assert report.verdict == "unclaimed"
    assert "holds" not in repr(report) + report._repr_html_()


@pytest.mark.parametrize("name", ["rk4", "gauss2"])
def test_floats_are_refined_to_the_exact_tableau(name: str) -> None:
    exact = Tableau.load(name)
    floats = Tableau.rk(np.array(exact.A, dtype=float), np.array(exact.b, dtype=float))
    assert refine(floats).tableau.A == exact.A
