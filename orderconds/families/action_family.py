"""The base class of families of variational methods. These methods have one order condition for each action
tree (:mod:`orderconds.series.action_trees`).
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import cache, cached_property, lru_cache, partial
from math import prod
from typing import TYPE_CHECKING, Self

from orderconds.conditions import OrderCondition
from orderconds.families.action_formula import ActionFormula, multiplier
from orderconds.families.base import Family, in_ring
from orderconds.families.memo import Memo
from orderconds.families.rk import has_weights
from orderconds.ring.protocol import Element, Ring
from orderconds.series import action_exact
from orderconds.series.action_counts import class_count
from orderconds.series.action_enumeration import velocities
from orderconds.series.action_switching import classes_in_turn, representatives
from orderconds.series.action_trees import Force, Momentum, Transport, Velocity, hamiltonian
from orderconds.tableau.products import Method
from orderconds.tableau.record import Tableau

if TYPE_CHECKING:
    import numpy as np

    from orderconds.ring.protocol import RandomRing
    from orderconds.series.action import ActionSeries
    from orderconds.series.action_relations import Polynomial


class ActionFamily(Family):
    """A family with one order condition for each action tree.

    The left-hand side of the condition of the tree t is ``sum_i b_i tau_t(i)``. The number ``tau_t(i)`` is
    the coefficient of t in the velocity of stage i. Velocities are elements of the Lie algebra. The
    conditions of order n belong to the trees with n vertices.

    The function :meth:`conditions` returns independent conditions. The function :meth:`decisive_conditions`
    is faster, but its conditions can be dependent.
    """

    needs_nonzero_weights = True
    trees = "action"
    search_limit = 6
    low_order = "rk"
    on_groups = True

    @abstractmethod
    def series(self, method: Method, ring: Ring) -> ActionSeries:
        """Return the action series of a method. Raises ZeroWeight if a weight b_i is zero."""

    @abstractmethod
    def random_series(self, ring: RandomRing, generator: np.random.Generator, order: int) -> ActionSeries:
        """Return the action series of a random method of this family, with coefficients in ``ring``.

        If the elements of ``ring`` are vectors with n entries, the result contains the series of n random
        methods. The number of stages grows with ``order``. With too few stages, independent conditions could
        seem dependent.
        """

    @abstractmethod
    def formula(self) -> ActionFormula:
        """Return the object that writes the conditions of this family as sums over indices."""

    def conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return independent conditions of the given order. A condition is omitted if it follows from simpler
        conditions."""
        return tuple(map(self.condition, _independent(self, order)[-1]))

    def all_conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the conditions of all trees of the given order, sorted by the attribute ``key`` of the
        trees.

        The attribute ``relation`` of a dependent condition expresses its left-hand side as a polynomial in
        the left-hand sides of independent conditions.
        """
        related = _relations(self, order)
        return tuple(replace(self.condition(tree), relation=related.get(tree)) for tree in velocities(order))

    def relations(self, order: int) -> dict[Velocity, Polynomial]:
        """Return one polynomial for each dependent condition of the given order.

        The keys of the result are the trees of the dependent conditions. The polynomial equals the left-hand
        side of the dependent condition. The variables of the polynomial are the left-hand sides of
        independent conditions. A polynomial is a tuple of terms (q, trees). A term is the product of the
        number q and the left-hand sides of the conditions of ``trees``.

        >>> from orderconds.families import get
        >>> {str(t): [(str(q), trees) for q, trees in p] for t, p in get("vcg").relations(2).items()}
        {'o(|f(*))': [('1', (o(o),))], 'o(|L(o))': [('1/2', (o, o))]}
        """
        from orderconds.series.action_relations import relations

        polynomials = relations(partial(self.random_series, order=order), _independent(self, order))
        return {
            tree: tuple(
                (q * multiplier(tree) / prod(map(multiplier, trees)), trees) for q, trees in polynomial
            )
            for tree, polynomial in polynomials.items()
        }

    def dependence_holds(self, order: int) -> bool:
        """Return True if the polynomials ``relations(order)`` pass a test in rational arithmetic.

        Each polynomial P gives an equation L = P(L_1, ..., L_k). Here L is the left-hand side of a dependent
        condition, and L_1, ..., L_k are the left-hand sides of independent conditions. The equation must
        hold for one method with random rational coefficients. The equation must also hold if each left-hand
        side is replaced by the right-hand side of its condition.
        """
        from orderconds.series.action_relations import hold_over_rationals, relations

        polynomials = relations(partial(self.random_series, order=order), _independent(self, order))
        return hold_over_rationals(partial(self.random_series, order=order + 2), polynomials)

    def decisive_conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return conditions that imply all conditions of the given order.

        The conditions of trees that differ only in the choice of the root are equivalent. The result contains
        only the condition of the simplest of these trees.
        """
        return tuple(map(self.condition, representatives(order)))

    def decisive_in_turn(self, order: int) -> Iterator[tuple[Velocity, Callable[[], OrderCondition]]]:
        """Yield a pair (tree, function) for each condition that :meth:`decisive_conditions` returns. The
        function constructs the condition of the tree."""
        for of_class in classes_in_turn(order):
            yield of_class[0], partial(self.condition, of_class[0])

    def decisive_count(self, order: int) -> int:
        """Return the number of conditions in :meth:`decisive_conditions`, computed by a formula."""
        return class_count(order)

    @cached_property
    def _memo(self) -> Memo[ActionSeries]:
        return Memo(self.series)

    def evaluate(
        self, method: Method, ring: Ring, conditions: Sequence[OrderCondition]
    ) -> tuple[Element, ...]:
        """Return the left-hand sides of the conditions for a method with coefficients in ``ring``."""
        series = self._memo(method, ring)
        return tuple(series.condition(c.key) * multiplier(c.key) for c in conditions)

    def principal_residuals(self, method: Method, ring: Ring, order: int) -> tuple[Element, ...]:
        """Return one residual for each action tree of the given order.

        The residual is the coefficient of the tree in one step minus its coefficient in the exact flow.
        """
        series = self.series(method, ring)
        exact = action_exact.condition
        return tuple(series.condition(t) - in_ring(ring, exact(t)) for t in velocities(order))

    @classmethod
    def claimable(cls, tableau: Tableau) -> Self | None:
        """Return this family if ``tableau`` is a Runge-Kutta tableau or a composition, and all weights are
        provably non-zero. Otherwise return None."""
        return cls() if has_weights(tableau, nonzero=True) else None

    def elementary_hamiltonian(self, condition: OrderCondition) -> str:
        """Return the elementary Hamiltonian of the tree of a condition, as text."""
        return hamiltonian(condition.key)

    def condition(self, tree: Velocity) -> OrderCondition:
        """Return the order condition of a tree."""
        return OrderCondition(
            family=self.label(),
            order=tree.vertices,
            tree=tree.text,
            source=partial(self.formula().condition, tree),
            rhs=action_exact.condition(tree) * multiplier(tree),
            key=tree,
        )


