"""Where the blocks of a kernel's state lie, in which arrays."""

from __future__ import annotations

from dataclasses import dataclass

from codegen.ir.kernel import VARIATION, Kernel
from codegen.run.terms import Term, real


@dataclass(frozen=True)
class Place:
    """A block of ``size`` numbers in an array of ``whole`` numbers, from ``start`` on."""

    array: str
    start: int
    size: int
    whole: int

    @property
    def term(self) -> Term:
        """The entries of the block."""
        return real(self.array, self.whole).part(self.start, self.size)


def places(kernel: Kernel) -> tuple[Place, ...]:
    """Return where the blocks of a kernel's state lie.

    A kernel that carries a variation along has it as its last field, and in an array of its own.
    """
    whole = sum(len(f.symbols) for f in kernel.state if f.name != VARIATION)
    result: list[Place] = []
    start = 0
    for f in kernel.state:
        n = len(f.symbols)
        result.append(Place("vector", 0, n, n) if f.name == VARIATION else Place("state", start, n, whole))
        start += n
    return tuple(result)
