"""Conditions that need not be evaluated, because theorems derive them from earlier results of a check.

``check`` evaluates orders 1, 2, .... When it evaluates order n, all conditions of lower order hold. Then

- *symmetry*: a symmetric method of odd order n - 1 has order n (HLW II.3, Theorem 3.2);
- *substitution*: the conditions of another family may imply all of order n and cost less. For a symplectic
  pair with b = bhat, the conditions of free trees with directed edges imply the conditions of all rooted
  trees of two colours (Abia and Sanz-Serna 1993; HLW VI.7, Theorem 7.4);
- *a cut of dexpinv* changes only values of trees with long words (:mod:`orderconds.families.dexpinv_cut`).

The assumptions of a reduction are verified exactly for each tableau. For tableaux over balls only the last
reduction is used, and only for proved solutions. It never improves a certificate.
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
    """Another family whose conditions imply the required ones for a method, and the method in the format of
    that family."""

    family: Family
    method: Method


class UnseenCut(Struct, frozen=True):
    """The conditions on which the cut of dexpinv has no effect.

    Without the cut the method has order ``order``. The cut does not change values on words up to the length
    ``longest``. ``length`` returns the length of the longest word on whose value the value of a tree or
    forest depends.
    """

    order: int
    longest: int
    length: Callable[[Key], int]


class Reductions(Struct, frozen=True):
    """The reductions that apply to one method in one family.

    ``even`` is true if the method is symmetric; its order is then even.

    >>> from orderconds.ring import QQ
    >>> [Reductions(QQ, even=True).order_follows(n) for n in (3, 4)]
    [False, True]
    """

    ring: Ring
    even: bool = False
    substitute: Substitute | None = None
    cut: UnseenCut | None = None

    def order_follows(self, n: int) -> bool:
        """Whether all conditions of order n hold if all conditions of lower order hold."""
        return self.even and n % 2 == 0

    def rest_follows(self, n: int) -> bool:
        """Whether all conditions of order n hold because those of the substitute do; this method evaluates
        the latter."""
        if self.substitute is None:
            return False
        family, method = self.substitute.family, self.substitute.method
        residuals = family.residuals(method, self.ring, family.conditions(n))
        return all(self.ring.is_zero(x) is True for x in residuals)

    def follows(self, n: int, key: Key) -> bool:
        """Whether the condition of order n of a tree or forest holds because the cut has no effect on it."""
        return self.cut is not None and n <= self.cut.order and self.cut.length(key) <= self.cut.longest
