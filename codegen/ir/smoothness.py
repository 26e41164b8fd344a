"""Selections in the formulas of a vector field.

A selection is a call of ``choose``, ``fabs`` or a piecewise polynomial (:mod:`codegen.ir.selection`). The
*side* of a selection is the index of the selected formula. For ``fabs(x)`` and ``choose(x, a, b)``, the side
is 1 if x > 0, and 0 otherwise.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from math import prod

from codegen.ir.domain import ExprDomain
from codegen.ir.elementary import ANGLE
from codegen.ir.expr import Expr, evaluate, walk
from codegen.ir.number import Number
from codegen.ir.selection import ABSOLUTE, CHOOSE, selects
from codegen.ir.table import PiecewisePolynomial

Sides = tuple[int, ...]
"""A tuple that contains one index for each selection in a list of selections.

A selection is a call of ``choose``, ``fabs`` or a piecewise polynomial. Each call chooses one of several
formulas, and the index is the index of the chosen formula.
"""

MOST_CASES = 256
"""The largest number of combinations of cases that are checked. Each takes about a millisecond."""


def selections(roots: Sequence[Expr]) -> list[Expr]:
    """Return all selections (calls of ``choose``, ``fabs`` or a piecewise polynomial) in ``roots``.

    If an argument of a selection contains another selection, the inner selection comes first.
    """
    return [node for node in walk(roots) if node.op == "call" and selects(node.payload)]


def combinations(nodes: Sequence[Expr]) -> list[Sides] | None:
    """Return all combinations of sides of the selections ``nodes``.

    The result is None if there are more than :data:`MOST_CASES` combinations.

    The side of abs(x) is 1 for x > 0 and 0 for x < 0. For example, abs(x) and abs(-x) have only the two
    combinations (1, 0) and (0, 1). The boundary x = 0 is ignored. The side of a piecewise polynomial is the
    index of the interval that contains its argument. Two piecewise polynomials with the same argument and the
    same intervals have equal sides.
    """
    keys = [_key(node) for node in nodes]
    counts: dict[object, int] = {
        key: len(node.payload.knots) + 1 if isinstance(node.payload, PiecewisePolynomial) else 2
        for (key, _), node in zip(keys, nodes, strict=True)
    }
    if prod(counts.values()) > MOST_CASES:
        return None
    chosen = (dict(zip(counts, choice, strict=True)) for choice in product(*map(range, counts.values())))
    return [tuple(1 - side[key] if flipped else side[key] for key, flipped in keys) for side in chosen]


def _key(node: Expr) -> tuple[object, bool]:
    """Return a key and a flag for the argument x of ``node``.

    If ``node`` is the value of a table at x, the flag is False. Otherwise, x and -x have the same key, but
    different flags.
    """
    x, flipped = node.args[0], False
    if isinstance(node.payload, PiecewisePolynomial):
        return (x.id, node.payload.knots), False
    if x.op == "neg":
        (x,), flipped = x.args, True
    if x.op == "sub":
        a, b = x.args
        return tuple(sorted((a.id, b.id))), flipped != (a.id > b.id)
    return x.id, flipped


def on_sides(roots: Sequence[Expr], nodes: Sequence[Expr], sides: Sides) -> tuple[list[Expr], list[Expr]]:
    """In the expressions ``roots``, replace each of the calls ``nodes`` by a formula.

    Each call in ``nodes`` is a call of ``choose``, ``fabs`` or a piecewise polynomial, and chooses one of
    several formulas. ``sides[k]`` is the index of the formula that replaces ``nodes[k]``. The result is a
    pair of lists: the new expressions, and expressions called margins. If all margins are positive, the new
    expressions have the same values as ``roots``.
    """
    (space,) = {node.space for node in roots}
    domain = ExprDomain(space)
    side = dict(zip((node.id for node in nodes), sides, strict=True))
    done: dict[int, Expr] = {}
    margins: list[Expr] = []
    for node in walk(roots):
        args = [done[a.id] for a in node.args]
        if node.id in side:
            # The node is a selection, so it is replaced by one of its formulas.
            value, more = _side(node.payload, args, side[node.id], domain)
            margins += more
        elif node.args:
            # The copy of the node has symbols as arguments, because ``evaluate`` can only replace symbols.
            names = [f"argument {k}" for k in range(len(args))]
            copy = space._make(node.op, tuple(map(space.sym, names)), node.payload)
            (value,) = evaluate([copy], domain, dict(zip(names, args, strict=True)))
        else:
            value = node
        done[node.id] = value
    return [done[root.id] for root in roots], margins


def _side(function: str, args: Sequence[Expr], side: int, domain: ExprDomain) -> tuple[Expr, list[Expr]]:
    """Return one formula for the value of ``function(*args)``, and a list of expressions called margins.

    For example, the value of ``fabs(x)`` is -x (``side`` = 0) or x (``side`` = 1). The argument ``side`` is
    the index of the returned formula. If all margins are positive, the value is given by this formula.
    """
    x = args[0]
    if isinstance(function, PiecewisePolynomial):
        knots = function.knots

        def constant(k: int) -> Expr:
            return domain.number(Number.rational(*knots[k].as_integer_ratio()))

        # The first interval has no lower end, and the last interval has no upper end.
        margins = [x - constant(side - 1)] if side else []
        margins += [constant(side) - x] if side < len(knots) else []
        return function.on_interval(domain, x, side), margins
    # Each tuple contains the formulas for x <= 0 and for x > 0, in this order.
    value = {ABSOLUTE: (-x, x), CHOOSE: tuple(reversed(args[1:]))}[function][side]
    # The formula ``value`` is valid if the second result (x or -x) is positive.
    return value, [x if side else -x]


def features(roots: Sequence[Expr]) -> str:
    """List the calls of ``choose``, ``fabs``, ``atan2`` and piecewise polynomials in ``roots``.

    ``roots`` are expressions. The list is returned as a text. If there are no such calls, the text is empty.

    >>> from codegen.ir.expr import Space
    >>> s = Space()
    >>> features([s.call("fabs", s.sym("x")) * s.sym("y")])
    'abs(x)'
    """
    words = []
    # ``walk`` visits the nodes in a fixed order, so equal expressions always give the same text.
    for node in walk(roots):
        if node.op != "call":
            continue
        if isinstance(node.payload, PiecewisePolynomial):
            words.append(f"a table with {len(node.payload.knots)} knots")
        elif node.payload == ANGLE:
            words.append(f"the jump of {node} from pi to -pi")
        elif node.payload == ABSOLUTE:
            words.append(f"abs({argument_text(node)})")
        elif node.payload == CHOOSE:
            words.append(f"a case distinction at {argument_text(node)} = 0")
    unique = list(dict.fromkeys(words))
    return ", ".join(unique[:SHOWN]) + (f" and {len(unique) - SHOWN} more" if len(unique) > SHOWN else "")


SHOWN = 3
"""The largest number of entries in the list of :func:`features`."""


def argument_text(node: Expr) -> str:
    """Return the text of the first argument of ``node``. A minus sign before the argument is omitted."""
    x = node.args[0]
    # The zeros of x and -x are the same, so the sign does not matter.
    if x.op == "neg":
        (x,) = x.args
    if x.op == "sub":
        # The differences a - b and b - a have the same zeros, so both must give the same text. Therefore a
        # and b are sorted.
        first, second = sorted(x.args, key=lambda e: (e.op == "const", e.id))
        return f"{first} - {second}"
    # ``str`` encloses sums, products and quotients in parentheses.
    text = str(x)
    return text[1:-1] if x.op in ("add", "mul", "div") else text
