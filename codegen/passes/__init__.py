"""Passes over the program of a step. A pass is a pure function from a program to a simpler program.

A pass is exact if, in exact arithmetic, the new program has the results of the old program.

After every pass, :func:`optimise` compares the results of the new program and of the original program.
"""

from __future__ import annotations

from dataclasses import replace

from codegen.ir.program import Program
from codegen.ir.verify import IllFormed, verify
from codegen.passes import (
    abelian,
    blocks,
    body_frame,
    dead,
    equal_unknowns,
    factor_linear,
    flows,
    fold_zeros,
    functions,
    fuse,
    hoist_scalars,
    legendre,
    opposites,
    shared_negatives,
    shared_sums,
    tearing,
    value_numbering,
)
from codegen.passes.equivalence import Reference
from codegen.passes.reports import Pass
from codegen.passes.reports import PassReport as PassReport
from codegen.passes.reports import summaries as summaries
from codegen.scene.problem import Problem

ZERO = "coefficients are zero, or terms cancel"
SHARED = "equal values are computed once"
UNUSED = "no result depends on these operations"
FACTORED = "a linear map is applied once to a sum and not to each term"


def optimise(
    program: Program, scene: Problem, *, framed: bool = False, composed: Program | None = None
) -> tuple[Program, tuple[PassReport, ...]]:
    """Return the program after all passes, and a report of each pass that changed the program.

    If ``framed`` is True, the equations are rewritten in the body frame of the group element at the start of
    the step (:mod:`codegen.passes.body_frame`). :class:`Optimiser` explains ``composed``.
    """
    work = Optimiser(program, scene, composed)
    return work.framed() if framed else work.plain()


class Optimiser:
    """Runs the passes on ``program``, and checks that no pass changes the results.

    The statements of ``program`` compute a whole step. If the step repeats a shorter method in several
    substeps (:mod:`codegen.lower.substeps`), the step can be described by a second program, ``composed``. The
    statements of ``composed`` compute only one substep. These statements are executed once for each substep
    in the list ``composed.substeps``. If ``composed`` is given, the passes rewrite ``composed`` instead of
    ``program``. :class:`codegen.ir.verify.IllFormed` is raised if a pass changes the results.
    """

    def __init__(self, program: Program, scene: Problem, composed: Program | None = None) -> None:
        self.scene = scene
        self.reports: list[PassReport] = []
        self.program, self.meaning = program, Reference(program, scene)
        if composed is not None:
            whole: Program = composed
            self._run(Pass("substeps", "the step is a sequence of substeps", lambda _: whole))
            # The result of the rewritten substep will be compared with the result of the original substep.
            self.meaning = Reference(_part(composed), scene)
        for each in plain_passes(scene):
            self._run(each)

    def plain(self) -> tuple[Program, tuple[PassReport, ...]]:
        """Return the program after the passes that apply to every scene, and the reports of these passes."""
        return self.program, tuple(self.reports)

    def framed(self) -> tuple[Program, tuple[PassReport, ...]]:
        """Return the program in the body frame, and the reports of all passes.

        If the scene has no body frame, the program stays in the space frame.
        """
        plain, reports = self.program, list(self.reports)
        for each in body_frame_passes(self.scene):
            self._run(each)
        outcome = self.program, tuple(self.reports)
        # A later call of :meth:`plain` must return the program as it was before the body-frame passes.
        self.program, self.reports = plain, reports
        return outcome

    def _run(self, each: Pass) -> None:
        old, new = self.program, verify(each.run(self.program))
        # A pass that leaves the program unchanged needs no test and no report.
        if new == old:
            return
        # ``new`` is not compared with ``old``, but with the program before the first pass. If the program has
        # substeps, one substep is compared.
        account = self.meaning.differs(new if old.substeps == () else _part(new))
        if account:
            raise IllFormed(f"the pass {each.name} changed the results of {old.name}: {account}")
        self.reports.append(PassReport(each.name, each.because, old, new))
        self.program = new


def _part(program: Program) -> Program:
    """Return ``program`` without the list ``substeps``."""
    return replace(program, substeps=())


