"""The order to which a method is symmetric.

The order is computed from the composition of two steps: a step of size h, then a step of size -h. A method is
symmetric to order q if the composition differs from the identity by O(h^(q + 1)). The largest such q is odd
and not smaller than the order p of the method. If this q is larger than p + 1, the method is called
effectively symmetric (Shmelev, Ebrahimi-Fard, Tapia and Salvi, arXiv 2507.21006).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from orderconds import families
from orderconds.checking.report import SymmetryOrder
from orderconds.families.cf import CommutatorFreeFamily
from orderconds.series.b_series import runge_kutta_series
from orderconds.series.characters import ORDERED, ROOTED, Character
from orderconds.tableau import Tableau
from orderconds.tableau.methods import CommutatorFree, RungeKutta
from orderconds.trees.ordered import ordered_forests
from orderconds.trees.rooted import rooted_trees

MOST_ROOTED, MOST_ORDERED = 8, 6
"""The test of symmetry uses rooted trees with at most MOST_ROOTED vertices, and ordered forests with at most
MOST_ORDERED vertices."""


def symmetry_order(tableau: Tableau, symmetric: bool | None) -> SymmetryOrder | None:
    """Return the order to which a Runge-Kutta or commutator-free method is symmetric.

    Return None for other methods. The result is valid on vector spaces for Runge-Kutta methods, and on groups
    for commutator-free methods.

    ``symmetric`` is True if the method is known to be symmetric. In this case,
    the result has ``order=None`` (all orders).

    >>> symmetry_order(Tableau.load("rk4"), False).order, symmetry_order(Tableau.load("gauss2"), True).order
    (5, None)
    """
    series = _series(tableau)
    if series is None:
        return None
    label, step, trees, most = series
    if symmetric is True:
        return SymmetryOrder(label, None)
    ring, certificate = tableau.ring, "exact"
    there_and_back = step.then(step.scaled(ring.rational(-1)))
    for n in range(2, most + 1, 2):
        verdicts = {ring.is_zero(there_and_back(tree)) for tree in trees(n)}
        if False in verdicts:
            return SymmetryOrder(label, n - 1, certificate)
        if None in verdicts:
            certificate = "decimal"
    return SymmetryOrder(label, most + 1, certificate, at_least=True)


def _series(tableau: Tableau) -> tuple[str, Character, Callable[[int], Iterator[bytes]], int] | None:
    """Return the data for the test of symmetry as a tuple (label, step, trees, most).

    - ``label`` is the label of the family of the method.
    - ``step`` is the series of one step.
    - ``trees(n)`` yields the trees or forests with n vertices.
    - ``most`` is the largest n in the test.

    Return None if the method is neither a Runge-Kutta method nor a commutator-free method.
    """
    method, ring = tableau.method, tableau.ring
    if isinstance(method, RungeKutta):
        weights = runge_kutta_series(ring, method.A, method.b)
        return "rk", Character(ring, ROOTED, weights), rooted_trees, MOST_ROOTED
    if isinstance(method, CommutatorFree):
        family = families.get("cf")
        assert isinstance(family, CommutatorFreeFamily)
        return "cf", Character(ring, ORDERED, family.series(method, ring)), ordered_forests, MOST_ORDERED
    return None
