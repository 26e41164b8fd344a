"""The position of each block of the state: its array, and the index of its first entry in this array."""

from __future__ import annotations

from dataclasses import dataclass

from codegen.ir.kernel import VARIATION, Kernel
from codegen.run.terms import Term, real


@dataclass(frozen=True)
class Place:
    """The position of one block (such as the momentum) in the state.

    The block consists of the entries ``start`` to ``start + size - 1`` of the array named ``array``. This
    array has ``whole`` entries.
    """

    array: str
    start: int
    size: int
    whole: int

    @property
    def term(self) -> Term:
        """The entries of the block, as a slice of the array."""
        # The array may contain other blocks, too. The stopping rule needs the largest absolute value in this
        # block, so the slice leaves out the other blocks.
        return real(self.array, self.whole).part(self.start, self.size)


def places(kernel: Kernel) -> tuple[Place, ...]:
    """Return the position of each block of a kernel's state.

    If the state has a variation (a tangent vector), the variation is the last block. The emitted code stores
    the variation in the array ``vector``, and all other blocks in the array ``state``.
    """
    # ``whole`` is the length of the emitted array ``state``. The variation in ``kernel.state`` is not
    # counted, because the emitted code stores the variation in another array.
    whole = sum(len(f.symbols) for f in kernel.state if f.name != VARIATION)
    result: list[Place] = []
    start = 0
    for f in kernel.state:
        n = len(f.symbols)
        result.append(Place("vector", 0, n, n) if f.name == VARIATION else Place("state", start, n, whole))
        start += n
    return tuple(result)
