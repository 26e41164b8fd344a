"""One member of a file's sub-family, exact: numbers of 128 bits in place of its decimals and radicals.

An identity between rational functions of degree at most D that is false holds at a point drawn from 2^128
values a coordinate with probability at most D / 2^128 (Schwartz 1980; Zippel 1979). The numbers come from a
digest of the file, so that a search for a file whose own point deceives has no chance either. Arithmetic is
over Q, or over Q(sqrt(d)) where the square root of a rational is the file's one radical: no prime enters.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from operator import mul
from typing import Any

from flint import fmpq

from orderconds.conditions import OrderCondition
from orderconds.errors import InputError, TableauError
from orderconds.families import Family, in_ring
from orderconds.proof.draws import Draws
from orderconds.ring.protocol import Element, Ring
from orderconds.ring.rationals import QQ
from orderconds.ring.tower import DegreeError, Tower
from orderconds.tableau.evaluate import NamedRoot, evaluate_in, rounded_and_exact
from orderconds.tableau.grammar import Constant
from orderconds.tableau.indeterminates import radicals
from orderconds.tableau.products import Method
from orderconds.tableau.unknowns import Spelled

Reading = Callable[[Method, Ring], Method]
"""Turns a file's method over a ring into the method that a family evaluates."""

Monomial = tuple[OrderCondition, ...]
"""The product of the left-hand sides of conditions."""

Combination = Mapping[Monomial, tuple[Fraction, Fraction]]
"""Monomials with their coefficients x + y sqrt(d)."""

BITS = 128
"""Size of the numbers drawn; a degree stays far below 2^40, since values are bounded in size."""


@dataclass(frozen=True)
class Surd:
    """The square root of a rational number that is the only radical of a file, in the field it generates."""

    radicand: Fraction
    ring: Ring
    root: Element


def lone_square_root(spelled: Spelled) -> Surd | None:
    """Return the only radical of a file where it is the square root of an exact rational, else None.

    >>> from orderconds.tableau import Tableau
    >>> text = 'name = "m"\\nfamily = "rk"\\nA = [["0.5~"]]\\nb = ["sqrt(12)"]\\n'
    >>> proof = Tableau.loads(text + '[proof]\\nconditions = "rk"\\norder = 1').proof
    >>> found = lone_square_root(proof.spelled)
    >>> found.radicand, found.root * found.root
    (Fraction(12, 1), Algebraic(12))
    """
    different = radicals(spelled)
    if len(different) != 1 or different[0].exponent.denominator != 2:
        return None
    exact = {name: x for name, x in spelled.numbers.items() if not any(c.unit for c in rounded_and_exact(x))}
    tower = Tower()
    try:
        inside: Any = evaluate_in(tower, {"radicand": different[0].base}, exact, spelled.where)["radicand"]
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
    spelled: Spelled,
    conditions: Sequence[OrderCondition],
    draws: Draws,
    surd: Surd | None,
    read: Reading | None = None,
) -> ExactMember | None:
    """Return a random member of the sub-family that ``spelled`` describes.

    None where it cannot be evaluated: its numbers explode, or a divisor is zero.
    """
    scalars = _Scalars(draws, surd)
    try:
        values = evaluate_in(scalars, spelled.expressions, spelled.numbers, spelled.where)
        method: Any = spelled.build(values, scalars.ring)[0]
        member = method if read is None else read(method, scalars.ring)
        left = family.evaluate(member, scalars.ring, conditions)
    except (InputError, ZeroDivisionError):
        return None
    return ExactMember(scalars.ring, dict(zip(conditions, left, strict=True)), surd)


def constants(spelled: Spelled) -> Iterator[Constant]:
    """Yield every constant of a file.

    >>> from orderconds.tableau import Tableau
    >>> text = 'name = "m"\\nfamily = "rk"\\nA = [["0.5~"]]\\nb = ["1"]\\n'
    >>> proof = Tableau.loads(text + '[proof]\\nconditions = "rk"\\norder = 1').proof
    >>> [str(c.value) for c in constants(proof.spelled)]
    ['1/2', '1']
    """
    for x in (*spelled.expressions.values(), *spelled.numbers.values()):
        if isinstance(x, NamedRoot):
            yield from (Constant(c) for c in x.minpoly)
        else:
            yield from rounded_and_exact(x)


class _Scalars:
    """Rationals as the file has them; decimals, radicals and named roots drawn, each once."""

    def __init__(self, draws: Draws, surd: Surd | None) -> None:
        self._draws, self._surd = draws, surd
        self.ring: Ring = QQ if surd is None else surd.ring

    def constant(self, value: Fraction, unit: Fraction) -> Element:
        if unit:
            return self._drawn(f"decimal {value} {unit}")
        return self.ring.rational(value.numerator, value.denominator)

    def root(self, x: Element, index: int) -> Element:
        if self._surd is not None and index == 2:
            return self._surd.root
        return self._drawn(f"root {index} {self.ring.text(x)}")

    def named_root(self, minpoly: Any, near: Fraction, unit: Fraction, name: str) -> Element:
        return self._drawn(f"named {name}")

    def size(self, x: Any) -> int:
        """Return the bits of the largest integer in x."""
        if isinstance(x, fmpq):
            return max(int(x.p).bit_length(), int(x.q).bit_length())
        polynomial = x.polynomial
        return max(int(polynomial.numer().height_bits()), int(polynomial.denom().bit_length()))

    def _drawn(self, name: str) -> Element:
        return self.ring.rational(self._draws.number(name, BITS))


def description(family: Family, spelled: Spelled, order: int) -> str:
    """Return a text that fixes every function of which dependences are computed."""
    return repr((family.label(), order, [*spelled.expressions.items()], [*spelled.numbers.items()]))
