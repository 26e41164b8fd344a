"""Runge-Kutta methods. For a rooted tree with density gamma, the condition is that the elementary weight is
1/gamma (HLW III.1, Thm 1.5)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cached_property, lru_cache, partial
from typing import ClassVar, Self

from orderconds.conditions import OrderCondition
from orderconds.families.base import Family, all_nonzero, expect
from orderconds.families.elementary_weights import elementary_weight
from orderconds.families.memo import Memo
from orderconds.families.registry import register
from orderconds.formula import Formula
from orderconds.ring.protocol import Element, Ring
from orderconds.series.b_series import ElementaryWeights, runge_kutta_series
from orderconds.tableau.method_properties import symmetric
from orderconds.tableau.methods import CommutatorFree, Composition, PartitionedRungeKutta, RungeKutta
from orderconds.tableau.products import Method
from orderconds.tableau.record import Tableau
from orderconds.trees.levels import Tree, children, density, text
from orderconds.trees.rooted import rooted_trees


@register
class RungeKuttaFamily(Family):
    """Runge-Kutta methods for ordinary differential equations.

    >>> [str(condition) for condition in RungeKuttaFamily().conditions(3)]
    ['sum_{i,j} b_i a_ij c_j = 1/6', 'sum_i b_i c_i^2 = 1/3']
    """

    name = "rk"
    description = (
        "Runge-Kutta methods: for each rooted tree, elementary weight = 1/gamma (HLW III.1, Thm 1.5)."
    )
    formats = ("rk",)
    trees = "rooted"
    illustrates: ClassVar[tuple[str, ...]] = ("rooted",)
    search_limit = 12
    over_rationals = True
    implies: ClassVar[Mapping[str, str]] = {
        "symplectic_rk": "the methods of the family symplectic_rk are Runge-Kutta methods"
    }
    low_order = "rk"
    bounds_others = True
    default_series = True
    low_storage: ClassVar[tuple[str, ...]] = ("rk", "cf")
    fixed_stages = True
    unknowns = "rk"

    def conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the conditions of the given order, one for each rooted tree. The conditions are independent
        (HLW III.1, Ex. 5)."""
        return _conditions(self.name, order)

    @cached_property
    def _memo(self) -> Memo[ElementaryWeights[Tree]]:
        return Memo(_series)

    def evaluate(
        self, method: Method, ring: Ring, conditions: Sequence[OrderCondition]
    ) -> tuple[Element, ...]:
        """Return the elementary weights of a tableau (A, b), one for each element of ``conditions``."""
        weights = self._memo(method, ring)
        return tuple(weights(condition.key) for condition in conditions)

    def read(self, tableau: Tableau) -> Method | None:
        """Return the tableau (A, b) of the method. If the method has no such tableau, return the tableau of
        the Runge-Kutta method to which it reduces on an abelian group."""
        return tableau.read_as(self.formats) or tableau.abelian()

    @classmethod
    def claimable(cls, tableau: Tableau) -> Self | None:
        """Return this family if the method of ``tableau`` is a Runge-Kutta method, a commutator-free method
        or a composition of symmetric methods. Otherwise return None."""
        return cls() if isinstance(tableau.method, RungeKutta | CommutatorFree | Composition) else None

    def is_symmetric(self, method: Method, ring: Ring) -> bool:
        """Return True if the tableau is proved to be symmetric."""
        return symmetric_tableau(method, ring)


def symmetric_tableau(method: Method, ring: Ring) -> bool:
    """Return True if a tableau is proved to be symmetric. For a partitioned method, each of the two tableaux
    must be proved to be symmetric.

    >>> from orderconds.tableau import find
    >>> gauss2 = Tableau.load(find("gauss2"))
    >>> symmetric_tableau(gauss2.method, gauss2.ring)
    True
    """
    if isinstance(method, PartitionedRungeKutta):
        both = (RungeKutta(method.A, method.b), RungeKutta(method.A_hat, method.b_hat))
        return all(symmetric(part, ring) is True for part in both)
    return isinstance(method, RungeKutta) and symmetric(method, ring) is True


def weights_of(tableau: Tableau) -> tuple[Element, ...] | None:
    """Return the weights b_i of a Runge-Kutta tableau, or the coefficients gamma_i of a composition. Return
    None for other formats.

    >>> from orderconds.tableau import find
    >>> [str(x) for x in weights_of(Tableau.load(find("rk4")))]
    ['1/6', '1/3', '1/3', '1/6']
    """
    method = tableau.method
    if isinstance(method, RungeKutta):
        return method.b
    return method.gamma if isinstance(method, Composition) else None


def has_weights(tableau: Tableau, *, nonzero: bool = False) -> bool:
    """Return True if ``weights_of(tableau)`` is not None. If ``nonzero`` is true, all weights must also be
    proved to be non-zero.

    >>> from orderconds.tableau import find
    >>> cg4 = Tableau.load(find("cg4"))
    >>> has_weights(cg4), has_weights(cg4, nonzero=True)
    (True, False)
    """
    b = weights_of(tableau)
    return b is not None and (not nonzero or all_nonzero(b, tableau.ring))


def _series(method: Method, ring: Ring) -> ElementaryWeights[Tree]:
    tableau = expect(method, RungeKutta)
    return runge_kutta_series(ring, tableau.A, tableau.b)


@lru_cache(maxsize=32)
def _conditions(family: str, order: int) -> tuple[OrderCondition, ...]:
    return tree_conditions(tuple(rooted_trees(order)), family)


def tree_conditions(trees: Sequence[Tree], family: str = "rk") -> tuple[OrderCondition, ...]:
    r"""Return one condition for each tree: the elementary weight is 1/gamma, where gamma is the density of
    the tree (HLW III.1, Theorem 1.5). The conditions belong to the family with the label ``family``.

    >>> print(*tree_conditions([b"\0\1\1"]))
    sum_i b_i c_i^2 = 1/3
    """
    return tuple(
        OrderCondition(
            family, len(tree), text(tree), partial(_weight, tree), Fraction(1, density(tree)), tree
        )
        for tree in trees
    )


def _weight(tree: Tree) -> Formula:
    return elementary_weight(tree, _branches, "b")


@lru_cache(maxsize=1 << 16)
def _branches(tree: Tree) -> tuple[tuple[int, Tree], ...]:
    return tuple((0, child) for child in children(tree))
