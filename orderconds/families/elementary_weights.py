"""Elementary weights of rooted trees as index sums, and the order conditions of trees.

The order condition of a tree states that the elementary weight is equal to 1/gamma, where gamma is the
density of the tree. In the elementary weight, an edge of kind 0 gives a factor a_ij, and an edge of kind 1
gives a factor ahat_ij.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from functools import lru_cache, partial
from typing import TypeVar

from orderconds.conditions import OrderCondition
from orderconds.families.relations import RootSwitching, with_relations
from orderconds.formula import Formula, IndexSum, Power, Product, coefficient, fresh
from orderconds.ring.protocol import Element
from orderconds.trees.directed import DirectedTree, branches, density

TreeT = TypeVar("TreeT", bound=bytes)

ROW_SUMS = ("c", "chat")
MATRICES = ("a", "ahat")
WEIGHTS = ("b", "bhat")

kept_branches = lru_cache(maxsize=1 << 16)(branches)
"""The function :func:`branches` with a cache of its results."""


def conjugate(A: Sequence[Sequence[Element]], b: Sequence[Element]) -> list[list[Element]]:
    """Return the matrix ahat with the entries ahat_ij = b_j (1 - a_ji / b_i). No b_i may be zero.

    The tableaux (A, b) and (ahat, b) define a symplectic partitioned Runge-Kutta method (Hairer, Lubich and
    Wanner, Geometric Numerical Integration, VI.4).

    >>> from orderconds.ring import QQ
    >>> str(conjugate([[QQ.zero]], [QQ.one])[0][0])
    '1'
    """
    stages = range(len(b))
    return [[b[j] - b[j] * A[j][i] / b[i] for j in stages] for i in stages]


def weight(tree: DirectedTree, weights: str = "b") -> Formula:
    r"""Return the elementary weight of a tree as an index sum.

    The argument ``weights`` is the name of the weights in the formula: ``b`` or ``bhat``.

    >>> from orderconds.formula import named
    >>> named(weight(b"\0\2\3")).text()
    'sum_i b_i c_i chat_i'
    """
    return elementary_weight(tree, branches, weights)


def elementary_weight(
    tree: TreeT, below: Callable[[TreeT], Iterable[tuple[int, TreeT]]], weights: str
) -> Formula:
    r"""Return the elementary weight of a tree as an index sum.

    A tree with n vertices is a bytes object of length n. ``below(tree)`` contains a pair (kind, subtree) for
    each edge at the root of the tree.

    >>> from orderconds.formula import named
    >>> from orderconds.trees.levels import children
    >>> named(elementary_weight(b"\0\1\2\1\2", lambda tree: [(0, t) for t in children(tree)], "b")).text()
    'sum_i b_i (sum_j a_ij c_j)^2'
    """
    i = fresh()
    return _summed((i,), [coefficient(weights, i)], tree, below)


def weight_conditions(
    family: str,
    trees: Sequence[DirectedTree],
    text: Callable[[DirectedTree], str],
    formula: Callable[[DirectedTree], Formula] = weight,
    switching: RootSwitching | None = None,
) -> tuple[OrderCondition, ...]:
    """Return the order conditions of the trees.

    The function ``switching`` expresses the elementary weights of some trees as polynomials in the elementary
    weights of other trees. If ``switching`` is given, the attribute ``relation`` of the conditions contains
    the polynomials as text.

    >>> from orderconds.trees.directed import directed_free_trees, text
    >>> [str(condition) for condition in weight_conditions("sprk", directed_free_trees(2), text)]
    ['sum_i b_i c_i = 1/2']
    """
    conditions = [weight_condition(family, tree, text, formula) for tree in trees]
    return tuple(conditions) if switching is None else with_relations(conditions, switching, text)


def weight_condition(
    family: str,
    tree: DirectedTree,
    text: Callable[[DirectedTree], str],
    formula: Callable[[DirectedTree], Formula] = weight,
) -> OrderCondition:
    """Return the order condition of a tree.

    The elementary weight of the tree must be equal to 1/gamma, where gamma is the density of the tree.

    >>> from orderconds.trees.directed import text
    >>> print(weight_condition("sprk", bytes((0, 3)), text))
    sum_i b_i chat_i = 1/2
    """
    return OrderCondition(
        family, len(tree), text(tree), partial(formula, tree), Fraction(1, density(tree)), tree
    )


def _summed(
    indices: tuple[str, ...],
    factors: list[Formula],
    tree: TreeT,
    below: Callable[[TreeT], Iterable[tuple[int, TreeT]]],
) -> Formula:
    """Return the sum of a product over the indices of all vertices of ``tree``.

    The last element of ``indices`` is the index of the root. The factors of the product are ``factors`` and,
    for each edge from a vertex with index i to its child with index j, a coefficient a_ij or ahat_ij.
    """
    bound = list(indices)
    _multiply(bound, factors, bound[-1], tree, below)
    return IndexSum(tuple(bound), (), factors[0] if len(factors) == 1 else Product(tuple(factors)))


def _multiply(
    bound: list[str],
    factors: list[Formula],
    i: str,
    tree: TreeT,
    below: Callable[[TreeT], Iterable[tuple[int, TreeT]]],
) -> None:
    counted: dict[tuple[int, TreeT], int] = {}
    # The branches are sorted so that the factors c_i of leaves come before the factors of larger branches.
    for branch in sorted(below(tree), key=lambda x: len(x[1]) > 1):
        counted[branch] = counted.get(branch, 0) + 1
    for (kind, child), times in counted.items():
        if len(child) == 1:
            row_sum = coefficient(ROW_SUMS[kind], i)
            factors.append(row_sum if times == 1 else Power(row_sum, times))
            continue
        j = fresh()
        entry = coefficient(MATRICES[kind], i, j)
        if times == 1:
            bound.append(j)
            factors.append(entry)
            _multiply(bound, factors, j, child, below)
        else:
            factors.append(Power(_summed((j,), [entry], child, below), times))
