"""How uncertain the coefficients of a tableau are, relative to a floating-point format."""

from __future__ import annotations

from flint import fmpq

from orderconds.ring.balls import Ball, Balls
from orderconds.ring.decimals import endpoints, rational_decimal
from orderconds.tableau.record import Tableau


def uncertainty(tableau: Tableau, bits: int) -> str:
    """Return the largest radius of those coefficients that are less accurate than a format of ``bits`` bits.

    A coefficient counts if its ball is wider than one rounding to ``bits`` bits. The result is a decimal of
    two digits, or an empty text if all coefficients are exact or narrow enough.

    >>> from orderconds.tableau import find
    >>> uncertainty(Tableau.load(find("rk4")), 53)
    ''
    >>> text = 'name = "t"\\nfamily = "rk"\\nA = [[], ["0.5~"]]\\nb = ["0", "1"]'
    >>> uncertainty(Tableau.loads(text), 53)
    '0.10'
    """
    if not isinstance(tableau.ring, Balls):
        return ""
    widest = fmpq(0)

    def visit(x: Ball) -> Ball:
        nonlocal widest
        low, high = endpoints(x.value)
        if high - low > abs(low + high) / 2**bits:
            widest = max(widest, (high - low) / 2)
        return x

    tableau.method.map(visit)
    return rational_decimal(widest, 2) if widest else ""
