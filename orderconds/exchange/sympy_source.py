"""SymPy: Python source that builds exact matrices, and the matrices themselves."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Any

from flint import fmpq

from orderconds.errors import TableauError
from orderconds.exchange.arrays import MATRICES, ROWS, TEXTS, Arrays, arrays, coefficient, data_of, table
from orderconds.exchange.nested import nested
from orderconds.exchange.spelling import from_python, python
from orderconds.ring.roots import isolate, real_roots
from orderconds.tableau import Tableau
from orderconds.tableau.file import from_data

IMPORT = "from sympy import CRootOf, Float, Integer, Matrix, Poly, Rational, Symbol, sqrt"
_TEXT = re.compile(r"^# (\w+): (.*)$", re.MULTILINE)
_ASSIGNED = re.compile(r"^(\w+)\s*=\s*(?:\w+\()?(\[.*?\])\)?$", re.MULTILINE | re.DOTALL)


def write(data: Any) -> bytes:
    """Return Python source; rows are matrices of one row.

    >>> print(write({"name": "m", "family": "rk", "A": [["1/2"]], "b": ["1"]}).decode().splitlines()[-1])
    b = Matrix([[1]])
    """
    found = arrays(data, "SymPy")
    lines = [f"# {name}: {found[name]}" for name in TEXTS if name in found] + [IMPORT, ""]
    for name, number in _defined(found):
        lines.append(f"{name} = {python(number) if isinstance(number, str) else _root(*number)}")
    for name, value in found.items():
        if name in MATRICES:
            rows = ",\n    ".join("[" + ", ".join(map(python, row)) + "]" for row in value)
            lines.append(f"{name} = Matrix([\n    {rows}])")
        elif name in ROWS:
            lines.append(f"{name} = Matrix([[{', '.join(map(python, value))}]])")
    return ("\n".join(lines) + "\n").encode()


def _defined(found: Arrays) -> Iterator[tuple[str, str | tuple[list[str], int]]]:
    """Yield the named numbers, each after those that it refers to: a spelling, or a root.

    A root is given by descending coefficients and its place among the real ones, as ``CRootOf`` counts them.
    """
    waiting = table(found.get("numbers", "{}"), "numbers")
    while waiting:
        for name, number in list(waiting.items()):
            if isinstance(number, dict):
                yield name, _place(number)
            elif not waiting.keys() - {name} & set(re.findall(r"[A-Za-z_]\w*", str(number), re.ASCII)):
                yield name, str(number)
            else:
                continue
            del waiting[name]


def _place(root: Mapping[str, Any]) -> tuple[list[str], int]:
    near, unit = fmpq(*_ratio(root["near"])), fmpq(1, 10 ** len(root["near"].partition(".")[2]))
    monic, enclosed = isolate([fmpq(*_ratio(x)) for x in root["minpoly"]], near, unit)
    place = [x.overlaps(enclosed(256)) for x in real_roots(monic, 256)].index(True)
    return [str(x) for x in monic.coeffs()][::-1], place


def _ratio(x: str | int) -> tuple[int, int]:
    return Fraction(x).as_integer_ratio()


def _root(coefficients: list[str], place: int) -> str:
    return f'CRootOf(Poly([{", ".join(map(python, coefficients))}], Symbol("t")), {place})'


def read(content: bytes, where: str) -> dict[str, Any]:
    """Return the keys of a tableau file from such source, which is not run.

    >>> read(b"A = Matrix([[Rational(1, 2)]])\\nb = [1]", "m.py")["A"]
    [['(1/2)']]
    """
    try:
        text = content.decode()
    except UnicodeDecodeError:
        raise TableauError("bytes that are no UTF-8", where=where, expected="Python source") from None
    found: Arrays = {name: value for name, value in _TEXT.findall(text) if name in TEXTS}
    for name, value in _ASSIGNED.findall(text):
        if name in ROWS + MATRICES:
            cells = _cells(nested(value, "[", "]", f"{where}: {name}"))
            found[name] = cells[0] if name in ROWS and cells and isinstance(cells[0], list) else cells
    if not found.keys() - set(TEXTS):
        raise TableauError(
            "no matrices", where=where, expected="assignments such as  A = Matrix([[0, 0], [1, 0]])"
        )
    return data_of(found, where)


def _cells(value: Any) -> Any:
    return [_cells(x) for x in value] if isinstance(value, list) else coefficient(from_python(value))


def to_sympy(tableau: Tableau) -> dict[str, Any]:
    """Return the coefficients as SymPy matrices by name (imports SymPy).

    >>> from orderconds.checking import read
    >>> to_sympy(read("heun"))["b"]
    Matrix([[1/2, 1/2]])
    """
    import sympy

    from orderconds.exchange import convert

    found = arrays(convert(tableau), "SymPy")
    names: dict[str, Any] = {}

    def number(x: str) -> Any:
        return sympy.sympify(x.replace("^", "**").replace("~", ""), names, rational="~" not in x)

    for name, defined in _defined(found):
        if isinstance(defined, str):
            names[name] = number(defined)
        else:
            coefficients, place = defined
            polynomial = sympy.Poly([sympy.Rational(x) for x in coefficients], sympy.Symbol("t"))
            names[name] = sympy.CRootOf(polynomial, place)
    exact = {name: value for name, value in found.items() if name in ROWS + MATRICES}
    return {
        name: sympy.Matrix([[number(x) for x in row] for row in _rows(value)])
        for name, value in exact.items()
    }


def _rows(value: Any) -> Any:
    return value if value and isinstance(value[0], list) else [value]


def from_sympy(name: str, matrices: dict[str, Any], where: str = "<sympy>") -> Tableau:
    """Return the tableau with these SymPy matrices, or nested lists: ``{"A": ..., "b": ...}``.

    >>> import sympy
    >>> from_sympy("euler", {"A": [[0]], "b": [sympy.Integer(1)]}).method
    RungeKutta(A=((0,),), b=(1,))
    """
    found: Arrays = {"name": name}
    for key, matrix in matrices.items():
        rows = matrix.tolist() if hasattr(matrix, "tolist") else matrix
        cells = _cells(_texts(rows))
        found[key] = cells[0] if key in ROWS and cells and isinstance(cells[0], list) else cells
    return from_data(data_of(found, where), where)


def _texts(value: Any) -> Any:
    return [_texts(x) for x in value] if isinstance(value, list | tuple) else str(value)
