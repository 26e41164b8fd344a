"""Runge-Kutta methods in the coordinates of the ambient space, a vector space that contains the manifold.

A step may leave the manifold. The order is the order of the tableau in the family ``rk``.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar, Self

from orderconds.families.registry import register
from orderconds.families.rk import RungeKuttaFamily
from orderconds.tableau.record import Tableau


@register
class AmbientFamily(RungeKuttaFamily):
    """Runge-Kutta methods in the ambient space. The conditions are those of the family ``rk``.

    >>> [str(condition) for condition in AmbientFamily().conditions(2)]
    ['sum_i b_i c_i = 1/2']
    """

    name = "ambient"
    description = "Runge-Kutta methods in coordinates of the ambient space; a step may leave the manifold."
    illustrates = ()
    implies: ClassVar[Mapping[str, str]] = {"rk": "a vector space is its own ambient space"}
    bounds_others = False
    default_series = False
    low_storage = ()
    keeps_manifold = False

    @classmethod
    def claimable(cls, tableau: Tableau) -> Self | None:
        """Return None. The order in the family ``ambient`` is always equal to the order in the family ``rk``,
        so a tableau file claims only the order in ``rk``."""
        return None

    def implied_order(self, orders: Mapping[str, int]) -> int:
        """Return the order of the method in the family ``rk``, or 0 if the order is unknown.

        ``orders`` maps the labels of families to the orders of the method in these families.
        """
        return orders.get("rk", 0)
