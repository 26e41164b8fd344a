"""Runge-Kutta-Munthe-Kaas methods written with few brackets, as compiled for ``rkmk`` without a cut-off.

The conditions are those of ``rkmk``; the left-hand sides are values of the very program that was written,
from its own Lie-Butcher series. So the order of what is compiled is computed, not taken from the uncut
method.
"""

from __future__ import annotations

from typing import Any

from orderconds.families.rkmk import MuntheKaasFamily
from orderconds.ring.protocol import Ring
from orderconds.series.bracketed_steps import BracketedSeries
from orderconds.series.brackets import BracketProgram


class FewestBrackets(MuntheKaasFamily):
    """The family that has one member: a program of arguments and brackets.

    >>> from orderconds.ring import QQ
    >>> euler = BracketProgram((), ({},), {("k", 0): QQ.one}, 0, (1,))
    >>> [FewestBrackets(euler).evaluate(None, QQ, FewestBrackets(euler).conditions(n)) for n in (1, 2)]
    [(1,), (0,)]
    """

    def __init__(self, program: BracketProgram) -> None:
        super().__init__(None)
        self.program = program

    def series(self, method: Any, ring: Ring) -> BracketedSeries:  # type: ignore[override]
        """Return the series of the program; ``method``, the tableau it was made from, is not read again."""
        return BracketedSeries(ring, self.program)
