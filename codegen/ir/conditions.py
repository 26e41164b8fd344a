"""The conditions of sympy's ``Piecewise``: comparisons of expressions, joined by And, Or and Not.

``choose(x, yes, no)`` (:data:`codegen.ir.selection.CHOOSE`) selects one of two expressions by the sign of x.
Every comparison a > b becomes a call of ``choose`` with x = a - b. Emitted code evaluates both expressions.
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
"""A condition is represented by a function of two expressions ``yes`` and ``no``. The function returns an
expression that equals ``yes`` where the condition is true, and ``no`` elsewhere."""

EXPECTED = "comparisons of formulas (<, <=, >, >=, Eq, Ne) joined by And, Or and Not"


def positive(x: Expr) -> Condition:
    """Return the condition x > 0."""
    return lambda yes, no: x.space.call(CHOOSE, x, yes, no)


def negation(condition: Condition) -> Condition:
    """Return the negation of a condition."""
    return lambda yes, no: condition(no, yes)


def both(a: Condition, b: Condition) -> Condition:
    """Return the conjunction of the conditions a and b."""
    return lambda yes, no: a(b(yes, no), no)


def always(yes: Expr, no: Expr) -> Expr:
    """Return ``yes``. This function is the :data:`Condition` that is always true.

    A :data:`Condition` returns ``yes`` where it is true, and ``no`` elsewhere.
    """
    return yes


def read_condition(condition: sympy.Basic, node: Callable[[sympy.Basic], Expr], where: str) -> Condition:
    """Convert a condition of sympy to a :data:`Condition`.

    The function ``node`` converts the two sides of a comparison from sympy to :class:`Expr`. Error messages
    begin with the text ``where``, which describes the formula. Comparisons may be joined by And, Or and Not.
    For all other conditions, :class:`SceneError` is raised.
    """
    import sympy

    def inner(e: sympy.Basic) -> Condition:
        return read_condition(e, node, where)

    # sympy replaces a comparison of two numbers by true or false.
    if condition in (sympy.true, sympy.false):
        return always if condition == sympy.true else negation(always)
    if isinstance(condition, sympy.Not):
        return negation(inner(condition.args[0]))
    if isinstance(condition, sympy.And | sympy.Or):
        joins_all = isinstance(condition, sympy.And)
        # The empty conjunction is true, so the loop starts with ``always``.
        total: Condition = always
        # The order of the operands in sympy depends on hashes.
        for part in sorted(condition.args, key=sympy.default_sort_key):
            total = both(total, inner(part) if joins_all else negation(inner(part)))
        # By De Morgan's rule, (a or b) = not (not a and not b).
        return total if joins_all else negation(total)
    if not isinstance(condition, sympy.core.relational.Relational):
        raise SceneError(f"{condition} is not a condition", where=where, expected=EXPECTED)
    a, b = (node(x) for x in condition.args)
    above, below = positive(a - b), positive(b - a)
    match condition:
        case sympy.StrictGreaterThan():
            return above
        case sympy.StrictLessThan():
            return below
        # ``choose`` has no test x >= 0, so a >= b becomes not (b > a).
        case sympy.GreaterThan():
            return negation(below)
        case sympy.LessThan():
            return negation(above)
        # The numbers a and b are equal if neither is larger than the other.
        case sympy.Ne():
            return negation(both(negation(above), negation(below)))
        case _:
            return both(negation(above), negation(below))
