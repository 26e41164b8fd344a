"""Forward differentiation along one direction. A tangent costs a small multiple of the cost of the value."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from codegen.ir.differentiate import partials
from codegen.ir.expr import Expr, walk
from codegen.ir.vector_calls import component


def tangents(roots: Sequence[Expr], seeds: Mapping[str, Expr]) -> tuple[Expr, ...]:
    """Return the derivatives of roots along one direction.

    ``seeds`` maps symbols to their derivatives along this direction. All other symbols are constant.
    :class:`codegen.ir.differentiate.NotDifferentiable` is raised if a function has no derivative.

    >>> from codegen.ir.expr import Space
    >>> s = Space(); x, y, dx = s.sym("x"), s.sym("y"), s.sym("dx")
    >>> tangents([x * y, y], {"x": dx})
    ((y * dx), 0)
    """
    known: dict[int, Expr] = {}
    # The tangents of all results of a vector function are computed together, and stored in this table.
    together: dict[tuple[str, tuple[int, ...]], tuple[Expr, ...]] = {}
    for node in walk(roots):
        # A symbol without a seed is constant.
        if node.op == "sym":
            if node.payload in seeds:
                known[node.id] = seeds[node.payload]
            continue
        moving = [(k, known[a.id]) for k, a in enumerate(node.args) if a.id in known]
        # A node that depends on no seed has tangent zero, and no entry in the table.
        if not moving:
            continue
        result = component(node.payload) if node.op == "call" else None
        if result is not None:
            function, index = result
            key = function.name, tuple(a.id for a in node.args)
            # One call of the tangent gives the derivatives of all results.
            if key not in together:
                rates = [known.get(a.id, node.space.zero) for a in node.args]
                together[key] = function.tangent(node.args, rates)
            known[node.id] = together[key][index]
            continue
        # ``partials`` raises an error for a function without a derivative. Constant nodes are skipped above.
        slopes = partials(node)
        total = node.space.zero
        # The chain rule needs one product for each argument that is not constant.
        for k, rate in moving:
            total = total + slopes[k] * rate
        # A tangent that cancels to zero is not stored, so that later nodes treat this node as constant.
        if not total.is_zero:
            known[node.id] = total
    return tuple(known.get(root.id, root.space.zero) for root in roots)
