"""The field of a Hamiltonian as the sum of the fields of its parts.

The sum often needs fewer operations than the field that is derived from the whole Hamiltonian.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from codegen.flows.recognise import recognise
from codegen.groups.capabilities import Coadjoint
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, walk
from codegen.scene.orbit import orbit_of
from codegen.scene.problem import TIME, Problem


def with_field_by_parts(problem: Problem) -> Problem:
    """Return the problem with its field written as a sum X_1 + ... + X_m.

    X_i is the field of the part H_i of the Hamiltonian H_1 + ... + H_m.

    The problem is returned unchanged in the following cases:

    - The Hamiltonian is not given as a sum of parts, or the flow of a part is unknown.
    - The sum of the fields does not need fewer operations than the field of ``problem``.
    - The sum of the fields differs from the field of ``problem`` at a sample point.
    - The scene gives formulas for flows, or has run-time inputs or external forces.
    """
    if problem.hamiltonian is None or not problem.parts:
        return problem
    if problem.stated or problem.inputs or problem.forced:
        return problem
    parts = recognise(problem)
    if not all(part.summands for part in parts):
        return problem
    space, group = problem.hamiltonian.space, problem.group.require(Coadjoint)
    domain = ExprDomain(space)
    q, mu = (tuple(space.sym(s) for s in block.symbols) for block in problem.state)
    values = {name: space.sym(name) for name in (*problem.symbols, *problem.parameters, TIME)}
    roots: tuple[Expr, ...] = (space.zero,) * len(problem.roots)
    for part in parts:
        for summand in part.summands:
            for _, flow in summand.flows:
                xi, n = flow.field(domain, group, values, q, mu)
                roots = tuple(a + b for a, b in zip(roots, (*xi, *n), strict=True))
    if _operations(roots) >= _operations(problem.roots):
        return problem
    rests = [a - b for a, b in zip(roots, problem.roots, strict=True)]
    return replace(problem, roots=roots) if orbit_of(problem).vanish(rests) else problem


def _operations(roots: Sequence[Expr]) -> int:
    return sum(node.op not in ("const", "sym", "neg") for node in walk(roots))
