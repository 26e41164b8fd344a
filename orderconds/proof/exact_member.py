"""Conditions at one random member of a file's sub-family, exactly: where combinations of them are verified.

The member is that of :mod:`orderconds.tableau.random_member`, over Q, or over Q(sqrt(d)) where the square
root of a rational is the only radical of the file.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from operator import mul
from typing import Any

from orderconds.conditions import OrderCondition
from orderconds.errors import TableauError
from orderconds.families import Family, in_ring
from orderconds.ring.draws import Draws
from orderconds.ring.protocol import Element, Ring
from orderconds.ring.tower import DegreeError, Tower
from orderconds.tableau.evaluate import NamedRoot, evaluate_in, rounded_and_exact
from orderconds.tableau.grammar import Constant
from orderconds.tableau.products import Method
from orderconds.tableau.random_member import OUTSIDE, RandomMember, radicals
from orderconds.tableau.unknowns import Spelled

Reading = Callable[[Method, Ring], Method]
"""Turns a file's method over a ring into the method that a family evaluates."""

Monomial = tuple[OrderCondition, ...]
"""The product of the left-hand sides of conditions."""

Combination = Mapping[Monomial, tuple[Fraction, Fraction]]
"""Monomials with their coefficients x + y sqrt(d)."""


@dataclass(frozen=True)
class Surd:
    """The square root of a rational number that is the only radical of a file, in the field it generates."""

    radicand: Fraction
    ring: Ring
    root: Element


def lone_square_root(formulas: Spelled) -> Surd | None:
    """Return the only radical of a file where it is the square root of an exact rational, else None.

    >>> from orderconds.tableau import Tableau
    >>> text = 'name = "m"\\nfamily = "rk"\\nA = [["0.5~"]]\\nb = ["sqrt(12)"]\\n'
    >>> proof = Tableau.loads(text + '[proof]\\nconditions = "rk"\\norder = 1').proof
    >>> found = lone_square_root(proof.spelled)
    >>> found.radicand, found.ring.text(found.root * found.root)
    (Fraction(12, 1), '12')
    """
    different = radicals(formulas)
    if len(different) != 1 or different[0].exponent.denominator != 2:
        return None
    exact = {name: x for name, x in formulas.numbers.items() if not any(c.unit for c in rounded_and_exact(x))}
    tower = Tower()
    try:
        inside: Any = evaluate_in(tower, {"radicand": different[0].base}, exact, formulas.where)["radicand"]
        if not inside.is_rational:
            return None
        radicand = inside.rational_value
        root = tower.root(tower.rational(int(radicand.p), int(radicand.q)), 2)
    except (TableauError, TypeError, ValueError, DegreeError):
        return None
    ring, lift = tower.ring()
    return Surd(Fraction(int(radicand.p), int(radicand.q)), ring, lift(root))


@dataclass(frozen=True)
class ExactMember:
    """The left-hand sides of conditions at one member; ``surd`` is the square root in coefficients."""

    ring: Ring
    values: Mapping[OrderCondition, Element]
    surd: Surd | None

    def holds(self, condition: OrderCondition) -> bool:
        """Say whether a condition holds here, hence at every member."""
        return self.ring.is_zero(self.values[condition] - in_ring(self.ring, condition.rhs)) is True

    def verifies(self, condition: OrderCondition, combination: Combination | None) -> bool:
        """Say whether a combination gives the left-hand side here, and the right-hand side.

        Where the conditions in it hold, ``condition`` then holds, for every member.
        """
        if combination is None:
            return False
        left, right = self.values[condition], in_ring(self.ring, condition.rhs)
        for monomial, (x, y) in combination.items():
            scale = in_ring(self.ring, x)
            if self.surd is not None and y:
                scale = scale + self.surd.root * in_ring(self.ring, y)
            left = left - reduce(mul, (self.values[c] for c in monomial), scale)
            right = right - reduce(mul, (in_ring(self.ring, c.rhs) for c in monomial), scale)
        return self.ring.is_zero(left) is True and self.ring.is_zero(right) is True


def exact_member(
    family: Family,
    formulas: Spelled,
    conditions: Sequence[OrderCondition],
    draws: Draws,
    surd: Surd | None,
    read: Reading | None = None,
) -> ExactMember | None:
    """Return a random member of the sub-family that ``formulas`` describes.

    None where it cannot be evaluated: its numbers explode, or a divisor is zero.
    """
    try:
        method, ring = _member(formulas, draws, surd)
        left = family.evaluate(method if read is None else read(method, ring), ring, conditions)
    except OUTSIDE:
        return None
    return ExactMember(ring, dict(zip(conditions, left, strict=True)), surd)


def _member(formulas: Spelled, draws: Draws, surd: Surd | None) -> tuple[Method, Ring]:
    if surd is None:
        ring = RandomMember(formulas, draws)
        return ring.method(), ring
    values = evaluate_in(
        _Scalars(formulas, draws, surd), formulas.expressions, formulas.numbers, formulas.where
    )
    return formulas.build(values, surd.ring)[0], surd.ring


class _Scalars:
    """Numbers drawn over the field that a square root generates."""

    def __init__(self, formulas: Spelled, draws: Draws, surd: Surd) -> None:
        self._drawn, self._surd = RandomMember(formulas, draws), surd

    def constant(self, value: Fraction, unit: Fraction) -> Element:
        if unit:
            return self._surd.ring.rational(int(self._drawn.variable(Constant(value, unit)).p))
        return self._surd.ring.rational(value.numerator, value.denominator)

    def root(self, x: Element, index: int) -> Element:
        return self._surd.root

    def named_root(self, minpoly: Any, near: Fraction, unit: Fraction, name: str) -> Element:
        return self._surd.ring.rational(int(self._drawn.named_root(minpoly, near, unit, name).p))

    def size(self, x: Any) -> int:
        return self._drawn.size(x) if self._surd.ring.name == "QQ" else Tower().size(x)


def constants(formulas: Spelled) -> Iterator[Constant]:
    """Yield every constant of a file.

    >>> from orderconds.tableau import Tableau
    >>> text = 'name = "m"\\nfamily = "rk"\\nA = [["0.5~"]]\\nb = ["1"]\\n'
    >>> proof = Tableau.loads(text + '[proof]\\nconditions = "rk"\\norder = 1').proof
    >>> [str(c.value) for c in constants(proof.spelled)]
    ['1/2', '1']
    """
    for x in (*formulas.expressions.values(), *formulas.numbers.values()):
        if isinstance(x, NamedRoot):
            yield from (Constant(c) for c in x.minpoly)
        else:
            yield from rounded_and_exact(x)
