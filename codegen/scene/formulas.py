"""Conversion of the sympy formulas of a scene to expressions."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from codegen.errors import SceneError
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, Space, evaluate, walk
from codegen.ir.from_sympy import read
from codegen.ir.number import Number
from codegen.scene.parameters import Parameter, Signal
from codegen.scene.problem import TIME

if TYPE_CHECKING:
    import sympy

NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
RESERVED = {
    "t": "t is the time; formulas may contain it, but it cannot be a coordinate or a parameter",
    "h": "h is the step size",
}
"""The names that a scene may not use for its own symbols, and the reason for each name."""


class Reader:
    """Converts the formulas of a scene to expressions. Records their parameters and functions of time."""

    def __init__(self, name: str, coordinates: Sequence[sympy.Symbol]) -> None:
        self.name = name
        self.coordinates = [str(getattr(symbol, "name", "")) for symbol in coordinates]
        for symbol, text in zip(coordinates, self.coordinates, strict=True):
            if not text:
                raise SceneError(f"the coordinate {symbol}", where=name, expected="a sympy symbol")
            self._allow(text)
        if len(set(self.coordinates)) != len(self.coordinates):
            raise SceneError("two coordinates have the same symbol", where=name, expected="distinct symbols")
        self.space = Space()
        self.defaults: dict[str, Number] = {}
        self.signals: dict[str, Expr] = {}

    def _allow(self, symbol: str) -> None:
        if symbol in RESERVED:
            raise SceneError(
                f"a symbol called {symbol}", where=self.name, expected="another name", hint=RESERVED[symbol]
            )
        if not NAME.fullmatch(symbol):
            raise SceneError(
                f"a symbol called {symbol!r}", where=self.name, expected="a letter, then letters, digits or _"
            )

    def parameters(self) -> dict[str, Number]:
        """Return the default values of all parameters in the converted formulas, by name."""
        return dict(sorted(self.defaults.items()))

    def _admit(self, symbol: Parameter) -> None:
        """Record the default value of a parameter.

        SceneError is raised for a reserved name, for the name of a coordinate or signal, and for a parameter
        that already has another default value.
        """
        self._allow(symbol.name)
        value = Number.rational(*symbol.default)
        if symbol.name in self.coordinates:
            raise self._taken(f"the parameter {symbol.name} has the name of a coordinate")
        if symbol.name in self.signals:
            raise self._taken(f"the signal {symbol.name} has the name of a parameter")
        if self.defaults.setdefault(symbol.name, value) != value:
            raise self._taken(f"the parameter {symbol.name} has two default values")

    def _admit_signal(self, symbol: Signal) -> None:
        """Record the formula of a signal. The formula may contain only the time and parameters."""
        self._allow(symbol.name)
        what = f"signal {symbol.name}"
        for inner in _free_symbols(symbol.formula):
            if inner.name != TIME and not isinstance(inner, Parameter):
                raise SceneError(
                    f"{what} contains {inner.name}", where=self.name, expected="a formula in t and parameters"
                )
        formula = self.scalar(symbol.formula, what)
        if symbol.name in self.coordinates:
            raise self._taken(f"the {what} has the name of a coordinate")
        if symbol.name in self.defaults:
            raise self._taken(f"the {what} has the name of a parameter")
        if self.signals.setdefault(symbol.name, formula) is not formula:
            raise self._taken(f"the {what} has two formulas")

    def _taken(self, what: str) -> SceneError:
        return SceneError(what, where=self.name, expected="one meaning for each name")

    def closed(self, roots: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the formulas ``roots`` with the symbol of each signal replaced by the signal's formula."""
        if not self.signals:
            return tuple(roots)
        names = {n.payload for n in walk(roots) if n.op == "sym"}
        values = {name: self.space.sym(name) for name in sorted(names)} | self.signals
        return tuple(evaluate(list(roots), ExprDomain(self.space), values))

    def scalar(
        self, formula: sympy.Expr, what: str, constant: bool = False, more: Sequence[str] = ()
    ) -> Expr:
        """Return one formula as an expression.

        The formula may contain coordinates, t, parameters, signals, and the symbols in ``more``.
        If ``constant`` is True, the formula may contain only parameters.
        """
        shape = getattr(formula, "shape", None)
        if shape == (1, 1):
            formula = formula[0]
        elif shape:
            raise SceneError(f"{what} has shape {shape}", where=self.name, expected="a scalar")
        root = read(self.space, formula, f"{self.name}, {what}")
        known = () if constant else (*self.coordinates, *more, TIME)
        for symbol in sorted(_free_symbols(formula), key=lambda s: str(s.name)):
            if isinstance(symbol, Parameter):
                self._admit(symbol)
            elif isinstance(symbol, Signal) and not constant:
                self._admit_signal(symbol)
            elif symbol.name not in known:
                hint = f'write {symbol.name} = param("{symbol.name}", 1) to make it a parameter'
                if symbol.name in RESERVED or symbol.name in self.coordinates:
                    hint = f"{what} must be constant: replace {symbol.name} by a number"
                raise SceneError(
                    f"the symbol {symbol.name} in {what} has no value",
                    where=self.name,
                    expected="numbers and parameters" if constant else "coordinates, t and parameters",
                    hint=hint if symbol.name != "h" or constant else RESERVED["h"],
                )
        return root

    def column(
        self,
        formulas: Iterable[sympy.Expr],
        n: int,
        what: str,
        constant: bool = False,
        more: Sequence[str] = (),
    ) -> tuple[Expr, ...]:
        """Return n formulas as expressions. A matrix of formulas is read row by row."""
        try:
            entries = list(_flat(formulas))
        except TypeError:
            raise SceneError(
                f"{what} is {formulas}", where=self.name, expected=f"a column of {n} components"
            ) from None
        if len(entries) != n:
            raise SceneError(
                f"{what} has {len(entries)} components", where=self.name, expected=f"{n} components"
            )
        return tuple(self.scalar(e, f"{what}[{k}]", constant, more) for k, e in enumerate(entries))


def _flat(formulas: Iterable[sympy.Expr]) -> Iterator[sympy.Expr]:
    """Yield the entries of a matrix row by row."""
    # Iteration over a sympy matrix yields entries. Iteration over a NumPy array or nested list yields rows.
    for entry in formulas:
        if isinstance(entry, list | tuple) or getattr(entry, "ndim", 0) > 0:
            yield from _flat(entry)
        else:
            yield entry


def _free_symbols(formula: sympy.Expr) -> Iterable[sympy.Symbol]:
    """Return the symbols of a formula. A Python number has no symbols."""
    symbols: Iterable[sympy.Symbol] = getattr(formula, "free_symbols", ())
    return symbols
