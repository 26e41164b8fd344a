"""Reading formulas: from sympy into one space of expressions, with the parameters and signals that occur."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from codegen.errors import SceneError
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, Space, evaluate, walk
from codegen.ir.from_sympy import read
from codegen.ir.number import Number
from codegen.scene.problem import TIME

NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
RESERVED = {
    "t": "t is the time; it may stand in formulas, but it is no coordinate and no parameter",
    "h": "h is the step size",
}
"""Names that programs use themselves, and why."""


class Reader:
    """Reads a scene's formulas into one space and remembers which parameters occur."""

    def __init__(self, name: str, coordinates: Sequence[Any]) -> None:
        self.name = name
        self.coordinates = [str(getattr(symbol, "name", "")) for symbol in coordinates]
        for symbol, spelled in zip(coordinates, self.coordinates, strict=True):
            if not spelled:
                raise SceneError(f"the coordinate {symbol}", where=name, expected="symbols")
            self._allow(spelled)
        if len(set(self.coordinates)) != len(self.coordinates):
            raise SceneError("a coordinate symbol twice", where=name, expected="distinct symbols")
        self.more: tuple[str, ...] = ()
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
        """Return the defaults of the parameters that occur, by name."""
        return dict(sorted(self.defaults.items()))

    def _admit(self, symbol: Any) -> None:
        """Note a parameter's default."""
        self._allow(symbol.name)
        value = Number.rational(*symbol.default)
        if symbol.name in self.coordinates or self.defaults.setdefault(symbol.name, value) != value:
            raise SceneError(
                f"the parameter {symbol.name} has the name of a coordinate, or two defaults",
                where=self.name,
                expected="one meaning for each name",
            )

    def _admit_signal(self, symbol: Any) -> None:
        """Note a signal's formula, which holds the time and parameters and no coordinate."""
        self._allow(symbol.name)
        what = f"signal {symbol.name}"
        for inner in getattr(symbol.formula, "free_symbols", ()):
            if inner.name != TIME and not hasattr(inner, "default"):
                raise SceneError(f"{what} holds {inner.name}", where=self.name, expected="t and parameters")
        formula = self.scalar(symbol.formula, what)
        taken = symbol.name in self.coordinates or symbol.name in self.defaults
        if taken or self.signals.setdefault(symbol.name, formula) is not formula:
            raise SceneError(
                f"the {what} has the name of another symbol, or two formulas",
                where=self.name,
                expected="one meaning for each name",
            )

    def closed(self, roots: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return formulas with every signal replaced by its own."""
        if not self.signals:
            return tuple(roots)
        names = {n.payload for n in walk(roots) if n.op == "sym"}
        values = {name: self.space.sym(name) for name in sorted(names)} | self.signals
        return tuple(evaluate(list(roots), ExprDomain(self.space), values))

    def scalar(self, formula: Any, what: str, constant: bool = False) -> Expr:
        """Return one formula; its symbols must be coordinates, t, parameters or signals."""
        if getattr(formula, "shape", None) == (1, 1):
            formula = formula[0]
        if hasattr(formula, "shape"):
            raise SceneError(f"{what} has shape {formula.shape}", where=self.name, expected="a scalar")
        root = read(self.space, formula, f"{self.name}, {what}")
        known = () if constant else (*self.coordinates, *self.more, TIME)
        for symbol in sorted(getattr(formula, "free_symbols", ()), key=lambda s: str(s.name)):
            if hasattr(symbol, "default"):
                self._admit(symbol)
            elif hasattr(symbol, "formula") and not constant:
                self._admit_signal(symbol)
            elif symbol.name not in known:
                raise SceneError(
                    f"the symbol {symbol.name} in {what} has no value",
                    where=self.name,
                    expected="numbers and parameters" if constant else "coordinates, t and parameters",
                    hint=f'write {symbol.name} = param("{symbol.name}", 1) to make it a parameter',
                )
        return root

    def column(self, formulas: Any, n: int, what: str, constant: bool = False) -> tuple[Expr, ...]:
        """Return n formulas."""
        try:
            entries = list(formulas)
        except TypeError:
            raise SceneError(
                f"{what} is {formulas}", where=self.name, expected=f"a column of {n} components"
            ) from None
        if len(entries) != n:
            raise SceneError(f"{what} has {len(entries)} components", where=self.name, expected=str(n))
        return tuple(self.scalar(e, f"{what}[{k}]", constant) for k, e in enumerate(entries))
