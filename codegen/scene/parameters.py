"""Parameters and signals of scenes: sympy symbols that carry a rational default, or a formula in time."""

from __future__ import annotations

from typing import Any

from sympy import Symbol


class Parameter(Symbol):  # type: ignore[misc]
    """A real symbol with the default p/q; parameters of one name and two defaults are different symbols.

    >>> Parameter("beta", 1) == Parameter("beta", 1), Parameter("beta", 1) == Parameter("beta", 2)
    (True, False)
    """

    __slots__ = ("default",)

    def __new__(cls, name: str, p: int, q: int = 1) -> Parameter:
        """Return the symbol; sympy makes equal symbols in ``__new__``."""
        symbol: Parameter = Symbol.__xnew__(cls, name, real=True)
        symbol.default = (p, q)
        return symbol

    def __getnewargs_ex__(self) -> tuple[tuple[Any, ...], dict[str, Any]]:
        return (self.name, *self.default), {}

    def _hashable_content(self) -> tuple[Any, ...]:
        return (*super()._hashable_content(), self.default)


class Signal(Symbol):  # type: ignore[misc]
    """A real symbol for a function of time: ``formula`` in ``t`` and parameters is what it is by default."""

    __slots__ = ("formula",)

    def __new__(cls, name: str, formula: Any) -> Signal:
        """Return the symbol; sympy makes equal symbols in ``__new__``."""
        symbol: Signal = Symbol.__xnew__(cls, name, real=True)
        symbol.formula = formula
        return symbol

    def __getnewargs_ex__(self) -> tuple[tuple[Any, ...], dict[str, Any]]:
        return (self.name, self.formula), {}

    def _hashable_content(self) -> tuple[Any, ...]:
        return (*super()._hashable_content(), self.formula)
