"""VRKMK with the inverse of dexp cut off in place of dexp^{-1} cut off: ``vrkmk_pade(r)``, for the compiler.

The conditions are those of every variational family; the left-hand sides come from the method's own action
series. The index sums are not spelled out.
"""

from __future__ import annotations

from typing import Any

from orderconds.families import require_nonzero_weights
from orderconds.families.vrkmk import VariationalMuntheKaas
from orderconds.ring.protocol import Ring
from orderconds.series.action_lie import MuntheKaasActionSeries, PadeActionSeries


class VariationalMuntheKaasPade(VariationalMuntheKaas):
    """The family of tableaux (A, b), all b_i non-zero, with dexp_(r),X_i v_i = xi_i (thesis section 3.4.1).

    >>> from orderconds.tableau import Tableau, find
    >>> gauss = Tableau.load(find("gauss1"))
    >>> family = VariationalMuntheKaasPade(1)
    >>> [str(x) for x in family.evaluate(gauss.method, gauss.ring, family.conditions(2))]
    ['1/2']
    """

    name = "vrkmk_pade"

    def __init__(self, cutoff: int) -> None:
        super().__init__(cutoff)

    def series(self, method: Any, ring: Ring) -> MuntheKaasActionSeries:
        """Return the action series of the tableau ``method.A``, ``method.b``."""
        require_nonzero_weights(self.label(), ring, method.b)
        return PadeActionSeries(ring, method.A, method.b, self.cutoff)
