"""A search for dependent conditions of a sub-family.

The sub-family contains the methods whose coefficients satisfy the formulas of a tableau file. The left-hand
side of each dependent condition is a polynomial in left-hand sides of independent conditions. The
coefficients of the polynomial are computed modulo primes and then converted to fractions.

:class:`orderconds.proof.exact_member.ExactMember` verifies each polynomial in exact arithmetic, because
conditions that are independent over Q can be dependent modulo the primes.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import islice
from random import Random
from typing import Any

from orderconds.conditions import OrderCondition
from orderconds.errors import ZeroWeight
from orderconds.families import Family
from orderconds.proof.exact_member import Combination, Monomial, Reading, Surd, constants
from orderconds.ring.draws import Draws
from orderconds.ring.reconstruct import rational_number
from orderconds.ring.samples import Sample, Samples, echelon
from orderconds.series.monomials import products
from orderconds.tableau.unknowns import SymbolicCoefficients

FIRST = 40
"""The initial number of random methods."""

SPARE = 24
"""The left-hand side of a dependent condition is a polynomial in left-hand sides of independent conditions.
Each random method gives one linear equation for the n coefficients of this polynomial. At least n + ``SPARE``
random methods are used. With fewer random methods, independent conditions could seem dependent by accident.
"""

PRIME_BITS = 61
"""Conditions are evaluated modulo primes of this size in bits. A residue modulo such a prime fits in a
machine word."""

MAX_PRIMES = 24
"""Conditions are evaluated modulo at most this number of primes."""

Residues = Mapping[OrderCondition, Mapping[Monomial, tuple[int, int]]]
"""A map from each dependent condition to a polynomial. The polynomial expresses the left-hand side of the
condition through left-hand sides of independent conditions. A coefficient x + y sqrt(d) of the polynomial is
stored as the pair (x, y) of residues modulo a prime. Here d is ``surd.radicand``, where ``surd`` is the
argument of :func:`dependences`. If ``surd`` is None, y is zero."""


@dataclass(frozen=True)
class Dependences:
    """The independent and the dependent conditions of a sub-family.

    - ``pivots``: the independent conditions.
    - ``primes``: the conditions were evaluated modulo these primes.
    - ``residues``: one map :data:`Residues` for each prime.
    """

    pivots: tuple[OrderCondition, ...]
    primes: tuple[int, ...]
    residues: tuple[Residues, ...]

    def combinations(self) -> Iterator[tuple[OrderCondition, Combination | None]]:
        """Yield a pair (condition, combination) for each dependent condition. The combination expresses the
        left-hand side of the condition as a polynomial in left-hand sides of independent conditions. The
        combination is None if its coefficients cannot be computed from their residues modulo ``primes``."""
        for condition in self.residues[0]:
            yield condition, self._lifted(condition)

    def _lifted(self, condition: OrderCondition) -> Combination | None:
        monomials = dict.fromkeys(m for modular in self.residues for m in modular[condition])
        try:
            return {m: (self._fraction(condition, m, 0), self._fraction(condition, m, 1)) for m in monomials}
        except ArithmeticError:
            return None

    def _fraction(self, condition: OrderCondition, monomial: Monomial, part: int) -> Fraction:
        residues = [modular[condition].get(monomial, (0, 0))[part] for modular in self.residues]
        return rational_number(residues, self.primes) if any(residues) else Fraction(0)


def dependences(
    family: Family,
    symbolic: SymbolicCoefficients,
    candidates: Sequence[Sequence[OrderCondition]],
    draws: Draws,
    surd: Surd | None,
    read: Reading | None = None,
) -> Iterator[Dependences]:
    """Yield the independent and the dependent conditions among ``candidates``.

    The conditions are evaluated modulo one prime after another, for random methods that satisfy the formulas
    ``symbolic``. Each yielded object :class:`Dependences` contains the results modulo one or more primes, and
    replaces all earlier objects. All primes of one object give the same set of independent conditions. If a
    new prime gives a larger set, the next object contains only the results modulo the new prime. If a new
    prime gives a smaller set, the new prime is ignored. A prime is also ignored if the formulas cannot be
    evaluated modulo this prime.

    ``candidates`` contains the conditions of each order. ``surd`` is the only radical in the formulas, or
    None.

    >>> from orderconds import families
    >>> from orderconds.proof.subfamily import decisive_conditions
    >>> from orderconds.tableau import Tableau
    >>> text = 'name = "m"\\nfamily = "rk"\\nA = [["b1/2"], ["b1", "b2/2"]]\\nb = ["b1", "b2"]\\n'
    >>> text += '[numbers]\\nb1 = "0.4~"\\nb2 = "1 - b1"\\n[proof]\\nconditions = "vcg"\\norder = 3'
    >>> family, symbolic = families.get("vcg"), Tableau.loads(text).proof.symbolic
    >>> candidates = decisive_conditions(family, 3)
    >>> first = next(dependences(family, symbolic, candidates, Draws("example"), None))
    >>> [c.tree for c in first.pivots], len(list(first.combinations()))
    (['o', 'o(o o)'], 11)
    """
    everything = [c for of_order in candidates for c in of_order]
    avoided = [n for c in constants(symbolic) for n in (c.value.numerator, c.value.denominator)]
    best: Dependences | None = None
    for prime in islice(draws.primes(PRIME_BITS, avoided), MAX_PRIMES):
        try:
            result = _modulo(_Sampling(family, symbolic, everything, prime, draws, read), candidates, surd)
        except (_NoRoot, ZeroWeight, ZeroDivisionError, ValueError):
            continue
        if result is None:
            continue
        pivots, residues = result
        places = [everything.index(c) for c in pivots]
        known = [] if best is None else [everything.index(c) for c in best.pivots]
        if best is None or (-len(places), places) < (-len(known), known):
            best = Dependences(pivots, (prime,), (residues,))
        elif places == known:
            best = Dependences(pivots, (*best.primes, prime), (*best.residues, residues))
        else:
            continue
        yield best


def _modulo(
    sampling: _Sampling, candidates: Sequence[Sequence[OrderCondition]], surd: Surd | None
) -> tuple[tuple[OrderCondition, ...], Residues] | None:
    """Return the conditions that are independent modulo one prime, and a map from each dependent condition to
    a polynomial in the left-hand sides of independent conditions.

    If the formulas contain a square root sqrt(d), the polynomials have coefficients x + y sqrt(d). Return
    None if the two square roots of d modulo the prime give different sets of independent conditions.
    """
    prime = sampling.prime
    if surd is None:
        pivots, combinations = _independent(sampling, candidates, None)
        return pivots, {c: {m: (x, 0) for m, x in terms.items()} for c, terms in combinations.items()}
    root = _root_modulo(surd.radicand, prime)
    (pivots, one), (others, two) = (_independent(sampling, candidates, r) for r in (root, prime - root))
    if pivots != others:
        return None
    half, slope = pow(2, -1, prime), pow(2 * root, -1, prime)
    joined = {}
    for c in one:
        monomials = dict.fromkeys((*one[c], *two[c]))
        pairs = {m: (one[c].get(m, 0), two[c].get(m, 0)) for m in monomials}
        joined[c] = {m: ((x + y) * half % prime, (x - y) * slope % prime) for m, (x, y) in pairs.items()}
    return pivots, joined


def _independent(
    sampling: _Sampling, candidates: Sequence[Sequence[OrderCondition]], root: int | None
) -> tuple[tuple[OrderCondition, ...], dict[OrderCondition, dict[Monomial, int]]]:
    columns = FIRST
    while True:
        values = sampling.values(columns, root)
        pivots: list[OrderCondition] = []
        combinations: dict[OrderCondition, dict[Monomial, int]] = {}
        generators: list[tuple[int, _Value]] = []
        widest = 0
        for n, of_order in enumerate(candidates, start=1):
            row = [*products(generators, n), *(values[c] for c in of_order)]
            before = len(row) - len(of_order)
            places, dependent = echelon([x.coordinates() for x in row], sampling.prime)
            chosen = [of_order[p - before] for p in places if p >= before]
            for place, terms in dependent.items():
                if place >= before:
                    combinations[of_order[place - before]] = {row[p].factors: x for p, x in terms.items()}
            widest = max(widest, before + len(chosen))
            pivots += chosen
            generators += [(n, values[c]) for c in chosen]
        if widest + SPARE <= columns:
            return tuple(pivots), combinations
        columns = widest + 2 * SPARE


@dataclass(frozen=True)
class _Value:
    """The product of the left-hand sides of some order conditions, and the product of their right-hand sides.
    Both products are computed modulo a prime.

    - ``factors``: the conditions.
    - ``members``: the product of the left-hand sides, evaluated for each of several random methods.
    - ``flow``: the product of the right-hand sides.
    """

    factors: Monomial
    members: Sample
    flow: int

    def __mul__(self, other: _Value) -> _Value:
        flow = self.flow * other.flow % self.members.ring.prime
        return _Value((*self.factors, *other.factors), self.members * other.members, flow)

    def coordinates(self) -> list[int]:
        return [*self.members.ring.coordinates(self.members), self.flow]


@dataclass(frozen=True)
class _Sampling:
    """Evaluates ``conditions`` modulo ``prime`` for random methods of a sub-family."""

    family: Family
    symbolic: SymbolicCoefficients
    conditions: Sequence[OrderCondition]
    prime: int
    draws: Draws
    read: Reading | None

    def values(self, count: int, root: int | None) -> dict[OrderCondition, _Value]:
        """Return both sides of each condition modulo ``prime``. The left-hand side has one value for each of
        ``count`` random methods. The right-hand side is one number. If ``root`` is None, random residues
        replace all radicals in the formulas. Otherwise, the formulas contain only one radical, a square root,
        and ``root`` replaces this square root."""
        generator = Random(self.draws.number(f"members modulo {self.prime}", 256))
        ring = _Members(self.prime, count, generator, root)
        known = {u.constant: ring.random(generator) for u in self.symbolic.decimals()}
        method: Any = self.symbolic.method(ring, known)[0]
        read = method if self.read is None else self.read(method, ring)
        values = self.family.evaluate(read, ring, self.conditions)
        flow = [
            c.rhs.numerator * pow(c.rhs.denominator, -1, self.prime) % self.prime for c in self.conditions
        ]
        return {c: _Value((c,), x, y) for c, x, y in zip(self.conditions, values, flow, strict=True)}


class _Members(Samples):
    """A ring for the coefficients of ``count`` random methods. An element contains one residue modulo
    ``prime`` for each method."""

    def __init__(self, prime: int, count: int, generator: Random, square_root: int | None) -> None:
        super().__init__(prime, count)
        self._generator, self._square_root = generator, square_root
        self._roots: dict[object, Sample] = {}

    def root(self, x: Sample, index: int) -> Sample:
        """Return the element that replaces the root x^(1/index).

        The root need not exist modulo ``prime``. Therefore a random element replaces the root. Equal
        arguments give equal elements. If a polynomial identity holds for random residues, the identity very
        probably holds for all values of the root. If the argument ``square_root`` of the constructor is an
        integer, this integer replaces every square root.
        """
        if self._square_root is not None and index == 2:
            return self.rational(self._square_root)
        return self._drawn((self.key(x), index))

    def named_root(self, minpoly: Any, near: Any, unit: Any, name: str) -> Sample:
        """Return random residues. Equal values of ``name`` give equal residues."""
        return self._drawn(name)

    def _drawn(self, key: object) -> Sample:
        if key not in self._roots:
            self._roots[key] = self.random(self._generator)
        return self._roots[key]


class _NoRoot(Exception):
    """The error that is raised if a number has no square root modulo the prime."""


def _root_modulo(x: Fraction, prime: int) -> int:
    value = x.numerator * pow(x.denominator, -1, prime) % prime
    root = pow(value, (prime + 1) // 4, prime)
    if root * root % prime != value:
        raise _NoRoot
    return root
