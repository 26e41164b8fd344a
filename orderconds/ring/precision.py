"""The one place that touches flint's working precision, which is global to the process.

All other modules set the precision through this one, which restores the caller's precision afterwards. So two
rings of different precision, or a user's own use of python-flint, do not affect each other.
"""

from __future__ import annotations

from types import TracebackType

from flint import ctx


class precision:  # noqa: N801 - reads as the statement it is: with precision(200): ...
    """Run a block with ``bits`` of working precision for balls, then restore the old precision.

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
    """Return the current working precision of balls.

    >>> with precision(99):
    ...     working_bits()
    99
    """
    return int(ctx.prec)
