"""Conditions of Piecewise formulas: comparisons of expressions, joined by And, Or and Not.

A condition selects one of two expressions by :data:`codegen.ir.selection.CHOOSE`. Emitted code therefore
has no branches, and all comparisons are those of a difference with zero.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from codegen.errors import SceneError
from codegen.ir.expr import Expr
from codegen.ir.selection import CHOOSE

if TYPE_CHECKING:
    import sympy

Condition = Callable[[Expr, Expr], Expr]
"""A function that returns its first argument where the condition holds, otherwise its second argument."""

EXPECTED = "comparisons of formulas (<, <=, >, >=, Eq, Ne) joined by And, Or and Not"


def positive(x: Expr) -> Condition:
    """Return the condition x > 0."""
    return lambda yes, no: x.space.call(CHOOSE, x, yes, no)


def negation(condition: Condition) -> Condition:
    """Return the condition that holds where the given one does not."""
    return lambda yes, no: condition(no, yes)


def both(a: Condition, b: Condition) -> Condition:
    """Return the condition a and b."""
    return lambda yes, no: a(b(yes, no), no)


def always(yes: Expr, no: Expr) -> Expr:
    """Return the first argument: a condition that holds everywhere."""
    return yes


def read_condition(condition: sympy.Basic, node: Callable[[sympy.Basic], Expr], where: str) -> Condition:
    """Return a condition of sympy; ``node`` reads a formula. :class:`SceneError` for any other condition."""
    import sympy

    def inner(e: sympy.Basic) -> Condition:
        return read_condition(e, node, where)

    if condition in (sympy.true, sympy.false):
        return always if condition == sympy.true else negation(always)
    if isinstance(condition, sympy.Not):
        return negation(inner(condition.args[0]))
    if isinstance(condition, sympy.And | sympy.Or):
        joins_all = isinstance(condition, sympy.And)
        total: Condition = always
        # The order of ``args`` depends on hashes, so the parts are sorted.
        for part in sorted(condition.args, key=sympy.default_sort_key):
            total = both(total, inner(part) if joins_all else negation(inner(part)))
        return total if joins_all else negation(total)
    if not isinstance(condition, sympy.core.relational.Relational):
        raise SceneError(f"the condition {condition}", where=where, expected=EXPECTED)
    a, b = (node(x) for x in condition.args)
    above, below = positive(a - b), positive(b - a)
    match condition:
        case sympy.StrictGreaterThan():
            return above
        case sympy.StrictLessThan():
            return below
        case sympy.GreaterThan():
            return negation(below)
        case sympy.LessThan():
            return negation(above)
        case sympy.Ne():
            return negation(both(negation(above), negation(below)))
        case _:
            return both(negation(above), negation(below))
