"""Conserved quantities of a scene: its invariants, and the equations that define its manifold."""

from __future__ import annotations

import math

from codegen.groups import LeftMultiplication
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr
from codegen.ir.values import Kind
from codegen.lab.number_types import Evaluate, Vector
from codegen.lab.straight_line_field import straight_line
from codegen.scene.problem import Problem

FUNCTIONS = {name: getattr(math, name) for name in ("sqrt", "sin", "cos", "exp", "log")}

MANIFOLD = "manifold"
"""The key of the manifold equations in the dictionaries of conserved quantities."""


def functions(scene: Problem) -> dict[str, Evaluate]:
    """Return each conserved quantity as a function (state, t) of floats."""
    kept = expressions(scene)
    return {name: straight_line(scene, exprs).python(float, FUNCTIONS) for name, exprs in kept.items()}


def expressions(scene: Problem) -> dict[str, tuple[Expr, ...]]:
    """Return each conserved quantity as expressions in the symbols of the state.

    The expressions with the name :data:`MANIFOLD` vanish on the manifold. This name is absent if the manifold
    is a vector space.
    """
    domain = ExprDomain()
    state = tuple(domain.space.sym(s) for s in scene.symbols)
    roots: dict[str, tuple[Expr, ...]] = {
        name: (scene.invariant(domain, name, state),) for name in scene.invariants
    }
    laws = _laws(scene, domain, state)
    if laws:
        roots[MANIFOLD] = laws
    return roots


def _laws(scene: Problem, domain: ExprDomain, state: Vector) -> Vector:
    """Return the expressions that are zero if and only if the state is on the manifold."""
    start = 0
    laws: list[Expr] = []
    for block in scene.state:
        values = state[start : start + len(block.symbols)]
        start += len(values)
        acting = block.kind is Kind.POINT and isinstance(scene.action, LeftMultiplication)
        if block.kind is Kind.GROUP or acting:
            laws += [x for _, x in scene.group.laws(domain, values)]
    return tuple(laws)
