"""The coefficients of a file as it spells them, with what its names stand for in their place.

Tables and arrays have no names; rounded decimals keep their digits, which a computed ball does not. So the
method is built over unevaluated expressions: those of the file, sums and products where a format expands
(low-storage schemes), nothing simplified but zero and one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

from orderconds.errors import TableauError
from orderconds.tableau.evaluate import evaluate_in
from orderconds.tableau.grammar import MAX_TEXT, ZERO, Chain, Constant, Expression, Name, Power, spell
from orderconds.tableau.record import File, Tableau

ONE = Constant(Fraction(1))


class TooLong(TableauError):
    """A coefficient that needs its names."""


class Spelling:
    """An unevaluated number."""

    __slots__ = ("expression",)

    def __init__(self, expression: Expression) -> None:
        self.expression = expression

    def __repr__(self) -> str:
        return f"Spelling({spell(self.expression)})"

    def __add__(self, other: Any) -> Spelling:
        if self.expression == ZERO:
            return _spelling(other)
        return self if _spelling(other).expression == ZERO else _joined("+", self, other)

    def __radd__(self, other: Any) -> Spelling:
        return _spelling(other) + self

    def __sub__(self, other: Any) -> Spelling:
        return self if _spelling(other).expression == ZERO else _joined("-", self, other)

    def __neg__(self) -> Spelling:
        return Spelling(ZERO) - self

    def __mul__(self, other: Any) -> Spelling:
        factor = _spelling(other)
        for x, y in ((self, factor), (factor, self)):
            if x.expression in (ZERO, ONE):
                return x if x.expression == ZERO else y
        return _joined("*", self, factor)

    def __rmul__(self, other: Any) -> Spelling:
        return _spelling(other) * self

    def __truediv__(self, other: Any) -> Spelling:
        return self if _spelling(other).expression == ONE else _joined("/", self, other)

    def __pow__(self, n: int) -> Spelling:
        return self if n == 1 else Spelling(Power(self.expression, Fraction(n)))


def _spelling(x: Any) -> Spelling:
    return x if isinstance(x, Spelling) else Spelling(Constant(Fraction(x)))


def _joined(operator: str, left: Spelling, right: Any) -> Spelling:
    return Spelling(Chain((operator,), (left.expression, _spelling(right).expression)))


class Spellings:
    """Unevaluated numbers as a ring in which nothing is known but what is spelled zero.

    >>> R = Spellings()
    >>> R.text(R.constant(Fraction(1, 4), Fraction(1, 100)) * 3 - R.rational(1, 2))
    '0.25~*3 - 1/2'
    """

    name = "spellings"

    def __init__(self) -> None:
        self.zero, self.one = Spelling(ZERO), Spelling(ONE)
        self._roots: dict[str, tuple[tuple[str, ...], str]] = {}

    @property
    def named_roots(self) -> tuple[tuple[str, tuple[str, ...], str], ...]:
        """(name, minimal polynomial, isolating decimal) of the roots that have a name."""
        return tuple((name, *root) for name, root in self._roots.items())

    def rational(self, p: int, q: int = 1) -> Spelling:
        """Return p/q."""
        return _spelling(p) / q

    def constant(self, value: Fraction, unit: Fraction) -> Spelling:
        """Return a constant of the file."""
        return Spelling(Constant(value, unit))

    def root(self, x: Spelling, index: int) -> Spelling:
        """Return the root of x."""
        return Spelling(Power(x.expression, Fraction(1, index)))

    def named_root(self, minpoly: Sequence[Fraction], near: Fraction, unit: Fraction, name: str) -> Spelling:
        """Return the root by its name."""
        self._roots[name] = tuple(map(str, minpoly)), spell(Constant(near, unit)).rstrip("~")
        return Spelling(Name(name))

    def size(self, x: Spelling) -> int:
        """Return 0: what explodes was refused when the file was read."""
        return 0

    def is_zero(self, x: Spelling) -> bool | None:
        """Return True for what is spelled 0, False for other constants, else None."""
        if isinstance(x.expression, Constant) and not x.expression.unit:
            return x.expression == ZERO
        return None

    def key(self, x: Spelling) -> tuple[str]:
        """Return the text alone."""
        return (self.text(x),)

    def approximate(self, x: Spelling, digits: int = 20) -> str:
        """Return the text: nothing is computed."""
        return self.text(x)

    def text(self, x: Spelling) -> str:
        """Return the coefficient; :class:`TooLong` where it is longer than a file may have."""
        text = spell(x.expression, MAX_TEXT)
        if len(text) > MAX_TEXT:
            raise TooLong(
                "a coefficient too long without names", expected="format json, which holds everything"
            )
        return text


def without_names(tableau: Tableau, file: File) -> Tableau:
    """Return the tableau over :class:`Spellings`, as ``file`` spells it.

    >>> from orderconds.tableau import Tableau
    >>> text = 'name = "m"\\nfamily = "rk"\\nA = [["a/2"]]\\nb = ["1"]\\nnumbers = { a = "0.99~" }'
    >>> found = without_names(Tableau.loads(text), Tableau.loads(text).file)
    >>> found.ring.text(found.method.A[0][0])
    '0.99~/2'
    """
    ring, spelled = Spellings(), file.spelled
    values = evaluate_in(ring, spelled.expressions, spelled.numbers, spelled.where)
    method, embedded = spelled.build(values, ring)
    return replace(tableau, ring=ring, method=method, embedded=embedded, file=None)
