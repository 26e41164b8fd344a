"""Reading sympy: where a scene's formulas become expressions, and sympy ends.

The order of sympy's arguments is taken by ``sort_key``, so that the result does not depend on hashing.
"""

from __future__ import annotations

from typing import Any

from codegen.errors import SceneError
from codegen.ir.expr import Expr, Space
from codegen.ir.number import Number

CALLS = {"sin": "sin", "cos": "cos", "exp": "exp", "log": "log"}


def read(space: Space, expression: Any, where: str = "") -> Expr:
    """Return a sympy expression as a node of space; :class:`SceneError` names what cannot be read.

    Rational numbers stay exact; floats are refused, because an exact scene is what orders are computed on.
    """
    import sympy

    cache: dict[Any, Expr] = {}

    def visit(e: Any) -> Expr:
        if e in cache:
            return cache[e]
        if isinstance(e, sympy.Symbol):
            node = space.sym(e.name)
        elif isinstance(e, sympy.Rational):
            node = space.const(Number.rational(int(e.p), int(e.q)))
        elif isinstance(e, sympy.Add):
            node = _fold(space.add, [visit(a) for a in sorted(e.args, key=sympy.default_sort_key)])
        elif isinstance(e, sympy.Mul):
            node = product(e)
        elif isinstance(e, sympy.Pow):
            node = raised(visit(e.base), e.exp, e)
        elif isinstance(e, sympy.Function) and e.func.__name__ in CALLS:
            node = space.call(CALLS[e.func.__name__], visit(e.args[0]))
        elif isinstance(e, sympy.Float):
            raise SceneError(
                f"the float {e}", where=where, expected="exact numbers", hint="write Rational(1, 10) for 0.1"
            )
        else:
            allowed = "symbols, rationals, + - * /, integer and half-integer powers, sin, cos, exp, log"
            raise SceneError(f"{type(e).__name__} in {e}", where=where, expected=allowed)
        cache[e] = node
        return node

    def product(e: Any) -> Expr:
        above, below = [], []
        for a in sorted(e.args, key=sympy.default_sort_key):
            if isinstance(a, sympy.Pow) and a.exp.is_Rational and a.exp < 0:
                below.append(raised(visit(a.base), -a.exp, a))
            else:
                above.append(visit(a))
        node = _fold(space.mul, above) if above else space.one
        return space.div(node, _fold(space.mul, below)) if below else node

    def raised(base: Expr, exponent: Any, e: Any) -> Expr:
        if exponent.is_Integer:
            return space.pow(base, int(exponent))
        if exponent.is_Rational and exponent.q == 2:
            root = space.call("sqrt", base)
            n = int(exponent.p)
            whole = space.pow(base, abs(n) // 2)
            value = space.mul(whole, root)
            return value if n > 0 else space.div(space.one, value)
        raise SceneError(f"the power {e}", where=where, expected="an integer or half-integer exponent")

    try:
        formula = sympy.sympify(expression, strict=True)  # strict: a string is no formula
    except sympy.SympifyError:
        found = f"{type(expression).__name__} {expression!r}"
        raise SceneError(found, where=where, expected="a sympy formula or a number") from None
    return visit(formula)


def _fold(operation: Any, nodes: list[Expr]) -> Expr:
    total = nodes[0]
    for node in nodes[1:]:
        total = operation(total, node)
    return total
