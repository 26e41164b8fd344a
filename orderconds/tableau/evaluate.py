"""Evaluation of the coefficients of a tableau file in one ring: Q, a number field, or balls (intervals).

The first of these rules that applies determines the ring:

- If the file contains a rounded decimal (``~``) or a double (``d``), all coefficients are balls.
- If all coefficients are rational, the ring is Q.
- The radicals and named roots in the coefficients generate a number field. If the degree of this field is at
  most :data:`orderconds.ring.tower.MAX_DEGREE`, the ring is this field.
- If the degree is larger, all coefficients are balls.

Equal expressions in one file are evaluated only once, so their values are the same Python object. Therefore
two coefficients are known to be equal if their ball is the same object. If the balls of two
coefficients are different objects and overlap, it is unknown whether the coefficients are equal.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Protocol

from msgspec import Struct

from orderconds.errors import TableauError
from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.grammar import MAX_DEPTH, Chain, Constant, Expression, Name, Power

MAX_SIZE = 40_000
"""The maximal size (:meth:`Scalars.size`) of an intermediate value."""


class NamedRoot(Struct, frozen=True):
    """A real root of a polynomial over Q. ``minpoly`` contains the coefficients of the polynomial, lowest
    power first. Exactly one real root must lie between ``near`` - u and ``near`` + u. Here u is one unit in
    the last digit of the decimal ``near``."""

    minpoly: tuple[Fraction, ...]
    near: Constant


Definition = Expression | NamedRoot


class Scalars(Protocol):
    """A ring for the evaluation of expressions, for example the ring of balls or a number field. If an
    expression contains a root that is not in the number field, the number field is extended by this root."""

    def constant(self, value: Fraction, unit: Fraction) -> Element:
        """Return the rational number ``value`` if its uncertainty ``unit`` is zero. Otherwise, return the
        ball of radius ``unit`` around ``value``."""

    def root(self, x: Element, index: int) -> Element:
        """Return the real root of x with the given index (2 for the square root, 3 for the cube root). Raises
        ValueError if x is negative and the index is even."""

    def named_root(self, minpoly: Sequence[Fraction], near: Fraction, unit: Fraction, name: str) -> Element:
        """Return the real root of ``minpoly`` whose distance from ``near`` is at most ``unit``. Raises
        ValueError if there is no such root or more than one."""

    def size(self, x: Element) -> int:
        """Return the number of bits of the largest numerator or denominator in x. For a ball, take the binary
        exponents of the midpoint and the radius, and return the larger absolute value."""


def evaluate(
    expressions: Mapping[str, Expression], numbers: Mapping[str, Definition], where: str
) -> tuple[Ring, dict[str, Element]]:
    """Return a ring and the values of ``expressions`` in this ring. The keys of ``expressions`` are positions
    in the tableau file, such as ``A[2][1]``.

    ``numbers`` contains the named numbers of the file. Raises :class:`TableauError` if a number has no value,
    for example after a division by zero or in a cycle of definitions.

    >>> from orderconds.tableau.grammar import parse
    >>> ring, values = evaluate({"a": parse("sqrt(g)/2", "")}, {"g": Constant(Fraction(3))}, "")
    >>> ring.text(values["a"] * values["a"])
    '3/4'
    """
    from orderconds.ring.tower import DegreeError, Tower

    constants = [c for x in (*expressions.values(), *numbers.values()) for c in rounded_and_exact(x)]
    if not any(c.unit for c in constants):
        tower = Tower()
        try:
            evaluation = _Evaluation(tower, numbers, where)
            values = evaluation.all(expressions)
            ring, lift = tower.ring()
            # Numbers that no coefficient uses must not enlarge the field of the coefficients. Hence these
            # numbers are evaluated only after the construction of the field.
            evaluation.check_unused()
            return ring, _shared(values, lift)
        except DegreeError:
            pass
    from orderconds.ring.balls import Balls

    balls = Balls(_bits(constants))
    evaluation = _Evaluation(balls, numbers, where)
    values = evaluation.all(expressions)
    evaluation.check_unused()
    return balls, values


def evaluate_in(
    scalars: Scalars, expressions: Mapping[str, Expression], numbers: Mapping[str, Definition], where: str
) -> dict[str, Element]:
    """Return the values of ``expressions`` in the ring ``scalars``. ``numbers`` contains the named numbers of
    the file. Raises :class:`TableauError` if an expression has no value, for example after a division by
    zero.

    >>> from orderconds.ring.balls import Balls
    >>> from orderconds.tableau.grammar import parse
    >>> R = Balls(64)
    >>> R.approximate(evaluate_in(R, {"a": parse("2^(1/2)", "")}, {}, "")["a"], 10)
    '1.414213562'
    """
    return _Evaluation(scalars, numbers, where).all(expressions)


def _shared(values: Mapping[str, Element], lift: Callable[[Element], Element]) -> dict[str, Element]:
    """Convert the values by the function ``lift``. Keys that share a value object also share the result."""
    lifted = {id(x): lift(x) for x in values.values()}
    return {key: lifted[id(x)] for key, x in values.items()}


def rounded_and_exact(x: Definition) -> Iterator[Constant]:
    """Yield every constant in an expression: exact numbers, rounded decimals and doubles. The uncertainty of
    a constant c is ``c.unit``.

    >>> from orderconds.tableau.grammar import parse
    >>> [str(c.unit) for c in rounded_and_exact(parse("1/2 + 0.25~", ""))]
    ['0', '0', '1/100']
    """
    if isinstance(x, Constant):
        yield x
    elif isinstance(x, Chain):
        for operand in x.operands:
            yield from rounded_and_exact(operand)
    elif isinstance(x, Power):
        yield from rounded_and_exact(x.base)


def _bits(constants: Sequence[Constant]) -> int:
    """Return a working precision in bits that exceeds the precision of every constant by at least 64 bits."""
    return max([256, *(64 + 4 * len(str(c.unit.denominator)) for c in constants)])


class _Evaluation:
    """The values of expressions in one ring."""

    def __init__(self, scalars: Scalars, numbers: Mapping[str, Definition], where: str) -> None:
        self.scalars, self.numbers, self.where = scalars, numbers, where
        self.known: dict[Expression, Element] = {}
        self.open: list[str] = []
        self.place = ""

    def error(self, problem: str, expected: str) -> TableauError:
        return TableauError(problem, where=f"{self.where}: {self.place}", expected=expected)

    def all(self, expressions: Mapping[str, Expression]) -> dict[str, Element]:
        result = {}
        for self.place, expression in expressions.items():
            result[self.place] = self.value(expression)
        return result

    def check_unused(self) -> None:
        """Evaluate all named numbers, to report errors in numbers that no coefficient uses."""
        for name in self.numbers:
            self.place = f"numbers.{name}"
            self.value(Name(name))

    def value(self, x: Expression) -> Element:
        value = self.known.get(x)
        if value is None:
            value = self.known[x] = self.bounded(self.compute(x))
        return value

    def bounded(self, value: Element) -> Element:
        if self.scalars.size(value) > MAX_SIZE:
            raise self.error("a number that is too large", f"integers of at most {MAX_SIZE} bits")
        return value

    def compute(self, x: Expression) -> Element:
        if isinstance(x, Constant):
            return self.scalars.constant(x.value, x.unit)
        if isinstance(x, Name):
            return self.named(x.name)
        if isinstance(x, Power):
            return self.power(self.value(x.base), x.exponent)
        result = self.value(x.operands[0])
        for operator, operand in zip(x.operators, x.operands[1:], strict=True):
            result = self.bounded(self.joined(result, operator, self.value(operand)))
        return result

    def joined(self, left: Element, operator: str, right: Element) -> Element:
        if operator == "+":
            return left + right
        if operator == "-":
            return left - right
        if operator == "*":
            return left * right
        try:
            return left / right
        except ZeroDivisionError:
            raise self.error("division by zero", "a divisor that is not zero") from None

    def power(self, base: Element, exponent: Fraction) -> Element:
        if self.scalars.size(base) * abs(exponent.numerator) > MAX_SIZE:
            raise self.error(
                f"a power that is too large (exponent {exponent})",
                f"integers of at most {MAX_SIZE} bits",
            )
        try:
            root = self.scalars.root(base, exponent.denominator) if exponent.denominator > 1 else base
            return root**exponent.numerator
        except ZeroDivisionError:
            raise self.error("division by zero", "a divisor that is not zero") from None
        except ValueError as problem:
            raise self.error(str(problem), "a real number") from None

    def named(self, name: str) -> Element:
        if name not in self.numbers:
            defined = ", ".join(self.numbers) or "none"
            raise self.error(
                f"the name {name!r}",
                f"a number, or a name from the table [numbers] (defined names: {defined})",
            )
        if name in self.open:
            raise self.error(f"circular definitions: {' -> '.join([*self.open, name])}", "no cycle")
        if len(self.open) >= MAX_DEPTH:
            first, second = self.open[:2]
            raise self.error(
                f"a chain of more than {MAX_DEPTH} definitions: {first} -> {second} -> ... -> {name}",
                "a shorter chain",
            )
        definition = self.numbers[name]
        self.open.append(name)
        try:
            if isinstance(definition, NamedRoot):
                return self.isolated(definition, name)
            return self.value(definition)
        finally:
            self.open.pop()

    def isolated(self, root: NamedRoot, name: str) -> Element:
        try:
            return self.scalars.named_root(root.minpoly, root.near.value, root.near.unit, name)
        except ValueError as problem:
            raise self.error(str(problem), "minpoly with exactly one real root near the decimal") from None
