"""The order of one tableau in one family.

The conditions of order 1, 2, ... are evaluated until a condition fails.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from decimal import Context, Decimal
from itertools import chain, islice

from orderconds.checking.limits import Meter
from orderconds.checking.residuals import Failure, judge
from orderconds.conditions import OrderCondition
from orderconds.errors import InputError
from orderconds.families import Family
from orderconds.families.base import Key
from orderconds.families.reductions import Reductions
from orderconds.ring import Balls, Ring
from orderconds.tableau import Method, Tableau

EXHAUSTIVE = 2000
"""If an order has at most EXHAUSTIVE conditions, all conditions of the order are evaluated.

If an order has more conditions, the evaluation ends after the first batch with a failing condition.
"""

STOPPED = "stopped"
"""The verdict on an order if a limit is reached before all conditions of the order are evaluated."""

DOUBLE = "double"
"""The certificate of an order that is confirmed in double precision, but not proved."""

Tree = tuple[Key, Callable[[], OrderCondition]]
"""The key of a tree, and a function that returns the order condition of the tree."""


@dataclass(frozen=True, repr=False)
class FamilyOrder:
    """The order of one tableau in one family, and the claimed or required order.

    - ``order`` is the computed order.
    - ``decided`` is False if the coefficients have too few digits to decide the conditions of order
      ``order + 1``.
    - ``failing`` contains the conditions of order ``order + 1`` that are known to fail.
    - ``error_norm`` is the 2-norm of the residuals of all failing conditions, or None if it is unknown.
    - ``claimed`` is the order that the file claims, or None.
    - ``required`` is the least acceptable order, or None. If ``required`` is given, ``claimed`` is ignored.
    - ``limit`` is equal to ``order`` if a limit on order or work ended the search. Then ``order`` is only a
      lower bound for the order of the method. In all other cases, ``limit`` is None.
    - ``stopped`` is the number of evaluated conditions if a limit on the work ended the search
      (:class:`~orderconds.checking.limits.Limits`), else None.
    """

    family: str
    order: int
    certificate: str
    decided: bool
    failing: tuple[Failure, ...]
    error_norm: float | None
    claimed: int | None = None
    required: int | None = None
    limit: int | None = None
    stopped: int | None = None
    largest: float | None = None
    """The largest absolute residual up to the computed order, or None if the coefficients are not doubles."""

    def __repr__(self) -> str:
        return (
            f"FamilyOrder({self.family}: order {self.order}, certificate {self.certificate}, {self.verdict})"
        )

    @property
    def verdict(self) -> str:
        """One of the words ``holds``, ``fails``, ``undecided`` and ``unclaimed``.

        ``unclaimed`` means that no order is claimed or required.
        """
        if self.required is not None:
            sound = self.order >= self.required
            unknown = not self.decided or self.stopped is not None
            return "holds" if sound else "undecided" if unknown else "fails"
        if not self.decided:
            return "undecided"
        if self.stopped is not None and self.claimed is not None and self.claimed >= self.order:
            return "undecided"
        if self.claimed is None:
            return "unclaimed"
        return "holds" if self.claimed == self.order else "fails"

    @property
    def sentence(self) -> str:
        """The order as text, such as ``order 4``, ``order at least 8`` or ``order 4 to double precision``."""
        text = f"order{' at least' if self.limit is not None or not self.decided else ''} {self.order}"
        if self.certificate != DOUBLE:
            return text
        size = "" if self.largest is None else f" (largest residual {self.largest:.1e})"
        return f"{text} to double precision{size}, not proved"

    def as_json(self) -> dict[str, object]:
        """Return the entry of one family in the JSON output of ``orderconds check``."""
        record: dict[str, object] = {
            "claimed": self.claimed,
            "order": self.order,
            "verdict": self.verdict,
            "certificate": self.certificate,
            "failing": [failure.as_json() for failure in self.failing],
            # An infinite norm is written as null, because JSON has no infinity.
            "error_norm": None if self.error_norm == math.inf else self.error_norm,
        }
        if self.limit is not None:
            record["limit"] = self.limit
        if self.stopped is not None:
            record["stopped"] = self.stopped
        if self.largest is not None:
            record["largest_residual"] = self.largest
        return record


def family_order(
    tableau: Tableau,
    family: Family,
    claimed: int | None = None,
    required: int | None = None,
    bound: FamilyOrder | None = None,
    proved: Mapping[str, int] | None = None,
    brief: bool = False,
    meter: Meter | None = None,
) -> FamilyOrder:
    """Find the order of ``tableau`` in ``family``.

    - ``claimed`` and ``required``: the claimed order and the required order, or None. No order above
      ``max(family.search_limit, claimed + 1, required + 1)`` is checked.
    - ``bound``: the result for another family. The conditions of the other family are also conditions of
      ``family``, so the order in ``family`` is at most ``bound.order``.
    - ``proved``: maps the labels of other families to proved orders. Conditions that follow from the proved
      orders are not evaluated (:mod:`orderconds.families.reductions`).
    - ``brief``: matters only if the order in ``family`` is ``bound.order``. If ``brief`` is true or
      ``bound.order >= family.search_limit``, the failing conditions in the result are copied from ``bound``.
      Otherwise the conditions of order ``bound.order + 1`` are evaluated to find the failing conditions.
    - ``meter``: counts the evaluated conditions. The search ends if a limit on the work is reached.

    >>> from orderconds.families import get
    >>> from orderconds.tableau import find
    >>> kutta3 = Tableau.load(find("kutta3"))
    >>> computed = family_order(kutta3, get("cg"))
    >>> computed.order, computed.certificate
    (2, 'exact')
    """
    method = _method(tableau, family)
    family.require(method, tableau.ring)
    spared = family.reductions(method, tableau.ring, proved or {})
    search = _Search(family, method, tableau.ring, spared, meter or Meter(), [] if tableau.doubles else None)
    computed = search.run(claimed, required, bound, brief)
    return replace(computed, largest=max(search.sizes)) if search.sizes else computed


def first_failing(tableau: Tableau, family: Family, order: int) -> tuple[Failure, ...]:
    """Return a tuple with at most one condition of order ``order`` that the method of ``tableau`` violates.

    Only the condition ``family.first_unmet(order)`` is tested. The residual of this condition is computed for
    the method of ``tableau``. The tuple is empty in three cases: ``family.first_unmet(order)`` is None, the
    residual is zero, or the residual is a ball that contains zero.

    >>> from orderconds.families import get
    >>> from orderconds.tableau import find
    >>> gauss3 = Tableau.load(find("gauss3"))
    >>> [failure.condition.tree for failure in first_failing(gauss3, get("vrkmk(1)"), 4)]
    ['o(o|L(o o))']
    """
    condition = family.first_unmet(order)
    if condition is None:
        return ()
    return judge(family, _method(tableau, family), tableau.ring, [condition])[1]


@dataclass(frozen=True)
class _Search:
    """The search for the order of one method in one family.

    ``spared`` describes which conditions follow from other conditions and are not evaluated.
    """

    family: Family
    method: Method
    ring: Ring
    spared: Reductions
    meter: Meter
    sizes: list[float] | None
    """The largest absolute residual of each batch of conditions. None if the coefficients are not doubles."""

    def run(
        self, claimed: int | None, required: int | None, bound: FamilyOrder | None, brief: bool
    ) -> FamilyOrder:
        """Return the order. The arguments are described in :func:`family_order`."""
        family, label, highest = self.family, self.family.label(), self.family.order_bound
        limit = max(family.search_limit, (claimed or 0) + 1, (required or 0) + 1)
        limit = limit if highest is None else min(limit, highest)
        expected = limit if claimed is None else claimed
        certificate = "exact"
        for n in range(1, limit + 1):
            known = len(self.sizes or ())
            verdicts, failing, whole = self._judged(n, n > expected, certificate == "decimal")
            if self.sizes and (failing or not verdicts.isdisjoint((STOPPED, "undecided"))):
                del self.sizes[known:]
            if not failing and STOPPED in verdicts:
                done = self.meter.total
                return FamilyOrder(label, n - 1, certificate, True, (), None, claimed, required, n - 1, done)
            if failing or "undecided" in verdicts:
                decided, norm = bool(failing), None
                certificate = certificate if decided else "none"
                if failing and whole:
                    norm = _norm([failure.size for failure in failing])
                return FamilyOrder(label, n - 1, certificate, decided, failing, norm, claimed, required)
            if "supported" in verdicts:
                certificate = "decimal"
            if bound is not None and n == bound.order and (brief or n >= family.search_limit):
                return FamilyOrder(label, n, certificate, True, bound.failing, None, claimed, required)
        ended = None if limit == highest else limit
        return FamilyOrder(label, limit, certificate, True, (), None, claimed, required, ended)

    def _judged(self, n: int, unlikely: bool, decimal: bool) -> tuple[set[str], tuple[Failure, ...], bool]:
        """Judge the conditions of order n. Return the set of verdicts, the failing conditions and a flag.

        The flag is true if the search for failing conditions of order n is complete. Set ``decimal`` to True
        if some conditions of lower order hold only to the precision of the rounded coefficients.
        """
        failing: tuple[Failure, ...] = ()
        verdicts: set[str] = set()
        whole = True
        if self.spared.order_follows(n):
            return verdicts, failing, whole
        known = decimal or not isinstance(self.ring, Balls)
        self.meter.next_order()
        for trees, every in _batches(self.family, n):
            whole = every
            if self.meter.stops(len(trees)):
                return {STOPPED}, failing, False
            batch = tuple(
                condition() for key, condition in trees if not (known and self.spared.follows(n, key))
            )
            judged, failing = judge(self.family, self.method, self.ring, batch, unlikely, self.sizes)
            self.meter.count(len(batch))
            verdicts |= judged
            if failing or (not every and judged == {"zero"} and self.spared.rest_follows(n)):
                break
        return verdicts, failing, whole


def _batches(family: Family, n: int) -> Iterator[tuple[tuple[Tree, ...], bool]]:
    """Divide the trees of ``family.decisive_in_turn(n)`` into batches, and yield pairs (batch, flag).

    Each tree has one condition. Together, the conditions of all batches imply every condition of order n. The
    flag is true if there is only one batch.
    """
    trees = family.decisive_in_turn(n)
    count = family.decisive_count(n)
    if count is None or count <= EXHAUSTIVE:
        first = tuple(islice(trees, EXHAUSTIVE + 1))
        if len(first) <= EXHAUSTIVE:
            yield first, True
            return
        trees = chain(first, trees)
    size = EXHAUSTIVE // 10
    while batch := tuple(islice(trees, size)):
        yield batch, False
        size *= 2


def _norm(sizes: list[Decimal]) -> float:
    """Return the 2-norm of the given residuals, to 15 digits."""
    context = Context(prec=30)
    total = Decimal(0)
    for x in sizes:
        total = context.fma(x, x, total)
    return float(f"{context.sqrt(total):.14e}")


def _method(tableau: Tableau, family: Family) -> Method:
    """Return the method of a tableau. Raise InputError if the tableau is not a method of the family."""
    method = family.read(tableau)
    if method is None:
        raise InputError(
            f"a tableau of format {tableau.family} is not a method of family {family.label()}",
            where=tableau.path or tableau.name,
            expected=f"format {' or '.join(family.formats)}",
        )
    return method
