"""Piecewise polynomials of one variable, which are defined by tables of numbers in formulas.

Expressions call a piecewise polynomial by its name, like ``sin``. The name object also contains the data, and
its text contains a digest of the data.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from hashlib import sha256
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from codegen.ir.domain import Domain, Scalar

Sign = Callable[["Scalar"], "int | None"]
"""The sign of a scalar: -1, 0 or 1, and None for a NaN."""

PREFIX = "table_"
"""The beginning of the name of every table."""


class PiecewisePolynomial(str):
    """A piecewise polynomial: between knots[k - 1] and knots[k] it is sum_j rows[k][j] (x - bases[k])^j.

    The numbers ``knots`` increase. There is one row more than there are knots. At a knot, the polynomial
    above the knot is used.

    >>> zero, one = Fraction(0), Fraction(1)
    >>> ramp = PiecewisePolynomial((zero,), (zero, zero), ((zero,), (zero, one)))
    >>> [str(c) for c in ramp.derivative().rows[1]]
    ['1', '0']
    """

    __slots__ = ("bases", "knots", "rows")

    knots: tuple[Fraction, ...]
    bases: tuple[Fraction, ...]
    rows: tuple[tuple[Fraction, ...], ...]

    def __new__(
        cls,
        knots: tuple[Fraction, ...],
        bases: tuple[Fraction, ...],
        rows: tuple[tuple[Fraction, ...], ...],
    ) -> PiecewisePolynomial:
        """Return the piecewise polynomial. All rows are extended by zeros to one length of at least two."""
        # At least two entries are needed, so that the value at NaN is c_0 + c_1 NaN = NaN.
        width = max(2, *map(len, rows))
        rows = tuple((*row, *(Fraction(0),) * (width - len(row))) for row in rows)
        content = ";".join(",".join(map(str, row)) for row in (knots, bases, *rows))
        # Tables are compared as strings, that is, by their names. The digest makes the names of different
        # tables differ.
        table = super().__new__(cls, PREFIX + sha256(content.encode()).hexdigest()[:8])
        table.knots, table.bases, table.rows = knots, bases, rows
        return table

    def __reduce__(self) -> tuple[object, ...]:
        # Without this method, pickle would call ``__new__`` with the name only, and the data would be
        # missing.
        return PiecewisePolynomial, (self.knots, self.bases, self.rows)

    @property
    def degree(self) -> int:
        """The degree: the highest power with a non-zero coefficient in a row."""
        return max((j for row in self.rows for j, c in enumerate(row) if c), default=0)

    def derivative(self) -> PiecewisePolynomial:
        """Return the derivative. At a knot, the result is the derivative from above."""
        # The derivative of c (x - b)^j is j c (x - b)^(j-1), so each coefficient moves to the next lower
        # power.
        rows = tuple(tuple(j * c for j, c in enumerate(row))[1:] for row in self.rows)
        return PiecewisePolynomial(self.knots, self.bases, rows)

    def value(self, domain: Domain, x: Scalar, sign: Sign) -> Scalar:
        """Return the value at x in any domain.

        ``sign`` returns the sign of a scalar. If the sign is None, as for a NaN, x is returned.
        """
        # Bisection counts the knots that are not above x. This count is the index of the polynomial.
        first, last = 0, len(self.knots)
        while first < last:
            middle = (first + last) // 2
            order = sign(x - domain.rational(*self.knots[middle].as_integer_ratio()))
            if order is None:
                return x
            first, last = (first, middle) if order < 0 else (middle + 1, last)
        return self.on_interval(domain, x, first)

    def on_interval(self, domain: Domain, x: Scalar, place: int) -> Scalar:
        """Return the value of polynomial number ``place`` at x."""
        *rest, total = (domain.rational(*c.as_integer_ratio()) for c in self.rows[place])
        # Horner's rule needs one product for each power of x - base.
        step = x - domain.rational(*self.bases[place].as_integer_ratio())
        for c in reversed(rest):
            total = c + step * total
        return total
