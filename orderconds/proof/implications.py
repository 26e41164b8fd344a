"""What a proved order in one family says of the order in another: theorems, each with its source.

A fact is (label of a family, order). ``cg`` 4 implies ``rk`` 4, since a vector space is a group; every family
has the conditions of ``rk`` up to order 2, since no bracket or momentum enters before.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from orderconds.families import Family

Fact = tuple[str, int]

ABELIAN = {
    "rk": ("symplectic_rk",),
    "cg": ("rk", "cf"),
    "cf": ("rk",),
    "sprk": ("rk",),
    "prk": ("rk",),
    "vcg": ("cg", "sprk", "vcf"),
    "vcf": ("cf",),
    "composition": (
        "rk",
        "symplectic_rk",
        "sprk",
        "cg",
        "cf",
        "vcg",
        "vcf",
        "symmetric_composition",
        "splitting",
    ),
    "symmetric_composition": ("composition",),
    "splitting": ("rkn",),
    "magnus": ("cf_magnus", "fer"),
    "cf_magnus": ("magnus",),
    "fer": ("magnus",),
}
"""A family to those whose conditions are among its own, at every order.

Groups contain vector spaces; T*G contains the flow on G of a Hamiltonian linear in the momentum, and T*V
of a vector space V. Crouch-Grossman methods are commutator-free ones. A composition of midpoints is one in
each family (Bogfjellmo and Marthinsen, Lemma 3.5.4), one of an adjoint pair a splitting (McLachlan 1995). Of
methods for Y' = A(t) Y, which read one step as this or that product of exponentials, the order is one."""


ONE_TABLEAU = ("rk", "symplectic_rk", "sprk", "cg", "cf", "rkmk", "vcg", "vcf", "vrkmk")
"""Families with the conditions of ``rk``, and no others, up to order 2."""


def implied(facts: Iterable[Fact], family: Family, order: int) -> bool:
    """Say whether ``facts`` about a tableau imply that it has at least this order in ``family``.

    >>> from orderconds import families
    >>> facts = [("cg", 4)]
    >>> implied(facts, families.get("rk"), 4), implied(facts, families.get("rkmk(1)"), 3)
    (True, True)
    >>> implied(facts, families.get("vcg"), 2), implied(facts, families.get("vcg"), 3)
    (True, False)
    """
    return order <= least_order(facts, family)


def least_order(facts: Iterable[Fact], family: Family) -> int:
    """Return the order that ``facts`` about a tableau imply that it has in ``family``, or 0.

    >>> from orderconds import families
    >>> least_order([("sprk", 6), ("rk", 6)], families.get("vrkmk(2)"))
    5
    """
    known = consequences(facts)
    best = known.get(family.label(), 0)
    if family.name == "splitting":
        best = max(best, min(3, known.get("rkn", 0)))  # brackets vanish from order four on
    if family.name in ONE_TABLEAU:
        best = max(best, min(2, known.get("rk", 0)))
    if family.name in ("rkmk", "vrkmk"):
        best = max(best, _truncated(known.get("rk" if family.name == "rkmk" else "sprk", 0), family))
    return best


def consequences(facts: Iterable[Fact]) -> dict[str, int]:
    """Return the order, by label of a family, of each family whose conditions are among those of the facts.

    >>> consequences([("vrkmk(1)", 3)])
    {'vrkmk(1)': 3, 'sprk': 3, 'rk': 3, 'symplectic_rk': 3}
    """
    known = dict[str, int]()
    waiting = list(facts)
    while waiting:
        label, proved = waiting.pop()
        if proved > known.get(label, 0):
            known[label] = proved
            base = label.partition("(")[0]
            waiting += [(other, proved) for other in ABELIAN.get(base, ())]
            if base in ("rkmk", "vrkmk"):
                waiting.append(("rk" if base == "rkmk" else "sprk", proved))
    return known


def settled(facts: Iterable[Fact], orders: Mapping[str, int], family: Family) -> int | None:
    """Return the order in ``family`` where theorems leave one only, else None.

    ``facts`` are lower bounds, ``orders`` exact orders by label: no family has a higher order than one whose
    conditions are among its own.

    >>> from orderconds import families
    >>> settled([("composition", 8)], {"composition": 8, "rk": 8}, families.get("vcg"))
    8
    >>> settled([("rk", 4)], {"rk": 4}, families.get("cg")) is None
    True
    """
    among = consequences([(family.label(), 1)])
    upper = min((order for label, order in orders.items() if label in among), default=None)
    return upper if upper is not None and upper <= least_order(facts, family) else None


def _truncated(abelian: int, family: Any) -> int:
    """Return min(p, R + 2), p the order where brackets vanish.

    dexpinv cut after r leaves an error of h^(r+3), and B_(r+1) = 0 for even r >= 2 makes the cut after r that
    after R = r + 1 (HLW Theorem IV.8.4; Bogfjellmo and Marthinsen, Theorem 3.5.3).
    """
    r = family.cutoff
    if r is None:
        return abelian
    kept = r + 1 if r >= 2 and r % 2 == 0 else r
    return min(abelian, int(kept) + 2)
