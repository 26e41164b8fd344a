"""Prints terms (:mod:`codegen.run.terms`) in C.

Terms are names, literals, entries of arrays, fields of records, and calls of the mathematical library.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from typing import ClassVar

from codegen.ir.precision import DOUBLE, Precision
from codegen.printers.c.text import closed_call, greatest
from codegen.printers.expression import Style, render
from codegen.printers.infix import (
    AND,
    CHOICE,
    COMPARED,
    OR,
    SIGN,
    SUM,
    Infix,
    Text,
    closed,
    joined,
)
from codegen.run.identifiers import Identifiers
from codegen.run.terms import Kind, Term, paired
from codegen.snippets.graph import LIBRARY

FUNCTIONS = {"abs": "fabs", "power": "pow"}
"""A map from function names in :mod:`codegen.run.terms` to C names.

A function that has the same name in C is omitted.
"""


def literal(precision: Precision, x: float) -> str:
    """Return the number ``x`` as a C literal in the format ``precision``."""
    return precision.text(x) + precision.suffix


def style(precision: Precision, prefix: str = "", forms: Callable[[str], str] = str) -> Style:
    """Return the conventions of C for constants (``0.5f``) and function names (``sqrtf``).

    Names of functions outside the mathematical library start with ``prefix``. ``forms`` maps the name of a
    function to the name of the variant that the code calls, for example a variant without branches.
    """

    def called(name: str) -> str:
        name = forms(name)
        # The prefix prevents a name clash of helper functions from two modules in one file.
        if name not in LIBRARY:
            return prefix + name
        # ``isfinite`` is a macro for all number formats. In single precision, other names get a suffix, as in
        # ``sqrtf``.
        return name + precision.suffix if name != "isfinite" else name

    return Style(lambda value: literal(precision, precision.round(value)), called)


class Terms(Infix):
    """Writes the terms of one function in C.

    ``pointers`` contains the names of the parameters that are pointers to records. ``tables`` contains the
    names of the constant arrays of the module.
    """

    words: ClassVar[dict[str, str]] = {"and": "&&", "or": "||", "//": "/"}

    def __init__(
        self,
        identifiers: Identifiers,
        precision: Precision,
        prefix: str,
        pointers: Collection[str],
        tables: Collection[str] = (),
        forms: Callable[[str], str] = str,
    ) -> None:
        self.identifiers, self.precision, self.prefix = identifiers, precision, prefix
        self.pointers, self.tables = frozenset(pointers), frozenset(tables)
        self.style = style(precision, prefix, forms)

    def negated(self, test: Term) -> Text:
        """Return the text of the negation of a test."""
        if test.op == "given":
            return Text((f"{self.line(test.args[0])} == NULL",), COMPARED)
        if test.op == "finite" and len(test.args) > 1:
            # De Morgan's law turns the negation of ``a || b`` into ``!a && !b``.
            finite, exact = self.one_test(test.args)
            return Text((*closed("!", finite, ""), *closed("&& !(", exact, ")")), AND)
        # If ``a`` or ``b`` is a NaN, ``!(a < b)`` is true, but ``a >= b`` is false.
        inner = self.text(test)
        return Text(closed("!", inner.within(SIGN), ""), SIGN)

    def one_test(self, values: Sequence[Term]) -> tuple[tuple[str, ...], tuple[str, ...]]:
        """Return C code for two checks that all values are finite: a fast check and an exact check."""
        # The fast check tests whether the sum of all values is finite. Because of overflow, the sum of finite
        # values may be infinite.
        finite = closed("isfinite(", self.text(paired(values)).segments, ")")
        # The difference x - x is 0 if x is finite, and NaN otherwise. Therefore the sum of these differences
        # is 0 only if all values are finite.
        differences = paired([x - x for x in values])
        zero = literal(self.precision, 0.0)
        return finite, (*self.text(differences).segments, f"== {zero}")

    def special(self, term: Term) -> Text:
        """Return the text of a term that is neither a negation nor a binary operation."""
        match term.op:
            case "name":
                return Text((self.name(term),))
            case "number":
                return Text((self.number(term),))
            case "value":
                assert term.value is not None
                # The expression may be a sum, which needs parentheses inside a product.
                return Text(render(term.value, dict(self.identifiers.by_name), self.style), SUM)
            case "status":
                return Text((self.prefix.upper() + term.text,))
            case "item" | "part" | "field":
                return self.access(term)
            case "select":
                return self.choice(*term.args)
            case "call":
                return self.called(term)
            case "finite":
                return self.finite(term.args)
            case "given":
                return Text((f"{self.line(term.args[0])} != NULL",), COMPARED)
            case "wide" | "narrow":
                return self.converted(term)
            case "holding":
                # Two arguments are passed: the callback ``hold`` and a pointer to the constant inputs.
                return Text((f"{self.prefix}hold, {self.line(term.args[0])}",))
            case "none":
                return Text(("NULL",))
            case _:
                assert term.op == "infinity"
                # INFINITY has the type float, so the cast avoids the warning of -Wdouble-promotion.
                return Text(("(double)INFINITY" if self.precision is DOUBLE else "INFINITY",))

    def name(self, term: Term) -> str:
        """Return the text of a name.

        A callback is a function that the user supplies. If the name denotes a callback, the text contains two
        C arguments, separated by a comma. The first argument is the callback. The second argument is a
        pointer to the data of the callback.
        """
        # C has no closures, so the user passes the data of the function separately.
        if term.kind is Kind.SIGNAL:
            return "input, context"
        if term.kind is Kind.EVENTS:
            return "event, data"
        # A table is global, so its name starts with the prefix of the module.
        if not term.own and term.text in self.tables:
            return self.prefix + term.text
        return self.identifiers.of(term)

    def number(self, term: Term) -> str:
        """Return the C literal of a constant."""
        if term.kind is Kind.REAL:
            return literal(self.precision, term.number)
        # A nonnegative integer constant converts to ``size_t`` without a compiler warning.
        return str(int(term.number))

    def access(self, term: Term) -> Text:
        """Return the text of an access: an array entry, a part of an array, or a field of a record."""
        base = term.args[0]
        if term.op == "field":
            # A record parameter is passed as a pointer, so its fields need ``->``.
            arrow = "->" if base.op == "name" and self.identifiers.of(base) in self.pointers else "."
            return Text((f"{self.line(base)}{arrow}{term.text}",))
        if term.op == "part":
            start = int(term.number)
            # In C a contiguous part of an array is passed as a pointer to the first entry of the part.
            return Text((f"{self.line(base)} + {start}",), SUM) if start else self.text(base)
        # A cell (an array with one entry) is a pointer in C.
        if base.cell:
            return Text((f"*{self.line(base)}",), SIGN)
        # The shape (0, n) means that the number of rows is known only at run time. C code stores the rows one
        # after the other in an array with one index.
        if base.shape[0] == 0 and len(base.shape) > 1:
            # Row 0 begins at the address of the array, so no offset is printed.
            if _is_zero(term.args[1]):
                return self.text(base)
            return Text((f"{self.line(base)} + {base.shape[1]} * {self.line(term.args[1])}",), SUM)
        if base.op == "item" and base.args[0].shape[0] == 0:
            row, width = base.args[1], base.args[0].shape[1]
            # The row and column of an entry become one index, because C code stores the rows one after the
            # other.
            place = (
                self.line(width * row + term.args[1])
                if not _is_zero(term.args[1])
                else f"{width} * {self.line(row)}"
            )
            return Text((f"{self.line(base.args[0])}[{place}]",))
        return Text((f"{self.line(base)}[{self.line(term.args[1])}]",))

    def choice(self, test: Term, yes: Term, no: Term) -> Text:
        """Return the text of the conditional expression ``test ? yes : no``."""
        segments = self.text(test).within(OR)
        first, second = self.text(yes).within(COMPARED), self.text(no)
        # The operator ``?:`` associates to the right, so a chain of choices needs no parentheses.
        last = second.segments if second.level == CHOICE else second.within(COMPARED)
        return Text((*joined(segments), *closed("? ", joined(first), ""), *closed(": ", last, "")), CHOICE)

    def finite(self, values: Sequence[Term]) -> Text:
        """Return C code for a condition that is true if all ``values`` are finite."""
        first = values[0]
        # For an array, the emitted code calls a helper function, which tests the entries in a loop.
        if first.shape:
            return Text((f"{self.prefix}all_finite({self.line(first)}, {first.shape[0]})",))
        if len(values) == 1:
            return Text(closed("isfinite(", self.text(first).segments, ")"))
        finite, exact = self.one_test(values)
        return Text((*finite, *closed("|| ", exact, "")), OR)

    def called(self, term: Term) -> Text:
        """Return the text of a function call."""
        if term.text == "greatest":
            return Text(greatest([self.line(x) for x in term.args], f"{self.prefix}greater"))
        if term.text == "largest":
            # A C array argument decays to a pointer, so the call also passes the length.
            (array,) = term.args
            return Text((f"{self.prefix}largest({self.line(array)}, {array.shape[0]})",))
        name = FUNCTIONS.get(term.text, term.text)
        # In single precision ``sqrtf`` is called, because ``sqrt`` would compute in double.
        name += "" if name == "isfinite" else self.precision.suffix
        if len(term.args) == 1:
            return Text(closed(f"{name}(", self.text(term.args[0]).segments, ")"))
        return Text(closed_call(name, [self.line(x) for x in term.args]))

    def converted(self, term: Term) -> Text:
        """Return the text of the conversion ``term``.

        The operation ``wide`` converts to double. The operation ``narrow`` converts to the number format of
        the module.
        """
        (x,) = term.args
        inner = self.text(x)
        # In double precision all real numbers are doubles, so only integers need a conversion.
        if self.precision is DOUBLE and (term.op == "narrow" or x.kind is Kind.REAL):
            return inner
        # An explicit cast avoids warnings about implicit conversions.
        to = "double" if term.op == "wide" else self.precision.c_type
        return Text(closed(f"({to})", inner.within(SIGN), ""), SIGN)


def _is_zero(term: Term) -> bool:
    return term.op == "number" and not term.number
