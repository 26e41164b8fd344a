"""The position of each block of the state: its array, and the index of its first entry in this array."""

from __future__ import annotations

from dataclasses import dataclass

from codegen.ir.kernel import VARIATION, Kernel
from codegen.run.terms import Term, real


@dataclass(frozen=True)
class Place:
    """The position of a block of the state, for example of the momentum.

    The block consists of the entries ``start`` to ``start + size - 1`` of the array named ``array``. This
    array has ``whole`` entries.
    """

    array: str
    start: int
    size: int
    whole: int

    @property
    def term(self) -> Term:
        """The term for the block, which is a part of the array called ``array``."""
        # The stopping rule computes the largest entry of a block, so it needs the block as one array.
        return real(self.array, self.whole).part(self.start, self.size)


def places(kernel: Kernel) -> tuple[Place, ...]:
    """Return the position of each block of a kernel's state.

    If the kernel has a variation (a tangent vector at the state), the variation is the last block. It is
    stored in the separate array ``vector``.
    """
    # The variation is not in the array of the state, so it is not counted here.
    whole = sum(len(f.symbols) for f in kernel.state if f.name != VARIATION)
    result: list[Place] = []
    start = 0
    for f in kernel.state:
        n = len(f.symbols)
        result.append(Place("vector", 0, n, n) if f.name == VARIATION else Place("state", start, n, whole))
        # After the variation, ``start`` is not read again, because the variation is the last block.
        start += n
    return tuple(result)
