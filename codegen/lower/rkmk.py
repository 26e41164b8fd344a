"""Runge-Kutta-Munthe-Kaas methods for vector fields, with one exponential for each stage.

A step of size h from y0 to y1 for the field f is (equation (3.14) of H. Marthinsen's thesis *On symplectic
integration in Lie groups and manifolds*):

    u_i = h sum_j a_ij v_j,   v_i = dexp^{-1}_{(r),u_i} f(exp(u_i).y0),   y1 = exp(h sum_i b_i v_i).y0.

Here a_ij and b_i are the coefficients of the tableau, and dexp^{-1}_{(r),u} is the series of dexp^{-1}_u up
to the terms with r brackets. The unknowns are the v_i.

If the scene has another coordinate map tau, tau replaces exp, and the exact inverse differential of tau
replaces the truncated dexp^{-1}. The method with tau does not use r, and has the order of the tableau.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING

from codegen.ir.operations import ElementAt, Exp, InverseDifferential, Operation
from codegen.ir.program import EMBEDDED, POWERS, Builder, Program
from codegen.ir.values import Kind, Var
from codegen.lower import minimal_brackets
from codegen.lower.field import FieldLowering
from codegen.lower.stages import Stages
from codegen.method import Method
from codegen.scene.problem import Problem
from orderconds.ring.protocol import Element
from orderconds.tableau.extension import Extension

if TYPE_CHECKING:
    from orderconds.checking import FamilyOrder
    from orderconds.families import Family


class MuntheKaas(FieldLowering):
    """Runge-Kutta-Munthe-Kaas methods.

    If a method has the cut-off r, the series of dexp^{-1} ends with the term with r brackets. If a method has
    no cut-off, a search finds the smallest number of brackets that gives the order of the tableau.
    """

    family = "rkmk"
    reads_coordinates = True

    def lower(self, problem: Problem, method: Method) -> Program:
        """Return the program of a step."""
        # If ``problem.coordinates`` is None, the coordinate map is exp.
        if problem.coordinates is not None:
            return in_coordinates(problem, method)
        # Without a cut-off, a search finds the brackets that are needed for the order of the tableau.
        if method.cutoff is None:
            return minimal_brackets.lower(problem, method)
        return with_cutoff(problem, method, method.cutoff)

    def extension(self, problem: Problem, method: Method) -> Program | None:
        """Return the program of the continuous extension.

        The result is None if ``method.cutoff`` is None, or if the coordinate map of the scene is not exp.
        The result is also None if the tableau is implicit or has no continuous extension.
        """
        # The continuous extension is exp(sigma(theta)).y0 with a polynomial sigma.
        exact = problem.coordinates is None and method.cutoff is not None
        return extension_with_cutoff(problem, method, method.cutoff or 0) if exact else None

    def conditions(self, method: Method, scene: Problem | None = None) -> Family:
        """Return the family with the order conditions of the method.

        If the scene has a coordinate map other than exp, the result is the family ``rkmk`` without a cut-off.
        If the map is exp and ``method.cutoff`` is None, the family uses the brackets from
        :func:`codegen.lower.minimal_brackets.bracket_program`.
        """
        if scene is not None and scene.coordinates is not None:
            from orderconds import families

            # The step inverts the differential of the coordinate map exactly. Therefore the order conditions
            # are those of methods without a cut-off.
            return families.get(self.family)
        if method.cutoff is not None:
            return super().conditions(method, scene)
        from orderconds.families.minimal_brackets import MinimalBrackets

        return MinimalBrackets(minimal_brackets.bracket_program(method))

    def order(self, method: Method, scene: Problem | None = None) -> FamilyOrder:
        """Return the order of a method."""
        if method.cutoff is not None or (scene is not None and scene.coordinates is not None):
            return super().order(method, scene)
        return _order(self, method)


@lru_cache(maxsize=256)
def _order(lowering: MuntheKaas, method: Method) -> FamilyOrder:
    # The result is cached, because a report needs the order many times.
    from orderconds.checking import family_order

    return replace(family_order(method.tableau, lowering.conditions(method)), failing=())


def with_cutoff(problem: Problem, method: Method, cutoff: int) -> Program:
    """Return the program of a step. No term of the series of dexp^{-1} has more than ``cutoff`` brackets."""

    def inverse(build: Builder, target: str, u: Var, k: Var) -> Var:
        # The series is dexp^{-1}_u k = k - [u, k]/2 + [u, [u, k]]/12 - .... With the cut-off 0, only the term
        # k remains.
        return build.dexpinv(target, u, k, cutoff)

    return _program(problem, method, Exp(), inverse)


def extension_with_cutoff(problem: Problem, method: Method, cutoff: int) -> Program | None:
    """Return the program of the continuous extension.

    The series of dexp^{-1} has at most ``cutoff`` brackets. The result is None if the tableau is
    implicit or has no continuous extension.
    """
    extension, zero = method.tableau.extension, method.ring.is_zero
    A = method.runge_kutta().A
    # The entries on and above the diagonal of an explicit tableau are zero.
    if extension is None or any(zero(x) is not True for i, row in enumerate(A) for x in row[i:]):
        return None

    def inverse(build: Builder, target: str, u: Var, k: Var) -> Var:
        return build.dexpinv(target, u, k, cutoff)

    return _program(problem, method, Exp(), inverse, extension)


def in_coordinates(problem: Problem, method: Method) -> Program:
    """Return the program of an RKMK step in which the coordinate map of the scene replaces exp."""

    def inverse(build: Builder, target: str, u: Var, k: Var) -> Var:
        return build.add(InverseDifferential(), target, u, k)

    # The inverse differential of the coordinate map has an exact formula, so no series is truncated.
    return _program(problem, method, ElementAt(), inverse)


def _program(
    problem: Problem,
    method: Method,
    element: Operation,
    inverse: Callable[[Builder, str, Var, Var], Var],
    extension: Extension | None = None,
) -> Program:
    """Return the program of a step with the coordinate map tau = ``element``.

    The function ``inverse`` appends the operation k -> (dtau_u)^{-1} k, where dtau_u is the differential of
    tau at u. For tau = exp, the operation is a truncated series.

    If ``extension`` is given, the program computes the coefficients of the continuous extension instead of
    the new state.
    """
    tableau = method.runge_kutta()
    y = Var("y", Kind.POINT)
    stages = Stages(problem, method, (y,))
    build = stages.builder
    v = [build.fresh(f"v{i + 1}", Kind.ALG) for i in range(tableau.s)]

    def images() -> list[Var]:
        result = []
        for i, row in enumerate(tableau.A):
            # Each pass through the loop computes one Runge-Kutta stage of u' = dexp^{-1}_u f(exp(u).y).
            u = stages.combination(f"u{i + 1}", Kind.ALG, row, v)
            # Every exponential acts on y0, because the u_i are coordinates relative to y0.
            point = build.act(f"Y{i + 1}", build.add(element, f"g{i + 1}", u), y)
            k = stages.f(f"k{i + 1}", point, tableau.c[i])
            result.append(inverse(build, f"w{i + 1}", u, k))
        return result

    def updated(weights: tuple[Element, ...]) -> Var:
        u = stages.combination("u", Kind.ALG, weights, v)
        return build.act("y1", build.add(element, "g", u), y)

    def powers() -> dict[str, Var]:
        assert extension is not None
        # The weights are polynomials in theta, and row p contains the coefficients of theta^p.
        rows = {f"{POWERS}{p}": extension.power(p) for p in range(1, extension.degree + 1)}
        return {name: stages.combination(name, Kind.ALG, row, v) for name, row in rows.items()}

    def update() -> dict[str, Var]:
        # The embedded solution also uses the stage values v_i, but with other weights.
        lower = method.embedded()
        more = {} if lower is None else {EMBEDDED: updated(lower.runge_kutta().b)}
        return {"y": updated(tableau.b)} | more

    # For the continuous extension, the program returns the coefficients of a polynomial in theta.
    ends = update if extension is None else powers
    return stages.program(v, images, lambda: [stages.f("k0", y, None)] * tableau.s, ends)
