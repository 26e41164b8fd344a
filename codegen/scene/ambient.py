"""The ambient equation of a problem on a manifold: the equation y' = F(y) on R^n.

Here y contains the n coordinates of the state, and F(y) is the time derivative of y.
"""

from __future__ import annotations

from dataclasses import replace

from codegen.groups.actions import LeftMultiplication
from codegen.groups.rn import Rn
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, evaluate
from codegen.ir.formulas import Formulas
from codegen.ir.values import Kind
from codegen.scene.problem import TIME, Problem, StateField


def ambient(problem: Problem) -> Problem:
    """Return the ambient equation y' = F(y) of ``problem``. The group of the result is R^n.

    The exact solution stays on the manifold of ``problem``, but a numerical solution leaves this manifold.

    Raise :class:`SceneError` if ``problem`` has no formulas in coordinates.
    """
    problem.require_formulas()
    field, domain = problem.as_field(), ExprDomain(problem.roots[0].space)
    state = tuple(domain.space.sym(s) for s in problem.symbols)
    values = field.values(domain, state, domain.space.sym(TIME))
    values |= {name: domain.space.sym(name) for name in problem.signals}

    def derivative(roots: tuple[Expr, ...]) -> tuple[Expr, ...]:
        if problem.matrices is not None:
            return problem.matrices.velocity(domain, state, values)
        f = tuple(evaluate(roots, domain, values))
        return field.action.velocity(Formulas(domain), field.group, f, state)

    initial = tuple(x for block in problem.state for x in block.initial)
    return replace(
        problem,
        group=Rn(len(problem.symbols)),
        action=LeftMultiplication(),
        state=(StateField("y", Kind.POINT, problem.symbols, initial),),
        roots=derivative(problem.roots),
        # Only problems with run-time inputs need ``open_roots``. In other problems, ``open_roots`` may be
        # empty.
        open_roots=derivative(problem.open_roots) if problem.open_roots else (),
        paired=False,
    )