@cache
def _relations(family: ActionFamily, order: int) -> dict[Velocity, str]:
    return {tree: _text(polynomial) for tree, polynomial in family.relations(order).items()}


def _text(polynomial: Polynomial) -> str:
    """Return a polynomial as text, such as ``3 <o(|L(o o))> - <o> <o(o)>``.

    Here <t> denotes the left-hand side of the condition of the tree t.
    """
    text = ""
    for q, trees in sorted(polynomial, key=lambda term: len(term[1])):
        sign = ("-" if q < 0 else "") if not text else (" - " if q < 0 else " + ")
        scale = f"{abs(q)} " if abs(q) != 1 else ""
        text += sign + scale + " ".join(f"<{tree}>" for tree in trees)
    return text or "0"


@cache
def _independent(family: ActionFamily, order: int) -> tuple[tuple[Velocity, ...], ...]:
    from orderconds.series.action_rank import independent_trees

    return independent_trees(partial(family.random_series, order=order), order)


@lru_cache(maxsize=1 << 14)
def longest_word(tree: Velocity) -> int:
    """The coefficient of the action tree ``tree`` is computed from coefficients of words, whose letters are
    smaller trees. Return the length of the longest of these words.

    >>> from orderconds.series.action_trees import velocity
    >>> longest_word(velocity((velocity(), velocity())))
    2
    """
    letters = max(map(longest_word, tree.word), default=0)
    return max(len(tree.word), letters, *map(_longest_in_momentum, tree.momenta), 0)


@lru_cache(maxsize=1 << 14)
def _longest_in_momentum(tree: Momentum) -> int:
    if isinstance(tree, Transport):
        return max(len(tree.word) + 1, *map(longest_word, tree.word))
    assert isinstance(tree, Force)
    word = (*tree.before, *tree.after)
    return max(len(word) + 1, *map(longest_word, word), *map(_longest_in_momentum, tree.momenta), 0)
