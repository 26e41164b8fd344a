"""Conserved quantities of a scene: its invariants, and the equations that define its manifold.

The magnitude of an invariant is the sum of the absolute values of its terms. Rounding errors in the value of
the invariant are proportional to the magnitude.
"""

from __future__ import annotations

import math

from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, walk
from codegen.ir.number import Number
from codegen.ir.values import Kind
from codegen.lab.number_functions import of_scalars
from codegen.lab.number_types import Evaluate, Vector
from codegen.lab.straight_line_field import straight_line
from codegen.scene.problem import TIME, Problem

FUNCTIONS = of_scalars(math)

MANIFOLD = "manifold"
"""The dictionary key for the equations of the manifold."""


def functions(scene: Problem) -> dict[str, Evaluate]:
    """Return a dictionary that maps the name of each conserved quantity to its function.

    Each function evaluates its quantity in double precision from the state and the time.
    """
    kept = expressions(scene)
    return {
        name: straight_line(scene.name, scene.symbols, exprs).python(float, FUNCTIONS)
        for name, exprs in kept.items()
    }


def expressions(scene: Problem) -> dict[str, tuple[Expr, ...]]:
    """Return the expressions of the conserved quantities, in the symbols of the state and the time.

    The keys are the names of the invariants and :data:`MANIFOLD`. The expressions with the key MANIFOLD are
    zero on the manifold. If the manifold is a vector space, the key MANIFOLD is missing.
    """
    domain = ExprDomain()
    state = tuple(domain.space.sym(s) for s in scene.symbols)
    time = domain.space.sym(TIME)
    roots: dict[str, tuple[Expr, ...]] = {
        name: (scene.invariant(domain, name, state, time),) for name in scene.invariants
    }
    laws = _laws(scene, domain, state)
    if laws:
        roots[MANIFOLD] = laws
    return roots


def magnitudes(scene: Problem) -> dict[str, tuple[Expr, ...]]:
    """Return the magnitudes of the invariants as expressions.

    The magnitude of an invariant is the sum of the absolute values of its terms.
    """
    return {name: (magnitude(e),) for name, (e, *_) in expressions(scene).items() if name in scene.invariants}


def magnitude(root: Expr) -> Expr:
    """Return the sum of the absolute values of the terms of an expression.

    >>> from codegen.ir.expr import Space
    >>> s = Space(); x = s.sym("x")
    >>> magnitude(2 * x - 3)
    (3 + (2 * sqrt((x)^2)))
    """
    sizes: dict[int, Expr] = {}
    for e in walk((root,)):
        sizes[e.id] = _magnitude(e, [sizes[a.id] for a in e.args])
    return sizes[root.id]


def _magnitude(e: Expr, sizes: list[Expr]) -> Expr:
    """Return the sum of the absolute values of the terms of ``e``.

    ``sizes`` contains these sums for the arguments ``e.args``.
    """
    match e.op:
        case "add" | "sub":
            return sizes[0] + sizes[1]
        case "mul":
            return sizes[0] * sizes[1]
        case "neg":
            return sizes[0]
        case "div":
            return sizes[0] / _absolute(e.args[1])
        case "pow":
            return sizes[0] ** int(e.payload)
        case "call" if e.payload == "sqrt":
            return e.space.call("sqrt", sizes[0])
        case _:
            return _absolute(e)


def _absolute(e: Expr) -> Expr:
    if e.op == "const" and e.payload.is_rational:
        size = abs(e.payload.fraction())
        return e.space.const(Number.rational(size.numerator, size.denominator))
    return e.space.call("sqrt", e * e)


def _laws(scene: Problem, domain: ExprDomain, state: Vector) -> Vector:
    """Return expressions that are zero if and only if the state is on the manifold."""
    start = 0
    laws: list[Expr] = []
    for block in scene.state:
        values = state[start : start + len(block.symbols)]
        start += len(values)
        if block.kind is Kind.GROUP:
            laws += [x for _, x in scene.group.laws(domain, values)]
        elif block.kind is Kind.POINT:
            laws += [x for _, x in scene.action.laws(domain, scene.group, values)]
    return tuple(laws)