def plain_passes(scene: Problem) -> list[Pass]:
    """Return the passes that apply to every scene, in order."""
    abelian_group = scene.group.abelian
    joined = "two flows of one term of H are joined if they commute with all flows between them"
    vanish = "the group is abelian" if abelian_group else "dexpinv is the identity at truncation order 0"
    return [
        # The first pass replaces brackets by zeros, and the pass for zeros removes the zeros from sums.
        Pass("brackets that vanish", vanish, lambda p: abelian.run(p, abelian_group)),
        Pass("zeros", ZERO, fold_zeros.run),
        Pass("shared values", SHARED, value_numbering.run),
        # The pass "equal unknowns" compares variables, so the pass "shared values" must first give equal
        # values the same variable.
        Pass("equal unknowns", "equal stages are solved once", equal_unknowns.run),
        # The pass "equal unknowns" replaces equal unknowns by one unknown, so a sum can contain a variable
        # twice. The pass "zeros" adds the two coefficients of this variable.
        Pass("zeros", ZERO, fold_zeros.run),
        Pass("joined flows", joined, lambda p: flows.run(p, scene)),
        # The previous pass removes flows. The stage times of these flows are now unused.
        Pass("unused values", UNUSED, dead.run),
        # The pass "blocks" determines which variables depend on the unknowns. A term with coefficient zero
        # would count as a dependency, so the pass "zeros" comes earlier.
        Pass("blocks", "stages are solved one after the other", blocks.run),
        # The pass "factored maps" counts how often each value is read, so unused operations are removed
        # before it.
        Pass("unused values", UNUSED, dead.run),
        # This pass replaces L(x) + L(y) by L(x + y) if no other operation reads L(x) or L(y).
        Pass("factored maps", FACTORED, factor_linear.run),
        Pass("maps of shared sums", FACTORED, shared_sums.run),
        # Factoring produces sums of a single term x. This pass replaces such a sum by x.
        Pass("zeros", ZERO, fold_zeros.run),
        Pass("shared values", SHARED, value_numbering.run),
        # This pass counts the operations that read exp(x), so equal exponentials must be merged first.
        Pass("fused exponentials", "exp(x).y is computed without exp(x)", lambda p: dead.run(fuse.run(p))),
        Pass("unused values", UNUSED, dead.run),
        # After factoring, more values are independent of the unknowns. The pass ``blocks`` moves these values
        # out of the implicit equations.
        Pass("blocks", "stages are solved one after the other", blocks.run),
    ]


def body_frame_passes(scene: Problem) -> list[Pass]:
    """Return the passes for a scene with a body frame, in order."""
    inverse = "an adjoint map and its inverse cancel"
    one_ad = "functions of the same ad_x are combined"
    return [
        Pass("body frame", "the equations are written in the body frame", lambda p: body_frame.run(p, scene)),
        Pass("zeros", ZERO, fold_zeros.run),
        # Equal momenta become the same variable. The Legendre transform requires this.
        Pass("shared values", SHARED, value_numbering.run),
        Pass("Legendre transform", "momenta are computed from velocities", lambda p: legendre.run(p, scene)),
        # The Legendre transform introduces inverses of maps.
        Pass("inverse maps", inverse, opposites.run),
        # After the Legendre transform, some unknowns can be computed from other unknowns.
        Pass("fewer unknowns", "the remaining unknowns determine the removed unknowns", tearing.run),
        # The previous pass can produce products of a map and its inverse. This pass removes these products.
        Pass("inverse maps", inverse, opposites.run),
        Pass("unused values", UNUSED, dead.run),
        Pass("shared values", SHARED, value_numbering.run),
        Pass("factored maps", FACTORED, factor_linear.run),
        Pass("maps of shared sums", FACTORED, shared_sums.run),
        # The pass "rows of products" replaces some products q exp(x) by operations that read q and x, but not
        # exp(x). The pass "rows of products" must come before "functions of ad", because "functions of ad"
        # replaces Ad_{exp x} by a function of ad_x only if no other operation reads exp(x).
        Pass("rows of products", "one operation computes q exp(x)", lambda p: functions.rows(p, scene)),
        Pass("functions of ad", one_ad, lambda p: functions.run(p, scene)),
        # This pass uses operations that the pass "functions of ad" creates.
        Pass("residuals", "equations compare momenta", lambda p: legendre.residuals(p, scene)),
        # The residuals contain inverses of maps. This pass removes products of a map and its inverse.
        Pass("inverse maps", inverse, opposites.run),
        Pass("functions of ad", one_ad, lambda p: functions.run(p, scene)),
        Pass("shared values", SHARED, value_numbering.run),
        Pass("factored maps", FACTORED, factor_linear.run),
        Pass("unused values", UNUSED, dead.run),
        # For linear maps L and numbers c, this pass replaces L(c x) by c L(x).
        Pass(
            "numbers outside maps",
            "numeric factors become coefficients of sums",
            hoist_scalars.run,
        ),
        Pass("shared values", SHARED, value_numbering.run),
        Pass("unused values", UNUSED, dead.run),
        # This pass comes last, because other passes would undo its changes.
        Pass("negatives of sums", "a sum is the negative of another sum", shared_negatives.run),
    ]
