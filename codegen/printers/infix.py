"""Prints terms (:mod:`codegen.run.terms`) as infix text with parentheses and line breaks.

Operations are never regrouped.

Subclasses of :class:`Infix` define the notation of a target language.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

from codegen.run.terms import Term

CHOICE, OR, AND, NOT, COMPARED, SUM, PRODUCT, SIGN, ATOM = range(9)
"""Levels of precedence, from the weakest to the strongest binding."""

LEVELS = {
    "or": OR,
    "and": AND,
    **dict.fromkeys(("<", "<=", ">", ">=", "==", "!="), COMPARED),
    **dict.fromkeys("+-", SUM),
    **dict.fromkeys(("*", "/", "//", "%"), PRODUCT),
}


@dataclass(frozen=True)
class Text:
    """The text of a term.

    ``level`` is the precedence of the text. A line can end after each string in ``segments``.
    """

    segments: tuple[str, ...]
    level: int = ATOM

    @property
    def line(self) -> str:
        """The text on one line."""
        return " ".join(self.segments)

    def within(self, level: int) -> tuple[str, ...]:
        """Return ``self.segments``, in parentheses if ``self.level`` is below ``level``."""
        if self.level >= level:
            return self.segments
        return closed("(", self.segments, ")")


def closed(start: str, segments: tuple[str, ...], end: str) -> tuple[str, ...]:
    """Return the segments with ``start`` added to the first one and ``end`` added to the last one."""
    # A single segment gets both ``start`` and ``end``.
    if len(segments) == 1:
        return (f"{start}{segments[0]}{end}",)
    return (f"{start}{segments[0]}", *segments[1:-1], f"{segments[-1]}{end}")


SHORT, LONG = 48, 80
"""Operands of at most SHORT characters and comparisons of at most LONG characters stay on one line."""


def joined(segments: tuple[str, ...], most: int = SHORT) -> tuple[str, ...]:
    """Join ``segments`` by spaces to one segment of at most ``most`` characters.

    If the joined segment would be longer, ``segments`` is returned unchanged.
    """
    line = " ".join(segments)
    return (line,) if len(line) <= most else segments


class Infix(ABC):
    """Writes terms as text.

    ``words`` maps the name of an operator to its notation in the target language. An operator that is not in
    ``words`` is printed as its name.
    """

    words: ClassVar[dict[str, str]]

    def text(self, term: Term) -> Text:
        """Return the text of a term."""
        if term.op in LEVELS:
            return self.binary(term)
        if term.op == "not":
            return self.negated(term.args[0])
        if term.op == "neg":
            return Text(closed("-", self.text(term.args[0]).within(SIGN), ""), SIGN)
        return self.special(term)

    def line(self, term: Term) -> str:
        """Return the text of a term on one line."""
        return self.text(term).line

    def binary(self, term: Term) -> Text:
        """Return the text of an operation on two terms."""
        level, word = LEVELS[term.op], self.words.get(term.op, term.op)
        left, right = map(self.text, term.args)
        if level in (AND, OR):
            # C compilers warn about ``a && b || c`` without parentheses (-Wparentheses).
            tight = {OR: COMPARED, AND: NOT}[level]
            # In ``a && b && c`` the left operand ``a && b`` needs no parentheses.
            first = left.segments if left.level == level else left.within(tight)
            return Text((*first, *closed(f"{word} ", right.within(tight), "")), level)
        # ``a + (b + c)`` keeps its parentheses, because regrouping changes the rounding.
        first = left.within(level if level in (SUM, PRODUCT) else SUM)
        # A line may break before an operator.
        segments = (*first, *closed(f"{word} ", joined(right.within(level + 1)), ""))
        return Text(joined(segments, LONG) if level == COMPARED else segments, level)

    @abstractmethod
    def negated(self, test: Term) -> Text:
        """Return the text of the negation of a test."""

    @abstractmethod
    def special(self, term: Term) -> Text:
        """Return the text of a term that is neither a negation nor a binary operation."""
