"""Conversion between tableaux, SymPy matrices, and Python source that uses SymPy."""

from __future__ import annotations

import keyword
import re
from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import TYPE_CHECKING

from orderconds.exchange.arrays import (
    MATRICES,
    ROWS,
    TABLES,
    TEXTS,
    Arrays,
    coefficient,
    from_arrays,
    to_arrays,
)
from orderconds.exchange.claim_text import json_table
from orderconds.exchange.comments import escaped
from orderconds.exchange.nested import Cells
from orderconds.exchange.notation import from_python, to_python
from orderconds.ring.roots import place_of_root
from orderconds.tableau import Tableau
from orderconds.tableau.file_format import Data
from orderconds.tableau.record import from_data
from orderconds.tableau.write import as_data

if TYPE_CHECKING:
    from sympy import Expr, Matrix

IMPORT = "from sympy import CRootOf, Float, Integer, Matrix, Poly, Rational, Symbol, sqrt"
_NAME = re.compile(r"[A-Za-z_]\w*", re.ASCII)


def write(data: Data) -> bytes:
    """Return Python source that constructs the arrays of a tableau as SymPy matrices. A vector is written as
    a matrix with one row.

    >>> print(write({"name": "m", "family": "rk", "A": [["1/2"]], "b": ["1"]}).decode().splitlines()[-1])
    b = Matrix([[1]])
    """
    entries = to_arrays(_with_python_names(data), "SymPy")
    lines = [f"# {name}: {escaped(entries[name])}" for name in TEXTS if name in entries] + [IMPORT, ""]
    for name, number in _defined(entries):
        lines.append(f"{name} = {to_python(number) if isinstance(number, str) else _root(*number)}")
    for name, value in entries.items():
        if name in MATRICES:
            rows = ",\n    ".join("[" + ", ".join(map(to_python, row)) + "]" for row in value)
            lines.append(f"{name} = Matrix([\n    {rows}])")
        elif name in ROWS:
            lines.append(f"{name} = Matrix([[{', '.join(map(to_python, value))}]])")
    return ("\n".join(lines) + "\n").encode()


def _defined(entries: Arrays) -> Iterator[tuple[str, str | tuple[list[str], int]]]:
    """Yield the name and the definition of each named number.

    The definition of a number x can contain the name of a number y. In this case, y is yielded before x.

    A definition is a formula or a pair (coefficients, index). The pair defines a real root of a polynomial.
    The coefficients are in descending degree. The real roots are numbered from 0, in ascending order.
    """
    remaining = json_table(entries.get("numbers", "{}"), "numbers")
    while remaining:
        for name, number in list(remaining.items()):
            if isinstance(number, dict):
                yield name, _place(number)
            elif not remaining.keys() - {name} & set(re.findall(r"[A-Za-z_]\w*", str(number), re.ASCII)):
                yield name, str(number)
            else:
                continue
            del remaining[name]


def _place(root: Data) -> tuple[list[str], int]:
    unit = Fraction(1, 10 ** len(root["near"].partition(".")[2]))
    coefficients, place = place_of_root([Fraction(x) for x in root["minpoly"]], Fraction(root["near"]), unit)
    return [str(x) for x in coefficients][::-1], place


def _root(coefficients: list[str], place: int) -> str:
    return f'CRootOf(Poly([{", ".join(map(to_python, coefficients))}], Symbol("t")), {place})'


def read(content: bytes, where: str) -> Data:
    """Read a tableau from Python source, and return a dictionary with the keys of a tableau file.

    The source is not executed (:mod:`orderconds.exchange.python_source`).

    >>> read(b"A = Matrix([[Rational(1, 2)]])\\nb = [1]", "m.py")["A"]
    [['1/2']]
    """
    from orderconds.exchange import python_source

    return python_source.read(content, where)


def _with_python_names(data: Data) -> Data:
    taken = {*keyword.kwlist, *keyword.softkwlist, *_NAME.findall(IMPORT), *MATRICES, *ROWS}
    numbers = data.get("numbers") or {}
    renamed = dict[str, str]()
    for name in numbers:
        if name in taken:
            other = name + "_"
            while other in taken or other in numbers or other in renamed.values():
                other += "_"
            renamed[name] = other
    if not renamed:
        return data

    def formatted(x: object) -> object:
        if isinstance(x, str):
            return _NAME.sub(lambda m: renamed.get(m[0], m[0]), x)
        if isinstance(x, list):
            return [formatted(y) for y in x]
        return {key: formatted(y) for key, y in x.items()} if isinstance(x, dict) else x

    texts = {key: data[key] for key in TEXTS if key in data and key not in TABLES}
    rest = {key: formatted(x) for key, x in data.items() if key not in texts and key not in TABLES}
    roots = {
        renamed.get(name, name): x if isinstance(x, dict) else formatted(x) for name, x in numbers.items()
    }
    claims = {"claims": data["claims"]} if "claims" in data else {}
    return {**texts, **rest, "numbers": roots, **claims}


def _cells(value: Cells) -> Cells:
    return [_cells(x) for x in value] if isinstance(value, list) else coefficient(from_python(value))


def to_sympy(tableau: Tableau) -> dict[str, Matrix]:
    """Return the arrays of a tableau as SymPy matrices. The keys are the names of the arrays, such as ``b``.

    >>> from orderconds.checking import read
    >>> to_sympy(read("heun"))["b"]
    Matrix([[1/2, 1/2]])
    """
    import sympy

    entries = to_arrays(as_data(tableau), "SymPy")
    names: dict[str, Expr] = {}

    def number(x: str) -> Expr:
        return sympy.sympify(x.replace("^", "**").replace("~", ""), names, rational="~" not in x)

    for name, defined in _defined(entries):
        if isinstance(defined, str):
            names[name] = number(defined)
        else:
            coefficients, place = defined
            polynomial = sympy.Poly([sympy.Rational(x) for x in coefficients], sympy.Symbol("t"))
            names[name] = sympy.CRootOf(polynomial, place)
    exact = {name: value for name, value in entries.items() if name in ROWS + MATRICES}
    return {
        name: sympy.Matrix([[number(x) for x in row] for row in (value if name in MATRICES else [value])])
        for name, value in exact.items()
    }


def from_sympy(name: str, matrices: Mapping[str, object], where: str = "<sympy>") -> Tableau:
    """Return a tableau from SymPy matrices or nested lists: ``{"A": ..., "b": ...}``.

    >>> import sympy
    >>> from_sympy("euler", {"A": [[0]], "b": [sympy.Integer(1)]}).method
    RungeKutta(A=((0,),), b=(1,))
    """
    entries: Arrays = {"name": name}
    for key, matrix in matrices.items():
        rows = matrix.tolist() if hasattr(matrix, "tolist") else matrix
        cells = _cells(_texts(rows))
        entries[key] = cells[0] if key in ROWS and cells and isinstance(cells[0], list) else cells
    return from_data(from_arrays(entries, where), where)


def _texts(value: object) -> Cells:
    return [_texts(x) for x in value] if isinstance(value, list | tuple) else str(value)
