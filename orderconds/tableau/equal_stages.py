"""Equal stages of Runge-Kutta methods, and tableaux that define the same method.

Different tableaux can define the same method: a tableau may have stages that do not contribute to the step,
it may contain a stage twice, and its stages can be numbered differently. Such tableaux are called
*equivalent*.
A partition of the stages into classes is called admissible here if, for any two stages i and k of the same
class, sum_{j in C} a_ij = sum_{j in C} a_kj for every class C. Two stages are equal for every vector field if
and only if they are in the same class of the coarsest admissible partition.
HLW denotes Hairer, Lubich and Wanner, *Geometric Numerical Integration*.
"""

from __future__ import annotations

from collections.abc import Sequence

from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.methods import RungeKutta


def stage_classes(methods: Sequence[RungeKutta], ring: Ring) -> list[list[int]]:
    """Return the number of the class of each stage of each method. Equal stages, also stages of different
    methods, have the same number. If the coefficients are balls (intervals), stages count as different unless
    they are proved to be equal.

    >>> from orderconds.ring import QQ
    >>> half = QQ.rational(1, 2)
    >>> stage_classes([RungeKutta(((half, QQ.zero), (QQ.zero, half)), (half, half))], QQ)
    [[0, 0]]
    """
    classes, count, before = [[0] * method.s for method in methods], 1, 0
    while count != before:
        kinds: list[tuple[int, list[Element]]] = []
        finer = []
        for method, own in zip(methods, classes, strict=True):
            numbers = []
            for i, row in enumerate(method.A):
                sums = class_sums(row, own, count, ring)
                known = (
                    k for k, entry in enumerate(kinds) if entry[0] == own[i] and _same(entry[1], sums, ring)
                )
                number = next(known, len(kinds))
                if number == len(kinds):
                    kinds.append((own[i], sums))
                numbers.append(number)
            finer.append(numbers)
        classes, count, before = finer, len(kinds), count
    return classes


def class_sums(row: Sequence[Element], classes: Sequence[int], count: int, ring: Ring) -> list[Element]:
    """Return the sum of the entries of ``row`` over the stages of each of the ``count`` classes.

    >>> from orderconds.ring import QQ
    >>> class_sums([QQ.one, QQ.one, QQ.zero], [0, 0, 1], 2, QQ) == [QQ.rational(2), QQ.zero]
    True
    """
    sums: list[Element] = [ring.zero] * count
    for number, x in zip(classes, row, strict=True):
        sums[number] = sums[number] + x
    return sums


def irreducible(method: RungeKutta, ring: Ring) -> RungeKutta:
    """Return an equivalent tableau with the least number of stages (HLW VI.7.3).

    >>> from orderconds.ring import QQ
    >>> half, zero = QQ.rational(1, 2), QQ.zero
    >>> irreducible(RungeKutta(((half, zero), (half, zero)), (half, half)), QQ).s
    1
    """
    stages = 0
    while method.s != stages:
        stages = method.s
        method = _of_different_stages(_of_used_stages(method, ring), ring)
    return method


def equivalent(first: RungeKutta, second: RungeKutta, ring: Ring) -> bool:
    """Return True if the two tableaux define the same method. If the coefficients are balls (intervals), the
    result is True only if this is proved.

    >>> from orderconds.ring import QQ
    >>> half, zero = QQ.rational(1, 2), QQ.zero
    >>> midpoint = RungeKutta(((half,),), (QQ.one,))
    >>> equivalent(midpoint, RungeKutta(((half, zero), (half, zero)), (half, half)), QQ)
    True
    """
    classes = stage_classes((first, second), ring)
    count = 1 + max(number for own in classes for number in own)
    one, other = (
        class_sums(method.b, own, count, ring) for method, own in zip((first, second), classes, strict=True)
    )
    return _same(one, other, ring)


def _same(x: Sequence[Element], y: Sequence[Element], ring: Ring) -> bool:
    return all(u is v or ring.is_zero(u - v) is True for u, v in zip(x, y, strict=True))


def _of_used_stages(method: RungeKutta, ring: Ring) -> RungeKutta:
    """Remove the stages on which the step does not depend. If no stage remains, return ``method``."""
    used: set[int] = set()
    more = [j for j, x in enumerate(method.b) if ring.is_zero(x) is not True]
    while more:
        used.update(more)
        rows = [method.A[i] for i in more]
        more = sorted({j for row in rows for j, x in enumerate(row) if ring.is_zero(x) is not True} - used)
    if not used or len(used) == method.s:
        return method
    kept = sorted(used)
    A = tuple(tuple(method.A[i][j] for j in kept) for i in kept)
    return RungeKutta(A, tuple(method.b[i] for i in kept))


def _of_different_stages(method: RungeKutta, ring: Ring) -> RungeKutta:
    """Replace each class of equal stages by one stage."""
    [classes] = stage_classes([method], ring)
    count = 1 + max(classes)
    if count == method.s:
        return method
    rows = [method.A[classes.index(number)] for number in range(count)]
    A = tuple(tuple(class_sums(row, classes, count, ring)) for row in rows)
    return RungeKutta(A, tuple(class_sums(method.b, classes, count, ring)))
