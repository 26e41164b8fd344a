"""Variational Runge-Kutta-Munthe-Kaas methods with dexpinv truncated after the power r: ``vrkmk(r)``. Here
dexpinv is the inverse of the differential of exp, a power series in ad.

Equation (3.16) of Bogfjellmo and Marthinsen defines the method without truncation. The order is min(p, R +
2), where p is the order as a symplectic partitioned Runge-Kutta method. Here R = r if r is 0 or odd, and R =
r + 1 if r >= 2 is even. For some r this order is higher than the bound in Theorem 3.5.3 of Bogfjellmo and
Marthinsen.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, ClassVar

from orderconds.conditions import OrderCondition
from orderconds.families.action_family import ActionFamily, longest_word
from orderconds.families.action_formula import ActionFormula, MuntheKaasFormula
from orderconds.families.base import Key, expect, require_nonzero_weights
from orderconds.families.dexpinv_cut import DexpinvCut
from orderconds.families.registry import register
from orderconds.ring.protocol import Ring
from orderconds.series.action import ActionSeries
from orderconds.series.action_lie import MuntheKaasActionSeries
from orderconds.series.action_trees import Velocity, transport, velocity
from orderconds.tableau.methods import RungeKutta
from orderconds.tableau.products import Method

if TYPE_CHECKING:
    import numpy as np

    from orderconds.ring.protocol import RandomRing


@register
class VariationalMuntheKaas(DexpinvCut, ActionFamily):
    """The family ``vrkmk(r)``: variational Runge-Kutta-Munthe-Kaas methods, given by tableaux (A, b) with
    non-zero weights.

    >>> [len(VariationalMuntheKaas(cutoff=2).conditions(n)) for n in (1, 2, 3, 4)]
    [1, 1, 3, 8]
    """

    name = "vrkmk"
    description = (
        "Variational Runge-Kutta-Munthe-Kaas methods with dexpinv truncated after the power r: vrkmk(r)."
    )
    formats = ("rk",)
    implies: ClassVar[Mapping[str, str]] = {"sprk": "a vector space is a Lie group under addition"}
    abelian: ClassVar[str | None] = "sprk"
    unknowns: ClassVar[str | None] = "rk"

    def series(self, method: Method, ring: Ring) -> ActionSeries:
        """Return the action series of a tableau (A, b)."""
        tableau = expect(method, RungeKutta)
        require_nonzero_weights(self.label(), ring, tableau.b)
        return MuntheKaasActionSeries(ring, tableau.A, tableau.b, self.cutoff)

    def longest_word(self, key: Key) -> int:
        """Return the length of the longest word that contributes to the coefficient of an action tree."""
        assert isinstance(key, Velocity)
        return longest_word(key)

    def first_unmet(self, order: int) -> OrderCondition | None:
        """Return one condition of the given order, or None if dexpinv is not truncated or ``order`` < 3.

        The condition belongs to the action tree ``o(o|L(o ... o))``, where L has ``order`` - 2 branches. The
        module docstring defines R. If ``order`` is R + 3, no method with truncated dexpinv satisfies this
        condition. The truncation of dexpinv changes no condition of an order below R + 3.
        """
        if self.cutoff is None or order < 3:
            return None
        leaf = velocity()
        return self.condition(velocity((leaf,), (transport((leaf,) * (order - 2)),)))

    def random_series(self, ring: RandomRing, generator: np.random.Generator, order: int) -> ActionSeries:
        """Return the action series of a tableau (A, b) with random coefficients in ``ring``."""
        stages = max(order - 1, 2)
        rows = [[ring.random(generator) for _ in range(stages)] for _ in range(stages + 1)]
        return MuntheKaasActionSeries(ring, rows[:-1], rows[-1], self.cutoff)

    def formula(self) -> ActionFormula:
        """Return the object that constructs the index sums of the conditions. The coefficients in these sums
        are a, b and c."""
        return MuntheKaasFormula(self.cutoff)
