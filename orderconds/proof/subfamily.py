"""Independent conditions of the sub-family that a file's formulas define: the reduction ``spelling``.

Coefficients given by formulas in others, as ``b3 = "1 - b1 - b2"``, restrict a family to a sub-family, in
which fewer of its conditions are independent. They are found as for a whole family
(:mod:`orderconds.series.action_rank`). A condition is left out if its value, at random members of the
sub-family and at the exact flow, is one combination of kept conditions of its order and of products of kept
conditions of lower order. It then holds where the kept conditions hold.

The computation is done modulo two primes, and the larger set is kept. Too many conditions would refuse a
proof. The probability that one is missing is about the number of columns over 2^31. Where a file has several
radicals, they are random numbers too: the sub-family is then larger and the statement stronger.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from random import Random

from flint import fmpz

from orderconds.conditions import OrderCondition
from orderconds.families import Family
from orderconds.ring.protocol import Ring
from orderconds.ring.samples import Sample, Samples, pivots
from orderconds.series.monomials import products
from orderconds.tableau.indeterminates import radicals
from orderconds.tableau.products import Method
from orderconds.tableau.unknowns import Spelled

Reading = Callable[[Method, Ring], Method]
"""Turns a file's method over a ring into the method that a family evaluates."""

FIRST = 40
"""Random members in the first attempt: most sub-families have few conditions."""

SPARE = 24
"""Random members beyond the number of columns, against accidental dependence."""


def independent_conditions(
    family: Family, spelled: Spelled, order: int, read: Reading | None = None
) -> tuple[OrderCondition, ...]:
    """Return the family's conditions up to ``order`` that do not follow from others for this spelling.

    ``read`` turns the file's method and its ring into the method that the family evaluates.

    >>> from orderconds import families
    >>> from orderconds.tableau import Tableau
    >>> text = 'name = "m"\\nfamily = "rk"\\nA = [["b1/2"], ["b1", "b2/2"]]\\nb = ["b1", "b2"]\\n'
    >>> text += '[numbers]\\nb1 = "0.4~"\\nb2 = "1 - b1"\\n[proof]\\nconditions = "vcg"\\norder = 3'
    >>> spelled = Tableau.loads(text).proof.spelled
    >>> [c.tree for c in independent_conditions(families.get("vcg"), spelled, 3)]
    ['o(o o)']
    """
    candidates = decisive_conditions(family, order)
    found: list[tuple[OrderCondition, ...]] = []
    for prime in _primes():
        try:
            found.append(_independent(family, spelled, candidates, prime, read))
        except _NoRoot:
            continue
        if len(found) == 2:
            break
    return max(found, key=len)


def _primes() -> Iterator[int]:
    """Yield primes below 2^31 that are 3 modulo 4, where a square root is a power."""
    for n in range(2**31 - 1, 2, -4):
        if fmpz(n).is_prime():
            yield n


def _independent(
    family: Family,
    spelled: Spelled,
    candidates: Sequence[Sequence[OrderCondition]],
    prime: int,
    read: Reading | None,
) -> tuple[OrderCondition, ...]:
    everything = [c for of_order in candidates for c in of_order]
    columns = FIRST
    while True:
        sampled = _sampled(family, spelled, everything, prime, columns, read)
        values = dict(zip(everything, sampled, strict=True))
        kept: list[OrderCondition] = []
        generators: list[tuple[int, _Value]] = []
        widest = 0
        for n, of_order in enumerate(candidates, start=1):
            decomposable = list(products(generators, n))
            sampled = [*decomposable, *(values[c] for c in of_order)]
            found = pivots([x.coordinates() for x in sampled], prime)
            chosen = [of_order[p - len(decomposable)] for p in found if p >= len(decomposable)]
            widest = max(widest, len(decomposable) + len(chosen))
            kept += [c for c in chosen if not values[c].is_constant()]
            generators += [(n, values[c]) for c in chosen]
        if widest + SPARE <= columns:
            return tuple(kept)
        columns = widest + 2 * SPARE


@dataclass(frozen=True)
class _Value:
    """The left-hand side of a condition at random members and at the exact flow."""

    members: Sample
    flow: int

    def __mul__(self, other: _Value) -> _Value:
        return _Value(self.members * other.members, self.flow * other.flow % self.members.ring.prime)

    def coordinates(self) -> list[int]:
        return [*self.members.ring.coordinates(self.members), self.flow]

    def is_constant(self) -> bool:
        """Whether all members have the value of the flow: the condition holds in the sub-family."""
        return self.members.ring.constant(self.members) == self.flow


def _sampled(
    family: Family,
    spelled: Spelled,
    conditions: Sequence[OrderCondition],
    prime: int,
    count: int,
    read: Reading | None,
) -> list[_Value]:
    """Return the values at ``count`` random members and at the flow."""
    ring = _Members(prime, count, Random(prime), alone=len(radicals(spelled)) == 1)
    known = {u.constant: ring.random(ring.generator) for u in spelled.decimals()}
    method = spelled.method(ring, known)[0]
    values = family.evaluate(method if read is None else read(method, ring), ring, conditions)
    flow = [c.rhs.numerator * pow(c.rhs.denominator, -1, prime) % prime for c in conditions]
    return [_Value(x, exact) for x, exact in zip(values, flow, strict=True)]


class _Members(Samples):
    """Samples in which radicals are random numbers, except the square root of a rational that stands alone.

    That is a root modulo the prime, whichever of the two: what holds there for all members holds over the
    field that it generates.
    """

    def __init__(self, prime: int, count: int, generator: Random, alone: bool) -> None:
        super().__init__(prime, count)
        self.generator, self._alone = generator, alone
        self._roots: dict[tuple[tuple[int, ...], int], Sample] = {}

    def root(self, x: Sample, index: int) -> Sample:
        """Return a random number, the same for the same radical, or the one square root there is."""
        value = self.constant(x)
        if self._alone and index == 2 and value is not None:
            root = pow(value, (self.prime + 1) // 4, self.prime)
            if root * root % self.prime == value:
                return self.rational(root)
            raise _NoRoot
        return self._roots.setdefault((self.key(x), index), self.random(self.generator))

    def named_root(self, minpoly: object, near: object, unit: object, name: str) -> Sample:
        """Return a random number, the same for the same name."""
        return self._roots.setdefault(((), hash_of(name)), self.random(self.generator))


class _NoRoot(Exception):
    """A number has no square root modulo a prime: another prime is needed."""


def hash_of(name: str) -> int:
    """Return a number that names a string, the same in every process.

    >>> hash_of("x")
    120
    """
    return int.from_bytes(name.encode(), "big")


def decisive_conditions(family: Family, order: int) -> list[tuple[OrderCondition, ...]]:
    """Return conditions that imply all up to ``order``, for every method of the family, by order.

    >>> from orderconds import families
    >>> [len(of_order) for of_order in decisive_conditions(families.get("vcg"), 3)]
    [1, 2, 10]
    """
    return [family.decisive_conditions(n) for n in range(1, order + 1)]
