"""Control of flint's working precision, a global variable of the process.

The project changes the working precision only in blocks ``with precision(bits)``.
"""

from __future__ import annotations

from types import TracebackType

from flint import ctx


class precision:  # noqa: N801 - a lower-case name, because the class is used as ``with precision(200):``
    """A context manager that sets flint's working precision to ``bits`` bits in a ``with`` block.

    >>> from flint import arb
    >>> with precision(200):
    ...     third = arb(1) / 3
    >>> third.rel_accuracy_bits() > 190
    True
    """

    __slots__ = ("before", "bits")

    def __init__(self, bits: int) -> None:
        self.bits = bits

    def __enter__(self) -> None:
        self.before = ctx.prec
        ctx.prec = self.bits

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        ctx.prec = self.before


def working_bits() -> int:
    """Return the current working precision of flint, in bits.

    >>> with precision(99):
    ...     working_bits()
    99
    """
    return int(ctx.prec)
