"""Prints terms (:mod:`codegen.run.terms`) in Python.

In double precision, a real constant is printed as a literal. In single precision, the emitted module defines
a variable for the constant. The value of this variable is a float32 number of NumPy, and the name of this
variable is printed. A literal would be wrong in single precision: before NumPy 2, the product of a float32
number and a literal is a double.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import ClassVar

from codegen.ir.expr import Expr
from codegen.ir.number import Number
from codegen.ir.precision import DOUBLE, Precision
from codegen.printers.expression import Style, render
from codegen.printers.infix import CHOICE, COMPARED, NOT, OR, SUM, Infix, Text, closed, joined
from codegen.run.identifiers import Identifiers
from codegen.run.terms import Kind, Term


class Constants:
    """The real constants of a module.

    In single precision, ``digits`` maps the name of each constant to the text of its value. In double
    precision, ``digits`` is empty.

    ``called`` maps the name of a function in an expression to the name that is printed. The divisions in
    ``divided`` are printed as calls of a helper.
    """

    def __init__(
        self,
        precision: Precision,
        taken: frozenset[str],
        called: Callable[[str], str] = str,
        divided: frozenset[Expr] = frozenset(),
    ) -> None:
        self.precision, self.taken = precision, taken
        self.digits: dict[str, str] = {}
        self._names: dict[str, str] = {}
        self.style = Style(function=called, divided=divided) if precision is DOUBLE else Style(self._rounded)

    def _rounded(self, value: Number) -> str:
        return self.text(self.precision.round(value))

    def text(self, x: float) -> str:
        """Return the text of a number.

        In double precision the text is a literal. In single precision the text is NAME or -NAME,
        where NAME (for example ``C1``) is a constant with the absolute value of the number.
        """
        text = self.precision.text(x)
        # In double precision a literal is used, because Python reads it faster than a global name.
        if self.precision is DOUBLE:
            return text
        # A number and its negative share one constant, because a change of sign is exact.
        size = text.removeprefix("-")
        if size not in self._names:
            place = 1 + len(self._names)
            # A constant must not have the name of a variable.
            while f"C{place}" in self.taken or f"C{place}" in self.digits:
                place += 1
            self._names[size] = f"C{place}"
            self.digits[f"C{place}"] = size
        return ("-" if text.startswith("-") else "") + self._names[size]


class Terms(Infix):
    """Prints the terms (expressions) in the body of one function as Python text."""

    words: ClassVar[dict[str, str]] = {}

    def __init__(self, identifiers: Identifiers, constants: Constants) -> None:
        self.identifiers, self.constants = identifiers, constants
        self.single = constants.precision is not DOUBLE

    def negated(self, test: Term) -> Text:
        """Return the text of the negation of a test."""
        if test.op == "given":
            return Text((f"{self.line(test.args[0])} is None",), COMPARED)
        # The negation of ``a < b`` is not ``a >= b``: both comparisons are false if ``a`` or ``b`` is a NaN.
        return Text(closed("not ", self.text(test).within(COMPARED), ""), NOT)

    def special(self, term: Term) -> Text:
        """Return the text of a term other than a negation or a binary operation."""
        match term.op:
            case "name":
                return Text((self.identifiers.of(term),))
            case "number":
                return Text((self.number(term),))
            case "value":
                assert term.value is not None
                # The expression may be a sum, so its text has the precedence of a sum.
                return Text(render(term.value, dict(self.identifiers.by_name), self.constants.style), SUM)
            case "status":
                return Text((term.text,))
            case "item":
                return Text((f"{self.line(term.args[0])}[{self.line(term.args[1])}]",))
            case "part":
                start, n = int(term.number), term.shape[0]
                return Text((f"{self.line(term.args[0])}[{start}:{start + n}]",))
            case "field":
                return Text((f"{self.line(term.args[0])}.{term.text}",))
            case "select":
                return self.choice(*term.args)
            case "call":
                return Text(self.called(term))
            case "finite":
                first = term.args[0]
                # ``all`` and ``map`` are faster than a ``for`` statement, because they are implemented in C.
                listed = self.line(first) if first.shape else self.tuple_of(term.args)
                return Text((f"all(map(isfinite, {listed}))",))
            case "wide" | "narrow":
                return self.converted(term)
            case _:
                return self.argument(term)

    def argument(self, term: Term) -> Text:
        """Return the text of a term with the operation ``given``, ``holding``, ``none`` or ``infinity``.

        - ``given`` tests whether the caller has passed an optional argument.
        - ``holding`` creates a constant function of time.
        - ``none`` is passed in place of an omitted optional argument.
        """
        match term.op:
            case "given":
                return Text((f"{self.line(term.args[0])} is not None",), COMPARED)
            case "holding":
                return Text((f"lambda t: {self.line(term.args[0])}",), CHOICE)
            case "none":
                return Text(("None",))
            case _:
                assert term.op == "infinity"
                return Text(("inf",))

    def tuple_of(self, terms: tuple[Term, ...]) -> str:
        """Return the text of a tuple of terms."""
        # In Python, a tuple with a single term needs a comma after the term.
        return f"({', '.join(map(self.line, terms))}{',' if len(terms) == 1 else ''})"

    def number(self, term: Term) -> str:
        """Return the Python text of a constant."""
        if term.kind is Kind.REAL:
            return self.constants.text(term.number)
        # A flag is printed as True or False. A count is printed as an integer.
        return str(bool(term.number)) if term.kind is Kind.FLAG else str(int(term.number))

    def choice(self, test: Term, yes: Term, no: Term) -> Text:
        """Return the text of the conditional expression ``yes if test else no``."""
        # Python reads ``a if s else b if t else c`` as ``a if s else (b if t else c)``.
        first = joined(self.text(yes).within(OR))
        condition, last = self.text(test).within(OR), self.text(no).within(CHOICE)
        return Text((*first, *closed("if ", joined(condition), ""), *closed("else ", last, "")), CHOICE)

    def called(self, term: Term) -> tuple[str, ...]:
        """Return the call of a library function, split into the segments of a :class:`Text`."""
        given = [self.line(x) for x in term.args]
        # Python has no function for the largest absolute value, so two functions are combined.
        if term.text == "largest":
            return (f"max(map(abs, {given[0]}))",)
        # In Python, ``0.0 ** -1`` raises an error. The helper ``_power`` returns an infinity, like C.
        name = {"greatest": "max", "power": "_power"}.get(term.text, term.text)
        segments = closed(f"{name}(", (*(f"{x}," for x in given[:-1]), given[-1]), ")")
        # ``math.copysign`` returns a Python float, so a single precision module converts the result.
        return closed("float32(", segments, ")") if self.single and name == "copysign" else segments

    def converted(self, term: Term) -> Text:
        """Return the text of a term with the operation ``wide`` or ``narrow``.

        The operation ``wide`` converts to double, and ``narrow`` rounds to the number format of the module.
        """
        (x,) = term.args
        inner = self.text(x)
        # In double precision, reals are Python floats, so no conversion is needed. In single precision, terms
        # of the kind REAL are numbers of the type float32, and ``wide`` converts them to Python floats. Terms
        # of other kinds are Python floats or integers, so ``wide`` does not convert them.
        if not self.single or (term.op == "wide" and x.kind is not Kind.REAL):
            return inner
        return Text(closed("float(" if term.op == "wide" else "float32(", inner.segments, ")"))
