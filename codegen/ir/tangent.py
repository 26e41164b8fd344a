"""Forward-mode differentiation: derivatives of expressions in one direction.

The derivative of an expression in one direction is called its tangent. The cost of a tangent is a small
multiple of the cost of the expression.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from codegen.ir.differentiate import partials
from codegen.ir.expr import Expr, walk
from codegen.ir.vector_calls import component


def tangents(roots: Sequence[Expr], seeds: Mapping[str, Expr]) -> tuple[Expr, ...]:
    """Return the derivatives of the expressions ``roots`` in one direction.

    ``seeds`` maps symbols to their derivatives in this direction. All other symbols are constant.
    :class:`codegen.ir.differentiate.NotDifferentiable` is raised if a function has no derivative.

    >>> from codegen.ir.expr import Space
    >>> s = Space(); x, y, dx = s.sym("x"), s.sym("y"), s.sym("dx")
    >>> tangents([x * y, y], {"x": dx})
    ((y * dx), 0)
    """
    known: dict[int, Expr] = {}
    # For each call of a vector function, ``together`` contains the tangents of all results.
    together: dict[tuple[str, tuple[int, ...]], tuple[Expr, ...]] = {}
    for node in walk(roots):
        # ``known`` contains the tangents that are not zero.
        if node.op == "sym":
            if node.payload in seeds:
                known[node.id] = seeds[node.payload]
            continue
        moving = [(k, known[a.id]) for k, a in enumerate(node.args) if a.id in known]
        # If all arguments are constant, the node is constant and gets no entry in ``known``.
        if not moving:
            continue
        result = component(node.payload) if node.op == "call" else None
        if result is not None:
            function, index = result
            key = function.name, tuple(a.id for a in node.args)
            if key not in together:
                rates = [known.get(a.id, node.space.zero) for a in node.args]
                together[key] = function.tangent(node.args, rates)
            known[node.id] = together[key][index]
            continue
        # If the function has no derivative, ``partials`` raises an error.
        slopes = partials(node)
        total = node.space.zero
        # By the chain rule, the tangent is the sum of partial derivatives times tangents of the arguments.
        for k, rate in moving:
            total = total + slopes[k] * rate
        # If the terms of the sum cancel, ``total`` is zero, and the node gets no entry in ``known``.
        if not total.is_zero:
            known[node.id] = total
    return tuple(known.get(root.id, root.space.zero) for root in roots)
