"""What a scene keeps, as functions of state and time: its invariants, and the laws of the manifold."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from codegen.groups import LeftMultiplication
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr
from codegen.ir.program import Kind
from codegen.lab.straight_line_field import straight_line
from codegen.scene.problem import Problem

FUNCTIONS = {name: getattr(math, name) for name in ("sqrt", "sin", "cos", "exp", "log")}

MANIFOLD = "manifold"


def functions(scene: Problem) -> dict[str, Callable[..., tuple[float, ...]]]:
    """Return what a scene keeps as functions of state and time: its invariants, and the manifold's laws."""
    kept = expressions(scene)
    return {name: straight_line(scene, exprs).python(float, FUNCTIONS) for name, exprs in kept.items()}


def expressions(scene: Problem) -> dict[str, tuple[Expr, ...]]:
    """Return what :func:`functions` evaluates, as expressions in the state's symbols."""
    domain = ExprDomain()
    state = tuple(domain.space.sym(s) for s in scene.symbols)
    roots: dict[str, tuple[Expr, ...]] = {
        name: (scene.invariant(domain, name, state),) for name in scene.invariants
    }
    laws = _laws(scene, domain, state)
    if laws:
        roots[MANIFOLD] = laws
    return roots


def _laws(scene: Problem, domain: ExprDomain, state: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return what must vanish on the blocks of the state that are elements of the group."""
    start, found = 0, []
    for block in scene.state:
        values = state[start : start + len(block.symbols)]
        start += len(values)
        acting = block.kind is Kind.POINT and isinstance(scene.action, LeftMultiplication)
        if block.kind is Kind.GROUP or acting:
            found += [x for _, x in scene.group.laws(domain, values)]
    return tuple(found)
