"""The types of coefficients in the Python interface: Fraction, float and :class:`RealNumber`."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, cast

from orderconds.ring.protocol import Element, Ring

if TYPE_CHECKING:
    import sympy

    from orderconds.ring.protocol import RealRing


@dataclass(frozen=True)
class RealNumber:
    """A real coefficient that is not an exact rational number. ``text`` is the number in the grammar of
    tableau files, and ``nearest`` is the nearest double.

    >>> root = RealNumber("sqrt(3)/6", 0.28867513459481287)
    >>> root, float(root)
    (sqrt(3)/6, 0.28867513459481287)
    """

    text: str
    nearest: float

    def __float__(self) -> float:
        return self.nearest

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return self.text

    def _repr_latex_(self) -> str:
        from orderconds.tableau.coefficient_latex import to_latex

        return f"${to_latex(self.text)}$"

    def _sympy_(self) -> sympy.Expr:
        """Convert the number to a SymPy expression, for ``sympy.sympify``. A rounded decimal becomes a SymPy
        Float."""
        import sympy

        if "~" in self.text:
            return sympy.Float(self.nearest)
        return sympy.sympify(self.text.replace("^", "**"), rational=True)


Value = Fraction | float | RealNumber
"""A coefficient in the Python interface. An exact rational number is a Fraction. In a tableau with doubles,
all other coefficients are floats. In a tableau without doubles, all other coefficients are RealNumbers."""


def value_of(x: Element, ring: Ring, doubles: bool = False) -> Value:
    """Convert an element of a ring to a value for Python users. An exact rational number becomes a Fraction.
    All other elements become floats if ``doubles`` is true, and :class:`RealNumber` objects otherwise.

    >>> from orderconds.ring import QQ
    >>> value_of(QQ.one / 2, QQ)
    Fraction(1, 2)
    """
    text = ring.text(x)
    try:
        return Fraction(text)
    except ValueError:
        nearest = cast("RealRing", ring).nearest_float(x)
        return nearest if doubles else RealNumber(text, nearest)
