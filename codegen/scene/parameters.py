"""Parameters and signals: two kinds of sympy symbols in the formulas of scenes.

A parameter has a rational default value. A signal has a default formula in the time and in parameters.
"""

from __future__ import annotations

import sympy

from codegen.errors import SceneError
from codegen.ir.decimals import exact
from codegen.ir.number import is_normal


class Parameter(sympy.Symbol):  # type: ignore[misc]
    """A real symbol with the default value p/q. Two parameters with one name and different default
    values are different symbols.

    >>> Parameter("beta", 1) == Parameter("beta", 1), Parameter("beta", 1) == Parameter("beta", 2)
    (True, False)
    """

    __slots__ = ("default",)

    def __new__(cls, name: str, p: int, q: int = 1) -> Parameter:
        """Return a new symbol with the default value p/q."""
        symbol: Parameter = sympy.Symbol.__xnew__(cls, name, real=True)
        symbol.default = (p, q)
        return symbol

    def __getnewargs_ex__(self) -> tuple[tuple[object, ...], dict[str, object]]:
        return (self.name, *self.default), {}

    def _hashable_content(self) -> tuple[object, ...]:
        return (*super()._hashable_content(), self.default)


class Signal(sympy.Symbol):  # type: ignore[misc]
    """A real symbol for a function of time. ``formula`` is its default value, an expression in ``t`` and
    parameters."""

    __slots__ = ("formula",)

    def __new__(cls, name: str, formula: sympy.Expr) -> Signal:
        """Return a new real symbol. Its default formula is ``formula``."""
        symbol: Signal = sympy.Symbol.__xnew__(cls, name, real=True)
        symbol.formula = formula
        return symbol

    def __getnewargs_ex__(self) -> tuple[tuple[object, ...], dict[str, object]]:
        return (self.name, self.formula), {}

    def _hashable_content(self) -> tuple[object, ...]:
        return (*super()._hashable_content(), self.formula)


def param(name: str, default: object) -> Parameter:
    """Return a sympy symbol for a parameter with a rational default.

    A float denotes the decimal number that Python prints: 0.1 is 1/10. With the option
    ``emit --parameter NAME``, the parameter is an argument of emitted code instead of a constant.
    :class:`SceneError` is raised if the default is not rational, or too large or too small for a normal
    double.
    """
    value = exact(default)
    if value is None:
        raise SceneError(f"the default {default}", where=f"parameter {name}", expected="a rational number")
    if not is_normal(value):
        raise SceneError(
            f"the default {sympy.N(sympy.Rational(value.numerator, value.denominator), 3)}",
            where=f"parameter {name}",
            expected="0, or an absolute value between 1e-307 and 1e308",
        )
    return Parameter(name, value.numerator, value.denominator)


def signal(name: str, formula: object = 0) -> Signal:
    """Return a sympy symbol for a function of time, for example a control input or a measured load.

    ``formula`` may contain t and parameters. With the option ``emit --input NAME``, emitted code reads the
    signal at run time instead of evaluating ``formula``. :class:`SceneError` is raised for a formula that
    sympy cannot read.
    """
    try:
        return Signal(name, sympy.sympify(formula, strict=True))
    except sympy.SympifyError:
        raise SceneError(
            f"the formula {formula!r}", where=f"signal {name}", expected="a sympy formula in t"
        ) from None
