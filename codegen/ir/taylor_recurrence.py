"""Taylor coefficients of the solution of y' = F(y, t), by recurrences over the expressions of F.

Each elementary operation has a recurrence for its coefficients: sums term by term, products and squares by
Cauchy's convolution, and quotients, constant powers, exponentials, logarithms and pairs of sine and cosine by
the recurrence of the differential equation that they satisfy (R. E. Moore, *Interval Analysis*, 1966, chapter
11; A. Jorba and M. Zou, Experimental Mathematics 14 (2005) 99, section 2). The coefficients are scalars of a
domain: over expressions, the recurrences become straight-line code.

Coefficients that are zero for all states are None, and terms with them are left out. So constants, the time
and expressions that are linear in the time cost one term in a convolution.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TypeAlias

from codegen.errors import SceneError
from codegen.ir.domain import Domain, Scalar
from codegen.ir.expr import Expr, power, walk
from codegen.ir.number import Number

TIME = "t"
"""The symbol of the time in expressions."""

Coefficient: TypeAlias = Scalar
"""A scalar, or None for a coefficient that is zero for all states."""


class Series(ABC):
    """The Taylor coefficients of one expression; ``terms`` are those that are known."""

    def __init__(self, domain: Domain) -> None:
        self.domain = domain
        self.terms: list[Coefficient] = []

    @abstractmethod
    def following(self, n: int) -> Coefficient:
        """Return coefficient n, given those of the arguments up to n and the own ones below n."""

    def term(self, n: int) -> Coefficient:
        """Return coefficient n."""
        while len(self.terms) <= n:
            self.terms.append(self.following(len(self.terms)))
        return self.terms[n]


class Given(Series):
    """Coefficients that are known or appended from outside: a constant, the time, a coordinate."""

    def __init__(self, domain: Domain, *terms: Scalar, closed: bool = True) -> None:
        super().__init__(domain)
        self.terms = list(terms)
        self.closed = closed

    def following(self, n: int) -> Coefficient:
        """Return None, as all further coefficients vanish."""
        assert self.closed, f"coefficient {n} is not known yet"
        return None


class Sum(Series):
    """a + b, or a - b."""

    def __init__(self, domain: Domain, a: Series, b: Series, minus: bool) -> None:
        super().__init__(domain)
        self.a, self.b, self.minus = a, b, minus

    def following(self, n: int) -> Coefficient:
        """Return a_n + b_n, or a_n - b_n."""
        return (
            _subtract(self.a.term(n), self.b.term(n)) if self.minus else _add(self.a.term(n), self.b.term(n))
        )


class Multiple(Series):
    """c a for a number c."""

    def __init__(self, domain: Domain, number: Number, a: Series) -> None:
        super().__init__(domain)
        self.a, self.number = a, number

    def following(self, n: int) -> Coefficient:
        """Return c a_n."""
        return _scaled(self.domain, self.number, self.a.term(n))


class Product(Series):
    """a b."""

    def __init__(self, domain: Domain, a: Series, b: Series) -> None:
        super().__init__(domain)
        self.a, self.b = a, b

    def following(self, n: int) -> Coefficient:
        """Return sum_j a_j b_{n-j}."""
        return convolution(self.domain, self.a, self.b, n)


class Quotient(Series):
    """a/b."""

    def __init__(self, domain: Domain, a: Series, b: Series) -> None:
        super().__init__(domain)
        self.a, self.b = a, b
        self.inverse: Scalar = None

    def following(self, n: int) -> Coefficient:
        """Return (a_n - sum_{j>0} b_j q_{n-j})/b_0."""
        if n == 0:
            self.inverse = self.domain.rational(1) / self.b.term(0)
            return _multiply(self.a.term(0), self.inverse)
        rest = _total(_multiply(self.b.term(j), self.term(n - j)) for j in _late_last(n, range(1, n + 1)))
        return _multiply(_subtract(self.a.term(n), rest), self.inverse)


class Root(Series):
    """The square root of a."""

    def __init__(self, domain: Domain, a: Series) -> None:
        super().__init__(domain)
        self.a = a
        self.inverse: Scalar = None

    def following(self, n: int) -> Coefficient:
        """Return (a_n - sum_{0<j<n} s_j s_{n-j})/(2 s_0)."""
        if n == 0:
            root = self.domain.call("sqrt", self.a.term(0))
            self.inverse = self.domain.rational(1, 2) / root
            return root
        rest = _square(self.domain, self, n, first=1)
        return _multiply(_subtract(self.a.term(n), rest), self.inverse)


class Power(Series):
    """a^e for a rational number e with the denominator 1 or 2."""

    def __init__(self, domain: Domain, a: Series, exponent: Fraction) -> None:
        super().__init__(domain)
        self.a, self.exponent = a, exponent
        self.slope = Slope(domain, a)
        self.inverse: Scalar = None

    def following(self, n: int) -> Coefficient:
        """Return sum_{j>0} (e j - (n - j)) a_j p_{n-j}/(n a_0)."""
        if n == 0:
            self.inverse = self.domain.rational(1) / self.a.term(0)
            return self._first(self.a.term(0))
        terms = []
        for j in _late_last(n, range(1, n + 1)):
            # The factor includes 1/n: the product with a_j costs as much with it as without.
            factor = (self.exponent * j - (n - j)) / n
            if factor and self.a.term(j) is not None:
                a = _scaled(self.domain, Number.rational(*factor.as_integer_ratio()), self.a.term(j))
                terms.append(_multiply(a, self.term(n - j)))
        return _multiply(_total(terms), self.inverse)

    def _first(self, a: Scalar) -> Scalar:
        """Return a^e for a scalar."""
        size = abs(self.exponent)
        whole, half = divmod(size.numerator, size.denominator)
        factors = [power(a, whole)] if whole else []
        factors += [self.domain.call("sqrt", a)] if half else []
        value = factors[0] * factors[1] if len(factors) == 2 else factors[0]
        return self.domain.rational(1) / value if self.exponent < 0 else value


class Square(Series):
    """a^2."""

    def __init__(self, domain: Domain, a: Series) -> None:
        super().__init__(domain)
        self.a = a

    def following(self, n: int) -> Coefficient:
        """Return sum_j a_j a_{n-j}, each pair computed once."""
        return _square(self.domain, self.a, n)


class Slope(Series):
    """j a_j, the coefficients of t a'(t)."""

    def __init__(self, domain: Domain, a: Series) -> None:
        super().__init__(domain)
        self.a = a

    def following(self, n: int) -> Coefficient:
        """Return n a_n."""
        return _scaled(self.domain, Number.rational(n), self.a.term(n)) if n else None


