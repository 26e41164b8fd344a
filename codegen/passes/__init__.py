"""The passes: one file each, pure functions over programs, run in a fixed order and verified after each.

``optimise`` runs them on a scene. After every pass it checks types and single assignment, and interprets the
program at sample points, where it must agree with the lowered program to rounding.
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
UNUSED = "no result depends on them"
FACTORED = "a linear map is applied to a sum, not to each term"


def optimise(
    program: Program, scene: Problem, *, framed: bool = False, composed: Program | None = None
) -> tuple[Program, tuple[PassReport, ...]]:
    """Return the program after all passes, and a report of each that changed something.

    ``scene`` is the problem that the program was lowered in; for ``framed`` and ``composed`` see
    :class:`Optimiser`.
    """
    work = Optimiser(program, scene, composed)
    return work.framed() if framed else work.plain()


class Optimiser:
    """The passes on one program, and the reference that each result is compared with.

    ``composed`` is the same step as a composition of shorter ones (:mod:`codegen.lower.substeps`), if it is
    one. It is compared as a whole and then replaces the step; the passes rewrite and compare one substep. A
    pass that breaks the program raises :class:`codegen.ir.verify.IllFormed`: a fault of this compiler.
    """

    def __init__(self, program: Program, scene: Problem, composed: Program | None = None) -> None:
        self.scene = scene
        self.reports: list[PassReport] = []
        self.program, self.meaning = program, Reference(program, scene)
        if composed is not None:
            whole: Program = composed
            self._run(Pass("substeps", "the step repeats a shorter one", lambda _: whole))
            # The passes now rewrite one substep, so the reference is this substep as a step of its own.
            self.meaning = Reference(_part(composed), scene)
        for each in plain_passes(scene):
            self._run(each)

    def plain(self) -> tuple[Program, tuple[PassReport, ...]]:
        """Return the program after the passes that serve every scene."""
        return self.program, tuple(self.reports)

    def framed(self) -> tuple[Program, tuple[PassReport, ...]]:
        """Return the program in the body frame with smaller equations, if the scene has a body frame.

        It need not be cheaper: the caller counts the operations of both programs.
        """
        plain, reports = self.program, list(self.reports)
        # The reference stays: interpreting a program in the body frame includes both turns of the momentum.
        for each in body_frame_passes(self.scene):
            self._run(each)
        outcome = self.program, tuple(self.reports)
        # The caller may still want the plain program: the body frame does not always need fewer operations.
        self.program, self.reports = plain, reports
        return outcome

    def _run(self, each: Pass) -> None:
        old, new = self.program, verify(each.run(self.program))
        # Many passes leave a program alone; a comparison would interpret it at several points for nothing.
        if new == old:
            return
        # Compared with the lowered program, not with the pass before: small deviations cannot accumulate.
        account = self.meaning.differs(new if old.substeps == () else _part(new))
        if account:
            raise IllFormed(f"the pass {each.name} changed the meaning of {old.name}: {account}")
        self.reports.append(PassReport(each.name, each.because, old, new))
        self.program = new


def _part(program: Program) -> Program:
    """Return one substep of a composition as a step of its own."""
    return replace(program, substeps=())


def plain_passes(scene: Problem) -> list[Pass]:
    """Return the passes that serve every scene, in order."""
    abelian_group = scene.group.abelian
    joined = "flows of one part are joined across flows that commute"
    vanish = "the group is abelian" if abelian_group else "dexpinv is cut off before its first bracket"
    return [
        # First of all: it makes the zeros that the next pass removes from sums.
        Pass("brackets that vanish", vanish, lambda p: abelian.run(p, abelian_group)),
        Pass("zeros", ZERO, fold_zeros.run),
        Pass("shared values", SHARED, value_numbering.run),
        # Stages with equal rows have one image only after value numbering.
        Pass("equal unknowns", "equal stages are solved once", equal_unknowns.run),
        # Two stages that became one leave several terms in one value, which may cancel.
        Pass("zeros", ZERO, fold_zeros.run),
        Pass("joined flows", joined, lambda p: flows.run(p, scene)),
        # A joined flow leaves the stage times of the flows that it replaces.
        Pass("unused values", UNUSED, dead.run),
        # Terms of later stages must have cancelled, else a composition method stays one large block.
        Pass("blocks", "stages are solved one after the other", blocks.run),
        # Factoring counts readers; a dead reader would keep a map inside its sum.
        Pass("unused values", UNUSED, dead.run),
        # Single readers first: factoring these always saves maps. Shared terms need a count, see below.
        Pass("factored maps", FACTORED, factor_linear.run),
        Pass("maps of shared sums", FACTORED, shared_sums.run),
        # Factoring leaves sums of a single term.
        Pass("zeros", ZERO, fold_zeros.run),
        Pass("shared values", SHARED, value_numbering.run),
        # After sharing: whether exp(x) has one reader is known only when equal exponentials are one.
        Pass("fused exponentials", "exp(x).y is computed without exp(x)", lambda p: dead.run(fuse.run(p))),
        Pass("unused values", UNUSED, dead.run),
        # Factoring makes values independent of a block's unknowns; they leave the block now.
        Pass("blocks", "stages are solved one after the other", blocks.run),
    ]


def body_frame_passes(scene: Problem) -> list[Pass]:
    """Return the passes that follow where the scene has a body frame, in order."""
    inverse = "adjoint maps undo each other"
    one_ad = "functions of one ad are one function"
    return [
        Pass("body frame", "the equations are those of the body", lambda p: body_frame.run(p, scene)),
        Pass("zeros", ZERO, fold_zeros.run),
        # The Legendre transform replaces variables, and would miss a second copy of a momentum.
        Pass("shared values", SHARED, value_numbering.run),
        Pass("Legendre transform", "momenta follow from velocities", lambda p: legendre.run(p, scene)),
        # The transform undoes maps that the program applies again elsewhere.
        Pass("inverse maps", inverse, opposites.run),
        # Only now: before the transform a force depends on its own momentum, which closes a cycle.
        Pass("fewer unknowns", "the other unknowns determine them", tearing.run),
        # Across an unknown that tearing removed, a map meets its inverse.
        Pass("inverse maps", inverse, opposites.run),
        Pass("unused values", UNUSED, dead.run),
        Pass("shared values", SHARED, value_numbering.run),
        Pass("factored maps", FACTORED, factor_linear.run),
        Pass("maps of shared sums", FACTORED, shared_sums.run),
        # Before functions of ad: without this reader exp(x) may have no reader but one adjoint map.
        Pass("rows of products", "q exp(x) is computed without exp(x)", lambda p: functions.rows(p, scene)),
        Pass("functions of ad", one_ad, lambda p: functions.run(p, scene)),
        # Residuals compare momenta in the cheaper frame, and the cheaper frame shows only in functions of ad.
        Pass("residuals", "momenta are compared", lambda p: legendre.residuals(p, scene)),
        # The residuals bring new inverse maps, so the passes for maps run again.
        Pass("inverse maps", inverse, opposites.run),
        Pass("functions of ad", one_ad, lambda p: functions.run(p, scene)),
        Pass("shared values", SHARED, value_numbering.run),
        Pass("factored maps", FACTORED, factor_linear.run),
        Pass("unused values", UNUSED, dead.run),
        # Factoring moves coefficients into maps; a coefficient that is alone in its map leaves it again.
        Pass("numbers outside maps", "numbers are multiplied into sums", hoist_scalars.run),
        Pass("shared values", SHARED, value_numbering.run),
        Pass("unused values", UNUSED, dead.run),
        # Last: the other passes would multiply the factor -1 back into a sum.
        Pass("negatives of sums", "a sum is the negative of another", shared_negatives.run),
    ]
