"""Variational Runge-Kutta-Munthe-Kaas methods ``vrkmk(r)``. The series dexpinv is the inverse of the
differential of exp. The methods truncate this series after the term with ad^r.

Equation (3.16) of Bogfjellmo and Marthinsen defines the method without truncation. For even r >= 2, the
Bernoulli number B_(r+1) is zero, so r and r + 1 define the same method.

Let p be the order of the symplectic partitioned Runge-Kutta method with the same tableau. Let R = r + 1 for
even r >= 2, and R = r for all other r. The order of the method of ``vrkmk(r)`` is min(p, R + 2). For some r,
the order is larger than the lower bound in Theorem 3.5.3 of Bogfjellmo and Marthinsen.
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
    """The family ``vrkmk(r)`` of variational Runge-Kutta-Munthe-Kaas methods. A tableau (A, b) without zero
    weights defines a method.

    >>> [len(VariationalMuntheKaas(cutoff=2).conditions(n)) for n in (1, 2, 3, 4)]
    [1, 1, 3, 8]
    """

    name = "vrkmk"
    description = (
        "Variational Runge-Kutta-Munthe-Kaas methods: vrkmk(r) truncates dexpinv after the power r of ad."
    )
    formats = ("rk",)
    implies: ClassVar[Mapping[str, str]] = {
        "sprk": "a vector space is a Lie group; on a vector space, a VRKMK method is an SPRK method"
    }
    abelian: ClassVar[str | None] = "sprk"
    unknowns: ClassVar[str | None] = "rk"

    def series(self, method: Method, ring: Ring) -> ActionSeries:
        """Return the action series of a tableau (A, b)."""
        tableau = expect(method, RungeKutta)
        require_nonzero_weights(self.label(), ring, tableau.b)
        return MuntheKaasActionSeries(ring, tableau.A, tableau.b, self.cutoff)

    def longest_word(self, key: Key) -> int:
        """The coefficient of the action tree ``key`` is computed from coefficients of words, whose letters
        are smaller trees. Return the length of the longest of these words."""
        assert isinstance(key, Velocity)
        return longest_word(key)

    def first_unmet(self, order: int) -> OrderCondition | None:
        """Return the condition of the action tree o(o|L(o ... o)) with ``order`` vertices. If dexpinv is not
        truncated or ``order`` < 3, return None.

        Let r be ``self.cutoff``, and let p be the highest order of a method of ``vrkmk(r)``: p is r + 3 for
        even r >= 2, and r + 2 for all other r. No method has order p + 1, because the condition that is
        returned for ``order`` = p + 1 contradicts the other conditions of orders 1, ..., p + 1.
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
        """Return the object that writes the conditions as formulas. The formulas are sums over indices and
        contain the coefficients a, b and c of the method."""
        return MuntheKaasFormula(self.cutoff)
