"""The grammar of a coefficient, an arithmetic expression of bounded size.

In the grammar, ``x*`` means that x may be repeated or omitted. ``[x]`` means that x is optional.

::

    sum      = product (("+" | "-") product)*
    product  = signed (("*" | "/") signed)*
    signed   = ("+" | "-") signed | power
    power    = atom ["^" exponent]
    exponent = ["-"] integer | "(" ["-"] integer ["/" ["-"] integer] ")"
    atom     = number ["~" | "d"] | name | "sqrt" "(" sum ")" | "(" sum ")"
    number   = integer | decimal

The decimal ``0.5`` is exactly 1/2. The rounded decimal ``0.81772~`` denotes a ball (an interval) whose radius
is one unit of the last digit, 0.00001. The double ``0.3333333333333333d`` denotes a ball whose radius is
defined in :mod:`orderconds.tableau.doubles`. The text ``a^b^c`` is an error, because it is ambiguous.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from decimal import Decimal
from fractions import Fraction
from math import inf

from msgspec import Struct

from orderconds.errors import TableauError
from orderconds.tableau import doubles

MAX_TEXT = 2000
MAX_DEPTH = 40
MAX_EXPONENT = 64
MAX_ROOT = 24

EXPECTED = 'a coefficient such as "1/2", "-0.25", "0.81772~", "1/4 - sqrt(3)/6" or "1/(2 - 2^(1/3))"'
_TOKEN = re.compile(
    r"\s*(?:(?P<decimal>\d+\.\d*|\.\d+)|(?P<integer>\d+)|(?P<name>[A-Za-z_]\w*)|(?P<sign>[-+*/^()~]))",
    re.ASCII,
)


class Constant(Struct, frozen=True, cache_hash=True):
    """An exact number or a ball (interval). If ``unit`` is zero, the constant is the rational number
    ``value``. Otherwise, it is the ball with the centre ``value`` and the radius ``unit``."""

    value: Fraction
    unit: Fraction = Fraction(0)

    @property
    def is_double(self) -> bool:
        """True if the constant is a double. An exact number has ``unit`` = 0. A rounded decimal with n
        decimal places has ``unit`` = 1/10^n. Only doubles have other values of ``unit``
        (:func:`orderconds.tableau.doubles.radius`)."""
        p, q = self.unit.as_integer_ratio()
        return p > 1 or (p == 1 and q != 10 ** (len(str(q)) - 1))


class Name(Struct, frozen=True, cache_hash=True):
    """A reference to a number that the file defines in its table ``numbers``."""

    name: str


class Chain(Struct, frozen=True, cache_hash=True):
    """A sum (operators + and -) or a product (operators * and /) of several operands. The operators are
    applied from left to right.

    A long sum is a single chain and is not deeply nested.
    """

    operators: tuple[str, ...]
    operands: tuple[Expression, ...]


class Power(Struct, frozen=True, cache_hash=True):
    """``base^exponent`` with a rational exponent. For example, sqrt(x) is x^(1/2)."""

    base: Expression
    exponent: Fraction


Expression = Constant | Name | Chain | Power
ZERO = Constant(Fraction(0))


def parse(text: str, where: str = "") -> Expression:
    """Parse one coefficient.

    Raises :class:`TableauError` if the text does not satisfy the grammar. The error message contains
    ``where``, the position of the coefficient.

    >>> parse("0.81772~")
    Constant(value=Fraction(20443, 25000), unit=Fraction(1, 100000))
    >>> parse("sqrt(x)")
    Power(base=Name(name='x'), exponent=Fraction(1, 2))
    """
    return _Parser(text, where).parse()


def spell(x: Expression, limit: int | None = None) -> str:
    """Return the text of an expression. If ``limit`` is given, the text is cut off soon after ``limit``
    characters.

    >>> [spell(parse(text)) for text in ("-(1 - sqrt(2))*3/4", "2^(-1/3)", "0.50~", "1 - (2 - 3)")]
    ['(-(1 - sqrt(2)))*3/4', '2^(-1/3)', '0.50~', '1 - (2 - 3)']
    """
    parts, length = [], 0
    for part in _parts(x, 0):
        parts.append(part)
        length += len(part)
        if limit is not None and length > limit:
            break
    return "".join(parts)


SUM, SIGN, PRODUCT, POWER, ATOM = range(5)


def _level(x: Expression) -> int:
    """Return the precedence of an expression, from SUM (lowest) to ATOM (highest)."""
    if isinstance(x, Chain):
        minus = x.operators == ("-",) and x.operands[0] == ZERO
        return SIGN if minus else SUM if x.operators[0] in "+-" else PRODUCT
    if isinstance(x, Constant) and x.value < 0:
        return SIGN
    return POWER if isinstance(x, Power) and x.exponent != Fraction(1, 2) else ATOM


def _parts(x: Expression, least: int) -> Iterator[str]:
    """Yield the text of x in pieces. The text has parentheses if the precedence of x is below ``least``."""
    level = _level(x)
    if level < least:
        yield from ("(", *_parts(x, SUM), ")")
    elif isinstance(x, Constant):
        yield _constant(x)
    elif isinstance(x, Name):
        yield x.name
    elif isinstance(x, Power) and level == ATOM:
        yield from ("sqrt(", *_parts(x.base, SUM), ")")
    elif isinstance(x, Power):
        yield from _parts(x.base, ATOM)
        yield f"^({x.exponent})" if x.exponent.denominator > 1 else f"^{x.exponent}"
    elif level == SIGN:
        yield "-"
        yield from _parts(x.operands[1], POWER)
    else:
        first, *others = x.operands
        yield from _parts(first, SUM if level == SUM else PRODUCT)
        for operator, operand in zip(x.operators, others, strict=True):
            yield operator if level == PRODUCT else f" {operator} "
            yield from _parts(operand, PRODUCT if level == SUM else POWER)


def _constant(x: Constant) -> str:
    """Return the text of a constant. An exact number without a finite decimal expansion is written as a
    fraction in parentheses."""
    if x.is_double:
        return f"{'-' if x.value < 0 else ''}{Decimal(repr(abs(float(x.value)))):f}d"
    unit = x.unit or next(
        (Fraction(1, 10**n) for n in range(MAX_TEXT) if 10**n % x.value.denominator == 0), None
    )
    if unit is None:
        return f"({x.value})"
    places = len(str(unit.denominator)) - 1
    figures = str(abs(int(x.value / unit))).rjust(places + 1, "0")
    whole, part = figures[: len(figures) - places], figures[len(figures) - places :]
    return f"{'-' if x.value < 0 else ''}{whole}{'.' if part else ''}{part}{'~' if x.unit else ''}"


class _Parser:
    def __init__(self, text: str, where: str) -> None:
        self.text, self.where = text, where
        if len(text) > MAX_TEXT:
            raise self.error(f"a coefficient of {len(text)} characters", f"at most {MAX_TEXT}")
        self.tokens = self.scan()
        self.position = 0
        self.depth = 0

    def error(self, problem: str, expected: str = EXPECTED) -> TableauError:
        return TableauError(problem, where=self.where, expected=expected)

    def scan(self) -> list[tuple[str, str, int]]:
        tokens, position, end = [], 0, len(self.text.rstrip())
        while position < end:
            match = _TOKEN.match(self.text, position)
            if match is None:
                raise self.error(f"the character {self.text[position:].lstrip()[:1]!r} in {self.shown()}")
            kind = match.lastgroup or ""
            tokens.append((kind, match.group(kind), match.start(kind)))
            position = match.end()
        tokens.append(("end", "", end))
        return tokens

    def shown(self) -> str:
        return repr(self.text if len(self.text) <= 60 else self.text[:57] + "...")

    def unexpected(self) -> TableauError:
        kind, content, at = self.tokens[self.position]
        token = "the end" if kind == "end" else repr(content)
        return self.error(f"{token} at character {at + 1} of {self.shown()}")

    def accept(self, *signs: str) -> str | None:
        kind, content, _ = self.tokens[self.position]
        if kind == "sign" and content in signs:
            self.position += 1
            return content
        return None

    def require(self, sign: str) -> None:
        if self.accept(sign) is None:
            raise self.unexpected()

    def parse(self) -> Expression:
        result = self.sum()
        if self.tokens[self.position][0] != "end":
            raise self.unexpected()
        return result

    def sum(self) -> Expression:
        self.depth += 1
        if self.depth > MAX_DEPTH:
            raise self.error(
                f"more than {MAX_DEPTH} nested parentheses in {self.shown()}",
                "an expression with fewer nested parentheses",
            )
        result = self.chain("+-", self.product)
        self.depth -= 1
        return result

    def product(self) -> Expression:
        return self.chain("*/", self.signed)

    def chain(self, signs: str, operand: Callable[[], Expression]) -> Expression:
        operators, operands = [], [operand()]
        while operator := self.accept(*signs):
            operators.append(operator)
            operands.append(operand())
        return Chain(tuple(operators), tuple(operands)) if operators else operands[0]

    def signed(self) -> Expression:
        negative = False
        while sign := self.accept("+", "-"):
            negative ^= sign == "-"
        result = self.power()
        return Chain(("-",), (ZERO, result)) if negative else result

    def power(self) -> Expression:
        base = self.atom()
        if self.accept("^") is None:
            return base
        exponent = self.exponent()
        if self.accept("^"):
            raise self.error(
                f"a power of a power needs parentheses in {self.shown()}", "parentheses, as in (a^b)^c"
            )
        return self.raised(base, exponent)

    def raised(self, base: Expression, exponent: Fraction) -> Expression:
        if abs(exponent.numerator) > MAX_EXPONENT:
            raise self.error(f"exponent {exponent} in {self.shown()}", f"at most {MAX_EXPONENT}")
        if exponent.denominator > MAX_ROOT:
            raise self.error(f"exponent {exponent} in {self.shown()}", f"a denominator of at most {MAX_ROOT}")
        return Power(base, exponent)

    def exponent(self) -> Fraction:
        if self.accept("("):
            value = self.fraction()
            self.require(")")
            return value
        return self.integer()

    def fraction(self) -> Fraction:
        top = self.integer()
        if self.accept("/") is None:
            return top
        bottom = self.integer()
        if bottom == 0:
            raise self.error(f"division by zero in {self.shown()}")
        return top / bottom

    def integer(self) -> Fraction:
        sign = -1 if self.accept("-") else 1
        kind, content, _ = self.tokens[self.position]
        if kind != "integer":
            raise self.unexpected()
        self.position += 1
        return Fraction(sign * int(content))

    def atom(self) -> Expression:
        kind, content, _ = self.tokens[self.position]
        if kind in ("integer", "decimal"):
            self.position += 1
            if self.followed_by_d():
                return self.double(content)
            value = Fraction(content)
            if self.accept("~") is None:
                return Constant(value)
            return Constant(value, Fraction(1, 10 ** len(content.partition(".")[2])))
        if kind == "name":
            self.position += 1
            return self.root() if content == "sqrt" else Name(content)
        if self.accept("("):
            result = self.sum()
            self.require(")")
            return result
        raise self.unexpected()

    def followed_by_d(self) -> bool:
        """Skip the suffix ``d`` of the preceding number, if present. Return True if the suffix is present."""
        (_, content, at), (kind, suffix, after) = self.tokens[self.position - 1 : self.position + 1]
        follows = kind == "name" and suffix == "d" and after == at + len(content)
        self.position += follows
        return follows

    def double(self, content: str) -> Constant:
        """Round the decimal ``content`` to the nearest double, and return a ball around this double.

        Raises TableauError if the decimal is too large for a double."""
        x = float(content)
        if x == inf:
            raise self.error(f"{content[:20]} ... in {self.shown()}", "a number in the range of doubles")
        value = Fraction(x)
        return Constant(value, doubles.radius(value)) if value else Constant(value)

    def root(self) -> Expression:
        self.require("(")
        result = self.sum()
        self.require(")")
        return Power(result, Fraction(1, 2))
