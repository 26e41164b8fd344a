"""Reductions: theorems that make some or all conditions of an order superfluous.

``check`` evaluates the conditions of order n only if all conditions of lower order hold. There are three
reductions:

- *symmetry*: if n is even and the method is symmetric, the conditions of order n hold, because the order of a
  symmetric method is even (HLW II.3, Theorem 3.2);
- *substitution*: the conditions of another family may imply all conditions of order n and take less time. For
  a symplectic pair with b = bhat, the conditions of free trees with directed edges imply the conditions of
  all rooted trees of two colours (Abia and Sanz-Serna 1993; HLW VI.7, Theorem 7.4);
- *truncation of dexpinv*: some methods truncate the series of dexpinv, the inverse of the differential of
  exp. The truncation leaves many conditions unchanged (:mod:`orderconds.families.dexpinv_cut`).

The assumptions of a reduction are verified exactly for each tableau. If the coefficients are balls
(intervals), only the truncation of dexpinv is used, and the balls must be proved to contain a solution.
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
    """Another family, whose conditions are checked instead, and the method in a format of this family."""

    family: Family
    method: Method


class UnseenCut(Struct, frozen=True):
    """A description of the conditions that the truncation of dexpinv does not change.

    ``order`` is the order of the method without truncation. Several words contribute to the coefficient of a
    tree or forest, and the function ``length`` returns the length of the longest of these words. If this
    length is at most ``longest``, the truncation does not change the coefficient.
    """

    order: int
    longest: int
    length: Callable[[Key], int]


class Reductions(Struct, frozen=True):
    """The reductions that apply to one method in one family.

    ``even`` is true if the method is symmetric, because its order is then even. ``substitute`` is another
    family whose conditions may be checked instead, or None if no such family is known. ``cut`` describes the
    conditions that the truncation of dexpinv does not change, or is None if no theorem describes them.

    >>> from orderconds.ring import QQ
    >>> [Reductions(QQ, even=True).order_follows(n) for n in (3, 4)]
    [False, True]
    """

    ring: Ring
    even: bool = False
    substitute: Substitute | None = None
    cut: UnseenCut | None = None

    def order_follows(self, n: int) -> bool:
        """Return True if the conditions of order n follow from the conditions of lower order."""
        return self.even and n % 2 == 0

    def rest_follows(self, n: int) -> bool:
        """Return True if the method satisfies the conditions of order n of the family in ``substitute``.
        These conditions imply all conditions of order n of the original family."""
        if self.substitute is None:
            return False
        family, method = self.substitute.family, self.substitute.method
        residuals = family.residuals(method, self.ring, family.conditions(n))
        return all(self.ring.is_zero(x) is True for x in residuals)

    def follows(self, n: int, key: Key) -> bool:
        """Return True if a condition of order ``n`` holds because the truncation of dexpinv does not change
        it. Without truncation, the method satisfies all conditions up to ``cut.order``. ``key`` is the key of
        the condition."""
        return self.cut is not None and n <= self.cut.order and self.cut.length(key) <= self.cut.longest
