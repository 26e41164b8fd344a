"""Reverse-mode differentiation of expressions. A gradient costs only a few times as much as the function
itself.
"""

from __future__ import annotations

from collections.abc import Container, Sequence

from codegen.ir.elementary import ANGLE, ELEMENTARY
from codegen.ir.expr import Expr, walk
from codegen.ir.number import Number
from codegen.ir.selection import ABSOLUTE, CHOOSE
from codegen.ir.table import PiecewisePolynomial
from codegen.ir.vector_calls import component, partial


class NotDifferentiable(ValueError):
    """Raised if the derivative of a function cannot be expressed by the available functions."""


def gradient(root: Expr, symbols: Sequence[str]) -> list[Expr]:
    """Return the partial derivatives of ``root`` with respect to the variables named in ``symbols``.

    >>> from codegen.ir.expr import Space
    >>> s = Space(); x = s.sym("x")
    >>> gradient(x * x * x, ["x", "y"])[1]
    0
    """
    # ``bars`` maps node numbers to adjoints, the derivatives of ``root`` with respect to the nodes.
    space = root.space
    bars: dict[int, Expr] = {root.id: space.one}
    # A node is visited after all nodes that use it, so its adjoint is complete.
    for node in reversed(list(walk([root]))):
        bar = bars.get(node.id)
        # A zero adjoint contributes nothing to the adjoints of the arguments.
        if bar is None or bar is space.zero:
            continue
        for arg, factor in zip(node.args, partials(node), strict=True):
            # By the chain rule, each node adds one term to the adjoint of each argument.
            bars[arg.id] = bars.get(arg.id, space.zero) + bar * factor
    # If a symbol has no adjoint, the derivative is zero.
    return [bars.get(space.sym(name).id, space.zero) for name in symbols]


def partials(node: Expr, moving: Container[int] | None = None) -> list[Expr]:
    """Return the partial derivatives of a node with respect to its arguments, in the order of the arguments.

    If the node is a call of a vector function and ``moving`` is not None, derivatives are computed only with
    respect to arguments whose node numbers are in ``moving``. For the other arguments, zero is returned. In
    all other cases, all derivatives are computed.

    :class:`NotDifferentiable` is raised for a function that has no rule for its derivative.
    """
    space, args = node.space, node.args
    match node.op:
        case "add":
            return [space.one, space.one]
        case "sub":
            return [space.one, -space.one]
        case "mul":
            return [args[1], args[0]]
        case "div":
            # The derivatives of a/b are 1/b and -a/b^2 = -(a/b) (1/b). Only 1/b needs a new division, because
            # a/b is ``node``.
            inverse = space.one / args[1]
            return [inverse, -(node * inverse)]
        case "neg":
            return [-space.one]
        case "pow":
            n = node.payload
            return [space.const(Number.rational(n)) * space.pow(args[0], n - 1)]
        case "call":
            result = component(node.payload)
            if result is None:
                return _derivatives(node)
            # Derivatives of vector functions are long, so only the wanted derivatives are computed.
            wanted = [moving is None or a.id in moving for a in node.args]
            return [partial(node, *result, j) if w else space.zero for j, w in enumerate(wanted)]
        case _:
            return []


def _derivatives(node: Expr) -> list[Expr]:  # complexity: one case for each function
    """Return the partial derivatives of ``node``, a call of a scalar function.

    The Stumpff functions c_k satisfy c_k' = (k c_{k+2} - c_{k+1})/2.
    """
    space, x = node.space, node.args[0]
    half = space.const(Number.rational(1, 2))
    match node.payload:
        case PiecewisePolynomial() as table:
            # A table of degree 0 is piecewise constant, so its derivative is zero between jumps.
            return [space.call(table.derivative(), x) if table.degree else space.zero]
        case name if name in (ABSOLUTE, CHOOSE):
            return _selection(node)
        case name if name == ANGLE:
            # The derivatives of atan2(x, b) with respect to x and b are b/(x^2 + b^2) and -x/(x^2 + b^2).
            size = x * x + node.args[1] * node.args[1]
            return [node.args[1] / size, -(x / size)]
        case "sqrt":
            # The derivative is 1/(2 sqrt x), and ``node`` is sqrt x.
            return [half * (space.one / node)]
        case "sin":
            return [space.call("cos", x)]
        case "cos":
            return [-space.call("sin", x)]
        case "exp":
            # The derivative of exp(x) is exp(x), that is, the node itself.
            return [node]
        case "log":
            return [space.one / x]
        # The Stumpff function c_0 has the derivative -c_1/2.
        case "stumpff0" | "signed_stumpff0" as name:
            return [-(half * space.call(f"{name[:-1]}1", x))]
        case "stumpff1":
            return [half * (space.call("stumpff3", x) - space.call("stumpff2", x))]
        # The formulas for c_2' and c_3' contain c_4 and c_5, for which emitted code has no functions.
        case "stumpff2" | "stumpff3" as name:
            return [space.call(f"slope{name[-1]}", x)]
        case "slope2" | "slope3" as name:
            return [space.call(f"curvature{name[-1]}", x)]
        case name if name in ELEMENTARY:
            return [ELEMENTARY[name].slope(x, node)]
        case "signed_stumpff1" | "signed_stumpff2" | "signed_stumpff3" as name:
            return [space.call(f"signed_slope{name[-1]}", x)]
        case "quotient":
            # For b = 0, quotient(a, b) is 0. The derivatives also use ``quotient`` in place of a division, so
            # for b = 0 they are 0 and not infinite.
            inverse = space.call("quotient", space.one, node.args[1])
            return [inverse, -(node * inverse)]
        case _:
            message = f"the function {node.payload} has no rule for its derivative"
            raise NotDifferentiable(message)


def sign(x: Expr) -> Expr:
    """Return an expression for the sign of x: 1, 0 or -1."""
    space = x.space
    # At x = 0, both calls of ``choose`` select their last argument.
    return space.call(CHOOSE, x, space.one, space.call(CHOOSE, -x, -space.one, space.zero))


def _selection(node: Expr) -> list[Expr]:
    """Return the partial derivatives of ``node``, which is ``fabs(x)`` or ``choose(x, a, b)``.

    The value of ``choose(x, a, b)`` is a for x > 0, and b otherwise. At x = 0, the derivatives of both
    functions with respect to x are set to 0.
    """
    space, (x, *formulas) = node.space, node.args
    if not formulas:
        return [sign(x)]
    one, zero = space.one, space.zero
    factors = (space.call(CHOOSE, x, one, zero), space.call(CHOOSE, x, zero, one))
    # ``choose(x, a, b)`` is piecewise constant in x, so its derivative with respect to x is zero.
    # If a or b is a constant, the derivative with respect to this constant is never used and is set to zero.
    return [zero, *(zero if a.op == "const" else f for a, f in zip(formulas, factors, strict=True))]
