"""The claimable families of a tableau. The tableau file should claim an order for each of these families.

For three kinds of methods, these families are:

- For a Butcher tableau: ``rk``, ``cg`` and ``rkmk``. If no weight is zero, also ``sprk``, ``vcg``, ``vrkmk``.
- For a commutator-free method: ``rk`` and ``cf``. If no weight is zero, also ``vcf``.
- For a partitioned method, which is a pair of tableaux: only ``sprk_separable`` if the pair is symplectic,
  otherwise only ``prk``.

For other kinds of methods, see the method ``claimable`` of each family.
"""

from __future__ import annotations

from orderconds import families
from orderconds.families import Family
from orderconds.tableau import Tableau


def claimable_families(tableau: Tableau) -> tuple[Family, ...]:
    """Return the families in which the file of ``tableau`` should claim an order.

    Families that need non-zero weights come last.

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
    """Return the families in which the tableau file should claim an order, but claims none.

    :func:`claimable_families` returns all families in which the tableau file should claim an order.

    >>> from orderconds.tableau import find
    >>> unclaimed(Tableau.load(find("kutta3")))
    ()
    """
    claimed = {claim.family for claim in tableau.claims.orders} | {c.label for c in tableau.claims.orders}
    return tuple(f for f in claimable_families(tableau) if f.label() not in claimed)
