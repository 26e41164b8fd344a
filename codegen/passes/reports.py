"""Reports of the operations that each pass removes, and texts for the header of emitted code."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from codegen.ir.program import Program


@dataclass(frozen=True)
class Pass:
    """A pass over programs.

    ``because`` says why the pass can remove operations. Emitted code contains this text in its header.
    """

    name: str
    because: str
    run: Callable[[Program], Program]


@dataclass(frozen=True)
class PassReport:
    """The program before a pass (``earlier``) and after it (``program``)."""

    name: str
    because: str
    # Whole programs are stored, because ``emit --explain`` prints the program after each pass.
    earlier: Program
    program: Program

    @property
    def before(self) -> dict[str, int]:
        """How often each operation occurs before the pass."""
        return self.earlier.counts()

    @property
    def after(self) -> dict[str, int]:
        """How often each operation occurs after the pass."""
        return self.program.counts()

    @property
    def removed(self) -> dict[str, int]:
        """The number of removed operations of each kind, negative if the pass added operations."""
        before, after = self.before, self.after
        # With sorted names, reports do not depend on the order of the statements.
        change = {n: before.get(n, 0) - after.get(n, 0) for n in sorted({*before, *after})}
        return {n: k for n, k in change.items() if k}

    @property
    def savings(self) -> Counter[str]:
        """The number of removed operations of each kind.

        Each key is a noun, such as ``exponential{s}``, where ``{s}`` marks the plural ending.
        """
        # If the pass adds operations, the difference is negative. The class ``Counter`` omits negative
        # differences.
        return _nouns(self.earlier) - _nouns(self.program)


def summaries(reports: Iterable[PassReport]) -> tuple[str, ...]:
    """Return a text for each reason why passes removed operations, in the order of the passes.

    An example is ``2 brackets: the group is abelian``. Operations that were removed for equal reasons are
    counted together.
    """
    total: dict[str, Counter[str]] = {}
    for report in reports:
        total.setdefault(report.because, Counter()).update(report.savings)
    return tuple(
        f"{', '.join(_counted(noun, n) for noun, n in sorted(saved.items()))}: {because}"
        for because, saved in total.items()
        if saved
    )


def _counted(noun: str, n: int) -> str:
    return f"{n} {noun.format(s='' if n == 1 else 's')}"


def _nouns(program: Program) -> Counter[str]:
    """Return the number of operations of each kind. The keys are the attributes ``noun`` of the operations.

    Operations that cost nothing are omitted.
    """
    return Counter(a.operation.noun for a in program.assigns() if a.operation.noun)
