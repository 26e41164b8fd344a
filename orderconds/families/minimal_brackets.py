"""Runge-Kutta-Munthe-Kaas methods, rewritten as programs with few brackets.

The conditions of ``rkmk`` are evaluated with the Lie-Butcher series of these programs.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from operator import attrgetter

from orderconds.families.reductions import UnseenCut
from orderconds.families.rkmk import MuntheKaasFamily
from orderconds.ring.balls import Enclosures
from orderconds.ring.protocol import Element, Ring
from orderconds.series.bracketed_steps import BracketedSeries
from orderconds.series.brackets import BracketProgram, Row
from orderconds.series.lie_butcher import ForestSeries
from orderconds.tableau.products import Method


class MinimalBrackets(MuntheKaasFamily):
    """A variant of the family ``rkmk`` that contains only one method. This method computes few brackets. The
    argument ``program`` contains the exponents of all stages as linear combinations of stage values and
    brackets.

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
        """Return the Lie-Butcher series of one step of :attr:`program`. The argument ``method`` is not
        used."""
        # ``Enclosures`` cannot compute with ``Ball`` objects, so each coefficient x is replaced by x.value.
        inner = self.converted(attrgetter("value")) if isinstance(ring, Enclosures) else self
        return BracketedSeries(ring, inner.program)

    def converted(self, convert: Callable[[Element], Element]) -> MinimalBrackets:
        """Return a copy of this family. Each coefficient x of :attr:`program` is replaced by
        ``convert(x)``."""

        def row(given: Row) -> Row:
            return {name: convert(x) for name, x in given.items()}

        program = self.program
        return MinimalBrackets(
            replace(
                program,
                brackets=tuple((row(x), row(y)) for x, y in program.brackets),
                stages=tuple(map(row, program.stages)),
                update=row(program.update),
            )
        )

    def unseen_cut(self, method: Method, orders: Mapping[str, int]) -> UnseenCut | None:
        """An :class:`UnseenCut` tests whether a truncation of dexpinv changes a condition. Return None,
        because :attr:`program` does not contain the series of dexpinv."""
        return None
