"""Reductions: theorems that reduce the number of conditions to evaluate at one order, sometimes to zero.

``check`` evaluates the conditions of order n only if all conditions of lower order hold. There are three
reductions:

- *symmetry*: if n is even and the method is symmetric, the conditions of order n hold, because the order of a
  symmetric method is even (HLW II.3, Theorem 3.2);
- *substitution*: the conditions of another family may imply all conditions of order n and cost less. For a
  symplectic pair with b = bhat, the conditions of free trees with directed edges imply the conditions of all
  rooted trees of two colours (Abia and Sanz-Serna 1993; HLW VI.7, Theorem 7.4);
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
    """A family whose conditions imply the required conditions, and the method in a format of this family."""

    family: Family
    method: Method


class UnseenCut(Struct, frozen=True):
    """The conditions that the truncation of dexpinv does not change.

    ``order`` is the order of the method without truncation. The truncation does not change the contributions
    of words of at most ``longest`` trees. The function ``length`` returns the length of the longest word that
    contributes to the coefficient of a tree or forest.
    """

    order: int
    longest: int
    length: Callable[[Key], int]


class Reductions(Struct, frozen=True):
    """The reductions that apply to one method in one family.

    ``even`` is true if the method is symmetric, because its order is then even. ``substitute``
    describes the reduction by substitution, or is None if this reduction does not apply. ``cut`` describes
    the truncation of dexpinv, or is None if the theorem on the truncation does not apply.

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
        These conditions imply all required conditions of order n."""
        if self.substitute is None:
            return False
        family, method = self.substitute.family, self.substitute.method
        residuals = family.residuals(method, self.ring, family.conditions(n))
        return all(self.ring.is_zero(x) is True for x in residuals)

    def follows(self, n: int, key: Key) -> bool:
        """Return True if the truncation of dexpinv does not change the condition that has order n and the
        key ``key``. An unchanged condition holds, because the method without truncation satisfies it."""
        return self.cut is not None and n <= self.cut.order and self.cut.length(key) <= self.cut.longest