class Exponential(Series):
    """exp(a)."""

    def __init__(self, domain: Domain, a: Series, slope: Series) -> None:
        super().__init__(domain)
        self.a, self.slope = a, slope

    def following(self, n: int) -> Coefficient:
        """Return sum_{j>0} j a_j e_{n-j}/n."""
        if n == 0:
            return self.domain.call("exp", self.a.term(0))
        return _mean(self.domain, self.slope, self, n)


class Logarithm(Series):
    """log(a)."""

    def __init__(self, domain: Domain, a: Series) -> None:
        super().__init__(domain)
        self.a = a
        self.slope = Slope(domain, self)
        self.inverse: Scalar = None

    def following(self, n: int) -> Coefficient:
        """Return (a_n - sum_{0<j<n} j l_j a_{n-j}/n)/a_0."""
        if n == 0:
            self.inverse = self.domain.rational(1) / self.a.term(0)
            return self.domain.call("log", self.a.term(0))
        rest = _total(_multiply(self.slope.term(j), self.a.term(n - j)) for j in _late_last(n, range(1, n)))
        rest = _scaled(self.domain, Number.rational(1, n), rest)
        return _multiply(_subtract(self.a.term(n), rest), self.inverse)


class Circular(Series):
    """sin(a) or cos(a), by its name; ``other`` is the other one of the same argument."""

    other: Circular

    def __init__(self, domain: Domain, name: str, a: Series, slope: Series, minus: bool) -> None:
        super().__init__(domain)
        self.name, self.a, self.slope, self.minus = name, a, slope, minus

    def following(self, n: int) -> Coefficient:
        """Return +-sum_{j>0} j a_j o_{n-j}/n for the coefficients o of the other function."""
        if n == 0:
            return self.domain.call(self.name, self.a.term(0))
        mean = _mean(self.domain, self.slope, self.other, n)
        return None if mean is None else -mean if self.minus else mean


def convolution(domain: Domain, a: Series, b: Series, n: int) -> Coefficient:
    """Return sum_j a_j b_{n-j}, for 0 <= j <= n."""
    if a is b:
        return _square(domain, a, n)
    return _total(_multiply(a.term(j), b.term(n - j)) for j in _late_last(n, range(n + 1)))


