"""Runge-Kutta-Munthe-Kaas methods on a field: one exponential a stage, brackets by dexp^{-1}_(r).

Thesis eq. (3.14): u_i = h sum_j a_ij v_j, v_i = dexp^{-1}_{(r),u_i} f(exp(u_i).y0), y1 = exp(h sum_i b_i
v_i).y0. The unknowns are the v_i. On R^n with r = 0 this is the Runge-Kutta method itself.
"""

from __future__ import annotations

from codegen.ir.program import EMBEDDED, Kind, Program, Var
from codegen.lower import minimal_brackets
from codegen.lower.stages import Stages
from codegen.method import Method
from codegen.scene.problem import Problem
from orderconds.ring.protocol import Element


def lower(scene: Problem, method: Method) -> Program:
    """Return the program of an RKMK method with cut-off ``method.cutoff``; rk is the cut-off 0.

    Without a cut-off it is written with the fewest brackets (:mod:`codegen.lower.minimal_brackets`).
    """
    if method.family == "rkmk" and method.cutoff is None:
        return minimal_brackets.lower(scene, method)
    tableau = method.runge_kutta()
    y = Var("y", Kind.POINT)
    stages = Stages(scene, method, (y,))
    do = stages.builder
    v = [do.fresh(f"v{i + 1}", Kind.ALG) for i in range(tableau.s)]

    def images() -> list[Var]:
        result = []
        for i, row in enumerate(tableau.A):
            u = stages.combination(f"u{i + 1}", Kind.ALG, row, v)
            point = do.do("act", f"Y{i + 1}", do.do("exp", f"g{i + 1}", u), y)
            k = stages.f(f"k{i + 1}", point, tableau.c[i])
            result.append(do.do("dexpinv", f"w{i + 1}", u, k, order=method.cutoff or 0))
        return result

    def updated(weights: tuple[Element, ...]) -> Var:
        u = stages.combination("u", Kind.ALG, weights, v)
        return do.do("act", "y1", do.do("exp", "g", u), y)

    def update() -> dict[str, Var]:
        lower = method.embedded()
        more = {} if lower is None else {EMBEDDED: updated(lower.runge_kutta().b)}
        return {"y": updated(tableau.b)} | more

    return stages.program(v, images, lambda: [stages.f("k0", y, None)] * tableau.s, update)
