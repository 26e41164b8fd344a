"""Claims: the orders and properties that a tableau file states for its method."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True)
class OrderClaim:
    """The claim that the method has exactly this order in ``family``. ``cutoff`` is None for a family without
    the option ``cutoff``."""

    family: str
    cutoff: int | None
    order: int

    @property
    def label(self) -> str:
        """The label of the family in reports: ``vcg``, ``rkmk(1)``."""
        return self.family if self.cutoff is None else f"{self.family}({self.cutoff})"


@dataclass(frozen=True)
class Claims:
    """The claims of a tableau file: the orders and the properties of the method. A check compares each claim
    with the computed result."""

    orders: tuple[OrderClaim, ...] = ()
    properties: dict[str, bool] = field(default_factory=dict)

    def order(self, family: str, cutoff: int | None = None) -> int | None:
        """Return the claimed order in a family, or None if the file claims no order in this family."""
        for claim in self.orders:
            if (claim.family, claim.cutoff) == (family, cutoff):
                return claim.order
        return None
