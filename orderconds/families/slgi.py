"""Symplectic Lie group integrators (H. Marthinsen, *On symplectic integration in Lie groups and manifolds*,
PhD thesis, NTNU Trondheim, 2014, Section 2.5).

The methods are those of the family ``vrkmk(0)``: the variational Runge-Kutta-Munthe-Kaas methods in which the
identity map replaces dexpinv, the inverse of the differential of exp. Hence a step computes no brackets, and
the order is at most two.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Self

from orderconds.families.base import Family
from orderconds.families.registry import register
from orderconds.families.vrkmk import VariationalMuntheKaas
from orderconds.tableau.claims import OrderClaim
from orderconds.tableau.record import Tableau


@register
class SymplecticLieGroupFamily(VariationalMuntheKaas):
    """Symplectic Lie group integrators, given by tableaux (A, b) with non-zero weights. The conditions are
    those of the family ``vrkmk(0)``.

    >>> [len(SymplecticLieGroupFamily().conditions(n)) for n in (1, 2)]
    [1, 1]
    """

    name = "slgi"
    description = (
        "Symplectic Lie group integrators: variational Runge-Kutta-Munthe-Kaas methods without brackets. The "
        "methods with one stage are theta-methods."
    )
    takes_cutoff = False

    def __init__(self) -> None:
        super().__init__(0)

    def label(self) -> str:
        """Return the label ``slgi``."""
        return self.name

    def claim(self, order: int) -> OrderClaim:
        """Return the claim that a method has the order ``order`` in the family ``slgi``."""
        return OrderClaim(self.name, None, order)

    @classmethod
    def claimable(cls, tableau: Tableau) -> Self | None:
        """Return None, because tableau files do not state the order in the family ``slgi``."""
        return None

    def claimed_variants(self) -> tuple[Family, ...]:
        """Return a tuple that contains only this family, because the family has no variants."""
        return (self,)

    def implied_order(self, orders: Mapping[str, int]) -> int:
        """For a method, return a lower bound of the order in this family.

        ``orders`` maps the labels of other families to the orders of the method in these families. The order
        in the family ``vrkmk(0)`` is a lower bound.
        """
        return max(super().implied_order(orders), orders.get("vrkmk(0)", 0))
