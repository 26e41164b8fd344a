"""SymPy source and matrices."""

from __future__ import annotations

import sympy

from orderconds import Tableau
from orderconds.exchange import export, read_data
from orderconds.exchange.sympy_source import from_sympy, to_sympy
from orderconds.tableau import find
from orderconds.tableau.record import from_data


def test_sympy_matrices_read_back_the_same() -> None:
    for name in ("gauss2", "rk4", "triple_jump"):
        tableau = Tableau.load(find(name))
        assert from_sympy(name, to_sympy(tableau)).method == tableau.method


def test_named_roots_are_sympys() -> None:
    matrices = to_sympy(Tableau.load(find("radau2a4")))
    assert matrices["A"].has(sympy.CRootOf)
    assert abs(float(sum(matrices["b"].evalf(30))) - 1) < 1e-15


def test_numbers_are_defined_before_they_are_used() -> None:
    numbers = {"x": "y + z", "y": "0.5~", "z": {"minpoly": [-2, 0, 1], "near": "1.4"}, "w": "x*y"}
    long = " + ".join(["w"] * 400)
    data = {"name": "t", "family": "rk", "A": [[]], "b": [long], "numbers": numbers}
    text = export(data, "sympy").decode()
    places = [text.index(f"\n{name} = ") for name in ("y", "z", "x", "w", "b")]
    assert places == sorted(places)
    assert from_data(read_data(text.encode(), "sympy", "x")).method == from_data(data).method
