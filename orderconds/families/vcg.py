"""Variational Crouch-Grossman methods: a Butcher tableau on T*G, one exponential for each coefficient.

Equations (3.18), (3.19) of Bogfjellmo and Marthinsen. Order 3 gives the six conditions of their Proposition
3.5.7; the action series gives every order.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orderconds.families import require_nonzero_weights
from orderconds.families.action_family import ActionFamily
from orderconds.families.action_formula import ActionFormula, CrouchGrossmanFormula
from orderconds.ring.protocol import Ring
from orderconds.series.action import ActionSeries, CommutatorFreeSeries, crouch_grossman_rows

if TYPE_CHECKING:
    import numpy as np

    from orderconds.ring.residues import Residues


class VariationalCrouchGrossman(ActionFamily):
    """The family ``vcg`` of tableaux (A, b) with all b_i non-zero.

    >>> [len(VariationalCrouchGrossman().conditions(n)) for n in (1, 2, 3)]
    [1, 1, 6]
    >>> for condition in VariationalCrouchGrossman().conditions(2):
    ...     print(condition.tree, ":", condition)
    o(o) : sum_i b_i c_i = 1/2
    """

    name = "vcg"
    formats = ("rk",)

    def series(self, method: Any, ring: Ring) -> ActionSeries:
        """Return the action series of the tableau ``method.A``, ``method.b``."""
        require_nonzero_weights(self.label(), ring, method.b)
        return CommutatorFreeSeries(ring, crouch_grossman_rows(ring, method.A, method.b))

    def random_series(self, ring: Residues, generator: np.random.Generator, order: int) -> ActionSeries:
        """Return the series of random full tableaux; from order - 1 stages on ranks stand."""
        stages = max(order - 1, 2)
        rows = [[ring.random(generator) for _ in range(stages)] for _ in range(stages + 1)]
        return CommutatorFreeSeries(ring, crouch_grossman_rows(ring, rows[:-1], rows[-1]))

    def formula(self) -> ActionFormula:
        """Return the writer of index sums over a, b, c."""
        return CrouchGrossmanFormula()


def create() -> VariationalCrouchGrossman:
    """Return the family.

    >>> create().label()
    'vcg'
    """
    return VariationalCrouchGrossman()
