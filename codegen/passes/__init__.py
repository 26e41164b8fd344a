"""The passes: one file each, pure functions over programs, run in a fixed order and verified after each.

``optimise`` runs them on a scene: types and single assignment are checked after every pass, and meaning by
interpretation at points where the program must agree with the lowered one to rounding.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from codegen.ir.program import Program
from codegen.ir.verify import IllFormed, verify
from codegen.passes import (
    abelian,
    blocks,
    dead,
    factor,
    flows,
    frame,
    functions,
    fuse,
    legendre,
    merge,
    opposites,
    scalars,
    shared_sums,
    sharing,
    tearing,
    zeros,
)
from codegen.passes.meaning import Reference
from codegen.setting import Setting


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


def optimise(
    program: Program, scene: Setting, *, framed: bool = False
) -> tuple[Program, tuple[PassReport, ...]]:
    """Return the program after all passes, and a report of each that changed something.

    ``scene`` is the setting that the program was lowered in. With ``framed`` the program is then put into the
    body frame and its equations made smaller, where the scene allows that; counting operations shows whether
    it is worth while. A pass that breaks the program raises
    :class:`codegen.ir.verify.IllFormed`: a fault of this compiler.
    """
    steps: list[tuple[str, Callable[[Program], Program]]] = [
        ("abelian", lambda p: abelian.run(p, scene.group.abelian)),
        ("zeros", zeros.run),
        ("sharing", sharing.run),
        ("merging", merge.run),
        ("cancellation", zeros.run),
        ("flows", lambda p: flows.run(p, scene)),
        ("dead code", dead.run),
        ("blocks", blocks.run),
        ("dead code", dead.run),
        ("factors", factor.run),
        ("common sums", shared_sums.run),
        ("cancellation", zeros.run),
        ("sharing", sharing.run),
        ("fusion", fuse.run),
        ("dead code", dead.run),
        ("blocks", blocks.run),  # what factoring made independent of a block's unknowns leaves it
    ]
    if framed:
        steps += [
            ("body frame", lambda p: frame.run(p, scene)),
            ("cancellation", zeros.run),
            ("sharing", sharing.run),
            ("Legendre transform", lambda p: legendre.run(p, scene)),
            ("opposites", opposites.run),
            ("tearing", tearing.run),
            ("opposites", opposites.run),
            ("dead code", dead.run),
            ("sharing", sharing.run),
            ("factors", factor.run),
            ("common sums", shared_sums.run),
            ("rows", lambda p: functions.rows(p, scene)),
            ("functions", lambda p: functions.run(p, scene)),
            ("residuals", lambda p: legendre.residuals(p, scene)),
            ("opposites", opposites.run),
            ("functions", lambda p: functions.run(p, scene)),
            ("sharing", sharing.run),
            ("factors", factor.run),
            ("dead code", dead.run),
            ("scalars", scalars.run),
            ("sharing", sharing.run),
            ("dead code", dead.run),
        ]
    reports: list[PassReport] = []
    meaning = Reference(program, scene)
    for name, step in steps:
        new = verify(step(program))
        if new == program:
            continue
        account = meaning.differs(new)
        if account:
            raise IllFormed(f"the pass {name} changed the meaning of {program.name}: {account}")
        reports.append(PassReport(name, program.counts(), new.counts(), new))
        program = new
    return program, tuple(reports)
