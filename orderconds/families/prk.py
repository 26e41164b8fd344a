"""Partitioned Runge-Kutta methods: one condition for each rooted tree with vertices of two colours (Hairer,
Lubich and Wanner, *Geometric Numerical Integration* (HLW), III.2.2).

The variables of the system are divided into two sets, and each tableau is applied to one set. If a file
contains a single tableau, this tableau is applied to both sets.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import ClassVar, Self

from orderconds.conditions import OrderCondition
from orderconds.families.base import Family, expect
from orderconds.families.elementary_weights import (
    WEIGHTS,
    kept_branches,
    weight,
    weight_condition,
    weight_conditions,
)
from orderconds.families.reductions import Substitute
from orderconds.families.registry import get, register
from orderconds.families.rk import symmetric_tableau
from orderconds.formula import Formula
from orderconds.ring.protocol import Element, Ring
from orderconds.series.b_series import ElementaryWeights
from orderconds.tableau.method_properties import symplectic_pair
from orderconds.tableau.methods import PartitionedRungeKutta, RungeKutta
from orderconds.tableau.products import Method
from orderconds.tableau.record import Tableau
from orderconds.trees import bicoloured
from orderconds.trees.bicoloured import BicolouredTree
from orderconds.trees.directed import DirectedTree


@register
class PartitionedFamily(Family):
    """Partitioned Runge-Kutta methods, given by two tableaux (A, b) and (A_hat, b_hat).

    >>> [len(PartitionedFamily().conditions(n)) for n in range(1, 6)]
    [2, 4, 14, 52, 214]
    >>> [str(condition) for condition in PartitionedFamily().conditions(2)][1:3]
    ['sum_i b_i chat_i = 1/2', 'sum_i bhat_i c_i = 1/2']
    """

    name = "prk"
    description = (
        "Partitioned Runge-Kutta methods: one condition for each rooted tree with "
        "vertices of two colours (Hairer, Lubich and Wanner, Geometric Numerical Integration, III.2.2)."
    )
    formats = ("prk", "rk")
    trees = "bicoloured"
    illustrates: ClassVar[tuple[str, ...]] = ("bicoloured",)
    search_limit = 7
    over_rationals = True
    implies: ClassVar[Mapping[str, str]] = {
        "rk": "y' = f(y) is a partitioned system with all variables in the first group"
    }

    def conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the conditions of the given order. The conditions are independent (HLW III.2, Theorem
        2.5)."""
        trees = tuple(bicoloured.bicoloured_rooted_trees(order))
        return weight_conditions(self.name, trees, bicoloured.text, rooted_weight)

    def decisive_in_turn(self, order: int) -> Iterator[tuple[BicolouredTree, Callable[[], OrderCondition]]]:
        """Yield a pair (tree, function) for each tree with ``order`` vertices. The function returns the
        condition of the tree."""
        for tree in bicoloured.bicoloured_rooted_trees(order):
            yield tree, partial(weight_condition, self.name, tree, bicoloured.text, rooted_weight)

    def evaluate(
        self, method: Method, ring: Ring, conditions: Sequence[OrderCondition]
    ) -> tuple[Element, ...]:
        """Return the elementary weight of the tree of each condition, for a pair of tableaux."""
        return rooted_weights(as_pair(method), ring, conditions)

    @classmethod
    def claimable(cls, tableau: Tableau) -> Self | None:
        """Return None for a symplectic pair of tableaux, because the file of a symplectic pair claims an
        order in the family ``sprk_separable``.

        Return this family for every other pair, and also if the program cannot decide whether a pair is
        symplectic. Return None for a tableau that is not a pair.
        """
        method = tableau.method
        if not isinstance(method, PartitionedRungeKutta) or symplectic_pair(method, tableau.ring):
            return None
        return cls()

    def is_symmetric(self, method: Method, ring: Ring) -> bool:
        """Return True if ``method`` is a pair of tableaux and both are proved to be symmetric."""
        return isinstance(method, PartitionedRungeKutta) and symmetric_tableau(method, ring)

    def substitute(self, method: Method, ring: Ring) -> Substitute | None:
        """For a symplectic pair with b = bhat and non-zero weights, return the family ``sprk`` and the first
        tableau of the pair. For other methods, return None.

        For such a pair, the conditions of ``sprk`` imply all conditions of ``prk`` (HLW VI.7, Theorem 7.4).
        """
        if not isinstance(method, PartitionedRungeKutta):
            return None
        same = all(ring.is_zero(x - y) is True for x, y in zip(method.b, method.b_hat, strict=True))
        nonzero = all(ring.is_zero(x) is False for x in method.b)
        if not (same and nonzero and symplectic_pair(method, ring) is True):
            return None
        return Substitute(get("sprk"), method.first())


def as_pair(method: Method) -> PartitionedRungeKutta:
    """Return a method as a pair of tableaux. A single tableau becomes a pair of two equal tableaux.

    >>> as_pair(RungeKutta(((0,),), (1,))).b_hat
    (1,)
    """
    if isinstance(method, RungeKutta):
        return PartitionedRungeKutta(method.A, method.b, method.A, method.b)
    return expect(method, PartitionedRungeKutta)


def rooted_weight(tree: BicolouredTree) -> Formula:
    r"""Return the elementary weight of a coloured tree as an index sum. A black root has the weights b, and a
    white root has the weights bhat.

    >>> from orderconds.formula import named
    >>> named(rooted_weight(b"\1\2")).text()
    'sum_i bhat_i c_i'
    """
    return weight(bicoloured.coloured(0, tree), WEIGHTS[tree[0]])


def rooted_weights(
    pair: PartitionedRungeKutta, ring: Ring, conditions: Sequence[OrderCondition]
) -> tuple[Element, ...]:
    """Return the elementary weights of a pair of tableaux, one for the coloured tree of each condition.

    >>> from orderconds.ring import QQ
    >>> from orderconds.tableau import Tableau, find
    >>> verlet = Tableau.load(find("stormer_verlet")).method
    >>> [str(x) for x in rooted_weights(verlet, QQ, PartitionedFamily().conditions(2))]
    ['1/2', '1/2', '1/2', '1/2']
    """
    matrices = (pair.A, pair.A_hat)
    of_colour = [
        ElementaryWeights[DirectedTree](ring, matrices, b, kept_branches) for b in (pair.b, pair.b_hat)
    ]
    return tuple(of_colour[c.key[0]](bicoloured.coloured(0, c.key)) for c in conditions)
