"""Convert the sympy formulas of a scene to expressions; the rest of the compiler uses only expressions.

The arguments of a sympy formula are sorted by ``sort_key``, so that the result does not depend on hashing.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from codegen.errors import SceneError
from codegen.ir.elementary import MATHEMATICAL
from codegen.ir.expr import Expr, Space
from codegen.ir.number import Number

if TYPE_CHECKING:
    import sympy

CALLS = frozenset(MATHEMATICAL) - {"sqrt"}
"""The functions that formulas may call; sympy writes roots as powers."""


def read(space: Space, expression: sympy.Basic | int, where: str = "") -> Expr:
    """Return a sympy expression as a node of space; a :class:`SceneError` names a part that cannot be read.

    Rational numbers stay exact. Floats are refused, because the order of a method is computed exactly and
    needs exact formulas.
    """
    import sympy

    try:
        formula = sympy.sympify(expression, strict=True)  # with strict=True, sympify does not parse strings
    except sympy.SympifyError:
        what = f"{type(expression).__name__} {expression!r}"
        raise SceneError(what, where=where, expected="a sympy formula or a number") from None
    return _Reader(space, where).node(formula)


@dataclass
class _Reader:
    """Reads one formula; equal subexpressions are read once."""

    space: Space
    where: str
    known: dict[sympy.Basic, Expr] = field(default_factory=dict)

    def node(self, e: sympy.Basic) -> Expr:
        """Return an expression as a node."""
        # Sympy expressions share subexpressions. The table stores the result for each of them; without it the
        # time could grow exponentially with the depth of the formula.
        if e not in self.known:
            self.known[e] = self._read(e)
        return self.known[e]

    def _read(self, e: sympy.Basic) -> Expr:
        import sympy

        if isinstance(e, sympy.Symbol):
            return self.space.sym(e.name)
        # A rational number stays exact. A float fails this test and is refused below.
        if isinstance(e, sympy.Rational):
            return self.space.const(Number.rational(int(e.p), int(e.q)))
        # A sum is read as a chain of binary additions in sorted order, so that its rounding errors depend
        # only on the formula.
        if isinstance(e, sympy.Add):
            return _fold(self.space.add, [self.node(a) for a in _sorted(e)])
        if isinstance(e, sympy.Mul):
            return self._product(e)
        if isinstance(e, sympy.Pow):
            return self._power(self.node(e.base), e.exp, e)
        if isinstance(e, sympy.Function) and e.func.__name__ in CALLS:
            return self.space.call(e.func.__name__, self.node(e.args[0]))
        if isinstance(e, sympy.Float):
            hint = "write Rational(1, 10) for 0.1"
            raise SceneError(f"the float {e}", where=self.where, expected="exact numbers", hint=hint)
        allowed = "symbols, rationals, + - * /, integer and half-integer powers, " + ", ".join(sorted(CALLS))
        raise SceneError(f"{type(e).__name__} in {e}", where=self.where, expected=allowed)

    def _product(self, e: sympy.Mul) -> Expr:
        """Return a product; factors with negative powers form one divisor, so that the product has one
        division."""
        import sympy

        above, below = [], []
        for a in _sorted(e):
            # A quotient a/b is the product a b^-1 in sympy.
            if isinstance(a, sympy.Pow) and a.exp.is_Rational and a.exp < 0:
                below.append(self._power(self.node(a.base), -a.exp, a))
            else:
                above.append(self.node(a))
        # Numerator and divisor are formed as separate products, because x/(y z) has one division and x y^-1
        # z^-1 has two.
        product = _fold(self.space.mul, above) if above else self.space.one
        return self.space.div(product, _fold(self.space.mul, below)) if below else product

    def _power(self, base: Expr, exponent: sympy.Expr, e: sympy.Pow) -> Expr:
        space = self.space
        if exponent.is_Integer:
            return space.pow(base, int(exponent))
        if exponent.is_Rational and exponent.q == 2:
            root, n = space.call("sqrt", base), int(exponent.p)
            # x^(n/2) = x^(n div 2) sqrt x for odd n: all half-integer powers of one base share one root.
            value = space.mul(space.pow(base, abs(n) // 2), root)
            return value if n > 0 else space.div(space.one, value)
        raise SceneError(f"the power {e}", where=self.where, expected="an integer or half-integer exponent")


def _sorted(e: sympy.Basic) -> list[sympy.Basic]:
    import sympy

    # The arguments are sorted, because sympy's order of ``args`` depends on hashes, which Python randomises
    # in each process.
    return sorted(e.args, key=sympy.default_sort_key)


def _fold(operation: Callable[[Expr, Expr], Expr], nodes: list[Expr]) -> Expr:
    # The loop starts with the first node and not with 0 or 1, so that no node is created only to be
    # simplified.
    total = nodes[0]
    for node in nodes[1:]:
        total = operation(total, node)
    return total
