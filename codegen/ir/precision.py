"""The floating-point formats of emitted code, and how constants are rounded and printed in each format.

>>> SINGLE.text(SINGLE.round(Number.rational(1, 3))), DOUBLE.text(DOUBLE.round(Number.rational(1, 3)))
('0.33333334', '0.3333333333333333')
"""

from __future__ import annotations

import math
import struct
from dataclasses import dataclass
from fractions import Fraction

from codegen.ir.kernel import UNIT
from codegen.ir.number import Number
from orderconds.errors import InputError, UnknownName

SUBNORMAL = {24: -149, 53: -1074}
"""The binary exponent of the smallest positive number of a format. The key is the number of bits of the
significand.
"""


@dataclass(frozen=True)
class Precision:
    """A binary floating-point format of IEEE 754.

    ``bits`` is the number of bits of the significand. ``suffix`` is appended to constants and to names of
    mathematical functions in C: for ``float``, ``sin`` becomes ``sinf``.
    """

    name: str
    bits: int
    c_type: str
    suffix: str
    largest: float

    @property
    def unit(self) -> float:
        """The unit roundoff: half the distance from 1 to the next larger number of the format."""
        return math.ldexp(1.0, -self.bits)

    @property
    def digits(self) -> int:
        """The smallest number of significant decimal digits that distinguishes all numbers of the format."""
        return 1 + math.ceil(self.bits * math.log10(2))

    def scaled(self, tolerance: float) -> float:
        """Return ``tolerance`` times u/v. Here u is the unit roundoff of this format, and v is the unit
        roundoff of doubles.

        >>> SINGLE.scaled(2.0**-44) == 2.0**-15
        True
        """
        # Unit roundoffs are powers of two, so the quotient is exact.
        return tolerance * (self.unit / UNIT)

    def round(self, value: Number | Fraction | float) -> float:
        """Return the nearest number of the format. InputError is raised if the value is too large."""
        rounded = _double(value) if self.bits == 53 else _nearest(value, self.bits)
        # This condition is also true if ``rounded`` is NaN.
        if not abs(rounded) <= self.largest:
            text = value.text() if isinstance(value, Number) else str(value)
            raise InputError(
                f"the constant {text} is too large for the type {self.c_type}",
                expected=f"an absolute value of at most {self.largest:.3g}",
            )
        return rounded

    def text(self, x: float) -> str:
        """Return the shortest decimal text from which a compiler obtains exactly the number ``x``."""
        # Python's ``repr`` of a float is the shortest text that is converted back to the same double.
        if self.bits == 53:
            return repr(x)
        # For single precision, the loop tries texts with 1 digit, 2 digits, and so on.
        for digits in range(1, self.digits + 1):
            # ``struct.pack`` rounds its argument to single precision.
            shorter = repr(float(f"{x:.{digits}g}"))
            if struct.pack("f", float(shorter)) == struct.pack("f", x):
                return shorter
        raise AssertionError(x)  # The loop always finds a text, because ``self.digits`` digits suffice.


def _double(value: Number | Fraction | float) -> float:
    try:
        return float(value)
    except OverflowError:
        # The caller :meth:`Precision.round` raises InputError for an infinity.
        return math.inf


def _nearest(value: Number | Fraction | float, bits: int) -> float:
    """Return the nearest number with ``bits`` significant bits. Ties are rounded to even."""
    if isinstance(value, Number):
        rational = value.is_rational
        # A decimal approximation with 40 digits replaces a number that is not rational.
        exact = value.fraction() if rational else Fraction(value.ring.approximate(value.element, 40))
    else:
        exact = Fraction(value)
    # Zero has no leading bit, so no exponent can be computed.
    if exact == 0:
        return 0.0
    # The exact value is rounded only once, because two roundings can give a wrong result.
    exponent = exact.numerator.bit_length() - exact.denominator.bit_length() - bits
    # The integer part of |exact|/2^exponent must have ``bits`` binary digits. If |exact|/2^exponent is at
    # least 2^bits, ``exponent`` is increased by one.
    exponent += abs(exact) >= Fraction(2) ** (exponent + bits)
    # Subnormal numbers have fewer than ``bits`` significant bits.
    exponent = max(exponent, SUBNORMAL[bits])
    try:
        # Python rounds a Fraction with ties to even, as IEEE 754 does by default.
        return math.ldexp(round(exact / Fraction(2) ** exponent), exponent)
    except OverflowError:
        # The caller :meth:`Precision.round` raises InputError for an infinity.
        return math.copysign(math.inf, exact)


DOUBLE = Precision("double", 53, "double", "", 1.7976931348623157e308)
SINGLE = Precision("single", 24, "float", "f", 3.4028234663852886e38)
PRECISIONS = {p.name: p for p in (DOUBLE, SINGLE)}
"""The floating-point formats by name."""


def precision(name: str) -> Precision:
    """Return the floating-point format called ``name``. UnknownName is raised for an unknown name."""
    if name not in PRECISIONS:
        raise UnknownName(f"unknown precision {name}", expected=" or ".join(PRECISIONS))
    return PRECISIONS[name]
