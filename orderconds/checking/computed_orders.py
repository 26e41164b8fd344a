"""The computed orders of a tableau in several families."""

from __future__ import annotations

from orderconds.checking.claimable import claimable_families
from orderconds.checking.verdict import check
from orderconds.tableau import Tableau


def orders_of(tableau: Tableau) -> dict[str, int]:
    """Return the computed orders of a tableau in several families.

    The result contains each family from :func:`~orderconds.checking.claimable.claimable_families`, and each
    family in which the tableau file claims an order.

    >>> orders_of(Tableau.load("cf3"))
    {'rk': 3, 'cf': 3}
    """
    labels = [family.label() for family in claimable_families(tableau)]
    labels += [claim.label for claim in tableau.claims.orders]
    return {label: check(tableau, family=label).orders[0].order for label in dict.fromkeys(labels)}
