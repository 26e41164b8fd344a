"""Conditions that need not be evaluated, because theorems derive them from earlier results of a check.

``check`` evaluates orders 1, 2, ...; at order n all lower conditions hold. Then

- *symmetry*: a symmetric method of odd order n - 1 has order n (HLW II.3, Theorem 3.2);
- *substitution*: the conditions of another family may imply all of order n and cost less. For a symplectic
  pair with b = bhat those of free trees with directed edges imply those of all rooted trees of two colours
  (Abia and Sanz-Serna 1993; HLW VI.7, Theorem 7.4);
- *a cut of dexpinv* changes only values of trees with long words (:mod:`orderconds.families.dexpinv_cut`).

The assumptions of a reduction are verified exactly for each tableau. For balls only the last reduction is
used, for proved solutions, and it never improves a certificate.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from msgspec import Struct

from orderconds.ring.protocol import Ring
from orderconds.tableau.products import Method

if TYPE_CHECKING:
    from orderconds.families.base import Family, Key


class Substitute(Struct, frozen=True):
    """Another family whose conditions imply those of a method, and the method in its format."""

    family: Family
    method: Method


class UnseenCut(Struct, frozen=True):
    """The conditions on which the cut of dexpinv has no effect.

    Without the cut it has order ``order``; the cut does not change words up to the length ``longest``.
    ``length`` returns the length of the longest word whose value enters that of a tree or forest.
    """

    order: int
    longest: int
    length: Callable[[Key], int]


class Reductions(Struct, frozen=True):
    """The reductions that apply to one method in one family.

    ``even`` says that the method is symmetric.

    >>> from orderconds.ring import QQ
    >>> [Reductions(QQ, even=True).order_follows(n) for n in (3, 4)]
    [False, True]
    """

    ring: Ring
    even: bool = False
    substitute: Substitute | None = None
    cut: UnseenCut | None = None

    def order_follows(self, n: int) -> bool:
        """Whether all conditions of order n hold, given that all lower ones do."""
        return self.even and n % 2 == 0

    def rest_follows(self, n: int) -> bool:
        """Whether all conditions of order n follow from those of the substitute, which are evaluated here."""
        if self.substitute is None:
            return False
        family, method = self.substitute.family, self.substitute.method
        residuals = family.residuals(method, self.ring, family.conditions(n))
        return all(self.ring.is_zero(x) is True for x in residuals)

    def follows(self, n: int, key: Key) -> bool:
        """Whether the condition of order n of a tree or forest holds because the cut has no effect on it."""
        return self.cut is not None and n <= self.cut.order and self.cut.length(key) <= self.cut.longest
