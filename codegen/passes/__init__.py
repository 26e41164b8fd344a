"""The passes: one file each, pure functions over programs, run in a fixed order and verified after each.

``optimise`` runs them on a scene: types and single assignment are checked after every pass, and meaning by
interpretation at points where the program must agree with the lowered one to rounding.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

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
from codegen.scene.problem import Problem


@dataclass(frozen=True)
class PassReport:
    """What a pass did: operation counts before and after, and the program after it."""

    name: str
    before: dict[str, int]
    after: dict[str, int]
    program: Program

    @property
    def removed(self) -> dict[str, int]:
        """How many of each operation the pass took out (negative: put in)."""
        names = sorted({*self.before, *self.after})
        change = {n: self.before.get(n, 0) - self.after.get(n, 0) for n in names}
        return {n: k for n, k in change.items() if k}


Step = tuple[str, Callable[[Program], Program]]
"""A pass: its name and what it does."""


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
            self._run("substeps", lambda _: whole)
            self.meaning = Reference(_part(composed), scene)
        for name, step in plain_passes(scene):
            self._run(name, step)

    def plain(self) -> tuple[Program, tuple[PassReport, ...]]:
        """Return the program after the passes that serve every scene."""
        return self.program, tuple(self.reports)

    def framed(self) -> tuple[Program, tuple[PassReport, ...]]:
        """Return the program put into the body frame and its equations made smaller, where that can be.

        Counting operations shows whether it is worth while.
        """
        plain, reports = self.program, list(self.reports)
        for name, step in framed_passes(self.scene):
            self._run(name, step)
        found = self.program, tuple(self.reports)
        self.program, self.reports = plain, reports
        return found

    def _run(self, name: str, step: Callable[[Program], Program]) -> None:
        old, new = self.program, verify(step(self.program))
        if new == old:
            return
        account = self.meaning.differs(new if old.substeps == () else _part(new))
        if account:
            raise IllFormed(f"the pass {name} changed the meaning of {old.name}: {account}")
        self.reports.append(PassReport(name, old.counts(), new.counts(), new))
        self.program = new


def _part(program: Program) -> Program:
    """Return one substep of a composition as a step of its own."""
    return replace(program, substeps=())


def plain_passes(scene: Problem) -> list[Step]:
    """Return the passes that serve every scene, in order."""
    return [
        ("abelian", lambda p: abelian.run(p, scene.group.abelian)),
        ("zeros", fold_zeros.run),
        ("sharing", value_numbering.run),
        ("merging", equal_unknowns.run),
        ("cancellation", fold_zeros.run),
        ("flows", lambda p: flows.run(p, scene)),
        ("dead code", dead.run),
        ("blocks", blocks.run),
        ("dead code", dead.run),
        ("factors", factor_linear.run),
        ("common sums", shared_sums.run),
        ("cancellation", fold_zeros.run),
        ("sharing", value_numbering.run),
        ("fusion", fuse.run),
        ("dead code", dead.run),
        ("blocks", blocks.run),  # what factoring made independent of a block's unknowns leaves it
    ]


def framed_passes(scene: Problem) -> list[Step]:
    """Return the passes that follow where there is a body frame, in order."""
    return [
        ("body frame", lambda p: body_frame.run(p, scene)),
        ("cancellation", fold_zeros.run),
        ("sharing", value_numbering.run),
        ("Legendre transform", lambda p: legendre.run(p, scene)),
        ("opposites", opposites.run),
        ("tearing", tearing.run),
        ("opposites", opposites.run),
        ("dead code", dead.run),
        ("sharing", value_numbering.run),
        ("factors", factor_linear.run),
        ("common sums", shared_sums.run),
        ("rows", lambda p: functions.rows(p, scene)),
        ("functions", lambda p: functions.run(p, scene)),
        ("residuals", lambda p: legendre.residuals(p, scene)),
        ("opposites", opposites.run),
        ("functions", lambda p: functions.run(p, scene)),
        ("sharing", value_numbering.run),
        ("factors", factor_linear.run),
        ("dead code", dead.run),
        ("scalars", hoist_scalars.run),
        ("sharing", value_numbering.run),
        ("dead code", dead.run),
        ("signs", shared_negatives.run),
    ]
