"""The recurrence of Taylor coefficients as a loop over the order n.

Coefficient n of the product of two series a and b is a_0 b_n + a_n b_0 plus the inner sum. The inner sum is
the sum of a_j b_{n-j} over 0 < j < n, and contains only coefficients of lower orders. For each order n, the
emitted loop first computes all inner sums, and then coefficient n of every expression.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from codegen.ir.expr import Expr, Space
from codegen.ir.number import Number
from codegen.ir.selection import CHOOSE
from codegen.ir.taylor_recurrence import Recurrence
from codegen.ir.taylor_series import (
    Angle,
    Antiderivative,
    Chosen,
    Circular,
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
    Start,
    Sum,
)

ORDER, INVERSE, NEXT, LINEAR = "order.n", "inverse.n", "next.n", "linear.n"
"""The names of four symbols in the loop over n. They denote n, 1/n, 1/(n + 1), and coefficient n of the
Taylor series of the time t. Coefficient n of the time is 1 for n = 1, and 0 for n > 1.
"""

PROBED = 3
"""A series counts as constant in time if its coefficients 1, ..., ``PROBED`` - 1 are identically zero."""


@dataclass(frozen=True)
class OrderLoop:
    """The expressions of a loop over the order n = 1, 2, ....

    - ``first`` are expressions that are computed before the loop.
    - ``names`` are the names of the symbols that represent the values of ``first`` in the loop.
    - ``coordinates`` contains one symbol name for each coordinate. The symbol denotes coefficient n of the
      Taylor series of this coordinate.
    - ``sums[k]`` is the name of the symbol for inner sum k, the sum of a_j b_{n-j} over 0 < j < n. Each inner
      sum has its own pair of series a and b.
    - ``left[k]`` is the expression for coefficient n of the series a in inner sum k.
    - ``right[k]`` is the expression for coefficient n of the series b in inner sum k.
    - ``start`` are the expressions for coefficient 1 of each coordinate.
    - ``following`` are the expressions for coefficient n + 1 of each coordinate.
    """

    names: tuple[str, ...]
    first: tuple[Expr, ...]
    start: tuple[Expr, ...]
    coordinates: tuple[str, ...]
    sums: tuple[str, ...]
    left: tuple[Expr, ...]
    right: tuple[Expr, ...]
    following: tuple[Expr, ...]


def order_loop(recurrence: Recurrence, space: Space) -> OrderLoop:
    """Return the expressions of the loop that computes the coefficients of ``recurrence``.

    The scalars of ``recurrence`` must be expressions of ``space``, and ``recurrence.scale`` must be 1.
    """
    # The method ``_Loop.constant`` later reads the coefficients 1, ..., ``PROBED`` - 1.
    start = [space.zero if row[1] is None else row[1] for row in recurrence.extend(PROBED)]
    work = _Loop(recurrence, space)
    # Coefficient n + 1 of a coordinate is 1/(n + 1) times coefficient n of the derivative of the coordinate.
    scale = space.sym(NEXT)
    following = []
    for number, slope in recurrence.slopes:
        x = work.of(slope)
        # If ``x`` is None, coefficient n of the derivative is zero.
        following.append(space.zero if x is None else scale * (space.const(number) * x))
    left, right = [], []
    # ``work.of`` may append pairs to ``work.pairs`` during this loop.
    for a, b in work.pairs:
        left.append(_known(work.of(a)))
        right.append(_known(work.of(b)))
    count = len(work.pairs)
    return OrderLoop(
        tuple(f"first.{k}" for k in range(len(work.first))),
        tuple(work.first),
        tuple(start),
        coordinate_names(len(recurrence.coordinates)),
        tuple(f"sum.{k}" for k in range(count)),
        tuple(left),
        tuple(right),
        tuple(following),
    )


def coordinate_names(count: int) -> tuple[str, ...]:
    """Return one symbol name for each of ``count`` coordinates.

    In the loop over the order n, the symbol denotes coefficient n of the Taylor series of its coordinate.
    """
    return tuple(f"coefficient.{i}" for i in range(count))


def _known(x: Expr | None) -> Expr:
    assert x is not None, "a coefficient of a constant series was requested"
    return x


@dataclass
class _Loop:
    """Builds the expression for coefficient n of each series.

    - ``pairs`` contains pairs (a, b) of series. For each pair, the loop computes an inner sum: the sum of the
      products a_j b_{n-j} over 0 < j < n.
    - ``first`` are expressions that are computed before the loop over n.
    - ``known`` maps the id of a series to its coefficient n, or to None if the series is constant.
    - ``places`` maps the ids of a pair of series to the index of the pair in ``pairs``.
    - ``positions`` maps the id of an expression to the index of the expression in ``first``.
    """

    recurrence: Recurrence
    space: Space
    pairs: list[tuple[Series, Series]] = field(default_factory=list)
    first: list[Expr] = field(default_factory=list)
    known: dict[int, Expr | None] = field(default_factory=dict)
    places: dict[tuple[int, int], int] = field(default_factory=dict)
    positions: dict[int, int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        # In pass n of the emitted loop, coefficient n of each coordinate is already known.
        coordinates = self.recurrence.coordinates
        for name, coordinate in zip(coordinate_names(len(coordinates)), coordinates, strict=True):
            self.known[id(coordinate)] = self.space.sym(name)
        # The symbol ``LINEAR`` denotes the n-th Taylor coefficient of the time t. This coefficient is 1 for
        # n = 1, and 0 for n > 1.
        self.known[id(self.recurrence.time)] = self.space.sym(LINEAR)

    def of(self, root: Series) -> Expr | None:
        """Return the expression that computes coefficient n of ``root`` in pass n of the loop.

        If ``root`` is constant, return None.
        """
        # An explicit stack is used in place of recursion, because series may be nested deeply.
        waiting = [root]
        while waiting:
            series = waiting[-1]
            # A series may be on the stack several times, if several series depend on it.
            if id(series) in self.known:
                waiting.pop()
            elif self.constant(series):
                # In ``known``, None represents a series that is constant in time.
                self.known[id(series)] = None
            else:
                missing = [x for x in _operands(series) if id(x) not in self.known]
                waiting += missing
                if not missing:
                    self.known[id(series)] = self.built(series)
        return self.known[id(root)]

    def constant(self, series: Series) -> bool:
        """Return True if coefficients 1, ..., :data:`PROBED` - 1 of a series are identically zero."""
        # None represents a coefficient that is identically zero.
        return all(series.term(n) is None for n in range(1, PROBED))

    def value(self, x: Expr) -> Expr:
        """Return ``x`` if ``x`` is a number, otherwise a symbol for the value of ``x``.

        The emitted code computes the value of ``x`` before the loop.
        """
        if x.op == "const":
            return x
        if x.id not in self.positions:
            self.positions[x.id] = len(self.first)
            self.first.append(x)
        return self.space.sym(f"first.{self.positions[x.id]}")

    def inner(self, a: Series, b: Series) -> Expr:
        """Return the symbol for the inner sum of a and b, the sum of a_j b_{n-j} over 0 < j < n."""
        # If a and b are exchanged, the sum does not change. Therefore (a, b) and (b, a) get the same key.
        key = min(id(a), id(b)), max(id(a), id(b))
        if key not in self.places:
            self.places[key] = len(self.pairs)
            self.pairs.append((a, b))
        return self.space.sym(f"sum.{self.places[key]}")

    def product(self, a: Series, b: Series) -> Expr:
        """Return coefficient n of the product of the series a and b."""
        x, y = self.known[id(a)], self.known[id(b)]
        if x is None or y is None:
            # If one factor is a constant c, the coefficients of the other factor are multiplied by c.
            constant, other = (a, y) if x is None else (b, x)
            return self.value(constant.term(0)) * _known(other)
        # The inner sum does not contain a_0 b_n and a_n b_0, the terms for j = 0 and j = n.
        return self.inner(a, b) + (self.value(a.term(0)) * y + x * self.value(b.term(0)))

    def beyond(self, a: Series, b: Series) -> Expr:
        """Return the sum of a_j b_{n-j} over 0 < j <= n."""
        # The term for j = n is a_n b_0.
        return self.inner(a, b) + _known(self.known[id(a)]) * self.value(b.term(0))

    def built(self, series: Series) -> Expr:
        """Return the expression that computes coefficient n of ``series`` in pass n of the emitted loop."""
        space = self.space
        match series:
            case Sum(a=a, b=b, minus=minus):
                x, y = (self.known[id(s)] for s in (a, b))
                if x is None or y is None:
                    # A constant operand contributes only to coefficient 0.
                    return _known(x) if y is None else -y if minus else y
                return x - y if minus else x + y
            case Multiple(number=number, a=a):
                return space.const(number) * _known(self.known[id(a)])
            case Convolution(a=a, b=b):
                return self.product(a, b)
            case Square(a=a):
                x = _known(self.known[id(a)])
                # The terms a_0 a_n and a_n a_0 are equal, so one of them is doubled.
                return self.inner(a, a) + space.const(Number.rational(2)) * (self.value(a.term(0)) * x)
            case Slope(a=a):
                # If a(s) is the sum of a_n s^n, then s times a'(s) is the sum of n a_n s^n.
                return space.sym(ORDER) * _known(self.known[id(a)])
            case Quotient(a=a, b=b):
                x = self.known[id(a)]
                # For a constant divisor b, coefficient n of the quotient is a_n/b_0.
                if self.known[id(b)] is None:
                    return self.value(series.inverse) * _known(x)
                # The quotient ``series.inverse`` = 1/b_0 is computed before the loop, because a division in
                # the loop would be slow.
                rest = self.beyond(b, series)
                return self.value(series.inverse) * (-rest if x is None else x - rest)
            case _:
                return self.function(series)

    def function(self, series: Series) -> Expr:
        """Return the expression that computes coefficient n of ``series`` in pass n of the emitted loop.

        ``series`` must be a function of other series, for example a square root, a power or a sine.
        """
        space = self.space
        match series:
            case Root(a=a):
                # This is the recurrence for the Taylor coefficients of a square root.
                return self.value(series.inverse) * (_known(self.known[id(a)]) - self.inner(series, series))
            case Power(a=a, slope=slope, exponent=exponent):
                # This is the recurrence for the Taylor coefficients of a power.
                factor = space.const(Number.rational(*(exponent + 1).as_integer_ratio())) * space.sym(INVERSE)
                rest = factor * self.beyond(slope, series) - self.beyond(a, series)
                return self.value(series.inverse) * rest
            case Exponential(slope=slope):
                # The exponential satisfies e' = a' e, so n e_n is the sum of j a_j e_{n-j} over 0 < j <= n.
                return space.sym(INVERSE) * self.beyond(slope, series)
            case Circular(slope=slope, other=other, minus=minus):
                # ``minus`` is true for the cosine, because the derivative of the cosine is minus the sine.
                mean = space.sym(INVERSE) * self.beyond(slope, other)
                return -mean if minus else mean
            case Chosen(test=test, a=a, b=b):
                # If ``test`` is positive at the beginning of the step, the result is a_n, otherwise b_n.
                pair = (space.zero if x is None else x for x in (self.known[id(a)], self.known[id(b)]))
                return space.call(CHOOSE, self.value(test.term(0)), *pair)
            case Angle(slopes=slopes, rates=rates):
                pairs = zip(slopes, rates, strict=True)
                # The derivative of the angle is (x y' - y x')/(x^2 + y^2). If y is constant, the term with y'
                # is omitted. If x is constant, the term with x' is omitted.
                means = [self.beyond(s, r) for s, r in pairs if self.known[id(s)] is not None]
                if len(means) == 2:
                    return space.sym(INVERSE) * (means[0] - means[1])
                # One coordinate of the point (x, y) is constant, so only one of the two terms of x y' - y x'
                # remains. The term with x' has a minus sign.
                (mean,) = means
                return space.sym(INVERSE) * (mean if self.known[id(slopes[0])] is not None else -mean)
            case Antiderivative(slope=slope, rate=rate):
                # The series is f(a), and ``rate`` is f'(a), so the chain rule gives the recurrence.
                return space.sym(INVERSE) * self.beyond(slope, rate)
            case Logarithm(a=a, slope=slope):
                # For the logarithm l of a, l_n = (a_n - z/n)/a_0, where z is the sum of j l_j a_{n-j} over
                # 0 < j < n.
                rest = space.sym(INVERSE) * self.inner(slope, a)
                return self.value(series.inverse) * (_known(self.known[id(a)]) - rest)
        raise AssertionError(type(series))


def _operands(series: Series) -> Sequence[Series]:
    """Return all series whose coefficient n is needed to compute coefficient n of ``series``."""
    match series:
        case Sum(a=a, b=b) | Convolution(a=a, b=b) | Quotient(a=a, b=b):
            return a, b
        case Power(a=a, slope=slope):
            return a, slope
        case Exponential(slope=slope) | Circular(slope=slope) | Antiderivative(slope=slope):
            # Coefficient n of the sine does not need coefficient n of the cosine.
            return (slope,)
        case Chosen(a=a, b=b):
            return a, b
        case Angle(slopes=slopes):
            return slopes
        case Multiple(a=a) | Square(a=a) | Slope(a=a) | Root(a=a) | Logarithm(a=a):
            # Coefficient n of ``series`` depends on coefficient n of ``a``.
            return (a,)
        case Given() | Start():
            return ()
    raise AssertionError(type(series))
