"""The passes: one file each, pure functions over programs, run in a fixed order and verified after each.

``optimise`` runs them on a scene: types and single assignment are checked after every pass, and meaning by
interpretation at points where the program must agree with the lowered one to rounding.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from codegen.ir.program import Program
from codegen.ir.verify import IllFormed, verify
from codegen.passes import abelian, blocks, dead, factor, flows, fuse, merge, sharing, zeros
from codegen.passes.meaning import Reference
from codegen.scene import Setting


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


def optimise(program: Program, scene: Setting) -> tuple[Program, tuple[PassReport, ...]]:
    """Return the program after all passes, and a report of each that changed something.

    ``scene`` is the setting that the program was lowered in. A pass that breaks the program raises
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
        ("cancellation", zeros.run),
        ("sharing", sharing.run),
        ("fusion", fuse.run),
        ("dead code", dead.run),
        ("blocks", blocks.run),  # what factoring made independent of a block's unknowns leaves it
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
