"""Discrete gradients on a lattice.

Inner products and energies are sums over all sites.

Let eta be the displacement of a step, and let H0 and H1 be the total energies before and after the step. Let
g be a covector that approximates the differential of the total energy. The discrete differential is
D = g + (e/|eta|^2) eta, where e = H1 - H0 - <g, eta>. First, the contribution of each site to e is computed.
Then the contributions are added. If H1, H0 and <g, eta> were summed over all sites before the subtraction,
the rounding error of e would be larger.

For Hamilton's equations, the canonical bivector is applied to D. For all other equations, the bivector
(gamma wedge f)/|gamma|^2 is applied to D (:mod:`codegen.scene.energy`). Here f is the field, and gamma is the
exact differential of the total energy, both at the midpoint of the step.
"""

from __future__ import annotations

from dataclasses import replace

from codegen.ir.operations import Operation
from codegen.ir.program import Assign, Builder, Program, Solve
from codegen.ir.scene_operations import Bivector, Differential, Field, Secant
from codegen.ir.site_operations import Corrected, Excess, InnerProduct, Total, Wedge
from codegen.ir.values import Var
from codegen.ir.verify import verify
from codegen.scene.energy import canonical
from codegen.scene.problem import Problem


def with_sums(program: Program, problem: Problem) -> Program:
    """Return the program with a separate assignment for each sum over all sites."""
    unknowns = {u.name for s in program.body if isinstance(s, Solve) for u in s.unknowns}
    targets = {v.name for assign in program.assigns() for v in assign.targets}
    # The names of new variables must not occur in the program.
    builder = Builder({v.name for v in program.inputs} | unknowns | targets | {"t", "h"})

    def expanded(assigns: tuple[Assign, ...]) -> tuple[Assign, ...]:
        return tuple(each for assign in assigns for each in _expanded(assign, problem, builder))

    body: list[Assign | Solve] = []
    for statement in program.body:
        if isinstance(statement, Solve):
            body.append(replace(statement, body=expanded(statement.body)))
        else:
            body += expanded((statement,))
    return verify(replace(program, body=tuple(body)))


def _expanded(assign: Assign, problem: Problem, build: Builder) -> tuple[Assign, ...]:
    """Return assignments that are equivalent to ``assign``.

    The first assignments compute the sums over all sites, one sum each. The last assignment computes the
    targets of ``assign`` from these sums. If ``assign`` needs no sum, the result contains only ``assign``.
    """

    # An inner product needs two operations: one at each site, and one that adds the results of all sites.
    def total(name: str, x: Var, y: Var) -> Var:
        return build.add(Total(), "sum", build.add(InnerProduct(x.kind, y.kind), name, x, y))

    operation: Operation
    args: tuple[Var, ...]
    if isinstance(assign.operation, Secant):
        # ``before`` and ``after`` are the energies of a site before and after the displacement x.
        g, x, before, after = assign.args
        # ``paired`` is the inner product of g and x at one site.
        paired = build.add(InnerProduct(g.kind, x.kind), "paired", g, x)
        # At each site, ``Excess`` computes ``after - before - paired``, and ``Total`` adds these numbers. If
        # ``after``, ``before`` and ``paired`` were summed over all sites before the subtraction, the rounding
        # error would be larger.
        excess = build.add(Total(), "sum", build.add(Excess(), "excess", paired, before, after))
        operation, args = Corrected(), (g, x, excess, total("size", x, x))
    elif isinstance(assign.operation, Bivector) and not canonical(problem):
        y, alpha = assign.args
        gamma, f = build.add(Differential(), "gamma", y), build.add(Field(), "slope", y)
        sums = total("along", gamma, alpha), total("across", f, alpha), total("norm", gamma, gamma)
        operation, args = Wedge(), (gamma, f, *sums)
    else:
        return (assign,)
    # The last assignment has the targets of ``assign``, so the rest of the program needs no change.
    return (*build.take(), replace(assign, operation=operation, args=args))
