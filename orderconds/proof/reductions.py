"""Conditions that need not be evaluated, since theorems give them from what a tableau has been seen to meet.

``check`` walks up the orders 1, 2, ...; when it comes to order n, all lower conditions hold. Then

- *symmetry*: a symmetric method of odd order n - 1 has order n (HLW II.3, Theorem 3.2);
- *root switching*: of a symplectic pair with b = bhat the conditions of free trees with directed edges imply
  those of all rooted trees of two colours (Abia and Sanz-Serna 1993; HLW VI.7, Theorem 7.4);
- *canonical coordinates*: RKMK and VRKMK with the whole of dexpinv are the Runge-Kutta method and its
  symplectic partner in coordinates of the first kind, and have their order (HLW IV.8, Theorem 8.4; Bogfjellmo
  and Marthinsen, Section 3.4.1). A cut of dexpinv changes the value only of trees in which a word is long
  enough to see it, so that all others hold up to that order.

What a reduction rests on is decided exactly for the tableau at hand. Where coefficients are balls only the
last one is used, for a proved solution, and never raises a certificate.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Any

from msgspec import Struct

from orderconds import families
from orderconds.families import Family
from orderconds.ring import Balls
from orderconds.ring.protocol import Ring
from orderconds.series.action_trees import Force, Momentum, Transport, Velocity
from orderconds.series.dexpinv import bernoulli
from orderconds.tableau.methods import CommutatorFree, PartitionedRungeKutta, RungeKutta
from orderconds.tableau.palindromes import symmetric_paths
from orderconds.tableau.properties import symmetric, symplectic_pair
from orderconds.trees.levels import Forest, branches, trees_of

UNCUT = {"rkmk": "rk", "vrkmk": "sprk"}
"""Families with a cut of dexpinv, and the one whose order they have without it."""


class Reductions(Struct, frozen=True):
    """What follows for one method in one family.

    ``even`` says that it is symmetric; ``free_trees`` is its symplectic pair as a tableau of ``sprk``;
    ``uncut`` the order that it has with the whole of dexpinv, and ``longest`` the length of the words
    that do not see the cut.
    """

    ring: Ring
    even: bool = False
    free_trees: RungeKutta | None = None
    uncut: int = 0
    longest: int = 0

    def order_follows(self, n: int) -> bool:
        """Say whether all conditions of order n hold, given that all lower ones do."""
        return self.even and n % 2 == 0

    def rest_follows(self, n: int) -> bool:
        """Say the same at the price of evaluating fewer conditions, where they are few; else False."""
        if self.free_trees is None:
            return False
        sprk = families.get("sprk")
        residuals = families.residuals(sprk, self.free_trees, self.ring, sprk.conditions(n))
        return all(self.ring.is_zero(x) is True for x in residuals)

    def follows(self, n: int, key: Any) -> bool:
        """Say whether the condition of order n that a tree or forest ``key`` names holds."""
        return n <= self.uncut and _longest_word(key) <= self.longest


def reductions(family: Family, method: Any, ring: Ring, orders: Mapping[str, int]) -> Reductions:
    """Return what follows for ``method`` in ``family``; ``orders`` are proved orders of the same tableau.

    >>> from orderconds.ring import QQ
    >>> from orderconds.tableau import Tableau, find
    >>> rk4 = Tableau.load(find("rk4")).method
    >>> found = reductions(families.get("vrkmk(2)"), rk4, QQ, {"sprk": 4})
    >>> found.uncut, found.longest
    (4, 4)
    """
    uncut, longest = 0, 0
    if family.name in UNCUT and isinstance(method, RungeKutta):
        uncut = orders.get(UNCUT[family.name], 0)
        longest = _unseen(getattr(family, "cutoff", None))
    if isinstance(ring, Balls):
        return Reductions(ring, uncut=uncut, longest=longest)
    return Reductions(ring, _symmetric(family, method, ring), _pair(family, method, ring), uncut, longest)


def _symmetric(family: Family, method: Any, ring: Ring) -> bool:
    """Say whether the step of this family is proved to be symmetric.

    A variational method is where its discrete Lagrangian is, and that where the paths to the stages are.
    """
    if isinstance(method, CommutatorFree):
        return family.name in ("cf", "vcf") and symmetric_paths(method, ring) is True
    if isinstance(method, PartitionedRungeKutta):
        both = (RungeKutta(method.A, method.b), RungeKutta(method.A_hat, method.b_hat))
        return all(symmetric(part, ring) is True for part in both)
    if not isinstance(method, RungeKutta):
        return False
    if family.name in ("cg", "vcg"):
        return symmetric_paths(method.as_crouch_grossman(ring), ring) is True
    return family.name in ("rk", "sprk") and symmetric(method, ring) is True


def _pair(family: Family, method: Any, ring: Ring) -> RungeKutta | None:
    if family.name not in ("prk", "prk_same_weights") or not isinstance(method, PartitionedRungeKutta):
        return None
    same = all(ring.is_zero(x - y) is True for x, y in zip(method.b, method.b_hat, strict=True))
    nonzero = all(ring.is_zero(x) is False for x in method.b)
    return method.first() if same and nonzero and symplectic_pair(method, ring) is True else None


def _unseen(cutoff: int | None) -> int:
    """Return how long a word may be to have its whole value: one letter and no power of ad that is cut.

    >>> [_unseen(r) for r in (0, 1, 2, 3, 4)]
    [1, 2, 4, 4, 6]
    """
    if cutoff is None:
        return 1 << 30
    first = cutoff + 1
    while not bernoulli(first):
        first += 1
    return first


def _longest_word(key: Velocity | Forest) -> int:
    """Return the length of the longest word whose value enters that of a tree or forest."""
    return _in_velocity(key) if isinstance(key, Velocity) else _in_forest(key)


@lru_cache(maxsize=1 << 14)
def _in_velocity(tree: Velocity) -> int:
    letters = max(map(_in_velocity, tree.word), default=0)
    return max(len(tree.word), letters, *map(_in_momentum, tree.momenta), 0)


@lru_cache(maxsize=1 << 14)
def _in_momentum(tree: Momentum) -> int:
    """The varied velocity is a letter of its own."""
    if isinstance(tree, Transport):
        return max(len(tree.word) + 1, *map(_in_velocity, tree.word))
    assert isinstance(tree, Force)
    word = (*tree.before, *tree.after)
    return max(len(word) + 1, *map(_in_velocity, word), *map(_in_momentum, tree.momenta), 0)


def _in_forest(forest: Forest) -> int:
    below = trees_of(forest)
    return max(len(below), *(_in_forest(branches(tree)) for tree in below if len(tree) > 1), 0)
