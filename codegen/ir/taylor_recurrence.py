"""Taylor coefficients in time of the solution of y' = F(y, t).

Every subexpression of F becomes a power series in time (:mod:`codegen.ir.taylor_series`). Coefficient n + 1
of y follows from coefficient n of F. To avoid convolutions of series, a product or quotient of powers of the
same expression is rewritten as one power.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from codegen.errors import SceneError
from codegen.ir.domain import Domain, Scalar
from codegen.ir.elementary import ANGLE, MATHEMATICAL
from codegen.ir.expr import Expr, walk
from codegen.ir.number import Number
from codegen.ir.selection import ABSOLUTE, CHOOSE
from codegen.ir.table import PiecewisePolynomial
from codegen.ir.taylor_series import (
    Angle,
    Antiderivative,
    Chosen,
    Circular,
    Coefficient,
    Convolution,
    Exponential,
    Given,
    Logarithm,
    Multiple,
    Power,
    Quotient,
    Root,
    Series,
    Slope,
    Square,
    Sum,
    composed,
    multiplied,
)

TIME = "t"
"""The name of the symbol for the time in expressions."""


@dataclass
class _Builder:
    """Builds the power series of expressions.

    ``series`` contains the series of the coordinates and of the time. ``values`` contains the values of all
    other symbols.
    """

    domain: Domain
    series: dict[str, Series]
    values: Mapping[str, Scalar]
    known: dict[int, Series] = field(default_factory=dict)
    shared: dict[tuple[str, int, Fraction], Series] = field(default_factory=dict)
    monomials: dict[int, tuple[Number, Expr, Fraction]] = field(default_factory=dict)

    def of(self, root: Expr) -> Series:
        """Return the series of an expression."""
        # An explicit stack is used in place of recursion, because expressions may be nested deeply.
        waiting = [root]
        while waiting:
            node = waiting[-1]
            missing = [x for x in self.operands(node) if x.id not in self.known]
            # A node may be on the stack several times, if several expressions contain it.
            if missing and node.id not in self.known:
                waiting += missing
                continue
            if node.id not in self.known:
                self.known[node.id] = self.built(node)
            waiting.pop()
        return self.known[root.id]

    def operands(self, node: Expr) -> tuple[Expr, ...]:
        """Return the expressions whose series must exist before the series of ``node`` can be built."""
        _, base, _ = self.monomial(node)
        # If the node was rewritten as c x^e, only the series of x is needed. Here x is ``base``.
        if base is not node:
            return (base,)
        if node.op == "div":
            # The divisor is rewritten as c x^e, so only the series of x is needed.
            _, divisor, _ = self.monomial(node.args[1])
            return node.args[0], divisor
        return node.args

    def monomial(self, root: Expr) -> tuple[Number, Expr, Fraction]:
        """Return a number c, an expression x and a rational exponent e such that ``root`` equals c x^e."""
        for node in walk([root], lambda n: n.id in self.monomials):
            if node.id not in self.monomials:
                self.monomials[node.id] = self._monomial(node)
        return self.monomials[root.id]

    def _monomial(self, node: Expr) -> tuple[Number, Expr, Fraction]:
        # ``plain`` represents the node itself, as 1 times node^1.
        one, plain = Number.rational(1), (Number.rational(1), node, Fraction(1))
        parts = [self.monomials[a.id] for a in node.args]
        constants = [a.payload if a.op == "const" else None for a in node.args]
        match node.op:
            case "call" if node.payload == "sqrt":
                # If the argument is a power, the exponent is not halved, because sqrt(x^2) is |x| and not x.
                return one, node.args[0], Fraction(1, 2)
            case "neg":
                ((c, x, e),) = parts
                return -c, x, e
            # A constant factor is always the first argument of a product.
            case "mul" if constants[0] is not None:
                c, x, e = parts[1]
                return c * constants[0], x, e
            # ``parts[1]`` represents the divisor c x^e.
            case "div" if constants[0] is not None:
                c, x, e = parts[1]
                return constants[0] / c, x, -e
            case "pow":
                ((c, x, e),) = parts
                # For e = 1, the node is not rewritten.
                if e == 1:
                    return plain
                for _ in range(node.payload - 1):
                    c = c * parts[0][0]
                result = c, x, e * node.payload
            case "mul" | "div":
                (c, x, e), (d, y, f) = parts
                # The node is the product or quotient of c x^e and d y^f.
                if x is not y or e == f == 1:
                    return plain
                result = (c * d, x, e + f) if node.op == "mul" else (c / d, x, e - f)
            case _:
                return plain
        # The third entry of ``result`` is the exponent. If the exponent is 0 or an integer above 1, the
        # node is not rewritten.
        return plain if result[2].denominator == 1 and result[2] >= 0 and result[2] != 1 else result

    def built(self, node: Expr) -> Series:
        """Return the series of a node. The series of its :meth:`operands` must already be in ``known``."""
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
                # All symbols except the coordinates and the time are constant.
                known = self.series.get(node.payload)
                return known if known is not None else Given(domain, self.values[node.payload])
            case "add" | "sub":
                return Sum(domain, arg(0), arg(1), node.op == "sub")
            case "mul":
                return Convolution(domain, arg(0), arg(1))
            case "pow":
                return self.integer_power(arg(0), node.payload)
            case "div":
                # ``node`` is a quotient with the denominator c x^e, where x is ``divisor``.
                c, divisor, e = self.monomial(node.args[1])
                below = self.known[divisor.id]
                if e == 1:
                    return self.multiple(Number.rational(1) / c, Quotient(domain, arg(0), below))
                # The quotient a/(c x^e) is computed as 1/c times the product of a and x^-e.
                other = self.power(below, divisor, -e)
                return self.multiple(Number.rational(1) / c, Convolution(domain, arg(0), other))
            case "call" if node.payload == ANGLE:
                return Angle(domain, arg(0), arg(1))
            case "call" if node.payload == CHOOSE:
                return Chosen(domain, arg(0), arg(1), arg(2))
            case "call" if node.payload == ABSOLUTE:
                return Chosen(domain, arg(0), arg(0), Multiple(domain, Number.rational(-1), arg(0)))
            case "call" if isinstance(node.payload, PiecewisePolynomial):
                return composed(domain, node.payload, arg(0))
            case _:
                return self.function(node.payload, node.args[0], arg(0))

    @property
    def one(self) -> Series:
        """The constant series 1."""
        return Given(self.domain, self.domain.rational(1))

    def multiple(self, number: Number, a: Series) -> Series:
        """Return the product of ``number`` and the series ``a``."""
        return a if number.is_one else Multiple(self.domain, number, a)

    def power(self, a: Series, base: Expr, exponent: Fraction) -> Series:
        """Return the series of base^exponent, where ``a`` is the series of ``base``.

        Equal powers of one expression share one series.
        """
        if exponent == 1:
            return a
        # Each power is built only once, and stored in ``shared``.
        key = "power", base.id, exponent
        if key not in self.shared:
            if exponent == Fraction(1, 2):
                # ``Root`` computes a square root with about half of the products that ``Power`` would need.
                self.shared[key] = Root(self.domain, a)
            elif exponent == -1:
                # The power recurrence for the exponent -1 simplifies to the recurrence of the quotient 1/a.
                self.shared[key] = Quotient(self.domain, Given(self.domain, self.domain.rational(1)), a)
            elif exponent.denominator == 1 and exponent > 0:
                self.shared[key] = self.integer_power(a, int(exponent))
            else:
                self.shared[key] = Power(self.domain, a, exponent)
        return self.shared[key]

    def integer_power(self, a: Series, n: int) -> Series:
        """Return the series a^n for n >= 1, computed by repeated squaring."""
        result = a
        # ``bin(n)`` begins with "0b" and the leading bit 1.
        for bit in bin(n)[3:]:
            result = Square(self.domain, result)
            if bit == "1":
                result = Convolution(self.domain, result, a)
        return result

    def function(self, name: str, argument: Expr, a: Series) -> Series:
        """Return the series of the function ``name`` of ``argument``, where ``a`` is the series of
        ``argument``.

        SceneError is raised if no recurrence is known for the function.
        """
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
                # The recurrence of the sine contains the cosine, and the recurrence of the cosine contains
                # the sine.
                sine, cosine = (
                    Circular(domain, "sin", a, slope, False),
                    Circular(domain, "cos", a, slope, True),
                )
                sine.other, cosine.other = cosine, sine
                self.shared["sin", argument.id, Fraction(1)] = sine
                self.shared["cos", argument.id, Fraction(1)] = cosine
            case "sinh" | "cosh":
                # sinh' = cosh and cosh' = sinh.
                pair = [Antiderivative(domain, n, a, slope) for n in ("sinh", "cosh")]
                pair[0].rate, pair[1].rate = pair[1], pair[0]
                for series in pair:
                    self.shared[series.name, argument.id, Fraction(1)] = series
            case "tan" | "tanh":
                # tan' = 1 + tan^2 and tanh' = 1 - tanh^2
                result = Antiderivative(domain, name, a, slope)
                result.rate = Sum(domain, self.one, Square(domain, result), name == "tanh")
                self.shared[key] = result
            case "atan":
                result = Antiderivative(domain, name, a, slope)
                # The derivative of atan at a is 1/(1 + a^2).
                result.rate = Quotient(domain, self.one, Sum(domain, self.one, Square(domain, a), False))
                self.shared[key] = result
            case "asin" | "acos":
                result = Antiderivative(domain, name, a, slope)
                # The derivative of asin at a is (1 - a^2)^(-1/2), and acos' = -asin'.
                root = Power(domain, Sum(domain, self.one, Square(domain, a), True), Fraction(-1, 2))
                result.rate = root if name == "asin" else Multiple(domain, Number.rational(-1), root)
                self.shared[key] = result
            case _:
                raise SceneError(
                    f"no recurrence is known for the Taylor coefficients of {name}",
                    expected="formulas with + - * /, constant powers, and the functions "
                    f"{', '.join(MATHEMATICAL)}",
                )
        return self.shared[key]


class Recurrence:
    """Computes the Taylor coefficients in time of the solution y of a differential equation.

    Coefficient n belongs to s^n in the power series of y(t + s * ``scale``).

    - ``symbols`` are the names of the coordinates y, and ``state`` contains their values at the time t.
    - ``roots`` are the expressions of the derivatives of the first ``len(roots)`` coordinates. If ``roots``
      is shorter than ``symbols``, the caller must use :meth:`append` in place of :meth:`extend`.
    - ``values`` are the values of all other symbols, including the time ``t``.
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
        # ``closed=False`` means that :meth:`append` adds coefficients to the series.
        self.coordinates = [Given(domain, x, closed=False) for x in state]
        # As a power series in s, the time is t + s * ``scale``.
        self.time = Given(domain, values[TIME], scale)
        series: dict[str, Series] = dict(zip(symbols, self.coordinates, strict=True))
        self.builder = _Builder(domain, series | {TIME: self.time}, values)
        # An entry (c, a) of ``slopes`` consists of a number c and a series a. The derivative of a coordinate
        # is the product of c and a.
        self.slopes = [_apart(self.builder.of(root)) for root in roots]

    def extend(self, degree: int) -> list[list[Coefficient]]:
        """Return the coefficients 0, ..., degree of each coordinate.

        A coefficient that is identically zero is represented by None.
        """
        # The number of known coefficients is the same for all coordinates.
        for n in range(len(self.coordinates[0].terms) - 1, degree):
            self.append(self.following(n))
        return [coordinate.terms for coordinate in self.coordinates]

    def following(self, n: int) -> list[Coefficient]:
        """Return Taylor coefficient n + 1 of each coordinate whose derivative was given to the constructor.

        All coefficients up to n must be known.
        """
        factors: dict[object, Scalar] = {}
        new = []
        for number, slope in self.slopes:
            # Integration of s^n gives s^(n+1)/(n + 1).
            number = number * Number.rational(1, n + 1)
            # The product of ``number`` and ``scale`` is computed once for each value of ``number``.
            if number.key not in factors:
                factors[number.key] = self.domain.number(number) * self.scale
            new.append(multiplied(factors[number.key], slope.term(n)))
        return new

    def append(self, coefficients: Sequence[Coefficient]) -> None:
        """Append the next coefficient to the series of each coordinate."""
        for coordinate, x in zip(self.coordinates, coefficients, strict=True):
            coordinate.terms.append(x)

    def series(self, root: Expr) -> Series:
        """Return the power series of the expression ``root``.

        ``root`` may contain the coordinates, the time and all symbols in ``values``.
        """
        return self.builder.of(root)


def _apart(series: Series) -> tuple[Number, Series]:
    """Return a number and a series whose product is ``series``.

    A :class:`Multiple` is the product of a number and a series. If ``series`` is a :class:`Multiple`, the
    result contains these two factors. Otherwise the result contains the number 1 and ``series``.
    """
    return (series.number, series.a) if isinstance(series, Multiple) else (Number.rational(1), series)
