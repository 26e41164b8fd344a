"""Coefficients in Python and LaTeX notation, there and back."""

from __future__ import annotations

import sympy
from hypothesis import given

from orderconds.exchange.notation import from_latex, from_python, to_python
from orderconds.tableau.coefficient_latex import to_latex
from orderconds.tableau.record import from_data
from tests.orderconds.exchange.coefficients import COEFFICIENTS


@given(COEFFICIENTS)
def test_notations_translate_back_to_the_same_number(spelled: str) -> None:
    def weight(text: str) -> object:
        return from_data({"name": "t", "family": "rk", "A": [[]], "b": [text]}).method.b  # type: ignore[union-attr]

    assert weight(from_python(to_python(spelled))) == weight(spelled)
    assert weight(from_latex(to_latex(spelled))) == weight(spelled)
    if "~" not in spelled:
        names = {"Rational": sympy.Rational, "Integer": sympy.Integer, "sqrt": sympy.sqrt}
        value = eval(to_python(spelled), names)
        assert sympy.simplify(value - sympy.sympify(spelled.replace("^", "**"), rational=True)) == 0
