"""The passes: one file each, pure functions over programs, run in a fixed order and verified after each.

``optimise`` runs them on a scene: types and single assignment are checked after every pass, and meaning by
interpretation at points where the program must agree with the lowered one to rounding.
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
    """The passes on one program: it is interpreted once, whatever is then compared with it.

    ``composed`` is the same step as a composition of shorter ones (:mod:`codegen.lower.substeps`), where it
    is one: compared as a whole, then taken in its place; passes change, and are held against, one substep. A
    pass that breaks the program raises :class:`codegen.ir.verify.IllFormed`: a fault of this compiler.
    """

    def __init__(self, program: Program, scene: Problem, composed: Program | None = None) -> None:
        self.scene = scene
        self.reports: list[PassReport] = []
        self.program, self.meaning = program, Reference(program, scene)
        if composed is not None:
            whole: Program = composed
            self._run(Pass("substeps", "the step repeats a shorter one", lambda _: whole))
            self.meaning = Reference(_part(composed), scene)
        for each in plain_passes(scene):
            self._run(each)

    def plain(self) -> tuple[Program, tuple[PassReport, ...]]:
        """Return the program after the passes that serve every scene."""
        return self.program, tuple(self.reports)

    def framed(self) -> tuple[Program, tuple[PassReport, ...]]:
        """Return the program put into the body frame and its equations made smaller, where that can be.

        Counting operations shows whether it is worth while.
        """
        plain, reports = self.program, list(self.reports)
        for each in body_frame_passes(self.scene):
            self._run(each)
        outcome = self.program, tuple(self.reports)
        self.program, self.reports = plain, reports
        return outcome

    def _run(self, each: Pass) -> None:
        old, new = self.program, verify(each.run(self.program))
        if new == old:
            return
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
        Pass("brackets that vanish", vanish, lambda p: abelian.run(p, abelian_group)),
        Pass("zeros", ZERO, fold_zeros.run),
        Pass("shared values", SHARED, value_numbering.run),
        Pass("equal unknowns", "equal stages are solved once", equal_unknowns.run),
        Pass("zeros", ZERO, fold_zeros.run),
        Pass("joined flows", joined, lambda p: flows.run(p, scene)),
        Pass("unused values", UNUSED, dead.run),
        Pass("blocks", "stages are solved one after the other", blocks.run),
        Pass("unused values", UNUSED, dead.run),
        Pass("factored maps", FACTORED, factor_linear.run),
        Pass("maps of shared sums", FACTORED, shared_sums.run),
        Pass("zeros", ZERO, fold_zeros.run),
        Pass("shared values", SHARED, value_numbering.run),
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
        Pass("shared values", SHARED, value_numbering.run),
        Pass("Legendre transform", "momenta follow from velocities", lambda p: legendre.run(p, scene)),
        Pass("inverse maps", inverse, opposites.run),
        Pass("fewer unknowns", "the other unknowns determine them", tearing.run),
        Pass("inverse maps", inverse, opposites.run),
        Pass("unused values", UNUSED, dead.run),
        Pass("shared values", SHARED, value_numbering.run),
        Pass("factored maps", FACTORED, factor_linear.run),
        Pass("maps of shared sums", FACTORED, shared_sums.run),
        Pass("rows of products", "q exp(x) is computed without exp(x)", lambda p: functions.rows(p, scene)),
        Pass("functions of ad", one_ad, lambda p: functions.run(p, scene)),
        Pass("residuals", "momenta are compared", lambda p: legendre.residuals(p, scene)),
        Pass("inverse maps", inverse, opposites.run),
        Pass("functions of ad", one_ad, lambda p: functions.run(p, scene)),
        Pass("shared values", SHARED, value_numbering.run),
        Pass("factored maps", FACTORED, factor_linear.run),
        Pass("unused values", UNUSED, dead.run),
        Pass("numbers outside maps", "numbers are multiplied into sums", hoist_scalars.run),
        Pass("shared values", SHARED, value_numbering.run),
        Pass("unused values", UNUSED, dead.run),
        Pass("negatives of sums", "a sum is the negative of another", shared_negatives.run),
    ]
