"""Reductions: theorems that imply some or all conditions of an order. The implied conditions are not
evaluated.

``check`` evaluates the conditions of order n only if all conditions of lower order hold. There are three
reductions:

- *symmetry*: if n is even and the method is symmetric, the conditions of order n hold, because the order of a
  symmetric method is even (HLW II.3, Theorem 3.2);
- *substitution*: the conditions of another family may imply all conditions of order n. The evaluation of
  these other conditions may take less time. For a symplectic pair with b = bhat, the
  conditions of free trees with directed edges imply the conditions of all rooted trees of two colours (Abia
  and Sanz-Serna 1993; HLW VI.7, Theorem 7.4);
- *truncation of dexpinv*: some methods truncate the series of dexpinv, the inverse of the differential of
  exp. The truncation leaves many conditions unchanged (:mod:`orderconds.families.dexpinv_cut`).

The assumptions of a reduction are verified exactly for each tableau. If the coefficients are balls
(intervals), only the third reduction is used, and the balls must be proved to contain a solution.
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
    """A family whose conditions are checked instead of the conditions of the original family. ``method`` is
    the method in a format of ``family``."""

    family: Family
    method: Method


class UnseenCut(Struct, frozen=True):
    """A description of the conditions that the truncation of dexpinv does not change.

    ``order`` is the order of the method without truncation. The coefficient of a tree or forest is computed
    from words, whose letters are smaller trees. The function ``length`` returns the length of the longest of
    these words. If this length is at most ``longest``, the truncation does not change the coefficient.
    """

    order: int
    longest: int
    length: Callable[[Key], int]


class Reductions(Struct, frozen=True):
    """The reductions that apply to one method in one family.

    ``even`` is true if the method is symmetric. The order of a symmetric method is even. ``substitute``
    contains a family whose conditions imply the conditions of the original family. ``cut`` describes the
    conditions that the truncation of dexpinv does not change. If one of these reductions does not apply, its
    attribute ``substitute`` or ``cut`` is None.

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
        """Return True if ``substitute.method`` satisfies all conditions of order n of ``substitute.family``.
        These conditions imply all conditions of order n of the original family. Return False if there is no
        substitute."""
        if self.substitute is None:
            return False
        family, method = self.substitute.family, self.substitute.method
        residuals = family.residuals(method, self.ring, family.conditions(n))
        return all(self.ring.is_zero(x) is True for x in residuals)

    def follows(self, n: int, key: Key) -> bool:
        """Return True if ``cut`` implies the condition of order ``n`` with the key ``key``.

        Without truncation of dexpinv, all conditions up to the order ``cut.order`` hold. If the truncation
        does not change one of these conditions, this condition also holds with truncation.
        """
        return self.cut is not None and n <= self.cut.order and self.cut.length(key) <= self.cut.longest
