"""Convert a user's sympy formulas to expressions (:mod:`codegen.ir.expr`). The rest of the compiler does not
use sympy formulas.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from codegen.errors import SceneError
from codegen.ir.conditions import Condition, always, both, negation, positive, read_condition
from codegen.ir.decimals import decimal
from codegen.ir.differentiate import sign
from codegen.ir.elementary import ANGLE, MATHEMATICAL
from codegen.ir.expr import Expr, Space, walk
from codegen.ir.number import Number, is_normal
from codegen.ir.selection import ABSOLUTE
from codegen.ir.table import PiecewisePolynomial

if TYPE_CHECKING:
    import sympy

CALLS = frozenset(MATHEMATICAL) - {"sqrt"}
"""The names of functions that formulas may call. ``sqrt`` is not included, because sympy represents sqrt(x)
by the power x^(1/2).
"""

SELECTIONS = ("Abs", "Heaviside", "Max", "Min", "Piecewise", "sign")
"""The functions of sympy that select one of several formulas."""

JUMPING = ("floor", "ceiling", "frac", "Mod")

SAFE = {"log": 1, "exp": 0, "sinh": 0, "cosh": 0, "asin": 0, "acos": 0}
"""The safe argument of each function, at which the function is finite.

If a branch of a Piecewise formula is not selected, its functions are evaluated at their safe arguments.
"""


def read(space: Space, expression: sympy.Basic | int, where: str = "") -> Expr:
    """Convert a sympy expression to a node of ``space``.

    A float becomes the shortest decimal that rounds to this float, so 0.1 becomes 1/10. :class:`SceneError`
    is raised if a subexpression is not supported. The text ``where`` describes which formula is converted,
    for example "driven_spin, signal u". The error message begins with this text.
    """
    import sympy

    try:
        # A string is refused, because ``sympify`` would execute it as Python code.
        formula = sympy.sympify(expression, strict=True)  # with strict=True, sympify does not parse strings
    except sympy.SympifyError:
        what = f"{expression!r} of type {type(expression).__name__} is not a formula"
        raise SceneError(what, where=where, expected="a sympy formula or a number") from None
    return _Reader(space, where).node(formula)


@dataclass
class _Reader:
    """Converts one formula.

    During the conversion of a branch of a Piecewise formula, ``guard`` is an expression with the value 1 if
    the branch is selected, and -1 otherwise. Outside of Piecewise formulas ``guard`` is None.
    """

    space: Space
    where: str
    known: dict[tuple[sympy.Basic, int], Expr] = field(default_factory=dict)
    guard: Expr | None = None

    def node(self, e: sympy.Basic) -> Expr:
        """Convert a sympy expression to a node."""
        # The result depends on ``guard``, so the key contains the node number of ``guard``.
        key = e, -1 if self.guard is None else self.guard.id
        if key not in self.known:
            self.known[key] = self._read(e)
        return self.known[key]

    def _read(self, e: sympy.Basic) -> Expr:
        import sympy

        if isinstance(e, sympy.Symbol):
            return self.space.sym(e.name)
        if isinstance(e, sympy.Rational):
            return self.space.const(Number.rational(int(e.p), int(e.q)))
        if isinstance(e, sympy.Float):
            return self._float(e)
        # The terms are sorted, because the rounding errors depend on the order of the additions.
        if isinstance(e, sympy.Add):
            return _fold(self.space.add, [self.node(a) for a in _sorted(e)])
        if isinstance(e, sympy.Mul):
            return self._product(e)
        if isinstance(e, sympy.Pow):
            return self._power(self.node(e.base), e.exp, e)
        name = e.func.__name__
        if isinstance(e, sympy.Function) and name in CALLS:
            argument = self.node(e.args[0])
            # ``SAFE[name]`` is an argument at which the function is finite.
            return self.space.call(name, self.guarded(argument, SAFE[name]) if name in SAFE else argument)
        if isinstance(e, sympy.Function) and name == ANGLE:
            y, x = map(self.node, e.args)
            # atan2(y, x) is not differentiable at x = y = 0.
            return self.space.call(ANGLE, y, self.guarded(x, 1))
        if name in SELECTIONS:
            return self._selection(name, e)
        table = getattr(e, "polynomial", None)
        if isinstance(table, PiecewisePolynomial):
            # The last argument is the point of evaluation.
            return self.space.call(table, self.node(e.args[-1]))
        if name in JUMPING:
            hint = "use a Piecewise formula or a table that covers the range of the argument"
            raise SceneError(
                f"{e} has infinitely many jumps",
                where=self.where,
                expected="formulas with finitely many jumps",
                hint=hint,
            )
        calls = ", ".join([*sorted(CALLS), ANGLE, *SELECTIONS, "table"])
        allowed = f"symbols, numbers, + - * /, integer and half-integer powers, {calls}"
        what = f"{type(e).__name__} in the formula {e} is not supported"
        raise SceneError(what, where=self.where, expected=allowed)

    def _float(self, e: sympy.Float) -> Expr:
        # A number outside the range of normal doubles would become infinite, zero or inaccurate in emitted
        # code.
        value = decimal(e)
        if not is_normal(value):
            expected = "0, or a number with an absolute value between 1e-307 and 1e308"
            raise SceneError(f"the number {e} is out of range", where=self.where, expected=expected)
        return self.space.const(Number.rational(*value.as_integer_ratio()))

    def guarded(self, x: Expr, safe: int) -> Expr:
        """Return an expression with the value x for ``guard`` = 1, and ``safe`` for ``guard`` = -1.

        If x is constant or ``guard`` is None, x is returned.
        """
        # Emitted code evaluates every branch of a Piecewise formula, even if another branch is selected.
        if self.guard is None or all(n.op != "sym" for n in walk([x])):
            return x
        return positive(self.guard)(x, self.space.const(Number.rational(safe)))

    def _selection(self, name: str, e: sympy.Basic) -> Expr:
        """Convert the call ``e`` of a function in :data:`SELECTIONS`, for example Max."""
        space = self.space
        match name:
            case "Abs":
                return space.call(ABSOLUTE, self.node(e.args[0]))
            case "sign":
                return sign(self.node(e.args[0]))
            case "Heaviside":
                # The second argument (by default 1/2) is the value of Heaviside at x = 0.
                x, middle = map(self.node, e.args)
                return positive(x)(space.one, positive(-x)(space.zero, middle))
            case "Min":
                return _fold(lambda a, b: positive(b - a)(a, b), [self.node(a) for a in _sorted(e)])
            case "Max":
                return _fold(lambda a, b: positive(a - b)(a, b), [self.node(a) for a in _sorted(e)])
            case _:
                return self._piecewise(e)

    def _piecewise(self, e: sympy.Piecewise) -> Expr:
        """Convert a Piecewise formula to an expression that evaluates all branches and selects one value."""
        import sympy

        if e.args[-1][1] != sympy.true:
            raise SceneError(
                f"the Piecewise formula {e} has no default branch",
                where=self.where,
                expected="a last branch (formula, True)",
            )
        # The loop below changes ``self.guard``, so the old value is stored in ``outer``.
        outer, rest = self.guard, always if self.guard is None else positive(self.guard)
        branches: list[tuple[Condition, Expr]] = []
        for formula, condition in e.args:
            self.guard = outer
            holds = read_condition(condition, self.node, self.where)
            # The guard is 1 if this branch is selected, and -1 otherwise.
            self.guard = both(rest, holds)(self.space.one, -self.space.one)
            branches.append((holds, self.node(formula)))
            rest = both(rest, negation(holds))
        self.guard = outer
        # The last branch is the default, because its condition is ``True``.
        (_, total) = branches.pop()
        # The loop runs backwards, because the first true condition has priority.
        for holds, formula in reversed(branches):
            total = holds(formula, total)
        return total

    def _product(self, e: sympy.Mul) -> Expr:
        """Convert the product ``e``, for example x y^-1 z^-1 to x/(y z)."""
        import sympy

        # ``above`` contains the factors of the numerator, and ``below`` the factors of the divisor.
        above, below = [], []
        for a in _sorted(e):
            # A factor with a negative exponent, such as y^-2, becomes the factor y^2 of the divisor.
            if isinstance(a, sympy.Pow) and a.exp.is_Rational and a.exp < 0:
                # Every branch of a Piecewise is evaluated, so unused branches must not divide by zero.
                below.append(self._power(self.guarded(self.node(a.base), 1), -a.exp, a))
            else:
                above.append(self.node(a))
        # The result x/(y z) contains one division, and (x/y)/z contains two.
        product = _fold(self.space.mul, above) if above else self.space.one
        return self.space.div(product, _fold(self.space.mul, below)) if below else product

    def _power(self, base: Expr, exponent: sympy.Expr, e: sympy.Pow) -> Expr:
        import sympy

        space = self.space
        if exponent.is_Float:
            # An exponent such as 0.5 is converted to the exact fraction 1/2.
            exponent = sympy.Rational(*decimal(exponent).as_integer_ratio())
        if exponent.is_Integer:
            # A negative power is infinite for the base 0.
            return space.pow(base if exponent > 0 else self.guarded(base, 1), int(exponent))
        if exponent.is_Rational and exponent.q == 2:
            # Emitted code evaluates all branches of a Piecewise. In a branch that is not selected, sqrt or
            # its derivative could be infinite or NaN, so ``guarded`` replaces the base by 1.
            base = self.guarded(base, 1)
            root, n = space.call("sqrt", base), int(exponent.p)
            # For odd n > 0, the power x^(n/2) is x^m sqrt(x) with m = (n - 1)/2.
            value = space.mul(space.pow(base, abs(n) // 2), root)
            return value if n > 0 else space.div(space.one, value)
        raise SceneError(
            f"the exponent in {e} is not a multiple of 1/2",
            where=self.where,
            expected="an integer or half-integer exponent",
        )


def _sorted(e: sympy.Basic) -> list[sympy.Basic]:
    import sympy

    # In sympy the order of the arguments depends on hashes, which differ between processes.
    return sorted(e.args, key=sympy.default_sort_key)


def _fold(operation: Callable[[Expr, Expr], Expr], nodes: list[Expr]) -> Expr:
    # For three nodes a, b, c the result is operation(operation(a, b), c).
    total = nodes[0]
    for node in nodes[1:]:
        total = operation(total, node)
    return total
