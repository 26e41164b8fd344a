"""Families with the option ``cutoff``: the series of dexpinv in powers of ad is truncated.

The value r of ``cutoff`` is the exponent of the last power that is kept. If r >= 2 is even, the Bernoulli
number B_(r+1) is zero. In this case let R = r + 1, otherwise let R = r.

Let p be the order without truncation. For RKMK methods, p is the order of the Runge-Kutta method of the
tableau. For VRKMK methods, p is the order of the symplectic partitioned Runge-Kutta method of the tableau
(HLW IV.8, Theorem 8.4; Bogfjellmo and Marthinsen, Section 3.4.1).

The order with truncation is min(p, R + 2) (compare Bogfjellmo and Marthinsen, Theorem 3.5.3).

The branches at a vertex of a tree form a word, whose letters are smaller trees. The truncation changes only
the coefficients of words with more than R + 1 letters.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping

from orderconds.errors import InputError
from orderconds.families.base import Family, Key
from orderconds.families.reductions import UnseenCut
from orderconds.tableau.claims import OrderClaim
from orderconds.tableau.methods import RungeKutta
from orderconds.tableau.products import Method
from orderconds.tableau.record import Tableau
from orderconds.tableau.work import Work, munthe_kaas_work

CLAIMED = (0, 1, 2)
"""``orderconds solve`` writes orders to the tableau file only for these values of ``cutoff``."""


class DexpinvCut(Family):
    """A family in which the series of dexpinv ends with the power ``cutoff`` of ad.

    If ``cutoff`` is None, the series is not truncated. Raises :class:`~orderconds.errors.InputError` for a
    negative ``cutoff``.
    """

    takes_cutoff = True

    def __init__(self, cutoff: int | None = None) -> None:
        # In Python, True and False are integers, but the label ``rkmk(True)`` is not the name of a family.
        if cutoff is not None and (type(cutoff) is not int or cutoff < 0):
            raise InputError(f"cutoff {cutoff!r}", where=f"family {self.name}", expected="an integer >= 0")
        self.cutoff = cutoff

    @abstractmethod
    def longest_word(self, key: Key) -> int:
        """Return the length of the longest word in the formula for the coefficient of a tree or forest. The
        letters of a word are trees."""

    def label(self) -> str:
        """Return the name of the family with its cutoff, such as ``rkmk(1)``.

        If dexpinv is not truncated, return the name alone.
        """
        return self.name if self.cutoff is None else f"{self.name}({self.cutoff})"

    def claim(self, order: int) -> OrderClaim:
        """Return the claim that a method has the order ``order`` in this family."""
        return OrderClaim(self.name, self.cutoff, order)

    def claimed_variants(self) -> tuple[Family, ...]:
        """Return one variant of the family for each value of ``cutoff`` in :data:`CLAIMED`."""
        return tuple(type(self)(cutoff) for cutoff in CLAIMED)

    def work(self, tableau: Tableau) -> Work | None:
        """Return the numbers of field evaluations, exponentials and brackets in one step."""
        return munthe_kaas_work(tableau, self.cutoff)

    def implied_order(self, orders: Mapping[str, int]) -> int:
        """Return a lower bound of the order that a method has in this family.

        ``orders`` maps the names of other families to the orders of the method in these families.
        """
        without = orders.get(self.abelian, 0) if self.abelian is not None else 0
        return max(super().implied_order(orders), self._truncated(without))

    def _truncated(self, order: int) -> int:
        if self.cutoff is None:
            return order
        kept = self.cutoff + 1 if self.cutoff >= 2 and self.cutoff % 2 == 0 else self.cutoff
        return min(order, kept + 2)

    def unseen_cut(self, method: Method, orders: Mapping[str, int]) -> UnseenCut | None:
        """Return an object that tests whether the truncation of dexpinv changes a condition.

        Let ``self.abelian`` be the name of the family to which this family reduces on an abelian group. The
        test uses ``orders[self.abelian]``, the order p of the method on abelian groups. By the theorems in
        the module docstring, the method has the same order p on all groups if dexpinv is not truncated.
        Return None if ``method`` is not a Runge-Kutta tableau, or if ``self.abelian`` is None.
        """
        if not isinstance(method, RungeKutta) or self.abelian is None:
            return None
        return UnseenCut(orders.get(self.abelian, 0), longest_unseen(self.cutoff), self.longest_word)


def longest_unseen(cutoff: int | None) -> int:
    """Return the largest number n such that the truncation of dexpinv does not change the coefficients of
    words with at most n letters.

    The series of dexpinv ends with the power ``cutoff`` of ad. If ``cutoff`` is None, the result is 2^30.

    >>> [longest_unseen(r) for r in (0, 1, 2, 3, 4)]
    [1, 2, 4, 4, 6]
    """
    if cutoff is None:
        return 1 << 30
    # The first power that the truncation omits is ``first``. The Bernoulli number B_n is zero if and only if
    # n is odd and n > 1.
    first = cutoff + 1
    return first + 1 if first > 1 and first % 2 else first
