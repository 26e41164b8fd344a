"""Recognition of Butcher tableaux that are compositions of implicit midpoint steps."""

from __future__ import annotations

from dataclasses import replace

from orderconds.tableau.methods import Composition, RungeKutta
from orderconds.tableau.record import Tableau


def as_composition(tableau: Tableau) -> Tableau | None:
    """Return a Runge-Kutta method (A, b) as a composition of implicit midpoint steps of sizes b_i h. Return
    None if the method is not such a composition.

    The conditions are a_ij = b_j for j < i, a_ii = b_i/2 and a_ij = 0 for j > i (Bogfjellmo and Marthinsen,
    Lemma 3.5.4). The third condition, a_ij = 0 for j > i, must hold exactly. If coefficients are rounded
    decimals, the other two conditions need to hold only within the uncertainty of the decimals.

    >>> from orderconds.tableau import find
    >>> jump = Tableau.load(find("triple_jump"))
    >>> arrays = replace(jump, family="rk", method=jump.read_as(("rk",)))
    >>> recognised = as_composition(arrays)
    >>> recognised.family, len(recognised.method.gamma)
    ('composition', 3)
    >>> as_composition(Tableau.load(find("gauss2"))) is None
    True
    """
    method, ring = tableau.method, tableau.ring
    if not isinstance(method, RungeKutta):
        return None
    A, b = method.A, method.b
    for i, row in enumerate(A):
        below = [(x, b[j]) for j, x in enumerate(row[:i])]
        if any(ring.is_zero(x) is not True for x in row[i + 1 :]):
            return None
        if any(ring.is_zero(x - y) is False for x, y in (*below, (row[i] + row[i], b[i]))):
            return None
    composition = Composition("symmetric-2", tuple(b))
    return replace(tableau, family="composition", method=composition, embedded=None, proof=None, file=None)
