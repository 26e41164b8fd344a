"""Discrete gradient methods on Lie groups.

A step from x0 to x1 uses the mean of dH over a curve from x0 to x1. Here dH is the differential of the
Hamiltonian. A quadrature rule approximates this mean. The methods preserve the energy exactly (H. Marthinsen,
*On symplectic integration in Lie groups and manifolds*, PhD thesis, NTNU Trondheim, 2014, Section 2.6). The
order is never higher than two.
"""

from __future__ import annotations

from collections.abc import Sequence

from orderconds.conditions import OrderCondition
from orderconds.errors import InputError
from orderconds.families.base import Family
from orderconds.families.registry import register
from orderconds.families.rk import RungeKuttaFamily, tree_conditions
from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.products import Method
from orderconds.tableau.record import Tableau
from orderconds.tableau.work import Work
from orderconds.trees.rooted import rooted_trees


@register
class DiscreteGradientFamily(Family):
    """Discrete gradient methods, given by the nodes c_i and weights b_i of a tableau (A, b).

    >>> [str(c) for n in (1, 2) for c in DiscreteGradientFamily().conditions(n)]
    ['sum_i b_i = 1', 'sum_i b_i c_i = 1/2']
    """

    name = "discrete_gradient"
    description = "Discrete gradient methods of order at most two, which preserve the energy exactly."
    formats = ("rk",)
    order_bound = 2
    trees = "rooted"
    low_order = "rk"
    keeps_energy = True

    def conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the condition of the given order: sum_i b_i = 1 for order 1, or
        sum_i b_i c_i = 1/2 for order 2.

        Raises :class:`~orderconds.errors.InputError` for orders above two.
        """
        if order > self.order_bound:
            raise InputError(
                f"there are no conditions of order {order}",
                where=f"family {self.name}",
                expected="order 1 or 2, because no method of this family has a higher order",
            )
        return tree_conditions(tuple(rooted_trees(order)), self.name)

    def evaluate(
        self, method: Method, ring: Ring, conditions: Sequence[OrderCondition]
    ) -> tuple[Element, ...]:
        """Return the left-hand sides: sum_i b_i for order 1, and sum_i b_i c_i for order 2."""
        return RungeKuttaFamily().evaluate(method, ring, conditions)

    def work(self, tableau: Tableau) -> Work | None:
        """Return None: a step evaluates no vector field, so there are no evaluations to count."""
        return None
