"""Symmetry of commutator-free methods: their exponentials form a palindrome.

A step of length h maps y0 to y1. The method is symmetric if a step of length -h maps y1 back to y0. An
exponent has s coefficients, one for each stage. We define the conjugate of an exponential: it is the
exponential with the same s coefficients in reverse order. For each stage, a sequence of exponentials leads
from y0 to the value of the stage. The method is symmetric if two conditions hold:

- The sequence from y0 to y1 is a palindrome: the conjugates of its exponentials, in reverse order, form the
  original sequence.
- Let E_1, ..., E_m be the exponentials that lead from y0 to the value of a stage i. Let D_k be the inverse of
  the conjugate of E_k. Then D_1, ..., D_m must lead from y1 to the value of stage s + 1 - i.

Neighbouring exponentials with proportional exponents count as one exponential.
"""

from __future__ import annotations

from collections.abc import Sequence

from orderconds.ring.protocol import Ring
from orderconds.tableau.methods import CommutatorFree, Row


def symmetric_paths(method: CommutatorFree, ring: Ring) -> bool | None:
    """Return True if a method is symmetric. Return None if the coefficients are balls (intervals) that are
    too wide to decide.

    The test compares stage i with stage s + 1 - i, where s is the number of stages. If a method is symmetric
    only after a renumbering of its stages, the result is not True.

    >>> from orderconds.tableau import Tableau, find
    >>> tableaux = [Tableau.load(find(name)) for name in ("cf4", "vcf_gauss2")]
    >>> [symmetric_paths(t.method, t.ring) for t in tableaux]
    [False, True]
    """
    update = method.from_start(method.update)
    verdicts = [_same(update, tuple(row[::-1] for row in update[::-1]), ring)]
    for one, other in zip(method.stages, method.stages[::-1], strict=True):
        back = tuple(tuple(-x for x in row[::-1]) for row in method.from_start(other))
        verdicts.append(_same(method.from_start(one), (*update, *back), ring))
    if False in verdicts:
        return False
    return None if None in verdicts else True


def _same(one: Sequence[Row], other: Sequence[Row], ring: Ring) -> bool | None:
    """Apply :func:`_reduced` to two products of exponentials. Return True if the results are equal, and False
    if they differ. Return None if balls are too wide to decide."""
    left, right = _reduced(one, ring), _reduced(other, ring)
    if len(left) != len(right):
        decided = all(ring.is_zero(x) is not None for row in (*one, *other) for x in row)
        return False if decided else None
    verdicts = [
        x is y or ring.is_zero(x - y)
        for row, column in zip(left, right, strict=True)
        for x, y in zip(row, column, strict=True)
    ]
    if False in verdicts:
        return False
    return None if None in verdicts else True


def _reduced(rows: Sequence[Row], ring: Ring) -> list[Row]:
    """Combine neighbouring exponentials with proportional exponents, and remove exponentials with zero
    exponent."""
    reduced: list[Row] = []
    for row in rows:
        total = row
        if reduced and _parallel(reduced[-1], row, ring):
            total = tuple(x + y for x, y in zip(reduced.pop(), row, strict=True))
        if not all(ring.is_zero(x) is True for x in total):
            reduced.append(total)
    return reduced


def _parallel(x: Row, y: Row, ring: Ring) -> bool:
    # The test of all 2 x 2 minors is slow, so a faster test comes first.
    zeros = [(ring.is_zero(u), ring.is_zero(v)) for u, v in zip(x, y, strict=True)]
    if (False, True) in zeros and (True, False) in zeros:
        return False
    places = [i for i, both in enumerate(zeros) if both != (True, True)]
    pairs = ((i, j) for i in places for j in places if j < i)
    return all(ring.is_zero(x[i] * y[j] - x[j] * y[i]) is True for i, j in pairs)
