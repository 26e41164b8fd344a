"""The array and the offset at which each block of a kernel's state is stored."""

from __future__ import annotations

from dataclasses import dataclass

from codegen.ir.kernel import VARIATION, Kernel
from codegen.run.terms import Term, real


@dataclass(frozen=True)
class Place:
    """A block of the state: the entries ``start`` to ``start + size - 1`` of the array named ``array``.

    The whole array has ``whole`` entries.
    """

    array: str
    start: int
    size: int
    whole: int

    @property
    def term(self) -> Term:
        """The entries of the block."""
        # The stopping rule needs the largest entry of a block, so all entries are returned as one array.
        return real(self.array, self.whole).part(self.start, self.size)


def places(kernel: Kernel) -> tuple[Place, ...]:
    """Return the positions of the blocks of a kernel's state.

    If the kernel has a variation (a derivative of the state), the variation is the last field of the state.
    It is stored in the separate array ``vector``.
    """
    # The variation is passed in an array of its own, so it is not counted here.
    whole = sum(len(f.symbols) for f in kernel.state if f.name != VARIATION)
    result: list[Place] = []
    start = 0
    for f in kernel.state:
        n = len(f.symbols)
        result.append(Place("vector", 0, n, n) if f.name == VARIATION else Place("state", start, n, whole))
        # The variation is the last field, so its size does not shift the start of another block.
        start += n
    return tuple(result)