def _square(domain: Domain, a: Series, n: int, first: int = 0) -> Coefficient:
    """Return sum_j a_j a_{n-j} for first <= j <= n - first; each pair is computed once."""
    pairs = _total(_multiply(a.term(j), a.term(n - j)) for j in range((n - 1) // 2, first - 1, -1))
    twice = _scaled(domain, Number.rational(2), pairs)
    middle = a.term(n // 2) if n % 2 == 0 and n // 2 >= first else None
    return _add(twice, _multiply(middle, middle))


def _mean(domain: Domain, slope: Series, factor: Series, n: int) -> Coefficient:
    """Return sum_{j>0} slope_j factor_{n-j}/n."""
    total = _total(_multiply(slope.term(j), factor.term(n - j)) for j in _late_last(n, range(1, n + 1)))
    return _scaled(domain, Number.rational(1, n), total)


def _late_last(n: int, indices: range) -> list[int]:
    """Return indices j of products a_j b_{n-j}, those with the newest coefficients last.

    A processor then computes the first products of a sum before the newest coefficients are known.
    """
    return sorted(indices, key=lambda j: max(j, n - j))


def _total(terms: Iterable[Coefficient]) -> Coefficient:
    """Return the sum of terms in order."""
    total: Coefficient = None
    for x in terms:
        total = _add(total, x)
    return total


def _add(a: Coefficient, b: Coefficient) -> Coefficient:
    return b if a is None else a if b is None else a + b


def _subtract(a: Coefficient, b: Coefficient) -> Coefficient:
    return a if b is None else -b if a is None else a - b


def _multiply(a: Coefficient, b: Coefficient) -> Coefficient:
    return None if a is None or b is None else a * b


def _scaled(domain: Domain, number: Number, a: Coefficient) -> Coefficient:
    if a is None or number.is_one:
        return a
    return -a if number.is_minus_one else domain.number(number) * a


@dataclass
class _Builder:
    """The series of expressions; ``values`` are those of symbols that are constant in time."""

    domain: Domain
    series: dict[str, Series]
    values: Mapping[str, Scalar]
    known: dict[int, Series] = field(default_factory=dict)
    shared: dict[tuple[str, int, Fraction], Series] = field(default_factory=dict)
    monomials: dict[int, tuple[Number, Expr, Fraction]] = field(default_factory=dict)

    def of(self, root: Expr) -> Series:
        """Return the series of an expression."""
        # The stack replaces recursion: expressions are deeper than Python's limit.
        waiting = [root]
        while waiting:
            node = waiting[-1]
            missing = [x for x in self.operands(node) if x.id not in self.known]
            if missing and node.id not in self.known:
                waiting += missing
                continue
            if node.id not in self.known:
                self.known[node.id] = self.made(node)
            waiting.pop()
        return self.known[root.id]

    def operands(self, node: Expr) -> tuple[Expr, ...]:
        """Return the expressions whose series the series of a node reads."""
        _, base, _ = self.monomial(node)
        if base is not node:
            return (base,)
        if node.op == "div":
            _, divisor, _ = self.monomial(node.args[1])
            return node.args[0], divisor
        return node.args

    def monomial(self, root: Expr) -> tuple[Number, Expr, Fraction]:
        """Return c, x, e with the node equal to c x^e, where e is no positive integer, or x is the node."""
        for node in walk([root], lambda n: n.id in self.monomials):
            if node.id not in self.monomials:
                self.monomials[node.id] = self._monomial(node)
        return self.monomials[root.id]

    def _monomial(self, node: Expr) -> tuple[Number, Expr, Fraction]:
        one, plain = Number.rational(1), (Number.rational(1), node, Fraction(1))
        parts = [self.monomials[a.id] for a in node.args]
        constants = [a.payload if a.op == "const" else None for a in node.args]
        match node.op:
            case "call" if node.payload == "sqrt":
                return one, node.args[0], Fraction(1, 2)
            case "neg":
                ((c, x, e),) = parts
                return -c, x, e
            case "mul" if constants[0] is not None:
                c, x, e = parts[1]
                return c * constants[0], x, e
            case "div" if constants[0] is not None:
                c, x, e = parts[1]
                return constants[0] / c, x, -e
            case "pow":
                ((c, x, e),) = parts
                if e == 1:
                    return plain
                for _ in range(node.payload - 1):
                    c = c * parts[0][0]
                result = c, x, e * node.payload
            case "mul" | "div":
                (c, x, e), (d, y, f) = parts
                if x is not y or e == f == 1:
                    return plain
                result = (c * d, x, e + f) if node.op == "mul" else (c / d, x, e - f)
            case _:
                return plain
        # A positive integer is left to products, as their coefficients need no division by x.
        return plain if result[2].denominator == 1 and result[2] >= 0 and result[2] != 1 else result

    def made(self, node: Expr) -> Series:
        """Return the series of a node whose operands have theirs."""
        domain = self.domain
        number, base, exponent = self.monomial(node)
        if base is not node:
            return self.multiple(number, self.power(self.known[base.id], base, exponent))

        def arg(i: int) -> Series:
            return self.known[node.args[i].id]

        match node.op:
            case "const":
                return Given(domain, domain.number(node.payload))
            case "sym":
                found = self.series.get(node.payload)
                return found if found is not None else Given(domain, self.values[node.payload])
            case "add" | "sub":
                return Sum(domain, arg(0), arg(1), node.op == "sub")
            case "mul":
                return Product(domain, arg(0), arg(1))
            case "pow":
                return self.integer_power(arg(0), node.payload)
            case "div":
                c, divisor, e = self.monomial(node.args[1])
                below = self.known[divisor.id]
                if e == 1:
                    return self.multiple(Number.rational(1) / c, Quotient(domain, arg(0), below))
                other = self.power(below, divisor, -e)
                return self.multiple(Number.rational(1) / c, Product(domain, arg(0), other))
            case _:
                return self.function(node.payload, node.args[0], arg(0))

    def multiple(self, number: Number, a: Series) -> Series:
        """Return c a."""
        return a if number.is_one else Multiple(self.domain, number, a)

    def power(self, a: Series, base: Expr, exponent: Fraction) -> Series:
        """Return the series of a power; equal powers of one expression are one series."""
        if exponent == 1:
            return a
        key = "power", base.id, exponent
        if key not in self.shared:
            if exponent == Fraction(1, 2):
                self.shared[key] = Root(self.domain, a)
            elif exponent == -1:
                self.shared[key] = Quotient(self.domain, Given(self.domain, self.domain.rational(1)), a)
            elif exponent.denominator == 1 and exponent > 0:
                self.shared[key] = self.integer_power(a, int(exponent))
            else:
                self.shared[key] = Power(self.domain, a, exponent)
        return self.shared[key]

    def integer_power(self, a: Series, n: int) -> Series:
        """Return a^n by squaring from the leading bit."""
        result = a
        for bit in bin(n)[3:]:
            result = Square(self.domain, result)
            if bit == "1":
                result = Product(self.domain, result, a)
        return result

    def function(self, name: str, argument: Expr, a: Series) -> Series:
        """Return the series of a function of an expression."""
        key = name, argument.id, Fraction(1)
        if key in self.shared:
            return self.shared[key]
        domain, slope = self.domain, Slope(self.domain, a)
        match name:
            case "exp":
                self.shared[key] = Exponential(domain, a, slope)
            case "log":
                self.shared[key] = Logarithm(domain, a)
            case "sin" | "cos":
                # The recurrences of sine and cosine read one another.
                sine, cosine = (
                    Circular(domain, "sin", a, slope, False),
                    Circular(domain, "cos", a, slope, True),
                )
                sine.other, cosine.other = cosine, sine
                self.shared["sin", argument.id, Fraction(1)] = sine
                self.shared["cos", argument.id, Fraction(1)] = cosine
            case _:
                raise SceneError(
                    f"no recurrence for the Taylor coefficients of {name}",
                    expected="+ - * /, constant powers, sqrt, sin, cos, exp, log",
                )
        return self.shared[key]


class Recurrence:
    """The series of the coordinates of y(t + s scale), in powers of s, and of their derivatives.

    ``roots`` are the derivatives of the coordinates called ``symbols``; ``values`` are those of the other
    symbols, the time ``t`` among them. A numeric factor of a derivative is kept apart from its series.
    """

    def __init__(
        self,
        roots: Sequence[Expr],
        domain: Domain,
        symbols: Sequence[str],
        state: Sequence[Scalar],
        values: Mapping[str, Scalar],
        scale: Scalar,
    ) -> None:
        self.domain, self.scale = domain, scale
        self.coordinates = [Given(domain, x, closed=False) for x in state]
        self.time = Given(domain, values[TIME], scale)
        series: dict[str, Series] = dict(zip(symbols, self.coordinates, strict=True))
        builder = _Builder(domain, series | {TIME: self.time}, values)
        self.slopes = [_apart(builder.of(root)) for root in roots]

    def extend(self, degree: int) -> list[list[Coefficient]]:
        """Return, for each coordinate, the coefficients 0, ..., degree; None if zero for all states."""
        for n in range(len(self.coordinates[0].terms) - 1, degree):
            factors: dict[object, Scalar] = {}
            new = []
            for number, slope in self.slopes:
                # The numeric factor of the derivative joins the factor scale/(n + 1).
                number = number * Number.rational(1, n + 1)
                if number.key not in factors:
                    factors[number.key] = self.domain.number(number) * self.scale
                new.append(_multiply(factors[number.key], slope.term(n)))
            for coordinate, x in zip(self.coordinates, new, strict=True):
                coordinate.terms.append(x)
        return [coordinate.terms for coordinate in self.coordinates]


def _apart(series: Series) -> tuple[Number, Series]:
    """Return the numeric factor of a series and the rest."""
    return (series.number, series.a) if isinstance(series, Multiple) else (Number.rational(1), series)
