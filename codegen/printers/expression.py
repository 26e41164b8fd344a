"""Prints expressions as infix text with few parentheses. Printing does not change the rounding errors.

An expression is rewritten only if no bit of its result in IEEE arithmetic changes. For example,
``a + (-b)`` is printed as ``a - b``, and ``-a + b`` as ``b - a``. Sums and products are never regrouped.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from codegen.ir.expr import Expr, walk
from codegen.ir.number import Number
from codegen.ir.precision import DOUBLE

SUM, PRODUCT, ATOM = 1, 2, 3


@dataclass(frozen=True)
class Rendering:
    """The text of an expression, its sign, and the precedence of the text.

    ``segments`` contains the text without the sign. A line may break between two segments. ``negative`` is
    True if a minus sign is printed before the text.
    """

    segments: tuple[str, ...]
    precedence: int
    negative: bool = False

    @property
    def text(self) -> str:
        """The text on one line, without the sign."""
        return " ".join(self.segments)


def number(value: Number) -> str:
    """Return the text of a constant. The constant is rounded once to a double.

    The text is the shortest decimal text from which a compiler obtains exactly this double.

    >>> number(Number.rational(1, 3)), number(Number.rational(2))
    ('0.3333333333333333', '2.0')
    """
    return DOUBLE.text(DOUBLE.round(value))


@dataclass(frozen=True)
class Style:
    """The conventions of a target language: the text of constants, and the names of functions."""

    constant: Callable[[Number], str] = number
    function: Callable[[str], str] = str


DOUBLES = Style()
"""The default style: constants are printed as doubles, and functions keep their names."""


def render(root: Expr, names: dict[str, str], style: Style = DOUBLES) -> tuple[str, ...]:
    """Return the text of an expression as segments. A line may break between two segments.

    ``names`` maps symbols to identifiers of the target language. Other symbols keep their names. Powers must
    be squares or cubes of symbols (see :mod:`codegen.kernel.schedule`). A power of another expression, or
    with an exponent above 3, raises ValueError.
    """
    # Expressions may be nested more deeply than Python's recursion limit allows, so they are traversed by a
    # loop.
    rendered: dict[int, Rendering] = {}
    for node in walk([root]):
        args = [rendered[a.id] for a in node.args]
        match node.op:
            case "const":
                # The text of a constant has no sign. The sign is stored separately, because a sum may print
                # the sign as the operator ``-``.
                text = style.constant(node.payload)
                rendered[node.id] = Rendering((text.removeprefix("-"),), ATOM, text.startswith("-"))
            case "sym":
                rendered[node.id] = Rendering((names.get(node.payload, str(node.payload)),), ATOM)
            case "neg":
                # A negation only changes the sign flag, so ``-(-x)`` is printed as ``x``.
                (x,) = args
                rendered[node.id] = Rendering(x.segments, x.precedence, not x.negative)
            case "add":
                rendered[node.id] = _add(*args)
            case "sub":
                x, y = args
                # In IEEE arithmetic, x - y and x + (-y) have the same rounded result.
                rendered[node.id] = _add(x, Rendering(y.segments, y.precedence, not y.negative))
            case "mul":
                x, y = args
                # ``a * (b * c)`` is printed as ``b * c * a``, which needs no parentheses. Multiplication in
                # IEEE arithmetic is commutative, so the result is the same. A constant factor stays in
                # front: ``2.0 * (b * c)`` keeps its parentheses.
                swap = y.precedence == PRODUCT and x.precedence == ATOM and node.args[0].op != "const"
                rendered[node.id] = _product(y, "*", x) if swap else _product(x, "*", y)
            case "div":
                rendered[node.id] = _product(args[0], "/", args[1])
            case "pow":
                if node.args[0].op != "sym" or node.payload > 3:
                    raise ValueError("the printer accepts only squares and cubes of symbols")
                # Results of ``pow`` in different languages may differ in the last bit, so powers are printed
                # as products.
                rendered[node.id] = Rendering((" * ".join([args[0].text] * node.payload),), PRODUCT)
            case _:
                # Commas separate the arguments, so no argument needs parentheses.
                inner = ", ".join(" ".join(signed(a)) for a in args)
                rendered[node.id] = Rendering((f"{style.function(node.payload)}({inner})",), ATOM)
    return signed(rendered[root.id])


def signed(x: Rendering) -> tuple[str, ...]:
    """Return the segments of ``x`` with its sign. The negative of a sum is printed as ``-(a + b)``."""
    if not x.negative:
        return x.segments
    if x.precedence == SUM:
        return (f"-({x.text})",)
    # The sign of a product is printed before its first factor.
    return (f"-{x.segments[0]}", *x.segments[1:])


def _add(x: Rendering, y: Rendering) -> Rendering:
    # The terms are exchanged in two cases. ``-a + b`` is printed as ``b - a``. ``a + (b + c)`` is printed as
    # ``b + c + a``, because a sum on the left needs no parentheses.
    if (x.negative and not y.negative) or (_sum(y) and not _sum(x)):
        x, y = y, x
    first = signed(x)
    # A line may break between the terms of a sum. A product inside a sum stays on one line.
    head = first if _sum(x) else (" ".join(first),)
    tail = f"({y.text})" if y.precedence == SUM else y.text
    return Rendering((*head, f"{'-' if y.negative else '+'} {tail}"), SUM)


def _sum(x: Rendering) -> bool:
    """Return True if ``x`` is a sum or a difference. For ``-(a + b)`` the result is False."""
    return x.precedence == SUM and not x.negative


def _product(x: Rendering, operator: str, y: Rendering) -> Rendering:
    # Division and multiplication associate to the left in C and in Python. Therefore a product on the left
    # needs no parentheses, but a sum does.
    left = x.segments if x.precedence >= PRODUCT else (f"({x.text})",)
    # A product on the right needs parentheses, because ``a * (b * c)`` and ``a * b * c`` may have different
    # rounding errors.
    right = y.text if y.precedence > PRODUCT else f"({y.text})"
    # The signs of the operands do not change the rounding. Two minus signs cancel.
    return Rendering((*left, f"{operator} {right}"), PRODUCT, x.negative != y.negative)
