"""Conversion of Python numbers to coefficients of a tableau file.

A float with few significant bits becomes an exact decimal. Other floats become decimals with the suffix ``d``
(:mod:`orderconds.tableau.doubles`). In error messages, rows and columns are counted from 1.
"""

from __future__ import annotations

import numbers
from collections.abc import Iterable
from decimal import Decimal
from fractions import Fraction
from typing import Protocol, cast

from orderconds.errors import TableauError
from orderconds.tableau.doubles import double_text, is_short
from orderconds.tableau.file_format import Coefficient

EXPECTED = (
    'a real number: an integer, a Fraction, a float, a SymPy number, or a text such as "1/4 - sqrt(3)/6"'
)


NARROW = {2: (3, 5), 4: (7, 12)}
"""For NumPy floats of 2 and 4 bytes: the number of digits of a rounded decimal, and the largest number of
significant bits of an exact number. The latter is half the number of significant bits of the format, rounded
down: 5 of 11 bits, and 12 of 24 bits. For doubles, it is 26 of 53 bits
(:data:`~orderconds.tableau.doubles.SHORT`)."""


class _Listed(Protocol):
    """An array of NumPy or a matrix of SymPy."""

    def tolist(self) -> list[object]: ...


class _Narrow(Protocol):
    """A floating-point number of NumPy that is not a double."""

    itemsize: int


def coefficient(x: object, where: str) -> Coefficient:
    """Convert a number to a coefficient of a tableau file.

    A NumPy float of 16 or 32 bits becomes an exact decimal if it counts as an exact number
    (:func:`~orderconds.tableau.doubles.is_short` with the number of bits in :data:`NARROW`). Otherwise, the
    float becomes a rounded decimal.

    Raises TableauError for complex numbers, infinities, NaN, truth values and objects that are not numbers.

    >>> from fractions import Fraction
    >>> [coefficient(x, "b[1]") for x in (1, Fraction(1, 3), "sqrt(3)/6", 0.25, 0.1)]
    [1, '1/3', 'sqrt(3)/6', '0.25', '0.1d']
    >>> coefficient(1 + 2j, "b[1]")
    Traceback (most recent call last):
    orderconds.errors.TableauError: b[1]: the complex number (1+2j); expected a real number
    """
    if isinstance(x, bool) or type(x).__name__ == "bool":
        raise TableauError(f"the truth value {x}", where=where, expected=EXPECTED)
    if isinstance(x, str):
        return str(x)
    if isinstance(x, numbers.Integral):
        return int(x)
    if isinstance(x, Fraction):
        return str(x)
    if isinstance(x, Decimal):
        if not x.is_finite():
            raise TableauError(f"the number {x}", where=where, expected="a finite number")
        return str(Fraction(x))
    if isinstance(x, float):
        return double_text(float(x), where)
    return _of_a_package(x, where)


def _of_a_package(x: object, where: str) -> Coefficient:
    """Convert a NumPy, SymPy or python-flint number to a coefficient."""
    package = type(x).__module__.partition(".")[0]
    if isinstance(x, numbers.Complex) and not isinstance(x, numbers.Real):
        raise TableauError(f"the complex number {x}", where=where, expected="a real number")
    if package == "numpy" and isinstance(x, numbers.Real):
        narrow = NARROW.get(cast("_Narrow", x).itemsize)
        return double_text(float(x), where) if narrow is None else _rounded(float(x), *narrow, where)
    if package == "sympy":
        return _of_sympy(x, where)
    if package in ("flint", "orderconds"):
        return str(x)
    shown = repr(x)
    shown = shown if len(shown) <= 60 else f"{shown[:60]} ..."
    raise TableauError(f"{shown} of type {type(x).__name__}", where=where, expected=EXPECTED)


def _rounded(x: float, digits: int, bits: int, where: str) -> Coefficient:
    text = double_text(x, where)
    if is_short(x, bits):
        return text
    return f"{Decimal(f'{x:.{digits - 1}e}'):f}~"


def _of_sympy(x: object, where: str) -> Coefficient:
    """Convert a real number of SymPy to a coefficient."""
    import sympy

    if not isinstance(x, sympy.Expr) or x.free_symbols:
        raise TableauError(f"the SymPy object {x}", where=where, expected="a SymPy number without symbols")
    if x.is_real is False:
        raise TableauError(f"the complex number {x}", where=where, expected="a real number")
    if x.is_Float:
        return double_text(float(x), where)
    text = str(x)
    if x.has(sympy.Float):
        return double_text(float(x), where)
    if x.atoms(sympy.Function, sympy.NumberSymbol) or "(" in text.replace("sqrt(", "").replace("**(", ""):
        text = str(sympy.radsimp(sympy.expand(x)))
    return text.replace("**", "^")


def row(values: object, where: str) -> list[Coefficient]:
    """Convert a sequence of numbers to coefficients. Error messages contain ``where`` as the name of the
    sequence.

    >>> row((0, 0.5, "1/2"), "b")
    [0, '0.5', '1/2']
    """
    return [coefficient(x, f"{where}[{i}]") for i, x in enumerate(_entries(values, where), start=1)]


def matrix(values: object, where: str) -> list[list[Coefficient]]:
    """Convert the rows of a matrix to coefficients. Error messages contain ``where`` as the name of the
    matrix.

    >>> matrix([[], [0.5]], "A")
    [[], ['0.5']]
    """
    return [row(x, f"{where}[{i}]") for i, x in enumerate(_items(values, where), start=1)]


def _items(values: object, where: str) -> list[object]:
    package = type(values).__module__.partition(".")[0]
    if package == "sympy" and hasattr(values, "tolist"):
        return cast("_Listed", values).tolist()
    scalar = getattr(values, "ndim", 1) == 0
    if isinstance(values, str | bytes | dict | set) or not isinstance(values, Iterable) or scalar:
        shown = repr(values)
        shown = shown if len(shown) <= 60 else f"{shown[:60]} ..."
        raise TableauError(
            f"{shown} of type {type(values).__name__}",
            where=where,
            expected="a sequence of numbers, such as a list",
        )
    return list(values)


def _entries(values: object, where: str) -> list[object]:
    """Return the entries of a row, or of a SymPy matrix with one row or one column."""
    items = _items(values, where)
    if type(values).__module__.partition(".")[0] != "sympy":
        return items
    rows = [x for x in items if isinstance(x, list)]
    return [x for part in rows for x in part] if 1 in (len(rows), *map(len, rows)) else items
