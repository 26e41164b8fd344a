"""Taylor series in time, with one class for each operation or function.

The recurrence for the coefficients of a series follows from an algebraic or differential equation
(R. E. Moore, *Interval Analysis*, 1966, chapter 11; A. Jorba and M. Zou, Experimental Mathematics 14 (2005)
99, section 2). The coefficients are scalars of a domain (:mod:`codegen.ir.domain`).

In all formulas a_n is coefficient n of the series a, and a prime denotes the derivative with respect to time.
The value None represents a coefficient that is identically zero.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable
from fractions import Fraction
from functools import partial
from typing import TypeAlias

from codegen.ir.domain import Domain, Scalar
from codegen.ir.elementary import ANGLE
from codegen.ir.expr import power
from codegen.ir.number import Number
from codegen.ir.selection import CHOOSE
from codegen.ir.table import PiecewisePolynomial

Coefficient: TypeAlias = Scalar
"""A coefficient of a Taylor series: a scalar, or None if the coefficient is identically zero."""


class Series(ABC):
    """The Taylor series in time of one expression. ``terms`` contains its computed coefficients."""

    def __init__(self, domain: Domain) -> None:
        self.domain = domain
        self.terms: list[Coefficient] = []

    @abstractmethod
    def following(self, n: int) -> Coefficient:
        """Return coefficient n of this series.

        The coefficients 0, ..., n - 1 of this series must be in ``terms``.
        """

    def term(self, n: int) -> Coefficient:
        """Return coefficient n of this series. All missing coefficients up to n are computed."""
        # The coefficients are computed in increasing order, because each one depends on the lower ones.
        while len(self.terms) <= n:
            self.terms.append(self.following(len(self.terms)))
        return self.terms[n]


class Given(Series):
    """A series with given coefficients: a constant, the time, or a coordinate."""

    def __init__(self, domain: Domain, *terms: Scalar, closed: bool = True) -> None:
        super().__init__(domain)
        self.terms = list(terms)
        self.closed = closed

    def following(self, n: int) -> Coefficient:
        """Return None. All nonzero coefficients of a ``closed`` series are already in ``terms``."""
        # If ``closed`` is true, all missing coefficients are zero. For the series of a coordinate, ``closed``
        # is false, and coefficient n must be in ``terms`` before ``term(n)`` is called.
        assert self.closed, f"coefficient {n} is unknown"
        return None


class Sum(Series):
    """The sum a + b of two series, or their difference a - b."""

    def __init__(self, domain: Domain, a: Series, b: Series, minus: bool) -> None:
        super().__init__(domain)
        self.a, self.b, self.minus = a, b, minus

    def following(self, n: int) -> Coefficient:
        """Return coefficient n: a_n + b_n, or a_n - b_n if ``minus`` is true."""
        return (
            _subtract(self.a.term(n), self.b.term(n)) if self.minus else _add(self.a.term(n), self.b.term(n))
        )


class Multiple(Series):
    """The product of a number c and a series a."""

    def __init__(self, domain: Domain, number: Number, a: Series) -> None:
        super().__init__(domain)
        self.a, self.number = a, number

    def following(self, n: int) -> Coefficient:
        """Return c a_n, where c is ``self.number``, and a_n is coefficient n of the series ``self.a``."""
        return _scaled(self.domain, self.number, self.a.term(n))


class Convolution(Series):
    """The product a b of two series."""

    def __init__(self, domain: Domain, a: Series, b: Series) -> None:
        super().__init__(domain)
        self.a, self.b = a, b

    def following(self, n: int) -> Coefficient:
        """Return coefficient n: the sum of a_j b_{n-j} over 0 <= j <= n."""
        return convolution(self.domain, self.a, self.b, n)


class Quotient(Series):
    """The quotient a/b of two series."""

    def __init__(self, domain: Domain, a: Series, b: Series) -> None:
        super().__init__(domain)
        self.a, self.b = a, b
        self.inverse: Scalar = None

    def following(self, n: int) -> Coefficient:
        """Return coefficient n of the quotient q = a/b: q_n = (a_n - sum_{0<j<=n} b_j q_{n-j})/b_0."""
        if n == 0:
            # The division by b_0 is replaced by a product with 1/b_0, because a product is cheaper.
            self.inverse = self.domain.rational(1) / self.b.term(0)
            return multiplied(self.a.term(0), self.inverse)
        # The sum contains only the known coefficients q_0, ..., q_{n-1} of the quotient.
        rest = _total(multiplied(self.b.term(j), self.term(n - j)) for j in _late_last(n, range(1, n + 1)))
        return multiplied(_subtract(self.a.term(n), rest), self.inverse)


class Root(Series):
    """The square root of a series a."""

    def __init__(self, domain: Domain, a: Series) -> None:
        super().__init__(domain)
        self.a = a
        self.inverse: Scalar = None

    def following(self, n: int) -> Coefficient:
        """Return coefficient n of s = sqrt(a). For n > 0 it is (a_n - sum_{0<j<n} s_j s_{n-j})/(2 s_0)."""
        if n == 0:
            root = self.domain.call("sqrt", self.a.term(0))
            # For n > 0, a product with ``inverse`` replaces the division by 2 s_0.
            self.inverse = self.domain.rational(1, 2) / root
            return root
        # The sum ``rest`` does not contain the unknown coefficient s_n.
        rest = _square(self.domain, self, n, first=1)
        return multiplied(_subtract(self.a.term(n), rest), self.inverse)


class Power(Series):
    """The power a^e of a series, for a rational number e with the denominator 1 or 2."""

    def __init__(self, domain: Domain, a: Series, exponent: Fraction) -> None:
        super().__init__(domain)
        self.a, self.exponent = a, exponent
        self.slope = Slope(domain, a)
        self.inverse: Scalar = None

    def following(self, n: int) -> Coefficient:
        """Return coefficient n of the power p = a^e, where e is ``exponent``.

        For n > 0 it is 1/(n a_0) times the sum of (e j - (n - j)) a_j p_{n-j} over 0 < j <= n.
        """
        if n == 0:
            self.inverse = self.domain.rational(1) / self.a.term(0)
            return self._first(self.a.term(0))
        # The power p = a^e satisfies the differential equation a p' = e a' p.
        terms = []
        for j in _late_last(n, range(1, n + 1)):
            # If the factor is zero, the term is omitted.
            factor = (self.exponent * j - (n - j)) / n
            if factor and self.a.term(j) is not None:
                a = _scaled(self.domain, Number.rational(*factor.as_integer_ratio()), self.a.term(j))
                terms.append(multiplied(a, self.term(n - j)))
        return multiplied(_total(terms), self.inverse)

    def _first(self, a: Scalar) -> Scalar:
        """Return the power a^e of a scalar a, where e is ``self.exponent``."""
        size = abs(self.exponent)
        # Since 2 e is an integer, |e| is ``whole`` + ``half``/2, and ``half`` is 0 or 1.
        whole, half = divmod(size.numerator, size.denominator)
        factors = [power(a, whole)] if whole else []
        factors += [self.domain.call("sqrt", a)] if half else []
        value = factors[0] * factors[1] if len(factors) == 2 else factors[0]
        return self.domain.rational(1) / value if self.exponent < 0 else value


class Square(Series):
    """The square a^2 of a series."""

    def __init__(self, domain: Domain, a: Series) -> None:
        super().__init__(domain)
        self.a = a

    def following(self, n: int) -> Coefficient:
        """Return coefficient n: the sum of a_j a_{n-j} over 0 <= j <= n. Equal products are computed only
        once.
        """
        return _square(self.domain, self.a, n)


class Slope(Series):
    """The product of s and a'(s) for a series a(s), where s is the time since the beginning of the step.

    Coefficient n of this product is n a_n, where a_n is coefficient n of the series a.
    """

    def __init__(self, domain: Domain, a: Series) -> None:
        super().__init__(domain)
        self.a = a

    def following(self, n: int) -> Coefficient:
        """Return n a_n, where a_n is coefficient n of the series a. For n = 0, the result is None. None
        represents a coefficient that is identically zero.
        """
        # The factor n is zero for n = 0, so coefficient 0 is identically zero.
        return _scaled(self.domain, Number.rational(n), self.a.term(n)) if n else None


class Exponential(Series):
    """The exponential exp(a) of a series."""

    def __init__(self, domain: Domain, a: Series, slope: Series) -> None:
        super().__init__(domain)
        self.a, self.slope = a, slope

    def following(self, n: int) -> Coefficient:
        """Return coefficient n of e = exp(a). For n > 0 it is the sum of j a_j e_{n-j}/n over 0 < j <= n."""
        if n == 0:
            return self.domain.call("exp", self.a.term(0))
        # The recurrence follows from the differential equation e' = a' e.
        return _mean(self.domain, self.slope, self, n)


class Logarithm(Series):
    """The logarithm log(a) of a series."""

    def __init__(self, domain: Domain, a: Series) -> None:
        super().__init__(domain)
        self.a = a
        # The logarithm l = log(a) satisfies the differential equation a l' = a'.
        self.slope = Slope(domain, self)
        self.inverse: Scalar = None

    def following(self, n: int) -> Coefficient:
        """Return coefficient n of l = log(a).

        Let z be the sum of j l_j a_{n-j} over 0 < j < n. For n > 0, coefficient n is (a_n - z/n)/a_0.
        """
        if n == 0:
            self.inverse = self.domain.rational(1) / self.a.term(0)
            return self.domain.call("log", self.a.term(0))
        # The sum ``rest`` does not contain the unknown coefficient l_n.
        rest = _total(multiplied(self.slope.term(j), self.a.term(n - j)) for j in _late_last(n, range(1, n)))
        rest = _scaled(self.domain, Number.rational(1, n), rest)
        return multiplied(_subtract(self.a.term(n), rest), self.inverse)


class Antiderivative(Series):
    """The series f(a), where f is tan, atan or another function with a simple derivative.

    Let r = f'(a) be the series ``rate``. The coefficients of b = f(a) follow from the differential equation
    b' = r a'.
    """

    rate: Series

    def __init__(self, domain: Domain, name: str, a: Series, slope: Series) -> None:
        super().__init__(domain)
        self.name, self.a, self.slope = name, a, slope

    def following(self, n: int) -> Coefficient:
        """Return coefficient n of f(a), where f is the function ``name``, and a is a series.

        For n > 0, the result is the sum of j a_j r_{n-j}/n over 0 < j <= n, where r is the series f'(a).
        """
        if n == 0:
            return self.domain.call(self.name, self.a.term(0))
        # Coefficient n of ``self.rate`` may depend on coefficient n of f(a), which is not known yet.
        # ``_mean`` reads only lower coefficients of ``self.rate``.
        return _mean(self.domain, self.slope, self.rate, n)


class Circular(Series):
    """The sine or the cosine of a series a.

    ``other`` is the other of the two functions. For the cosine, ``minus`` is true, because cos' = -sin.
    """

    other: Circular

    def __init__(self, domain: Domain, name: str, a: Series, slope: Series, minus: bool) -> None:
        super().__init__(domain)
        self.name, self.a, self.slope, self.minus = name, a, slope, minus

    def following(self, n: int) -> Coefficient:
        """Return coefficient n of this series, which is the sine or the cosine of ``self.a``.

        If this series is the sine, ``self.other`` is the cosine. If this series is the cosine, ``self.other``
        is the sine.

        Let a_j and o_j be the coefficients of ``self.a`` and ``self.other``. For n > 0, let z be the sum of
        j a_j o_{n-j}/n over 0 < j <= n. The result is z for the sine, and -z for the cosine.
        """
        if n == 0:
            return self.domain.call(self.name, self.a.term(0))
        # The recurrence follows from sin(a)' = a' cos(a) and cos(a)' = -a' sin(a).
        mean = _mean(self.domain, self.slope, self.other, n)
        return None if mean is None else -mean if self.minus else mean


class Angle(Series):
    """The polar angle of the point (x, y). The derivative of the angle is (x y' - y x')/(x^2 + y^2)."""

    def __init__(self, domain: Domain, y: Series, x: Series) -> None:
        super().__init__(domain)
        self.y, self.x = y, x
        size = Sum(domain, Square(domain, x), Square(domain, y), False)
        self.slopes = Slope(domain, y), Slope(domain, x)
        self.rates = Quotient(domain, x, size), Quotient(domain, y, size)

    def following(self, n: int) -> Coefficient:
        """Return coefficient n of the polar angle of the point (x, y).

        Let p = x/(x^2 + y^2) and q = y/(x^2 + y^2). For n > 0, coefficient n is the sum of
        j (y_j p_{n-j} - x_j q_{n-j})/n over 0 < j <= n.
        """
        if n == 0:
            return self.domain.call(ANGLE, self.y.term(0), self.x.term(0))
        # Coefficient n is the difference of two weighted sums.
        means = [_mean(self.domain, s, r, n) for s, r in zip(self.slopes, self.rates, strict=True)]
        return _subtract(*means)


class Chosen(Series):
    """The series a if ``test`` is positive at the beginning of the step, otherwise the series b."""

    def __init__(self, domain: Domain, test: Series, a: Series, b: Series) -> None:
        super().__init__(domain)
        self.test, self.a, self.b = test, a, b

    def following(self, n: int) -> Coefficient:
        """Return coefficient n of the series a or b.

        If ``test`` is positive at the beginning of the step, the series is a, otherwise b.
        """
        a, b = self.a.term(n), self.b.term(n)
        if a is None and b is None:
            return None
        # ``choose`` needs two scalars, so None is replaced by 0.
        pair = (self.domain.rational(0) if x is None else x for x in (a, b))
        return self.domain.call(CHOOSE, self.test.term(0), *pair)


class Start(Series):
    """The constant series f(a_0). The function f is ``function``, and a_0 is the value of the series a at the
    beginning of the step.
    """

    def __init__(self, domain: Domain, a: Series, function: Callable[[Scalar], Scalar]) -> None:
        super().__init__(domain)
        self.a, self.function = a, function

    def following(self, n: int) -> Coefficient:
        """Return coefficient n of the constant series f(a_0): f(a_0) for n = 0, and None for n > 0.

        The function f is ``function``, and a_0 is the value of the series a at the beginning of the step.
        None represents a coefficient that is identically zero.
        """
        return self.function(self.a.term(0)) if n == 0 else None


def composed(domain: Domain, table: PiecewisePolynomial, a: Series) -> Series:
    """Return the series of f(a), where f is the piecewise polynomial ``table``.

    All coefficients are computed with the polynomial of the interval that contains the first coefficient a_0.
    """
    # The term of order k of the Taylor series at a_0 is (a - a_0)^k/k! times the derivative of order k.
    step = Sum(domain, a, Start(domain, a, lambda x: x), True)
    derivatives, factors = [table], [Fraction(1)]
    # ``derivatives[k]`` is the derivative of order k, and ``factors[k]`` is 1/k!.
    while derivatives[-1].degree:
        factors.append(factors[-1] / len(derivatives))
        derivatives.append(derivatives[-1].derivative())
    starts: list[Series] = []
    for derivative, factor in zip(derivatives, factors, strict=True):
        start = Start(domain, a, partial(domain.call, derivative))
        number = Number.rational(*factor.as_integer_ratio())
        starts.append(start if number.is_one else Multiple(domain, number, start))
    # The sum is computed by Horner's rule, beginning with the highest derivative.
    total: Series = starts[-1]
    for constant in reversed(starts[:-1]):
        total = Sum(domain, constant, Convolution(domain, step, total), False)
    return total


def convolution(domain: Domain, a: Series, b: Series, n: int) -> Coefficient:
    """Return coefficient n of the product a b: the sum of a_j b_{n-j} over 0 <= j <= n."""
    # For a = b the products for j and n - j are equal, so only one of them is computed.
    if a is b:
        return _square(domain, a, n)
    return _total(multiplied(a.term(j), b.term(n - j)) for j in _late_last(n, range(n + 1)))


def _square(domain: Domain, a: Series, n: int, first: int = 0) -> Coefficient:
    """Return the sum of a_j a_{n-j} over ``first`` <= j <= n - ``first``."""
    # The products are sorted by n - j, the larger of the two indices (see :func:`_late_last`).
    pairs = _total(multiplied(a.term(j), a.term(n - j)) for j in range((n - 1) // 2, first - 1, -1))
    twice = _scaled(domain, Number.rational(2), pairs)
    # For even n, the sum also contains the square of a_{n/2}.
    middle = a.term(n // 2) if n % 2 == 0 and n // 2 >= first else None
    return _add(twice, multiplied(middle, middle))


def _mean(domain: Domain, slope: Series, factor: Series, n: int) -> Coefficient:
    """Return 1/n times the sum of s_j f_{n-j} over 0 < j <= n, where s is ``slope`` and f is ``factor``."""
    total = _total(multiplied(slope.term(j), factor.term(n - j)) for j in _late_last(n, range(1, n + 1)))
    return _scaled(domain, Number.rational(1, n), total)


def _late_last(n: int, indices: range) -> list[int]:
    """Sort the ``indices`` j of a sum of products a_j b_{n-j} by max(j, n - j)."""
    # Coefficients with high indices are computed last, so products with these coefficients are added last.
    return sorted(indices, key=lambda j: max(j, n - j))


def _total(terms: Iterable[Coefficient]) -> Coefficient:
    """Return the sum of ``terms``, added in the given order. An empty sum is None."""
    total: Coefficient = None
    for x in terms:
        total = _add(total, x)
    return total


def _add(a: Coefficient, b: Coefficient) -> Coefficient:
    return b if a is None else a if b is None else a + b


def _subtract(a: Coefficient, b: Coefficient) -> Coefficient:
    return a if b is None else -b if a is None else a - b


def multiplied(a: Coefficient, b: Coefficient) -> Coefficient:
    """Return the product a b. None represents zero: if a or b is None, the result is None."""
    return None if a is None or b is None else a * b


def _scaled(domain: Domain, number: Number, a: Coefficient) -> Coefficient:
    if a is None or number.is_one:
        return a
    return -a if number.is_minus_one else domain.number(number) * a
