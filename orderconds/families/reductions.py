"""Reductions: theorems that imply order conditions of a method. The implied conditions are not evaluated.

``check`` evaluates the conditions of order n only if all conditions of lower order hold. There are three
reductions:

- *symmetry*: the order of a symmetric method is even (Hairer, Lubich and Wanner, *Geometric Numerical
  Integration* (HLW), II.3, Theorem 3.2). Therefore, if n is even, the conditions of lower order imply the
  conditions of order n;
- *substitution*: for some methods, the conditions of another family imply all conditions of order n and are
  faster to evaluate. For a symplectic pair with b = bhat, the conditions of free trees with directed edges
  imply the conditions of all rooted trees of two colours (Abia and Sanz-Serna 1993; HLW VI.7, Theorem 7.4);
- *truncation of dexpinv*: a truncation of the series of dexpinv, the inverse of the differential of exp,
  leaves many conditions unchanged. If these conditions hold without truncation, they also hold with
  truncation (:mod:`orderconds.families.dexpinv_cut`).

The assumptions of a reduction are verified for each tableau in exact arithmetic. If the coefficients are
balls (intervals), only the third reduction is used. In this case, a separate proof must show that the balls
contain a solution of the order conditions.
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
    """A family that replaces the original family when a method is checked.

    The program evaluates the conditions of the replacement ``family``. For the checked method, these
    conditions imply the conditions of the original family. ``method`` is the checked method, converted to a
    tableau format that ``family`` reads.
    """

    family: Family
    method: Method


class UnseenCut(Struct, frozen=True):
    """An object that tests whether the truncation of dexpinv changes a condition.

    - ``order``: the order of the method without truncation.
    - ``length``: the condition with the index ``key`` is computed from words. ``length(key)`` is the length
      of the longest of these words.
    - ``longest``: the truncation does not change the conditions with ``length(key)`` <= ``longest``.
    """

    order: int
    longest: int
    length: Callable[[Key], int]


class Reductions(Struct, frozen=True):
    """The reductions that apply to one method in one family F.

    ``even`` is true if the method is symmetric. ``substitute`` is None, or a :class:`Substitute` with
    another family, whose conditions imply the conditions of F for this method. ``cut`` is None or an
    :class:`UnseenCut`.

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
        """Return True if ``substitute.method`` satisfies the conditions of order n of ``substitute.family``.
        If ``substitute`` is None, return False."""
        if self.substitute is None:
            return False
        family, method = self.substitute.family, self.substitute.method
        residuals = family.residuals(method, self.ring, family.conditions(n))
        return all(self.ring.is_zero(x) is True for x in residuals)

    def follows(self, n: int, key: Key) -> bool:
        """Return True if the test ``cut`` shows that the condition of the tree or forest ``key`` holds. The
        order of the condition is ``n``."""
        return self.cut is not None and n <= self.cut.order and self.cut.length(key) <= self.cut.longest
