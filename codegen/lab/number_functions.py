"""The functions (for example ``sin``) in formulas, for floats, mpmath numbers, Arb balls and arrays."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Mapping

from codegen.ir.elementary import ANGLE, MATHEMATICAL
from codegen.ir.number import Number
from codegen.ir.selection import ABSOLUTE, CHOOSE
from codegen.ir.table import PiecewisePolynomial
from codegen.lab.number_types import Scalar

TABLES = "table"
"""The key for piecewise polynomials in a dictionary of the type :data:`Functions`."""

Functions = Mapping[str, Scalar]
"""A dictionary that maps names such as ``sin`` to functions of numbers or arrays.

The value for the key :data:`TABLES` is a function ``table``. Let p be a piecewise polynomial, and let
``convert`` be a function that converts an exact coefficient to a number of the required type. Then
``table(p, convert)`` is a function that evaluates p.
"""


def of_scalars(source: object) -> Functions:
    """Return the functions that formulas may call, for one type of numbers.

    ``source`` is a module or class with functions of these numbers, for example the module ``math``. The
    numbers must have the operators ``<``, ``<=`` and ``>``.
    """
    return {
        **{name: getattr(source, name) for name in (*MATHEMATICAL, ANGLE)},
        ABSOLUTE: abs,
        CHOOSE: _choose,
        TABLES: _scalar_table,
    }


def of_arrays(library: Scalar) -> Functions:
    """Return the functions of arrays that formulas may call.

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
    """Return the function with the name ``name`` in ``functions``.

    If ``name`` is a piecewise polynomial, the result evaluates the polynomial. ``constant`` converts the
    exact coefficients of the polynomial to the number type. Raises ArithmeticError if ``functions`` has no
    such function.
    """
    key = TABLES if isinstance(name, PiecewisePolynomial) else name
    if key not in functions:
        message = f"the function {key} is not defined for this number type"
        raise ArithmeticError(message)
    function: Callable[..., Scalar] = functions[key](name, constant) if key == TABLES else functions[key]
    return function


def _choose(x: Scalar, a: Scalar, b: Scalar) -> Scalar:
    return a if x > 0 else b if x <= 0 else x


def _converted(polynomial: PiecewisePolynomial, constant: Callable[[Number], Scalar]) -> list[list[Scalar]]:
    """Return the numbers that define a piecewise polynomial, converted by ``constant``.

    On an interval with base point b, the polynomial is c_0 + c_1 (x - b) + c_2 (x - b)^2 + ...

    - The first list contains the knots, the points between the intervals.
    - The second list contains the base points of the intervals.
    - The third list contains c_0 for each interval, the next list c_1, and so on.
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
