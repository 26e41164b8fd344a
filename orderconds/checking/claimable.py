"""The claimable families of a tableau: the families in which the file of the tableau should claim an order.

A family F is omitted if the order of the tableau in another family implies its order in F. For each family,
the method :meth:`orderconds.families.Family.claimable` makes this decision. The file of a tableau should
claim an order in these families:

- a Butcher tableau: ``rk``, ``cg`` and ``rkmk``; with non-zero weights also ``sprk``, ``vcg`` and ``vrkmk``.
- a commutator-free method: ``rk`` and ``cf``; with non-zero weights also ``vcf``.
- a partitioned method (a pair of tableaux): ``prk``, or only ``sprk_separable`` if the pair is symplectic.
"""

from __future__ import annotations

from orderconds import families
from orderconds.families import Family
from orderconds.tableau import Tableau


def claimable_families(tableau: Tableau) -> tuple[Family, ...]:
    """Return the families in which a file of this tableau should claim an order.

    The result is sorted: first families on vector spaces, then families on Lie groups, and finally families
    whose formulas divide by the weights.

    >>> from orderconds.checking import read
    >>> [family.name for family in claimable_families(read("rk4"))]
    ['rk', 'cg', 'rkmk', 'sprk', 'vcg', 'vrkmk']
    >>> [[f.name for f in claimable_families(read(name))] for name in ("cg4", "cf3")]
    [['rk', 'cg', 'rkmk'], ['rk', 'cf']]
    """
    classes = map(families.family_class, families.names())
    members = [family for c in classes if (family := c.claimable(tableau)) is not None]

    def place(family: Family) -> tuple[bool, bool, bool]:
        return family.needs_nonzero_weights, family.on_groups, family.formats[0] != tableau.family

    return tuple(sorted(members, key=place))


def unclaimed(tableau: Tableau) -> tuple[Family, ...]:
    """Return the families in which the file of the tableau should claim an order, but claims none.

    >>> from orderconds.tableau import find
    >>> unclaimed(Tableau.load(find("kutta3")))
    ()
    """
    claimed = {claim.family for claim in tableau.claims.orders} | {c.label for c in tableau.claims.orders}
    return tuple(f for f in claimable_families(tableau) if f.label() not in claimed)
