"""Truncated power series in the step size h, over any base ring.

If one step of a method is computed with truncated power series, the result is the Taylor expansion of the
numerical solution in h.
"""

from __future__ import annotations

from orderconds.ring.power import power
from orderconds.ring.protocol import Element, Key, Ring


class PowerSeries:
    """The ring of power series in h with coefficients in ``base``. Powers of h above h^order are omitted.

    >>> from orderconds.ring import QQ
    >>> R = PowerSeries(QQ, 3)
    >>> R.text(R.one / (R.one - 2 * R.h))
    '1 + 2*h + 4*h^2 + 8*h^3'
    """

    def __init__(self, base: Ring, order: int) -> None:
        self.base, self.order = base, order
        self.name = f"{base.name}[[h]]/h^{order + 1}"
        self.zero = Series(self, (base.zero,) * (order + 1))
        self.one = self.constant(base.one)
        self.h = self.from_coefficients((base.zero, base.one))

    def __repr__(self) -> str:
        return self.name

    def __eq__(self, other: object) -> bool:
        return isinstance(other, PowerSeries) and (other.base, other.order) == (self.base, self.order)

    def __hash__(self) -> int:
        return hash((self.name, self.order))

    def rational(self, p: int, q: int = 1) -> Series:
        """Return the constant series p/q."""
        return self.constant(self.base.rational(p, q))

    def constant(self, x: Element) -> Series:
        """Return an element of the base ring as a constant series."""
        return Series(self, (x, *self.zero.coefficients[1:]))

    def from_coefficients(self, coefficients: tuple[Element, ...]) -> Series:
        """Return the series with the given coefficients of 1, h, h^2, ..., followed by zeros. Coefficients of
        powers above h^order are ignored."""
        kept = coefficients[: self.order + 1]
        return Series(self, (*kept, *((self.base.zero,) * (self.order + 1 - len(kept)))))

    def is_zero(self, x: Series) -> bool | None:
        """Return True if all coefficients are proved to be zero, and False if some coefficient is proved to
        be nonzero. Return None in all other cases."""
        verdicts = [self.base.is_zero(c) for c in x.coefficients]
        return False if False in verdicts else None if None in verdicts else True

    def text(self, x: Series) -> str:
        """Return x as text, in ascending powers of h. If the coefficient of a positive
        power of h is a sum, the sum is in parentheses."""
        terms = []
        for k, c in enumerate(x.coefficients):
            if self.base.is_zero(c) is True:
                continue
            text = self.base.text(c)
            if k == 0:
                terms.append(text)
                continue
            if " " in text:
                text = f"({text})"
            h = "h" if k == 1 else f"h^{k}"
            terms.append({"1": h, "-1": f"-{h}"}.get(text, f"{text}*{h}"))
        return " + ".join(terms).replace("+ -", "- ") if terms else "0"

    def key(self, x: Series) -> Key:
        """Return the tuple of the keys of the coefficients."""
        return tuple(self.base.key(c) for c in x.coefficients)

    def approximate(self, x: Series, digits: int = 20) -> str:
        """Return the coefficients of x as text, in the form of a list of decimals."""
        return "[" + ", ".join(self.base.approximate(c, digits) for c in x.coefficients) + "]"

    def valuation(self, x: Series) -> int:
        """Return the smallest power k of h whose coefficient may be non-zero.

        Return order + 1 if all coefficients are proved to be zero.
        """
        for k, c in enumerate(x.coefficients):
            if self.base.is_zero(c) is not True:
                return k
        return self.order + 1


class Series:
    """A truncated power series. ``coefficients[k]`` multiplies h^k.

    The second operand of an arithmetic operator is a series of the ring, an element of the base ring, or an
    integer.
    """

    __slots__ = ("coefficients", "ring")

    def __init__(self, ring: PowerSeries, coefficients: tuple[Element, ...]) -> None:
        self.ring = ring
        self.coefficients = coefficients

    def __repr__(self) -> str:
        return f"Series({self.ring.text(self)})"

    def _constant(self, other: Element) -> Element:
        """Return ``other``, converted to the base ring if ``other`` is an integer."""
        return self.ring.base.rational(other) if isinstance(other, int) else other

    def _same(self, other: Series) -> tuple[Element, ...]:
        if other.ring != self.ring:
            raise TypeError(f"cannot combine series of different rings: {self.ring} and {other.ring}")
        return other.coefficients

    def __add__(self, other: Element) -> Series:
        if isinstance(other, Series):
            pairs = zip(self.coefficients, self._same(other), strict=True)
            return Series(self.ring, tuple(x + y for x, y in pairs))
        return Series(self.ring, (self.coefficients[0] + self._constant(other), *self.coefficients[1:]))

    __radd__ = __add__

    def __neg__(self) -> Series:
        return Series(self.ring, tuple(-x for x in self.coefficients))

    def __sub__(self, other: Element) -> Series:
        if isinstance(other, Series):
            pairs = zip(self.coefficients, self._same(other), strict=True)
            return Series(self.ring, tuple(x - y for x, y in pairs))
        return Series(self.ring, (self.coefficients[0] - self._constant(other), *self.coefficients[1:]))

    def __rsub__(self, other: Element) -> Series:
        return (-self).__add__(other)

    def __mul__(self, other: Element) -> Series:
        if not isinstance(other, Series):
            factor = self._constant(other)
            return Series(self.ring, tuple(x * factor for x in self.coefficients))
        base, size = self.ring.base, self.ring.order + 1
        result = [base.zero] * size
        right = [(j, y) for j, y in enumerate(self._same(other)) if base.is_zero(y) is not True]
        for i, x in enumerate(self.coefficients):
            if base.is_zero(x) is True:
                continue
            for j, y in right:
                if i + j >= size:
                    break
                result[i + j] = result[i + j] + x * y
        return Series(self.ring, tuple(result))

    __rmul__ = __mul__

    def reciprocal(self) -> Series:
        """Return the series y = 1/x for this series x. The constant term of x must have an inverse.

        Let x_n and y_n be the coefficients of h^n in x and y. Then y_0 = 1/x_0, and
        y_n = -y_0 (x_1 y_{n-1} + ... + x_n y_0) for n > 0.
        """
        unit = self.coefficients[0]
        if self.ring.base.is_zero(unit) is True:
            raise ZeroDivisionError("division by a power series whose constant term is zero")
        first = self.ring.base.one / unit
        result = [first]
        for n in range(1, self.ring.order + 1):
            total = self.ring.base.zero
            for k in range(1, n + 1):
                total = total + self.coefficients[k] * result[n - k]
            result.append(-first * total)
        return Series(self.ring, tuple(result))

    def __truediv__(self, other: Element) -> Series:
        if isinstance(other, Series):
            self._same(other)
            return self * other.reciprocal()
        divisor = self._constant(other)
        return Series(self.ring, tuple(x / divisor for x in self.coefficients))

    def __rtruediv__(self, other: Element) -> Series:
        return self.reciprocal().__mul__(other)

    def __pow__(self, n: int) -> Series:
        return power(self, n, self.ring.one)

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, Series) and other.ring == self.ring and other.coefficients == self.coefficients
        )

    def __hash__(self) -> int:
        return hash((self.ring.name, self.ring.key(self)))
