"""Passes over the program of a step. A pass is a pure function from a program to a simpler program.

A pass is exact if, in exact arithmetic, the new program has the results of the old program.

The function :func:`optimise` runs all passes in a fixed order. After every pass, :func:`optimise` checks the
new program: types must match, and each variable is assigned once. The results of the new program are compared
with the results of the program before the first pass.
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

    ``program`` is the program of a step for the problem ``scene``. If ``framed`` is True, the equations are
    rewritten in the body frame of the group element at the start of the step
    (:mod:`codegen.passes.body_frame`).
    :class:`Optimiser` explains ``composed``.
    """
    work = Optimiser(program, scene, composed)
    return work.framed() if framed else work.plain()


class Optimiser:
    """Runs the passes on ``program``. After each pass the new program is compared with ``program``.

    If the step repeats a shorter method in several substeps (:mod:`codegen.lower.substeps`), ``composed`` is
    another program for the step. The statements of ``composed`` compute one substep. The attribute
    ``substeps`` of ``composed`` lists all substeps. The optimiser tests that ``composed`` and ``program``
    have the same results. Then the passes rewrite ``composed``.

    If a pass changes the results, the compiler has a bug, and :class:`codegen.ir.verify.IllFormed` is raised.
    """

    def __init__(self, program: Program, scene: Problem, composed: Program | None = None) -> None:
        self.scene = scene
        self.reports: list[PassReport] = []
        self.program, self.meaning = program, Reference(program, scene)
        if composed is not None:
            whole: Program = composed
            self._run(Pass("substeps", "the step is a sequence of substeps", lambda _: whole))
            # The passes rewrite the statements of one substep. Therefore the reference computes one substep.
            self.meaning = Reference(_part(composed), scene)
        for each in plain_passes(scene):
            self._run(each)

    def plain(self) -> tuple[Program, tuple[PassReport, ...]]:
        """Return the program after the passes that apply to every scene, and the reports of these passes."""
        return self.program, tuple(self.reports)

    def framed(self) -> tuple[Program, tuple[PassReport, ...]]:
        """Return the program in the body frame, and the reports of all passes.

        If the scene has no body frame, the program stays in the space frame. In the body frame the implicit
        equations are smaller, but the program may need more operations.
        """
        plain, reports = self.program, list(self.reports)
        # For a program in the body frame, the interpreter also returns the momentum in the space frame.
        # Therefore the results can be compared.
        for each in body_frame_passes(self.scene):
            self._run(each)
        outcome = self.program, tuple(self.reports)
        # A later call of ``plain`` must return the program in the space frame. Therefore it is restored.
        self.program, self.reports = plain, reports
        return outcome

    def _run(self, each: Pass) -> None:
        old, new = self.program, verify(each.run(self.program))
        # An unchanged program is not compared with the reference.
        if new == old:
            return
        # The reference is the program before the first pass. Therefore small deviations of the passes cannot
        # add up.
        account = self.meaning.differs(new if old.substeps == () else _part(new))
        if account:
            raise IllFormed(f"the pass {each.name} changed the results of {old.name}: {account}")
        self.reports.append(PassReport(each.name, each.because, old, new))
        self.program = new


def _part(program: Program) -> Program:
    """Return the program of one substep of ``program``."""
    return replace(program, substeps=())


