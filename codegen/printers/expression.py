"""Expressions as infix text with the fewest parentheses, each operation rounded as the expression says.

Only rewritings that change no bit in IEEE arithmetic are made: a + (-b) is spelled a - b, commuting operands
may trade places, a sign moves through products. Sums and products are never regrouped.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from codegen.ir.expr import Expr, walk
from codegen.ir.number import Number
from codegen.run.precision import DOUBLE

SUM, PRODUCT, ATOM = 1, 2, 3


@dataclass(frozen=True)
class Spelling:
    """Text of |x| with its precedence; ``negative`` asks for a minus; lines may break between ``pieces``."""

    pieces: tuple[str, ...]
    precedence: int
    negative: bool = False

    @property
    def text(self) -> str:
        """The text on one line, without the sign."""
        return " ".join(self.pieces)


def number(value: Number) -> str:
    """Spell a constant as a double: rounded once, shortest digits that read back the same, always a float.

    >>> number(Number.rational(1, 3)), number(Number.rational(2))
    ('0.3333333333333333', '2.0')
    """
    return DOUBLE.text(DOUBLE.round(value))


@dataclass(frozen=True)
class Style:
    """What infix notation leaves open: how constants are spelled, and what functions are called."""

    constant: Callable[[Number], str] = number
    function: Callable[[str], str] = str


DOUBLES = Style()
"""Constants as doubles, functions by their own names."""


def spell(root: Expr, names: dict[str, str], style: Style = DOUBLES) -> tuple[str, ...]:
    """Return the text of an expression, cut where a line may be broken; ``" ".join`` gives one line.

    ``names`` maps symbols to identifiers of the target; those missing stand for themselves.
    Powers must have a symbol as base and exponent 2 or 3 (see :mod:`codegen.kernel.schedule`).
    """
    made: dict[int, Spelling] = {}
    for node in walk([root]):
        args = [made[a.id] for a in node.args]
        match node.op:
            case "const":
                text = style.constant(node.payload)
                made[node.id] = Spelling((text.removeprefix("-"),), ATOM, text.startswith("-"))
            case "sym":
                made[node.id] = Spelling((names.get(node.payload, str(node.payload)),), ATOM)
            case "neg":
                (x,) = args
                made[node.id] = Spelling(x.pieces, x.precedence, not x.negative)
            case "add":
                made[node.id] = _add(*args)
            case "sub":
                x, y = args
                made[node.id] = _add(x, Spelling(y.pieces, y.precedence, not y.negative))
            case "mul":
                x, y = args
                swap = y.precedence == PRODUCT and x.precedence == ATOM and node.args[0].op != "const"
                made[node.id] = _product(y, "*", x) if swap else _product(x, "*", y)
            case "div":
                made[node.id] = _product(args[0], "/", args[1])
            case "pow":
                if node.args[0].op != "sym" or node.payload > 3:
                    raise ValueError("a power reached the printer unarranged")
                made[node.id] = Spelling((" * ".join([args[0].text] * node.payload),), PRODUCT)
            case _:
                inner = ", ".join(" ".join(signed(a)) for a in args)
                made[node.id] = Spelling((f"{style.function(node.payload)}({inner})",), ATOM)
    return signed(made[root.id])


def signed(x: Spelling) -> tuple[str, ...]:
    """Return the pieces of a spelling with its sign."""
    if not x.negative:
        return x.pieces
    if x.precedence == SUM:
        return (f"-({x.text})",)
    return (f"-{x.pieces[0]}", *x.pieces[1:])


def _add(x: Spelling, y: Spelling) -> Spelling:
    if (x.negative and not y.negative) or (_sum(y) and not _sum(x)):
        x, y = y, x
    first = signed(x)
    head = first if _sum(x) else (" ".join(first),)
    tail = f"({y.text})" if y.precedence == SUM else y.text
    return Spelling((*head, f"{'-' if y.negative else '+'} {tail}"), SUM)


def _sum(x: Spelling) -> bool:
    """Whether x is spelled as a bare sum: a negated sum stands in parentheses."""
    return x.precedence == SUM and not x.negative


def _product(x: Spelling, operator: str, y: Spelling) -> Spelling:
    left = x.pieces if x.precedence >= PRODUCT else (f"({x.text})",)
    right = y.text if y.precedence > PRODUCT else f"({y.text})"
    return Spelling((*left, f"{operator} {right}"), PRODUCT, x.negative != y.negative)
