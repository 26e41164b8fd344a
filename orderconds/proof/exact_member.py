"""Exact verification that the left-hand side of one order condition is a polynomial in the left-hand sides of
other conditions.

The left-hand sides are evaluated in exact arithmetic for one random method. A wrong polynomial passes the
verification only with negligible probability.

The formulas in a tableau file define a sub-family of methods. The random method is a *member* of the
sub-family. If sqrt(d) is the only radical in the file, the coefficients of a random member are in Q(sqrt(d)).
Otherwise random rational numbers replace all radicals, and the coefficients are in Q.
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
from orderconds.tableau.unknowns import SymbolicCoefficients

Reading = Callable[[Method, Ring], Method]
"""A function that converts a method from the format of the tableau file to the format in which a family
evaluates its conditions."""

Monomial = tuple[OrderCondition, ...]
"""A product of left-hand sides of conditions, represented by the tuple of the conditions."""

Combination = Mapping[Monomial, tuple[Fraction, Fraction]]
"""A polynomial in the left-hand sides of conditions, as a map from monomials to coefficients. A pair (x, y)
denotes the coefficient x + y sqrt(d), where d is :attr:`Surd.radicand`."""


@dataclass(frozen=True)
class Surd:
    """A square root that is the only radical in the formulas of a tableau file.

    - ``radicand``: the rational number d under the root.
    - ``ring``: the field Q(sqrt(d)).
    - ``root``: the element sqrt(d) of ``ring``.
    """

    radicand: Fraction
    ring: Ring
    root: Element


def lone_square_root(symbolic: SymbolicCoefficients) -> Surd | None:
    """If the formulas of a tableau file contain exactly one radical, and this radical is the square root of
    an exact rational number, return the radical. Otherwise, return None.

    >>> from orderconds.tableau import Tableau
    >>> text = 'name = "m"\\nfamily = "rk"\\nA = [["0.5~"]]\\nb = ["sqrt(12)"]\\n'
    >>> proof = Tableau.loads(text + '[proof]\\nconditions = "rk"\\norder = 1').proof
    >>> surd = lone_square_root(proof.symbolic)
    >>> surd.radicand, surd.ring.text(surd.root * surd.root)
    (Fraction(12, 1), '12')
    """
    different = radicals(symbolic)
    if len(different) != 1 or different[0].exponent.denominator != 2:
        return None
    exact = {name: x for name, x in symbolic.numbers.items() if not any(c.unit for c in rounded_and_exact(x))}
    tower = Tower()
    try:
        inside: Any = evaluate_in(tower, {"radicand": different[0].base}, exact, symbolic.where)["radicand"]
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
    """The left-hand sides of conditions, evaluated at one random member (method) of a sub-family. If the
    coefficients of the member contain a square root, ``surd`` is this square root, else None."""

    ring: Ring
    values: Mapping[OrderCondition, Element]
    surd: Surd | None

    def holds(self, condition: OrderCondition) -> bool:
        """Return True if ``self.values[condition]``, the left-hand side of ``condition`` for a random method,
        is equal to the right-hand side."""
        return self.ring.is_zero(self.values[condition] - in_ring(self.ring, condition.rhs)) is True

    def verifies(self, condition: OrderCondition, combination: Combination | None) -> bool:
        """Return True if the polynomial ``combination`` expresses ``condition`` through other conditions.

        The variables of the polynomial are the left-hand sides of order conditions. The dictionary
        ``self.values`` contains the left-hand sides for one random method. Two equalities are tested. First,
        insert these values into the polynomial. The result must be equal to the left-hand side of
        ``condition`` for the random method. Second, insert the right-hand sides of the order conditions into
        the polynomial in place of the left-hand sides. The result must be equal to the right-hand side of
        ``condition``. The test is probabilistic: a wrong ``combination`` passes only with negligible
        probability. Return False if ``combination`` is None.
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
    symbolic: SymbolicCoefficients,
    conditions: Sequence[OrderCondition],
    draws: Draws,
    surd: Surd | None,
    read: Reading | None = None,
) -> ExactMember | None:
    """Evaluate the left-hand sides of ``conditions`` for a random method of the sub-family ``symbolic``.

    ``surd`` is the result of :func:`lone_square_root`. Return None if the numbers become too large or a
    divisor is zero.

    >>> from orderconds import families
    >>> from orderconds.proof.subfamily import decisive_conditions
    >>> from orderconds.tableau import Tableau
    >>> text = 'name = "m"\\nfamily = "rk"\\nA = [["b1/2"], ["b1", "b2/2"]]\\nb = ["b1", "b2"]\\n'
    >>> text += '[numbers]\\nb1 = "0.4~"\\nb2 = "1 - b1"\\n[proof]\\nconditions = "vcg"\\norder = 3'
    >>> family, symbolic = families.get("vcg"), Tableau.loads(text).proof.symbolic
    >>> candidates = decisive_conditions(family, 3)
    >>> conditions = [c for of_order in candidates for c in of_order]
    >>> member = exact_member(family, symbolic, conditions, Draws("example"), None)
    >>> [c.tree for c in conditions if member.holds(c)][:3]
    ['o', 'o(o)', 'o(|L(o))']
    """
    try:
        method, ring = _member(symbolic, draws, surd)
        left = family.evaluate(method if read is None else read(method, ring), ring, conditions)
    except OUTSIDE:
        return None
    return ExactMember(ring, dict(zip(conditions, left, strict=True)), surd)


def _member(symbolic: SymbolicCoefficients, draws: Draws, surd: Surd | None) -> tuple[Method, Ring]:
    if surd is None:
        ring = RandomMember(symbolic, draws)
        return ring.method(), ring
    values = evaluate_in(
        _Scalars(symbolic, draws, surd), symbolic.expressions, symbolic.numbers, symbolic.where
    )
    return symbolic.build(values, surd.ring)[0], surd.ring


class _Scalars:
    """Converts the numbers in formulas to elements of Q(sqrt(d)). A random rational number replaces each
    rounded decimal and each root of a polynomial. The module :mod:`orderconds.tableau.random_member` states
    the reason."""

    def __init__(self, symbolic: SymbolicCoefficients, draws: Draws, surd: Surd) -> None:
        self._drawn, self._surd = RandomMember(symbolic, draws), surd

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


def constants(symbolic: SymbolicCoefficients) -> Iterator[Constant]:
    """Yield every constant in the formulas of a tableau file. If a number of the file is defined as a root of
    a polynomial, the constants include the coefficients of the polynomial.

    >>> from orderconds.tableau import Tableau
    >>> text = 'name = "m"\\nfamily = "rk"\\nA = [["0.5~"]]\\nb = ["1"]\\n'
    >>> proof = Tableau.loads(text + '[proof]\\nconditions = "rk"\\norder = 1').proof
    >>> [str(c.value) for c in constants(proof.symbolic)]
    ['1/2', '1']
    """
    for x in (*symbolic.expressions.values(), *symbolic.numbers.values()):
        if isinstance(x, NamedRoot):
            yield from (Constant(c) for c in x.minpoly)
        else:
            yield from rounded_and_exact(x)
