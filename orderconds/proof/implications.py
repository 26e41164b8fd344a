"""Theorems that derive the order of a method in one family from its proved orders in other families.

A fact is a pair (label of a family, order): the method has at least this order in the family. Order 4 in
``cg`` implies order 4 in ``rk``, because a vector space is a Lie group under addition.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from orderconds import families
from orderconds.families import Family

Fact = tuple[str, int]


def implied(facts: Iterable[Fact], family: Family, order: int) -> bool:
    """Return True if ``facts`` imply that a method has order ``order`` in ``family``. A pair (label, n) in
    ``facts`` means that the method has at least order n in the family with this label.

    >>> facts = [("cg", 4)]
    >>> implied(facts, families.get("rk"), 4), implied(facts, families.get("rkmk(1)"), 3)
    (True, True)
    >>> implied(facts, families.get("vcg"), 2), implied(facts, families.get("vcg"), 3)
    (True, False)
    """
    return order <= least_order(facts, family)


def least_order(facts: Iterable[Fact], family: Family) -> int:
    """Return a lower bound of the order that a method has in ``family``. A pair (label, n) in ``facts`` means
    that the method has at least order n in the family with this label. If ``facts`` imply no order, return 0.

    >>> least_order([("sprk", 6), ("rk", 6)], families.get("vrkmk(2)"))
    5
    """
    known = consequences(facts)
    return max(known.get(family.label(), 0), family.implied_order(known))


def consequences(facts: Iterable[Fact]) -> dict[str, int]:
    """Return lower bounds of the orders of one method, as a map from labels of families to bounds. The bounds
    follow from ``facts``, which contains lower bounds for some families.

    >>> consequences([("vrkmk(1)", 3)])
    {'vrkmk(1)': 3, 'sprk': 3, 'rk': 3, 'symplectic_rk': 3}
    """
    known = dict[str, int]()
    waiting = list(facts)
    while waiting:
        label, proved = waiting.pop()
        if proved > known.get(label, 0):
            known[label] = proved
            waiting += [(other, proved) for other in families.get(label).implies]
    return known


def settled(facts: Iterable[Fact], orders: Mapping[str, int], family: Family) -> int | None:
    """Return the exact order of a method in ``family`` if theorems determine it, else None.

    A pair (label, n) in ``facts`` means that the method has at least order n in the family with this label.
    ``orders`` maps labels of families to exact orders.

    >>> settled([("composition", 8)], {"composition": 8, "rk": 8}, families.get("vcg"))
    8
    >>> settled([("rk", 4)], {"rk": 4}, families.get("cg")) is None
    True
    """
    among = consequences([(family.label(), 1)])
    upper = min((order for label, order in orders.items() if label in among), default=None)
    return upper if upper is not None and upper <= least_order(facts, family) else None
