"""Runge-Kutta-Munthe-Kaas methods with the fewest brackets. ``rkmk`` without ``cutoff`` is compiled in this
form.

The conditions are equal to those of ``rkmk``, but their left-hand sides are computed from the Lie-Butcher
series of the compiled program. Hence the computed order is the order of the program.
"""

from __future__ import annotations

from collections.abc import Mapping

from orderconds.families.reductions import UnseenCut
from orderconds.families.rkmk import MuntheKaasFamily
from orderconds.ring.protocol import Ring
from orderconds.series.bracketed_steps import BracketedSeries
from orderconds.series.brackets import BracketProgram
from orderconds.series.lie_butcher import ForestSeries
from orderconds.tableau.products import Method


class MinimalBrackets(MuntheKaasFamily):
    """A family with one method, given by a program that computes exponents from stage values and brackets.

    >>> from orderconds.ring import QQ
    >>> euler = BracketProgram((), ({},), {("k", 0): QQ.one}, 0, (1,))
    >>> from orderconds.tableau import Tableau, find
    >>> method, family = Tableau.load(find("euler")).method, MinimalBrackets(euler)
    >>> [family.evaluate(method, QQ, family.conditions(n)) for n in (1, 2)]
    [(1,), (0,)]
    """

    def __init__(self, program: BracketProgram) -> None:
        super().__init__(None)
        self.program = program

    def series(self, method: Method, ring: Ring) -> ForestSeries:
        """Return the Lie-Butcher series of the program. ``method``, the tableau of the program, is not
        used."""
        return BracketedSeries(ring, self.program)

    def unseen_cut(self, method: Method, orders: Mapping[str, int]) -> UnseenCut | None:
        """Return None: the program computes arguments that differ from those of RKMK, so no theorem about
        dexpinv applies."""
        return None
