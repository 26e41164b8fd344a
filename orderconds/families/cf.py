"""Commutator-free methods: each stage and the update are products of exponentials.

Each exponent is a linear combination of the values k_j of the vector field at the stages. The update with m
exponentials is exp(h sum_j beta_mj k_j) ... exp(h sum_j beta_1j k_j) y0, where the rightmost exponential acts
first. Stage i has coefficients alpha_iIj instead of beta_Ij, where I = 1, 2, ... is the number of the
exponential (Celledoni, Marthinsen and Owren, FGCS 19 (2003) 341). A method may compute stage i from the value
of an earlier stage. Then the product of stage i includes the exponentials of the earlier stage.

Printed conditions contain alpha, beta and three sums: b_j = sum_I beta_Ij, a_ij = sum_I alpha_iIj and the
abscissae c_i = sum_j a_ij.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from itertools import pairwise
from math import factorial, prod
from typing import ClassVar, Self

from orderconds.families.base import expect
from orderconds.families.cg import crouch_grossman_series
from orderconds.families.ordered_forests import OrderedForestFamily
from orderconds.families.registry import register
from orderconds.formula import Formula, coefficient, fresh, index_sum, one, product, total
from orderconds.ring.protocol import Element, Ring
from orderconds.series.b_series import sparse
from orderconds.series.lie_butcher import ExponentialsSeries
from orderconds.tableau.methods import CommutatorFree, RungeKutta
from orderconds.tableau.palindromes import symmetric_paths
from orderconds.tableau.products import Method
from orderconds.tableau.record import Tableau
from orderconds.tableau.work import Work, commutator_free_work
from orderconds.trees.levels import Forest, Tree, branches, trees_of
from orderconds.words.compositions import compositions

Exponentials = tuple[tuple[Element, ...], ...]
Table = Sequence[Element] | Sequence[Sequence[Element]] | Sequence[Sequence[Sequence[Element]]]


EXPONENTIAL_SYMBOLS = {
    "alpha": r"$\alpha_{iIj}$ is the coefficient of $k_j$ in exponential $I$ of stage $i$",
    "beta": r"$\beta_{Ij}$ is the coefficient of $k_j$ in exponential $I$ of the update",
    "a": r"$a_{ij} = \sum_I \alpha_{iIj}$",
    "b": r"$b_j = \sum_I \beta_{Ij}$",
    "c": r"$c_i = \sum_j a_{ij}$ are the abscissae",
}
"""Definitions, in LaTeX, of the coefficients in printed conditions."""


@register
class CommutatorFreeFamily(OrderedForestFamily):
    """Commutator-free methods.

    The family also accepts a Runge-Kutta tableau. The tableau then defines a Crouch-Grossman method, which is
    a special commutator-free method.

    >>> for condition in CommutatorFreeFamily().conditions(3):
    ...     print(condition)
    sum_{i,j} b_i a_ij c_j = 1/6
    sum_i b_i c_i^2 = 1/3
    sum_{I,i,j} beta_Ii c_i beta_Ij + 2 sum_{I<J,i,j} beta_Ii c_i beta_Jj = 1/3
    """

    name = "cf"
    description = (
        "Commutator-free methods: each stage and the update are products of exponentials of "
        "linear combinations of stage values."
    )
    formats = ("cf", "rk")
    symbols = EXPONENTIAL_SYMBOLS
    implies: ClassVar[Mapping[str, str]] = {"rk": "a vector space is a Lie group under addition"}
    default_series = True
    unknowns = "cf"

    def series(self, method: Method, ring: Ring) -> ExponentialsSeries:
        """Return the Lie-Butcher series of one step. A tableau (A, b) is read as a Crouch-Grossman method."""
        if isinstance(method, RungeKutta):
            return crouch_grossman_series(method, ring)
        *stages, update = [[sparse(ring, row) for row in rows] for rows in exponentials(method)]
        return ExponentialsSeries(ring, stages, update)

    def formula(self, forest: Forest) -> Formula:
        """Return the left-hand side of the condition of a forest as an index sum."""
        return _word(forest, lambda J, j: coefficient("beta", J, j), lambda j: coefficient("b", j), None)

    @classmethod
    def claimable(cls, tableau: Tableau) -> Self | None:
        """Return this family for a tableau in the format ``cf``, else None."""
        return cls() if isinstance(tableau.method, CommutatorFree) else None

    def is_symmetric(self, method: Method, ring: Ring) -> bool:
        """Return True if ``method`` is certainly symmetric.

        If the result is False, the method may still be symmetric. The result is always False if ``method`` is
        not an object :class:`CommutatorFree`.
        """
        return isinstance(method, CommutatorFree) and symmetric_paths(method, ring) is True

    def work(self, tableau: Tableau) -> Work | None:
        """Return the numbers of field evaluations and exponentials in one step."""
        return commutator_free_work(tableau)


def exponentials(method: Method) -> list[Exponentials]:
    """Return the exponents of each stage, and finally those of the update.

    The exponents of a stage are in the order in which their exponentials are applied to y0. An exponent is a
    tuple with one coefficient for each k_j.

    >>> from orderconds.tableau import Tableau, find
    >>> [len(rows) for rows in exponentials(Tableau.load(find("cf4")).method)]
    [0, 1, 1, 2, 2]
    """
    paths: list[Exponentials] = []
    commutator_free = expect(method, CommutatorFree)
    for stage in (*commutator_free.stages, commutator_free.update):
        before = paths[stage.start] if stage.start is not None else ()
        paths.append((*before, *stage.exponentials))
    return paths


def coefficient_tables(method: Method, ring: Ring) -> dict[str, Table]:
    """Return a dictionary with the arrays alpha, beta, a, b and c of a commutator-free method.

    The module docstring defines these coefficients.

    >>> from orderconds.ring import QQ
    >>> from orderconds.tableau import Tableau, find
    >>> [str(c) for c in coefficient_tables(Tableau.load(find("cf4")).method, QQ)["c"]]
    ['0', '1/2', '1/2', '1']
    """
    stages = expect(method, CommutatorFree).s
    *rows, update = exponentials(method)
    most = max(1, *(len(row) for row in rows))
    empty = (ring.zero,) * stages
    return {
        "alpha": [[*row, *([empty] * (most - len(row)))] for row in rows],
        "beta": update,
        "a": [_totals(own, stages, ring) for own in rows],
        "b": _totals(update, stages, ring),
        "c": [sum(_totals(own, stages, ring), ring.zero) for own in rows],
    }


def _totals(rows: Exponentials, stages: int, ring: Ring) -> list[Element]:
    return [sum((row[j] for row in rows), ring.zero) for j in range(stages)]


def _word(
    word: Forest,
    row: Callable[[str, str], Formula],
    row_total: Callable[[str], Formula],
    row_sum: Formula | None,
) -> Formula:
    """Return n! times the coefficient of a word of n letters in a product of exponentials.

    The function ``row(J, j)`` returns the coefficient of the stage value k_j in the exponent with index J.
    The sum of ``row(J, j)`` over J is ``row_total(j)``. The symbol ``row_sum`` denotes the sum of
    ``row(J, j)`` over J and j.
    """
    letters = trees_of(word)
    if len(set(letters)) == 1:
        alone = row_sum if row_sum is not None and len(letters[0]) == 1 else None
        # Exponentials of multiples of one letter commute, so their product is the exponential of the sum of
        # the exponents.
        j = fresh()
        first = alone or index_sum((j,), (), product(row_total(j), _stage(letters[0], j)))
        return product(*([first] * len(letters)))
    terms = []
    for runs in compositions(len(letters)):
        numbers = [fresh("J") for _ in runs]
        factors = [_letter(tree, J, row) for tree, J in zip(letters, _repeated(numbers, runs), strict=True)]
        order = [(first, "<", then) for first, then in pairwise(numbers)]
        weight = Fraction(factorial(len(letters)), prod(map(factorial, runs)))
        terms.append((weight, index_sum(numbers, order, product(*factors))))
    return total(*terms)


def _letter(tree: Tree, J: str, row: Callable[[str, str], Formula]) -> Formula:
    j = fresh()
    return index_sum((j,), (), product(row(J, j), _stage(tree, j)))


def _stage(tree: Tree, i: str) -> Formula:
    if len(tree) == 1:
        return one()
    return _word(
        branches(tree),
        lambda J, j: coefficient("alpha", i, J, j),
        lambda j: coefficient("a", i, j),
        coefficient("c", i),
    )


def _repeated(numbers: Sequence[str], runs: Sequence[int]) -> list[str]:
    return [number for number, length in zip(numbers, runs, strict=True) for _ in range(length)]
