"""Piecewise polynomials of one variable, for functions that the user defines by a table.

In expressions, a piecewise polynomial is a function with a name, as ``sin`` is. The name of the function
contains a hash of the knots and the coefficients.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from hashlib import sha256
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from codegen.ir.domain import Domain, Scalar

Sign = Callable[["Scalar"], "int | None"]
"""A function that returns the sign of a scalar: -1, 0 or 1, or None for a NaN."""

PREFIX = "table_"
"""The beginning of the name of every piecewise polynomial."""


class PiecewisePolynomial(str):
    """A piecewise polynomial in x. The object is also a string, the name of the polynomial.

    The increasing numbers ``knots`` divide the real line into intervals. Interval 0 ends before ``knots[0]``,
    and the last interval begins at the last knot. Each interval k between these two begins at
    ``knots[k - 1]`` and ends before ``knots[k]``. On interval k, the polynomial is the sum over j of
    ``rows[k][j]`` (x - ``bases[k]``)^j.

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
        """Return the piecewise polynomial. Zeros are appended to the rows of coefficients until all rows
        have the same length and at least two entries.
        """
        # A row with only one coefficient would define a constant, and the value of a constant at x = NaN is
        # not NaN. With at least two coefficients, Horner's rule multiplies by a difference that contains x.
        # Therefore the value at x = NaN is NaN.
        width = max(2, *map(len, rows))
        rows = tuple((*row, *(Fraction(0),) * (width - len(row))) for row in rows)
        content = ";".join(",".join(map(str, row)) for row in (knots, bases, *rows))
        # A name contains a digest of ``content``, so different polynomials have different names.
        table = super().__new__(cls, PREFIX + sha256(content.encode()).hexdigest()[:8])
        table.knots, table.bases, table.rows = knots, bases, rows
        return table

    def __reduce__(self) -> tuple[object, ...]:
        # Without this method, ``pickle`` would call ``__new__`` with the name only, without the coefficients.
        return PiecewisePolynomial, (self.knots, self.bases, self.rows)

    @property
    def degree(self) -> int:
        """The largest degree of the polynomials."""
        return max((j for row in self.rows for j, c in enumerate(row) if c), default=0)

    def derivative(self) -> PiecewisePolynomial:
        """Return the derivative as a piecewise polynomial. Its value at a knot is the right derivative."""
        # The derivative of c (x - b)^j is j c (x - b)^(j-1), so the coefficients move by one place.
        rows = tuple(tuple(j * c for j, c in enumerate(row))[1:] for row in self.rows)
        return PiecewisePolynomial(self.knots, self.bases, rows)

    def value(self, domain: Domain, x: Scalar, sign: Sign) -> Scalar:
        """Return the value at x, where x is a scalar of ``domain``.

        ``sign`` returns the sign of a scalar: -1, 0, 1, or None for a NaN.
        """
        # The index of the interval is the number of knots that are less than or equal to x.
        first, last = 0, len(self.knots)
        while first < last:
            middle = (first + last) // 2
            order = sign(x - domain.rational(*self.knots[middle].as_integer_ratio()))
            # A NaN lies in no interval, so the value is the NaN itself.
            if order is None:
                return x
            first, last = (first, middle) if order < 0 else (middle + 1, last)
        return self.on_interval(domain, x, first)

    def on_interval(self, domain: Domain, x: Scalar, place: int) -> Scalar:
        """Return p(x), where p is the polynomial for the interval with the index ``place``.

        The number x may be outside this interval.
        """
        *rest, total = (domain.rational(*c.as_integer_ratio()) for c in self.rows[place])
        # Horner's rule begins with the leading coefficient.
        step = x - domain.rational(*self.bases[place].as_integer_ratio())
        for c in reversed(rest):
            total = c + step * total
        return total
