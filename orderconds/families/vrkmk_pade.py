"""Variational Runge-Kutta-Munthe-Kaas methods ``vrkmk_pade(r)``. The methods truncate the series of dexp and
invert the result.

Let xi_i be the velocity of stage i, and let h be the step size. Let dexp^(r) be the series of dexp up to the
power r of ad. Two equations define the exponent X_i of stage i and an auxiliary vector v_i:
X_i = h sum_j a_ij v_j and dexp^(r)(X_i) v_i = xi_i (section 3.4.1 of Marthinsen's thesis).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Self

from orderconds.families.action_formula import ActionFormula, PadeFormula
from orderconds.families.base import Family, expect, require_nonzero_weights
from orderconds.families.reductions import UnseenCut
from orderconds.families.registry import register
from orderconds.families.vrkmk import VariationalMuntheKaas
from orderconds.ring.protocol import Ring
from orderconds.series.action import ActionSeries
from orderconds.series.action_lie import PadeActionSeries
from orderconds.tableau.methods import RungeKutta
from orderconds.tableau.products import Method
from orderconds.tableau.record import Tableau

if TYPE_CHECKING:
    import numpy as np

    from orderconds.ring.protocol import RandomRing


@register
class VariationalMuntheKaasPade(VariationalMuntheKaas):
    """The family ``vrkmk_pade(r)``. A tableau (A, b) in which no weight b_i is zero defines a method. The
    option ``cutoff`` is r, the last power of ad in the series of dexp.

    If ``cutoff`` is None, the series of dexp is not truncated. In this case the family contains the same
    methods as the family ``vrkmk`` with ``cutoff`` None.

    >>> from orderconds.tableau import Tableau, find
    >>> gauss = Tableau.load(find("gauss1"))
    >>> family = VariationalMuntheKaasPade(1)
    >>> [str(x) for x in family.evaluate(gauss.method, gauss.ring, family.conditions(2))]
    ['1/2']
    """

    name = "vrkmk_pade"
    description = (
        "Variational Runge-Kutta-Munthe-Kaas methods: vrkmk_pade(r) truncates the series of dexp "
        "after the power r of ad and inverts the result."
    )

    def series(self, method: Method, ring: Ring) -> ActionSeries:
        """Return the action series of a tableau (A, b)."""
        if self.cutoff is None:
            return super().series(method, ring)
        tableau = expect(method, RungeKutta)
        require_nonzero_weights(self.label(), ring, tableau.b)
        return PadeActionSeries(ring, tableau.A, tableau.b, self.cutoff)

    def random_series(self, ring: RandomRing, generator: np.random.Generator, order: int) -> ActionSeries:
        """Return the action series of a tableau (A, b) with random coefficients in ``ring``."""
        if self.cutoff is None:
            return super().random_series(ring, generator, order)
        stages = max(order - 1, 2)
        rows = [[ring.random(generator) for _ in range(stages)] for _ in range(stages + 1)]
        return PadeActionSeries(ring, rows[:-1], rows[-1], self.cutoff)

    def formula(self) -> ActionFormula:
        """Return the object that writes the conditions as formulas. The formulas are sums over indices and
        contain the coefficients a, b and c of the method."""
        return super().formula() if self.cutoff is None else PadeFormula(self.cutoff)

    @classmethod
    def claimable(cls, tableau: Tableau) -> Self | None:
        """Return None. No tableau file claims an order in the family ``vrkmk_pade``."""
        return None

    def claimed_variants(self) -> tuple[Family, ...]:
        """Return this family alone, without variants for other values of ``cutoff``."""
        return (self,)

    def implied_order(self, orders: Mapping[str, int]) -> int:
        """Return a lower bound of the order that a method has in this family.

        ``orders`` maps the labels of other families to the orders of the method in these families. The
        conditions of orders 1 and 2 are the same as in the family ``rk``.
        """
        return min(2, orders.get("rk", 0))

    def unseen_cut(self, method: Method, orders: Mapping[str, int]) -> UnseenCut | None:
        """Return None. For this family, no :class:`UnseenCut` is known."""
        return None
