"""Jacobians of expressions to first order in the step size h, for simplified Newton iterations.

An expression and its derivatives with respect to the unknowns are expanded as v_0 + v_1 h. Each sweep of
Newton's method with this Jacobian multiplies the error of the unknowns by O(h^2).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import factorial

from codegen.ir.differentiate import sign
from codegen.ir.elementary import ELEMENTARY, MATHEMATICAL
from codegen.ir.expr import Expr, Space, walk
from codegen.ir.number import Number
from codegen.ir.selection import ABSOLUTE, CHOOSE
from codegen.ir.table import PiecewisePolynomial

STEP = "h"

EXPANDED = frozenset({*MATHEMATICAL, ABSOLUTE, *(f"stumpff{k}" for k in range(4))})
"""The names of the functions that this module can expand to first order in h.

Piecewise polynomials, which have arbitrary names, can be expanded, too."""

Pair = tuple[Expr, Expr]
"""The coefficients (v_0, v_1) of an expansion v_0 + v_1 h."""


class NotLinearised(ArithmeticError):
    """Raised if an expression contains a function that cannot be expanded in powers of h at h = 0."""


@dataclass(frozen=True)
class _Dual:
    """The expansions in h of an expression and of its derivatives with respect to the unknowns.

    ``slopes`` maps the index of an unknown to the expansion of the derivative with respect to this unknown.
    Derivatives that are zero are omitted.
    """

    value: Pair
    slopes: dict[int, Pair]


class FirstOrder:
    """Computes derivatives of expressions with respect to the unknowns, to first order in the step size h.

    ``unknowns`` are the names of the symbols of the unknowns.

    >>> from codegen.ir.expr import Space
    >>> s = Space(); x, h = s.sym("x"), s.sym("h")
    >>> FirstOrder(["x"]).jacobian([x * x * h + h * h * x + x])
    [[(1 + (h * (2 * x)))]]
    """

    def __init__(self, unknowns: Sequence[str]) -> None:
        self.place = {name: k for k, name in enumerate(unknowns)}
        self.duals: dict[int, _Dual] = {}

    def jacobian(self, roots: Sequence[Expr]) -> list[list[Expr]]:
        """Return the derivatives of the expressions ``roots`` with respect to the unknowns.

        Row i of the result belongs to ``roots[i]``. All roots must be expressions of the same :class:`Space`.

        :class:`NotLinearised` is raised if a root cannot be expanded at h = 0.
        """
        if not roots:
            return []
        space, duals = roots[0].space, self.duals
        # Subexpressions that an earlier call has expanded are not expanded again.
        for node in walk(roots, lambda n: n.id in duals):
            if node.id not in duals:
                duals[node.id] = _visit(node, [duals[a.id] for a in node.args], self.place, space)
        h, none = space.sym(STEP), (space.zero, space.zero)
        rows = []
        for root in roots:
            slopes = [duals[root.id].slopes.get(k, none) for k in range(len(self.place))]
            # To first order in h, each derivative of ``root`` is ``low`` + ``high`` h.
            rows.append([h * high + low for low, high in slopes])
        return rows


def _visit(node: Expr, args: list[_Dual], place: dict[str, int], space: Space) -> _Dual:
    zero, one = space.zero, space.one
    match node.op:
        case "const":
            return _Dual((node, zero), {})
        case "sym":
            if node.payload == STEP:
                # The symbol h has the expansion 0 + 1 h.
                return _Dual((zero, one), {})
            # A pair (v_0, v_1) represents the expansion v_0 + v_1 h. A symbol u that is not h does not depend
            # on h. Therefore the pair for u is (u, 0). ``slopes`` contains derivatives with respect to
            # unknowns only. The derivative of an unknown with respect to itself is 1, with the pair (1, 0).
            slopes = {place[node.payload]: (one, zero)} if node.payload in place else {}
            return _Dual((node, zero), slopes)
        case "add":
            return _combined(space, [(one, args[0]), (one, args[1])])
        case "sub":
            return _combined(space, [(one, args[0]), (-one, args[1])])
        case "neg":
            return _combined(space, [(-one, args[0])])
        case "mul":
            return _product(space, args[0], args[1])
        case "div":
            # All quotients with the divisor b share the expression 1/b.
            return _product(space, args[0], _inverse(space, args[1]))
        case "pow":
            # The expansion of x^n is computed by n - 1 products of expansions.
            result = args[0]
            for _ in range(node.payload - 1):
                result = _product(space, result, args[0])
            return result
        case _ if node.payload == CHOOSE:
            return _chosen(space, *args)
        case _ if node.payload in EXPANDED or isinstance(node.payload, PiecewisePolynomial):
            return _called(space, node.payload, args[0])
        case _:
            raise NotLinearised(f"the function {node.payload} cannot be expanded in h")


def _times(a: Pair, b: Pair) -> Pair:
    # The product of two expansions, without the term in h^2.
    return a[0] * b[0], a[0] * b[1] + a[1] * b[0]


def _plus(a: Pair, b: Pair) -> Pair:
    return a[0] + b[0], a[1] + b[1]


def _combined(space: Space, terms: list[tuple[Expr, _Dual]]) -> _Dual:
    value, slopes = (space.zero, space.zero), dict[int, Pair]()
    for c, x in terms:
        value = _plus(value, (c * x.value[0], c * x.value[1]))
        for k, slope in x.slopes.items():
            scaled = (c * slope[0], c * slope[1])
            # The derivatives of all terms with respect to the unknown k are added.
            slopes[k] = _plus(slopes[k], scaled) if k in slopes else scaled
    return _Dual(value, _trimmed(slopes))


def _product(space: Space, a: _Dual, b: _Dual) -> _Dual:
    slopes: dict[int, Pair] = {}
    # The two passes of the loop add the terms a' b and b' a of the product rule.
    for x, y in ((a, b), (b, a)):
        for k, slope in x.slopes.items():
            term = _times(slope, y.value)
            slopes[k] = _plus(slopes[k], term) if k in slopes else term
    return _Dual(_times(a.value, b.value), _trimmed(slopes))


def _inverse(space: Space, a: _Dual) -> _Dual:
    # Let v_0 + v_1 h be the expansion of ``a``. For v_0 = 0, the reciprocal has a pole at h = 0 and no
    # expansion.
    if a.value[0].is_zero:
        raise NotLinearised("a divisor vanishes at h = 0")
    # To first order in h, 1/(v_0 + v_1 h) is 1/v_0 - (v_1/v_0^2) h.
    low = space.one / a.value[0]
    value = (low, -(a.value[1] * (low * low)))
    # The derivative of 1/a is -a'/a^2.
    square = _times(value, value)
    slopes = {k: _times((-slope[0], -slope[1]), square) for k, slope in a.slopes.items()}
    return _Dual(value, _trimmed(slopes))


def _chosen(space: Space, test: _Dual, a: _Dual, b: _Dual) -> _Dual:
    """Return the expansion of ``choose(test, a, b)``.

    If ``test`` is positive at h = 0, this is the expansion of ``a``, otherwise the expansion of ``b``.
    """
    none = (space.zero, space.zero)

    def pair(x: Pair, y: Pair) -> Pair:
        # The choice depends only on the value of ``test`` at h = 0.
        low, high = (space.call(CHOOSE, test.value[0], p, q) for p, q in zip(x, y, strict=True))
        return low, high

    # A derivative that is missing in ``a.slopes`` or ``b.slopes`` is zero.
    places = sorted({*a.slopes, *b.slopes})
    slopes = {k: pair(a.slopes.get(k, none), b.slopes.get(k, none)) for k in places}
    return _Dual(pair(a.value, b.value), _trimmed(slopes))


def _called(space: Space, function: str, a: _Dual) -> _Dual:
    """Return the expansion of f(a), where f is the function with the name ``function``.

    In the code, ``low`` is the value of ``a`` at h = 0. The variables ``at``, ``first`` and ``second`` are
    the values of f, f' and f'' at ``low``.
    """
    low, high = a.value
    if function.startswith("stumpff"):
        k = int(function[7:])
        # The Stumpff function c_k is expanded only at 0, where its derivatives are rational numbers.
        if not low.is_zero:
            raise NotLinearised("the argument of a Stumpff function does not vanish at h = 0")
        # The three numbers are the coefficients of 1, z and z^2 in the series c_k(z) = 1/k! - z/(k+2)! +
        # z^2/(k+4)! - .... The second derivative c_k''(0) is twice the coefficient of z^2.
        at, first, second = (space.const(Number.rational((-1) ** j, factorial(k + 2 * j))) for j in range(3))
        second = second + second
    elif function == "sqrt":
        # At x = 0 the derivatives of sqrt(x) are infinite, so no expansion exists.
        if low.is_zero:
            raise NotLinearised("the argument of a square root vanishes at h = 0")
        # The first derivative is 1/(2 sqrt x).
        at = space.call("sqrt", low)
        first = space.const(Number.rational(1, 2)) * (space.one / at)
        # The second derivative of sqrt x is -1/(2 x) times the first derivative.
        second = -(first * (space.const(Number.rational(1, 2)) / low))
    elif function == "exp":
        at = first = second = space.call("exp", low)
    elif function == "log":
        at, first = space.call("log", low), space.one / low
        # The second derivative of log x is -(1/x)^2.
        second = -(first * first)
    elif isinstance(function, PiecewisePolynomial):
        slope_of = function.derivative()
        at, first, second = (space.call(f, low) for f in (function, slope_of, slope_of.derivative()))
    elif function == ABSOLUTE:
        # The derivative of the absolute value is constant on each side of 0, so the second derivative is 0.
        at, first, second = space.call(ABSOLUTE, low), sign(low), space.zero
    elif function in ELEMENTARY:
        at, rule = space.call(function, low), ELEMENTARY[function]
        first, second = rule.slope(low, at), rule.curvature(low, at)
    else:
        # The function f is sin or cos, so f'' = -f.
        other = {"sin": "cos", "cos": "sin"}[function]
        at, turned = space.call(function, low), space.call(other, low)
        # The derivative of cos is -sin, so only the cosine needs a minus sign in ``first``.
        first, second = (turned, -at) if function == "sin" else (-turned, -at)
    # To first order in h, f'(``low`` + ``high`` h) is f'(``low``) + f''(``low``) ``high`` h.
    slope = (first, second * high)
    slopes = {k: _times(x, slope) for k, x in a.slopes.items()}
    return _Dual((at, first * high), _trimmed(slopes))


def _trimmed(slopes: dict[int, Pair]) -> dict[int, Pair]:
    # Zero derivatives are dropped to shorten later products and sums.
    return {k: x for k, x in slopes.items() if not (x[0].is_zero and x[1].is_zero)}
