"""Claims: orders and properties of a method, as stated in its tableau file."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True)
class OrderClaim:
    """The claim that the order of a method in the family ``family`` is ``order``, and not higher. If the
    family truncates a power series in ad, ``cutoff`` is the highest power in the truncated series. For all
    other families, ``cutoff`` is None."""

    family: str
    cutoff: int | None
    order: int

    @property
    def label(self) -> str:
        """The label of the family in reports. For example, ``rkmk(1)`` denotes the family ``rkmk`` with the
        option ``cutoff`` = 1."""
        return self.family if self.cutoff is None else f"{self.family}({self.cutoff})"


@dataclass(frozen=True)
class Claims:
    """The orders and properties that a tableau file claims. The command ``check`` compares each claim with
    the computed result."""

    orders: tuple[OrderClaim, ...] = ()
    properties: dict[str, bool] = field(default_factory=dict)

    def order(self, family: str, cutoff: int | None = None) -> int | None:
        """Return the claimed order in a family, or None if the file claims no order in this family. For
        ``rkmk(1)``, the family is ``rkmk`` and the cutoff is 1."""
        for claim in self.orders:
            if (claim.family, claim.cutoff) == (family, cutoff):
                return claim.order
        return None
