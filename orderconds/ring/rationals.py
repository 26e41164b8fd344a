"""The field of rational numbers. Elements have python-flint's type ``fmpq``, because a wrapper would make
operations slower."""

from __future__ import annotations

from flint import arb, fmpq

from orderconds.ring.decimals import rational_decimal, rational_float
from orderconds.ring.precision import precision


class Rationals:
    """The field Q. The only instance of this class is :data:`QQ`.

    >>> QQ.text(QQ.rational(1, 6) + QQ.rational(1, 3) * 2)
    '5/6'
    """

    name = "QQ"
    zero = fmpq(0)
    one = fmpq(1)

    def __repr__(self) -> str:
        return self.name

    def rational(self, p: int, q: int = 1) -> fmpq:
        """Return p/q."""
        return fmpq(p, q)

    def is_zero(self, x: fmpq) -> bool:
        """Return True if x = 0."""
        return bool(x == 0)

    def text(self, x: fmpq) -> str:
        """Return x as ``p`` or ``p/q``."""
        return str(x)

    def key(self, x: fmpq) -> tuple[int, int]:
        """Return (numerator, denominator) in lowest terms."""
        return int(x.p), int(x.q)

    def approximate(self, x: fmpq, digits: int = 20) -> str:
        """Return x as a decimal, correctly rounded to ``digits`` significant digits. If the decimal is equal
        to x, trailing zeros are removed."""
        return rational_decimal(x, digits)

    def nearest_float(self, x: fmpq) -> float:
        """Return the double nearest to x."""
        return rational_float(x)

    def ball(self, x: fmpq, bits: int) -> arb:
        """Return a ball around x with relative radius about 2^-bits."""
        with precision(bits):
            return arb(x)

    def sign(self, x: fmpq) -> int:
        """Return the sign of x: -1, 0 or 1."""
        return int(x > 0) - int(x < 0)


QQ = Rationals()
