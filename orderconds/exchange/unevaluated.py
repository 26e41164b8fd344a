"""Coefficients as unevaluated expressions, for file formats without named numbers.

In each coefficient, each named number is replaced by its formula. Rounded decimals keep their digits. Only
operations with 0 and 1 are simplified.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

from orderconds.errors import TableauError
from orderconds.ring.protocol import Element
from orderconds.tableau.evaluate import evaluate_in
from orderconds.tableau.file import File
from orderconds.tableau.grammar import MAX_TEXT, ZERO, Chain, Constant, Expression, Name, Power, spell
from orderconds.tableau.record import Tableau

ONE = Constant(Fraction(1))


class CoefficientTooLong(TableauError):
    """The error for a coefficient whose text is too long for a file.

    A coefficient can contain names of numbers. Its text becomes longer when each name is replaced by its
    definition.
    """


class Unevaluated:
    """A number that is represented by an expression and never evaluated."""

    __slots__ = ("expression",)

    def __init__(self, expression: Expression) -> None:
        self.expression = expression

    def __repr__(self) -> str:
        return f"Unevaluated({spell(self.expression)})"

    def __add__(self, other: Element) -> Unevaluated:
        if self.expression == ZERO:
            return _unevaluated(other)
        return self if _unevaluated(other).expression == ZERO else _joined("+", self, other)

    def __radd__(self, other: Element) -> Unevaluated:
        return _unevaluated(other) + self

    def __sub__(self, other: Element) -> Unevaluated:
        return self if _unevaluated(other).expression == ZERO else _joined("-", self, other)

    def __neg__(self) -> Unevaluated:
        return Unevaluated(ZERO) - self

    def __mul__(self, other: Element) -> Unevaluated:
        factor = _unevaluated(other)
        for x, y in ((self, factor), (factor, self)):
            if x.expression in (ZERO, ONE):
                return x if x.expression == ZERO else y
        return _joined("*", self, factor)

    def __rmul__(self, other: Element) -> Unevaluated:
        return _unevaluated(other) * self

    def __truediv__(self, other: Element) -> Unevaluated:
        return self if _unevaluated(other).expression == ONE else _joined("/", self, other)

    def __pow__(self, n: int) -> Unevaluated:
        return self if n == 1 else Unevaluated(Power(self.expression, Fraction(n)))


def _unevaluated(x: Element) -> Unevaluated:
    return x if isinstance(x, Unevaluated) else Unevaluated(Constant(Fraction(x)))


def _joined(operator: str, left: Unevaluated, right: Element) -> Unevaluated:
    return Unevaluated(Chain((operator,), (left.expression, _unevaluated(right).expression)))


class UnevaluatedNumbers:
    """A ring whose elements are expressions. The method :meth:`text` writes ``~`` after each inexact
    constant.

    >>> R = UnevaluatedNumbers()
    >>> R.text(R.constant(Fraction(1, 4), Fraction(1, 100)) * 3 - R.rational(1, 2))
    '0.25~*3 - 1/2'
    """

    name = "unevaluated numbers"

    def __init__(self) -> None:
        self.zero, self.one = Unevaluated(ZERO), Unevaluated(ONE)
        self._roots: dict[str, tuple[tuple[str, ...], str]] = {}

    @property
    def named_roots(self) -> tuple[tuple[str, tuple[str, ...], str], ...]:
        """One triple (name, minimal polynomial, decimal) for each named root. The decimal selects
        one root of the polynomial."""
        return tuple((name, *root) for name, root in self._roots.items())

    def rational(self, p: int, q: int = 1) -> Unevaluated:
        """Return p/q."""
        return _unevaluated(p) / q

    def constant(self, value: Fraction, unit: Fraction) -> Unevaluated:
        """Return a constant with the value ``value`` and the error bound ``unit``. An exact constant has
        the bound 0."""
        return Unevaluated(Constant(value, unit))

    def root(self, x: Unevaluated, index: int) -> Unevaluated:
        """Return the real ``index``-th root of x."""
        return Unevaluated(Power(x.expression, Fraction(1, index)))

    def named_root(
        self, minpoly: Sequence[Fraction], near: Fraction, unit: Fraction, name: str
    ) -> Unevaluated:
        """Store a real root of the polynomial ``minpoly`` under the name ``name``. Return an expression that
        consists of this name.

        The root is the only root of the polynomial in the interval [near - unit, near + unit].
        """
        self._roots[name] = tuple(map(str, minpoly)), spell(Constant(near, unit)).rstrip("~")
        return Unevaluated(Name(name))

    def size(self, x: Unevaluated) -> int:
        """Return 0, because the limit on the size of evaluated numbers does not apply to expressions."""
        return 0

    def is_zero(self, x: Unevaluated) -> bool | None:
        """Return True for the constant 0, and False for an exact constant other than 0. Return None if x is
        not an exact constant."""
        if isinstance(x.expression, Constant) and not x.expression.unit:
            return x.expression == ZERO
        return None

    def key(self, x: Unevaluated) -> tuple[str]:
        """Return a sort key for x: a tuple that contains only the text of x."""
        return (self.text(x),)

    def approximate(self, x: Unevaluated, digits: int = 20) -> str:
        """Return the text of x and ignore ``digits``, because x is never evaluated."""
        return self.text(x)

    def text(self, x: Unevaluated) -> str:
        """Return the text of x. Raise :class:`CoefficientTooLong` if the text is too long for a file."""
        text = spell(x.expression, MAX_TEXT)
        if len(text) > MAX_TEXT:
            raise CoefficientTooLong(
                "the text of a coefficient is too long",
                expected="format json, which stores named numbers",
            )
        return text


def with_names_inlined(tableau: Tableau, file: File) -> Tableau:
    """Return a copy of ``tableau``. Its coefficients are the unevaluated expressions from ``file``.

    In these expressions, each name in the table ``numbers`` is replaced by its definition.

    >>> from orderconds.tableau import Tableau
    >>> text = 'name = "m"\\nfamily = "rk"\\nA = [["a/2"]]\\nb = ["1"]\\nnumbers = { a = "0.99~" }'
    >>> inlined = with_names_inlined(Tableau.loads(text), Tableau.loads(text).file)
    >>> inlined.ring.text(inlined.method.A[0][0])
    '0.99~/2'
    """
    ring, texts = UnevaluatedNumbers(), file.symbolic
    values = evaluate_in(ring, texts.expressions, texts.numbers, texts.where)
    method, embedded = texts.build(values, ring)
    return replace(tableau, ring=ring, method=method, embedded=embedded, file=None)
