"""Passes over the program of a step. A pass is a pure function from a program to a simpler program.

A pass is exact if, in exact arithmetic, both programs have the same results.

The function :func:`optimise` runs all passes in a fixed order. After every pass it checks the new program:
types must match, and each variable is assigned once. It also runs the new and the original program from two
states of the scene and compares the results.
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
    """Runs the passes on one program and compares the result of each pass with a reference.

    ``composed`` may be given if the step repeats a shorter method in several substeps
    (:mod:`codegen.lower.substeps`). The statements of ``composed`` compute one substep. Its list ``substeps``
    contains all substeps of the step. The optimiser tests that ``composed`` has the same results as
    ``program``. Then the passes rewrite the statements of ``composed``.

    If a pass changes the results, :class:`codegen.ir.verify.IllFormed` is raised. This error means that the
    compiler has a bug.
    """

    def __init__(self, program: Program, scene: Problem, composed: Program | None = None) -> None:
        self.scene = scene
        self.reports: list[PassReport] = []
        self.program, self.meaning = program, Reference(program, scene)
        if composed is not None:
            whole: Program = composed
            self._run(Pass("substeps", "the step repeats a shorter step", lambda _: whole))
            # The passes rewrite the statements of one substep, so the reference is also one substep.
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
        # The interpreter returns the momentum in the space frame for both kinds of programs. Therefore the
        # results in the two frames can be compared.
        for each in body_frame_passes(self.scene):
            self._run(each)
        outcome = self.program, tuple(self.reports)
        # The program in the space frame is restored, so that a later call of ``plain`` returns this program.
        self.program, self.reports = plain, reports
        return outcome

    def _run(self, each: Pass) -> None:
        old, new = self.program, verify(each.run(self.program))
        # An unchanged program is not compared with the reference.
        if new == old:
            return
        # Each program is compared with the program before the first pass, so small deviations cannot add up
        # from pass to pass.
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
        # This pass comes first: it replaces brackets by zeros, and the next pass removes zeros from sums.
        Pass("brackets that vanish", vanish, lambda p: abelian.run(p, abelian_group)),
        Pass("zeros", ZERO, fold_zeros.run),
        Pass("shared values", SHARED, value_numbering.run),
        # This pass must follow value numbering, which replaces equal right-hand sides by a single variable.
        Pass("equal unknowns", "equal stages are solved once", equal_unknowns.run),
        # After two stages have been merged, terms of a sum may be equal, and may cancel.
        Pass("zeros", ZERO, fold_zeros.run),
        Pass("joined flows", joined, lambda p: flows.run(p, scene)),
        # The pass for joined flows removes flows. This pass removes their stage times.
        Pass("unused values", UNUSED, dead.run),
        # The pass for zeros removes terms that cancel. Without it, this pass would find dependencies in them.
        Pass("blocks", "stages are solved one after the other", blocks.run),
        # The next pass tests whether only one operation reads a linear map. Therefore this pass first removes
        # operations whose results are not used.
        Pass("unused values", UNUSED, dead.run),
        # This pass replaces L(x) + L(y) by L(x + y) if no other operation reads L(x) or L(y). The next pass
        # treats the case that several sums read L(x) and L(y).
        Pass("factored maps", FACTORED, factor_linear.run),
        Pass("factored maps in several sums", FACTORED, shared_sums.run),
        # Factoring produces sums of a single term, which this pass removes.
        Pass("zeros", ZERO, fold_zeros.run),
        Pass("shared values", SHARED, value_numbering.run),
        # This pass counts the operations that read exp(x), so it must follow value numbering, which merges
        # equal exponentials.
        Pass("fused exponentials", "exp(x).y is computed without exp(x)", lambda p: dead.run(fuse.run(p))),
        Pass("unused values", UNUSED, dead.run),
        # After factoring, some values of a block may no longer depend on the unknowns of the block. This pass
        # moves these values out of the block.
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
        # The Legendre transform introduces inverses of maps, which may cancel other maps.
        Pass("inverse maps", inverse, opposites.run),
        # In general the force of a stage depends on the unknown momentum of the stage. The Legendre transform
        # removes this dependence. Only then can this pass remove the force from the unknowns.
        Pass("fewer unknowns", "the remaining unknowns determine the removed unknowns", tearing.run),
        # After an unknown has been removed, a map may directly follow its inverse.
        Pass("inverse maps", inverse, opposites.run),
        Pass("unused values", UNUSED, dead.run),
        Pass("shared values", SHARED, value_numbering.run),
        Pass("factored maps", FACTORED, factor_linear.run),
        Pass("factored maps in several sums", FACTORED, shared_sums.run),
        # The next pass replaces more adjoint operations of exp(x) if no other operation reads exp(x).
        # Therefore this pass first replaces products that read exp(x).
        Pass("rows of products", "q exp(x) is computed without exp(x)", lambda p: functions.rows(p, scene)),
        Pass("functions of ad", one_ad, lambda p: functions.run(p, scene)),
        # This pass adds residuals. Each residual is the difference of two formulas for the same momentum. To
        # choose this momentum, the pass looks for functions of ad, which the previous pass creates.
        Pass("residuals", "equations compare momenta", lambda p: legendre.residuals(p, scene)),
        # The residuals contain new inverses of maps, so the passes for maps are repeated.
        Pass("inverse maps", inverse, opposites.run),
        Pass("functions of ad", one_ad, lambda p: functions.run(p, scene)),
        Pass("shared values", SHARED, value_numbering.run),
        Pass("factored maps", FACTORED, factor_linear.run),
        Pass("unused values", UNUSED, dead.run),
        # Factoring moves coefficients into the arguments of maps. This pass moves a coefficient out of an
        # argument that is a single term.
        Pass(
            "numbers outside maps",
            "numeric factors become coefficients of sums",
            hoist_scalars.run,
        ),
        Pass("shared values", SHARED, value_numbering.run),
        Pass("unused values", UNUSED, dead.run),
        # This pass takes the factor -1 out of sums. Other passes would multiply it into the sums again, so
        # this pass is the last.
        Pass("negatives of sums", "a sum is the negative of another sum", shared_negatives.run),
    ]
