"""The conditions that are independent for every method spelled like a file: the reduction ``spelling``.

Coefficients of a file that are spelled by others, ``b3 = "1 - b1 - b2"``, restrict it to a sub-family, and of
the family's conditions fewer are independent there. Those are found as for a whole family
(:mod:`orderconds.series.action_rank`): a condition is left out if its value, at random members of the
sub-family and at the exact flow, is one combination of those of its order that are kept and of products of
kept ones of lower order. Where the kept ones hold, it then holds. Computed modulo two primes, the larger set
kept: too many would refuse a proof; that none is missing holds up to chance, about the number of columns over
2^31. Where a file has several radicals they are random numbers too, which makes the sub-family larger and the
statement stronger.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from flint import fmpz

from orderconds.conditions import OrderCondition
from orderconds.families import Family, in_ring
from orderconds.ring.protocol import Element
from orderconds.ring.rank import pivot_columns
from orderconds.ring.residues import Residue, Residues
from orderconds.series.action_rank import products
from orderconds.tableau.indeterminates import radicals
from orderconds.tableau.unknowns import Spelled

BLOCK = 256
"""Members evaluated together."""

SPARE = 24
"""Members beyond the number of columns, so that chance does not hide a dependence."""


def independent_conditions(
    family: Family, spelled: Spelled, order: int, read: Any = None
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
    candidates = [list(_decisive(family, n)) for n in range(1, order + 1)]
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
    family: Family, spelled: Spelled, candidates: Sequence[Sequence[OrderCondition]], prime: int, read: Any
) -> tuple[OrderCondition, ...]:
    everything = [c for of_order in candidates for c in of_order]
    columns = len(everything)
    while True:
        values = dict(
            zip(everything, _sampled(family, spelled, everything, prime, columns, read), strict=True)
        )
        kept: list[OrderCondition] = []
        generators: list[tuple[int, Residue]] = []
        widest = 0
        for n, of_order in enumerate(candidates, start=1):
            decomposable = list(products(generators, n))
            pivots = pivot_columns([*decomposable, *(values[c] for c in of_order)])
            chosen = [of_order[p - len(decomposable)] for p in pivots if p >= len(decomposable)]
            widest = max(widest, len(decomposable) + len(chosen))
            kept += [c for c in chosen if not _constant(values[c])]
            generators += [(n, values[c]) for c in chosen]
        if widest + SPARE <= columns:
            return tuple(kept)
        columns = 2 * (widest + SPARE)


def _constant(x: Residue) -> bool:
    """Say whether a value is that of the flow for all members: a condition that holds by the spelling."""
    return bool((x.values == x.values[-1]).all())


def _sampled(
    family: Family, spelled: Spelled, conditions: Sequence[OrderCondition], prime: int, count: int, read: Any
) -> list[Residue]:
    """Return the values at so many random members and, last, at the flow."""
    generator = np.random.default_rng(prime)
    alone = len(radicals(spelled)) == 1
    blocks = []
    for start in range(0, count, BLOCK):
        ring = _Members(prime, min(BLOCK, count - start), generator, alone)
        known = {u.constant: ring.random(generator) for u in spelled.decimals()}
        method: Any = spelled.method(ring, known)[0]
        values = family.evaluate(method if read is None else read(method, ring), ring, conditions)
        blocks.append([x.values for x in values])
    one = Residues(prime, 1)
    blocks.append([in_ring(one, c.rhs).values for c in conditions])
    whole = Residues(prime, count + 1)
    return [whole.element(np.concatenate(parts)) for parts in zip(*blocks, strict=True)]


class _Members(Residues):
    """Residues in which radicals are random numbers, except the square root of a rational that stands alone.

    That is a root modulo the prime, whichever of the two: what holds there for all members holds over the
    field that it generates.
    """

    def __init__(self, prime: int, samples: int, generator: np.random.Generator, alone: bool) -> None:
        super().__init__(prime, samples)
        self._generator, self._alone = generator, alone
        self._roots: dict[tuple[tuple[int, ...], int], Residue] = {}

    def root(self, x: Element, index: int) -> Residue:
        """Return a random number, the same for the same radical, or the one square root there is."""
        if self._alone and index == 2 and (x.values == x.values[0]).all():
            root = pow(int(x.values[0]), (self.prime + 1) // 4, self.prime)
            if root * root % self.prime == int(x.values[0]):
                return self.rational(root)
            raise _NoRoot
        return self._roots.setdefault((self.key(x), index), self.random(self._generator))

    def named_root(self, minpoly: Any, near: Any, unit: Any, name: str) -> Residue:
        """Return a random number, the same for the same name."""
        return self._roots.setdefault(((), hash_of(name)), self.random(self._generator))


class _NoRoot(Exception):
    """A number has no square root modulo a prime: another prime is needed."""


def hash_of(name: str) -> int:
    """Return a number that names a string, the same in every process.

    >>> hash_of("x")
    120
    """
    return int.from_bytes(name.encode(), "big")


def _decisive(family: Family, order: int) -> tuple[OrderCondition, ...]:
    decisive = getattr(family, "decisive_conditions", family.conditions)
    found: tuple[OrderCondition, ...] = decisive(order)
    return found
