"""Selections in formulas, at which a field may not be smooth.

A selection is a call that selects one of several formulas (:mod:`codegen.ir.selection`). The *side* of a
selection is the index of the selected formula. For ``choose`` and ``fabs`` the side is 1 if the argument is
positive, else 0. For a table the side is the index of an interval. If the sides of all selections are fixed,
the formulas are smooth.
"""

from __future__ import annotations

from collections.abc import Sequence

from codegen.ir.domain import ExprDomain
from codegen.ir.elementary import ANGLE
from codegen.ir.expr import Expr, evaluate, walk
from codegen.ir.number import Number
from codegen.ir.selection import ABSOLUTE, CHOOSE, selects
from codegen.ir.table import PiecewisePolynomial

Sides = tuple[int, ...]
"""The side of each selection, in the order of :func:`selections`."""


def selections(roots: Sequence[Expr]) -> list[Expr]:
    """Return the selections in expressions. Selections in arguments of another selection come first."""
    # walk yields the arguments of a node before the node. Hence the selections in arguments come first.
    return [node for node in walk(roots) if node.op == "call" and selects(node.payload)]


def on_sides(roots: Sequence[Expr], nodes: Sequence[Expr], sides: Sides) -> tuple[list[Expr], list[Expr]]:
    """Replace each selection in ``roots`` by one of its formulas. Also return conditions for this choice.

    ``nodes`` are the selections, and ``sides`` contains the index of the chosen formula for each selection.
    The second result is a list of expressions, called margins. Where all margins are positive, the selections
    choose the formulas with the indices ``sides``.
    """
    (space,) = {node.space for node in roots}
    domain = ExprDomain(space)
    side = dict(zip((node.id for node in nodes), sides, strict=True))
    done: dict[int, Expr] = {}
    margins: list[Expr] = []
    for node in walk(roots):
        args = [done[a.id] for a in node.args]
        if node.id in side:
            # Selections in the arguments are already replaced, so the margins contain no selections.
            value, more = _side(node.payload, args, side[node.id], domain)
            margins += more
        elif node.args:
            # The operation is rebuilt with placeholders as arguments. evaluate then replaces the placeholders
            # by the new arguments and simplifies the result.
            names = [f"argument {k}" for k in range(len(args))]
            copy = space._make(node.op, tuple(map(space.sym, names)), node.payload)
            (value,) = evaluate([copy], domain, dict(zip(names, args, strict=True)))
        else:
            value = node
        done[node.id] = value
    return [done[root.id] for root in roots], margins


def _side(function: str, args: Sequence[Expr], side: int, domain: ExprDomain) -> tuple[Expr, list[Expr]]:
    """Return the formula of a selection for a side, and expressions that are positive on this side."""
    x = args[0]
    if isinstance(function, PiecewisePolynomial):
        knots = function.knots

        def constant(k: int) -> Expr:
            return domain.number(Number.rational(*knots[k].as_integer_ratio()))

        # Only inner intervals have two ends. The first interval has no lower end, and the last interval has
        # no upper end.
        margins = [x - constant(side - 1)] if side else []
        margins += [constant(side) - x] if side < len(knots) else []
        return function.on_interval(domain, x, side), margins
    # In choose(x, a, b) the formula a for positive x comes first, but here index 1 belongs to positive x.
    value = {ABSOLUTE: (-x, x), CHOOSE: tuple(reversed(args[1:]))}[function][side]
    return value, [x if side else -x]


def features(roots: Sequence[Expr]) -> str:
    """Return a text that lists the selections in expressions, or an empty text if there are none.

    >>> from codegen.ir.expr import Space
    >>> s = Space()
    >>> features([s.call("fabs", s.sym("x")) * s.sym("y")])
    'abs(x)'
    """
    words = []
    # walk visits the nodes in a fixed order, so the text depends on the expressions alone.
    for node in walk(roots):
        if node.op != "call":
            continue
        if isinstance(node.payload, PiecewisePolynomial):
            words.append(f"a table with {len(node.payload.knots)} knots")
        elif node.payload == ANGLE:
            words.append(f"{node} where it jumps from pi to -pi")
        elif node.payload == ABSOLUTE:
            words.append(f"abs({_argument(node)})")
        elif node.payload == CHOOSE:
            words.append(f"a choice at {_argument(node)} = 0")
    unique = list(dict.fromkeys(words))
    return ", ".join(unique[:SHOWN]) + (f" and {len(unique) - SHOWN} more" if len(unique) > SHOWN else "")


SHOWN = 3
"""The largest number of selections that a text lists."""


def _argument(node: Expr) -> str:
    """Return the text of an argument without a minus sign, because x = 0 and -x = 0 are the same
    condition.
    """
    x = node.args[0]
    if x.op == "neg":
        (x,) = x.args
    if x.op == "sub":
        # a - b and b - a have the same zeros. A fixed order gives both differences the same text, with a
        # constant last.
        first, second = sorted(x.args, key=lambda e: (e.op == "const", e.id))
        return f"{first} - {second}"
    # str encloses sums, products and quotients in parentheses. They are removed here.
    text = str(x)
    return text[1:-1] if x.op in ("add", "mul", "div") else text
