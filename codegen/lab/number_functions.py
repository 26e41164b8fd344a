"""The functions that formulas may call, such as ``sin``, for floats, mpmath numbers, Arb balls and arrays."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Mapping

from codegen.ir.elementary import ANGLE, MATHEMATICAL
from codegen.ir.number import Number
from codegen.ir.selection import ABSOLUTE, CHOOSE
from codegen.ir.table import PiecewisePolynomial
from codegen.lab.number_types import Scalar

TABLES = "table"
"""The key for tables in a dictionary of functions (:data:`Functions`).

A table is a piecewise polynomial, given by its coefficients.
"""

Functions = Mapping[str, Scalar]
"""A dictionary that maps names such as ``sin`` to functions of numbers or arrays.

The value for the key :data:`TABLES` is a function of another kind. Its arguments are a table (a piecewise
polynomial) and a function that converts exact numbers to the number type. It returns a function that
evaluates the piecewise polynomial.
"""


def of_scalars(source: object) -> Functions:
    """Return the functions that formulas may call. They accept numbers that can be compared with ``<``.

    ``source`` is a module or type that contains ``sin``, ``sqrt`` and the remaining functions of these
    numbers. For floats, ``source`` is the module ``math``.
    """
    return {
        **{name: getattr(source, name) for name in (*MATHEMATICAL, ANGLE)},
        ABSOLUTE: abs,
        CHOOSE: _choose,
        TABLES: _scalar_table,
    }


def of_arrays(library: Scalar) -> Functions:
    """Return the functions that formulas may call. They accept arrays.

    ``library`` is NumPy, or a library with the same interface as NumPy.
    """

    def choose(x: Scalar, a: Scalar, b: Scalar) -> Scalar:
        return library.where(x > 0, a, library.where(x <= 0, b, x))

    def table(polynomial: PiecewisePolynomial, constant: Callable[[Number], Scalar]) -> Scalar:
        knots, bases, *columns = (library.array(x) for x in _converted(polynomial, constant))

        def value(x: Scalar) -> Scalar:
            place = library.searchsorted(knots, x, side="right")
            total, step = 0.0, x - bases[place]
            for column in reversed(columns):
                total = column[place] + step * total
            return total

        return value

    names = {name: getattr(library, name) for name in MATHEMATICAL}
    return names | {ANGLE: library.arctan2, ABSOLUTE: abs, CHOOSE: choose, TABLES: table}


def chosen(functions: Functions, name: str, constant: Callable[[Number], Scalar]) -> Callable[..., Scalar]:
    """Return the function with the given name. Raise ArithmeticError for a name that is not in ``functions``.

    In place of a name, the argument can be a table (a piecewise polynomial). ``constant`` then converts the
    exact coefficients of the table to the number type.
    """
    key = TABLES if isinstance(name, PiecewisePolynomial) else name
    if key not in functions:
        message = f"the function {key} is not defined for these numbers"
        raise ArithmeticError(message)
    function: Callable[..., Scalar] = functions[key](name, constant) if key == TABLES else functions[key]
    return function


def _choose(x: Scalar, a: Scalar, b: Scalar) -> Scalar:
    return a if x > 0 else b if x <= 0 else x


def _converted(polynomial: PiecewisePolynomial, constant: Callable[[Number], Scalar]) -> list[list[Scalar]]:
    """Return the knots, base points and coefficients as lists. ``constant`` converts each number.

    On each interval between knots, the function is a polynomial in x - b, where b is the base point of the
    interval. The first list contains the knots. The second list contains the base points of all intervals.
    Each further list contains the coefficients of one power of x - b on all intervals.
    """
    columns = (polynomial.knots, polynomial.bases, *zip(*polynomial.rows, strict=True))
    return [[constant(Number.rational(*x.as_integer_ratio())) for x in column] for column in columns]


def _scalar_table(polynomial: PiecewisePolynomial, constant: Callable[[Number], Scalar]) -> Scalar:
    knots, bases, *columns = _converted(polynomial, constant)

    def value(x: Scalar) -> Scalar:
        place = bisect_right(knots, x)
        *rest, total = (column[place] for column in columns)
        step = x - bases[place]
        for c in reversed(rest):
            total = c + step * total
        return total

    return value
