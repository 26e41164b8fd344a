"""Commutator-free methods on a field: products of exponentials, no brackets.

A stage, and the update, is exp(h sum_j beta_J^j k_j) ... exp(h sum_j beta_1^j k_j) applied to y0 or to an
earlier stage; the first exponential acts first. The unknowns are the k_i.
"""

from __future__ import annotations

from functools import reduce
from operator import add

from codegen.ir.program import EMBEDDED, Program
from codegen.ir.values import Kind, Var
from codegen.lower.field import FieldLowering
from codegen.lower.stages import Stages
from codegen.method import Method
from codegen.scene.problem import Problem
from orderconds.ring.protocol import Element
from orderconds.tableau import CommutatorFree, Stage


class CommutatorFreeLowering(FieldLowering):
    """Commutator-free methods."""

    family = "cf"
    repeats_substeps = True

    def lower(self, problem: Problem, method: Method) -> Program:
        """Return the program."""
        embedded = method.embedded()
        lower = None if embedded is None else embedded.commutator_free().update
        return products(problem, method, method.commutator_free(), lower)


def products(problem: Problem, method: Method, tableau: CommutatorFree, lower: Stage | None) -> Program:
    """Return the program of a method whose stages and update are products of exponentials. ``lower`` is the
    update of the embedded method, if any."""
    y = Var("y", Kind.POINT)
    stages = Stages(problem, method, (y,))
    build = stages.builder
    k = [build.fresh(f"k{i + 1}", Kind.ALG) for i in range(tableau.s)]

    def product(stage: Stage, name: str, points: list[Var]) -> Var:
        # A stage may start from an earlier stage, Y_i = exp(...) Y_k, which saves the exponentials of stage
        # k.
        point = y if stage.start is None else points[stage.start]
        for row in stage.exponentials:
            # All exponents of a stage are requested with one name, because Builder makes names unique by
            # appended numbers.
            x = stages.combination(f"x{name}", Kind.ALG, row, k)
            # Each row gives one exponential. The first exponential is applied first, so it is the rightmost
            # factor of the product.
            point = build.act(f"Y{name}", build.exp(f"g{name}", x), point)
        return point

    def images() -> list[Var]:
        # The tableau lists stages after the stages from which they start.
        points: list[Var] = []
        times: list[Element] = []
        result = []
        for i, stage in enumerate(tableau.stages):
            points.append(product(stage, str(i + 1), points))
            entries = [x for row in stage.exponentials for x in row]
            # A stage starts from an earlier stage or from y0. Its time is the time of this start, plus h
            # times the sum of the coefficients in its exponents.
            own = reduce(add, entries, method.tableau.ring.zero)
            times.append(own if stage.start is None else own + times[stage.start])
            result.append(stages.f(f"f{i + 1}", points[i], times[i]))
        # Like a stage, the update may start from an earlier stage.
        stage_points[:] = points
        return result

    stage_points: list[Var] = []

    def update() -> dict[str, Var]:
        # The embedded solution needs its own exponentials, because it is not a linear function of the stages.
        more = {} if lower is None else {EMBEDDED: product(lower, "", stage_points)}
        return {"y": product(tableau.update, "", stage_points)} | more

    # The initial guess for all k_i is f(y0), which is accurate to O(h) and costs one evaluation for all
    # stages.
    return stages.program(k, images, lambda: [stages.f("k0", y, None)] * tableau.s, update)