def plain_passes(scene: Problem) -> list[Pass]:
    """Return the passes that apply to every scene, in order."""
    abelian_group = scene.group.abelian
    joined = "two flows of one term of H are joined if they commute with all flows between them"
    vanish = "the group is abelian" if abelian_group else "dexpinv is the identity at truncation order 0"
    return [
        # The first pass replaces brackets by zeros. Then the pass for zeros removes these zeros from sums.
        Pass("brackets that vanish", vanish, lambda p: abelian.run(p, abelian_group)),
        Pass("zeros", ZERO, fold_zeros.run),
        Pass("shared values", SHARED, value_numbering.run),
        # Value numbering has replaced equal right-hand sides by one variable. This pass relies on that.
        Pass("equal unknowns", "equal stages are solved once", equal_unknowns.run),
        # After two stages have been merged, terms of a sum may be equal, and may cancel.
        Pass("zeros", ZERO, fold_zeros.run),
        Pass("joined flows", joined, lambda p: flows.run(p, scene)),
        # The previous pass removes flows. This pass removes the stage times of the removed flows.
        Pass("unused values", UNUSED, dead.run),
        # Terms that cancel would look like dependencies. Therefore the pass for zeros precedes this pass.
        Pass("blocks", "stages are solved one after the other", blocks.run),
        # The next pass tests whether only one operation reads a linear map. Therefore this pass first removes
        # operations whose results are not used.
        Pass("unused values", UNUSED, dead.run),
        # This pass replaces L(x) + L(y) by L(x + y) if no other operation reads L(x) or L(y). If several sums
        # read L(x) and L(y), the next pass replaces L(x) + L(y).
        Pass("factored maps", FACTORED, factor_linear.run),
        Pass("factored maps in several sums", FACTORED, shared_sums.run),
        # Factoring produces sums of a single term. This pass removes these sums.
        Pass("zeros", ZERO, fold_zeros.run),
        Pass("shared values", SHARED, value_numbering.run),
        # This pass counts the operations that read exp(x). Therefore value numbering first merges equal
        # exponentials.
        Pass("fused exponentials", "exp(x).y is computed without exp(x)", lambda p: dead.run(fuse.run(p))),
        Pass("unused values", UNUSED, dead.run),
        # Factoring can remove dependencies. If a value in a block no longer depends on the unknowns of the
        # block, this pass moves the value out of the block.
        Pass("blocks", "stages are solved one after the other", blocks.run),
    ]


def body_frame_passes(scene: Problem) -> list[Pass]:
    """Return the passes for a scene with a body frame, in order."""
    inverse = "an adjoint map and its inverse cancel"
    one_ad = "functions of the same ad_x are combined"
    return [
        Pass("body frame", "the equations are written in the body frame", lambda p: body_frame.run(p, scene)),
        Pass("zeros", ZERO, fold_zeros.run),
        # Value numbering merges variables that contain the same momentum. The Legendre transform needs one
        # variable for each momentum.
        Pass("shared values", SHARED, value_numbering.run),
        Pass("Legendre transform", "momenta are computed from velocities", lambda p: legendre.run(p, scene)),
        # The Legendre transform introduces inverses of maps. This pass removes a map and its inverse if one
        # is applied directly after the other.
        Pass("inverse maps", inverse, opposites.run),
        # The Legendre transform computes the force of a stage from the velocity. Therefore this pass can
        # remove the force from the unknowns.
        Pass("fewer unknowns", "the remaining unknowns determine the removed unknowns", tearing.run),
        # After an unknown has been removed, a map may directly follow its inverse.
        Pass("inverse maps", inverse, opposites.run),
        Pass("unused values", UNUSED, dead.run),
        Pass("shared values", SHARED, value_numbering.run),
        Pass("factored maps", FACTORED, factor_linear.run),
        Pass("factored maps in several sums", FACTORED, shared_sums.run),
        # The next pass keeps an adjoint map of exp(x) if other operations read exp(x). Therefore this pass
        # first replaces products that read exp(x).
        Pass("rows of products", "q exp(x) is computed without exp(x)", lambda p: functions.rows(p, scene)),
        Pass("functions of ad", one_ad, lambda p: functions.run(p, scene)),
        # A residual is the difference of two formulas for one momentum. The previous pass creates functions
        # of ad. The choice of the momentum depends on these functions.
        Pass("residuals", "equations compare momenta", lambda p: legendre.residuals(p, scene)),
        # The residuals contain new inverses of maps. Therefore the next passes are repeated.
        Pass("inverse maps", inverse, opposites.run),
        Pass("functions of ad", one_ad, lambda p: functions.run(p, scene)),
        Pass("shared values", SHARED, value_numbering.run),
        Pass("factored maps", FACTORED, factor_linear.run),
        Pass("unused values", UNUSED, dead.run),
        # Factoring moves coefficients c into the arguments of maps L. This pass moves c out again.
        Pass(
            "numbers outside maps",
            "numeric factors become coefficients of sums",
            hoist_scalars.run,
        ),
        Pass("shared values", SHARED, value_numbering.run),
        Pass("unused values", UNUSED, dead.run),
        # This pass takes the factor -1 out of sums. Other passes would multiply the sums by -1 again, so this
        # pass is the last.
        Pass("negatives of sums", "a sum is the negative of another sum", shared_negatives.run),
    ]
