"""Replace the doubles in a tableau file by intervals. The caller chooses the width."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction

from orderconds.tableau.doubles import radius
from orderconds.tableau.evaluate import Definition, evaluate
from orderconds.tableau.grammar import Chain, Constant, Expression, Power
from orderconds.tableau.record import Tableau


def with_tolerance(tableau: Tableau, units: float | None) -> Tableau:
    """Return the tableau with a ball (interval) in place of every double x. The ball has the centre x and the
    radius ``units * 2^-53 * max(1, |x|)``. If ``units`` is None, the tableau itself is returned.

    >>> text = 'name = "m"\\nfamily = "rk"\\nA = [["0.1d"]]\\nb = ["1"]'
    >>> wide = with_tolerance(Tableau.loads(text), 2**43)
    >>> wide.ring.text(wide.method.A[0][0])
    '0.10~'
    """
    file = tableau.file
    if units is None or file is None or not tableau.doubles:
        return tableau
    scale = Fraction(units)
    source = file.symbolic
    expressions = {place: _scaled(x, scale) for place, x in source.expressions.items()}
    numbers: Mapping[str, Definition] = {
        name: _scaled(x, scale) if isinstance(x, Constant | Chain | Power) else x
        for name, x in source.numbers.items()
    }
    ring, values = evaluate(expressions, numbers, source.where)
    method, embedded = source.build(values, ring)
    return replace(tableau, ring=ring, method=method, embedded=embedded, proof=None, file=None)


def _scaled(x: Expression, units: Fraction) -> Expression:
    """Replace each double c by the ball (interval) of centre c and radius ``units * 2^-53 * max(1, |c|)``."""
    if isinstance(x, Constant):
        return Constant(x.value, radius(x.value, units)) if x.is_double else x
    if isinstance(x, Chain):
        return Chain(x.operators, tuple(_scaled(y, units) for y in x.operands))
    return Power(_scaled(x.base, units), x.exponent) if isinstance(x, Power) else x
