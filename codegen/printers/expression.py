"""Prints expressions as infix text with few parentheses.

In IEEE arithmetic, the printed text has the same result as the expression, bit for bit. Sums and products are
never regrouped.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from codegen.ir.expr import Expr, walk
from codegen.ir.number import Number
from codegen.ir.precision import DOUBLE

SUM, PRODUCT, ATOM = 1, 2, 3

DIVIDED = "divided"
"""The name of the helper that divides in IEEE arithmetic."""


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
        """The text without the sign, on one line."""
        return " ".join(self.segments)


def number(value: Number) -> str:
    """Round a constant to the nearest double, and return the double as text.

    The text is the shortest decimal text that a compiler converts to this double.

    >>> number(Number.rational(1, 3)), number(Number.rational(2))
    ('0.3333333333333333', '2.0')
    """
    return DOUBLE.text(DOUBLE.round(value))


@dataclass(frozen=True)
class Style:
    """The conventions of a target language: the text of constants, and the names of functions.

    The divisions in ``divided`` are printed as calls of the helper :data:`DIVIDED`.
    """

    constant: Callable[[Number], str] = number
    function: Callable[[str], str] = str
    divided: frozenset[Expr] = frozenset()


DOUBLES = Style()
"""The default style: constants are printed as doubles, and functions keep their names."""


def render(root: Expr, names: dict[str, str], style: Style = DOUBLES) -> tuple[str, ...]:
    """Return the text of an expression as segments. A line may break between two segments.

    ``names`` maps symbols to identifiers of the target language. Other symbols keep their names. A power must
    be the square or the cube of a symbol. Other powers raise ValueError.
    """
    # For deeply nested expressions, a recursive function would exceed Python's recursion limit.
    rendered: dict[int, Rendering] = {}
    for node in walk([root]):
        # The function ``walk`` yields arguments first, so ``rendered`` contains the texts of all arguments.
        args = [rendered[a.id] for a in node.args]
        match node.op:
            case "const":
                # The sign is stored separately, because a sum may print the sign as the operator ``-``.
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
                # To avoid parentheses, ``a * (b * c)`` is printed as ``b * c * a``. The rounded result is the
                # same. Constants stay in front, as in ``2.0 * (b * c)``.
                swap = y.precedence == PRODUCT and x.precedence == ATOM and node.args[0].op != "const"
                rendered[node.id] = _product(y, "*", x) if swap else _product(x, "*", y)
            case "div" if node not in style.divided:
                rendered[node.id] = _product(args[0], "/", args[1])
            case "pow":
                if node.args[0].op != "sym" or node.payload > 3:
                    raise ValueError("a power must be the square or the cube of a symbol")
                # Results of ``pow`` in different languages may differ in the last bit, so powers are printed
                # as products.
                rendered[node.id] = Rendering((" * ".join([args[0].text] * node.payload),), PRODUCT)
            case _:
                # Commas separate the arguments, so no argument needs parentheses.
                inner = ", ".join(" ".join(signed(a)) for a in args)
                name = DIVIDED if node.op == "div" else node.payload
                rendered[node.id] = Rendering((f"{style.function(name)}({inner})",), ATOM)
    return signed(rendered[root.id])


def signed(x: Rendering) -> tuple[str, ...]:
    """Return the segments of ``x`` with its sign. A sum with a minus sign is printed as ``-(a + b)``."""
    if not x.negative:
        return x.segments
    if x.precedence == SUM:
        return (f"-({x.text})",)
    # A product with a minus sign is printed as ``-a * b``.
    return (f"-{x.segments[0]}", *x.segments[1:])


def _add(x: Rendering, y: Rendering) -> Rendering:
    # ``-a + b`` is printed as ``b - a``. ``a + (b + c)`` is printed as ``b + c + a``, because a sum on the
    # left needs no parentheses.
    if (x.negative and not y.negative) or (_sum(y) and not _sum(x)):
        x, y = y, x
    first = signed(x)
    # A line may break between the terms of a sum.
    head = first if _sum(x) else (" ".join(first),)
    # Floating-point addition is not associative, so a sum on the right keeps its parentheses.
    tail = f"({y.text})" if y.precedence == SUM else y.text
    return Rendering((*head, f"{'-' if y.negative else '+'} {tail}"), SUM)


def _sum(x: Rendering) -> bool:
    """Return True if ``x`` is a sum or a difference. For ``-(a + b)`` the result is False."""
    return x.precedence == SUM and not x.negative


def _product(x: Rendering, operator: str, y: Rendering) -> Rendering:
    # Division and multiplication associate to the left, so a product on the left needs no parentheses.
    left = x.segments if x.precedence >= PRODUCT else (f"({x.text})",)
    # A product on the right needs parentheses, because ``a * (b * c)`` and ``a * b * c`` may have different
    # rounding errors.
    right = y.text if y.precedence > PRODUCT else f"({y.text})"
    # The sign of the result is stored separately. In IEEE arithmetic, (-x) * y and -(x * y) have the same
    # rounded result. The same is true for (-x) / y and -(x / y).
    return Rendering((*left, f"{operator} {right}"), PRODUCT, x.negative != y.negative)
