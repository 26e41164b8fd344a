"""An order condition is an equation ``formula = rhs`` for one tree.

The numerical solution and the exact solution are series with one term for each tree. ``formula`` is the
coefficient of the tree in the numerical solution. The number ``rhs`` is the coefficient of the tree in the
exact solution. A method has order p if and only if all conditions of the orders 1, ..., p hold.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import Any

from orderconds.formula import Formula, named
from orderconds.formula.notation import latex_fraction

SHOWN = 80
"""The ``repr`` of a condition shows at most this number of characters of the equation."""


@dataclass(frozen=True, repr=False)
class OrderCondition:
    """An order condition: the equation ``formula = rhs`` for the parameters of a method.

    - ``family`` is the label of the family, for example ``rkmk(1)``.
    - ``order`` is the order of the condition.
    - ``tree`` is the text of a tree or word.
    - ``source`` is the left-hand side, or a function that returns the left-hand side.
    - ``rhs`` is the right-hand side.
    - ``key`` is the tree in the internal encoding of the family.
    - ``relation`` is None for an independent condition. For a dependent condition, ``relation`` is the
      left-hand side as a polynomial in other left-hand sides. The symbol ``<x>`` denotes the left-hand side
      of the condition of the tree x. An example is ``3 <o(|L(o o))> - <o> <o(o)>``.

    >>> from orderconds.formula import coefficient, index_sum
    >>> quadrature = OrderCondition("rk", 1, "[]", index_sum(("i",), (), coefficient("b", "i")), Fraction(1))
    >>> print(quadrature)
    sum_i b_i = 1
    """

    family: str
    order: int
    tree: str
    source: Formula | Callable[[], Formula] = field(repr=False, compare=False)
    rhs: Fraction
    key: Any = field(default=None, repr=False, compare=False)
    relation: str | None = None

    @cached_property
    def formula(self) -> Formula:
        """The left-hand side of the condition, with readable index names."""
        return named(self.source if isinstance(self.source, Formula) else self.source())

    @cached_property
    def expression(self) -> str:
        """The left-hand side of the condition as ASCII text."""
        return self.formula.text()

    @property
    def latex(self) -> str:
        """The left-hand side of the condition in LaTeX."""
        return self.formula.latex()

    @property
    def latex_equation(self) -> str:
        """The condition in LaTeX: left-hand side = right-hand side."""
        return f"{self.latex} = {latex_fraction(self.rhs)}"

    def sympy(self) -> Any:
        """Return the equation as ``sympy.Eq``. SymPy is imported only when this function is called."""
        import sympy

        from orderconds.formula.sympy_form import export

        rhs = sympy.Rational(self.rhs.numerator, self.rhs.denominator)
        return sympy.Eq(export(self.formula), rhs, evaluate=False)

    def as_json(self) -> dict[str, object]:
        """Return the entry of the condition in the output of ``orderconds derive --format json``."""
        record: dict[str, object] = {
            "order": self.order,
            "tree": self.tree,
            "expression": self.expression,
            "latex": self.latex,
            "rhs": str(self.rhs),
        }
        return record if self.relation is None else {**record, "relation": self.relation}

    def __str__(self) -> str:
        return f"{self.expression} = {self.rhs}"

    def __repr__(self) -> str:
        shown = str(self)
        shown = shown if len(shown) <= SHOWN else f"{shown[:SHOWN]} ..."
        return f"OrderCondition({self.family} {self.tree}: {shown})"

    def _repr_latex_(self) -> str:
        return rf"$\displaystyle {self.latex_equation}$"
