"""Variational Runge-Kutta-Munthe-Kaas methods with dexpinv cut after the power r: ``vrkmk(r)``.

Equation (3.16) of Bogfjellmo and Marthinsen. The order is computed from the method's own series; it comes out
as min(p, R + 2), p the order as symplectic partitioned method and R as for RKMK, sharper than Theorem 3.5.3:
the tests compute R + 2 from the series.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orderconds.errors import InputError
from orderconds.families import require_nonzero_weights
from orderconds.families.action_family import ActionFamily
from orderconds.families.action_formula import ActionFormula, MuntheKaasFormula
from orderconds.ring.protocol import Ring
from orderconds.series.action import ActionSeries
from orderconds.series.action_lie import MuntheKaasActionSeries

if TYPE_CHECKING:
    import numpy as np

    from orderconds.ring.residues import Residues


class VariationalMuntheKaas(ActionFamily):
    """The family ``vrkmk(r)`` of tableaux (A, b) with all b_i non-zero.

    >>> [len(VariationalMuntheKaas(cutoff=2).conditions(n)) for n in (1, 2, 3, 4)]
    [1, 1, 3, 8]
    """

    name = "vrkmk"
    formats: tuple[str, ...] = ("rk",)

    def __init__(self, cutoff: int | None = None) -> None:
        self.cutoff = cutoff

    def label(self) -> str:
        """Return ``vrkmk(r)``, or ``vrkmk`` when dexpinv is not cut."""
        return self.name if self.cutoff is None else f"{self.name}({self.cutoff})"

    def series(self, method: Any, ring: Ring) -> ActionSeries:
        """Return the action series of the tableau ``method.A``, ``method.b``."""
        require_nonzero_weights(self.label(), ring, method.b)
        return MuntheKaasActionSeries(ring, method.A, method.b, self.cutoff)

    def random_series(self, ring: Residues, generator: np.random.Generator, order: int) -> ActionSeries:
        """Return the series of random full tableaux."""
        stages = max(order - 1, 2)
        rows = [[ring.random(generator) for _ in range(stages)] for _ in range(stages + 1)]
        return MuntheKaasActionSeries(ring, rows[:-1], rows[-1], self.cutoff)

    def formula(self) -> ActionFormula:
        """Return the writer of index sums over a, b, c."""
        return MuntheKaasFormula(self.cutoff)


def create(cutoff: int | None = None) -> VariationalMuntheKaas:
    """Return the family with dexpinv cut after the power ``cutoff``, or uncut.

    Raises :class:`~orderconds.errors.InputError` for a negative cutoff.

    >>> create(cutoff=2).label(), create().label()
    ('vrkmk(2)', 'vrkmk')
    """
    if cutoff is not None and not (isinstance(cutoff, int) and cutoff >= 0):
        raise InputError(f"cutoff {cutoff!r}", where="family vrkmk", expected="an integer >= 0")
    return VariationalMuntheKaas(cutoff)
