"""The numbers of action trees and of elementary Hamiltonians, computed from generating functions."""

from __future__ import annotations


def tree_counts(order: int) -> tuple[int, ...]:
    """Return the numbers of independent elementary Hamiltonians with 1, 2, ..., ``order`` vertices.

    In the following generating functions, the coefficient of x^n is the number of objects with n vertices:

    - T: trees with values in the Lie algebra g.
    - P: trees with values in the dual g*.
    - W: words of g-valued trees.
    - E(P): multisets of g*-valued trees.
    - Lie(T): independent Lie polynomials in g-valued trees.

    The functions T, P and W solve the equations T = x W E(P), P = x W^2 E(P) + W - 1 and W = 1/(1 - T). The
    returned number for n vertices is the coefficient of x^n in Lie(T) - T P. The number of independent order
    conditions of trees with n vertices is at most this coefficient.

    >>> tree_counts(6)
    (1, 1, 6, 28, 174, 1096)
    """
    t, p = _generating_functions(order)
    lie = _lie_counts(t, order)
    edges = [sum(t[k] * p[n - k] for k in range(n + 1)) for n in range(order + 1)]
    return tuple(lie[n] - edges[n] for n in range(1, order + 1))


def velocity_count(vertices: int) -> int:
    """Return the number of g-valued trees (:class:`~orderconds.series.action_trees.Velocity`) with
    ``vertices`` vertices.

    >>> [velocity_count(n) for n in range(1, 7)]
    [1, 3, 17, 111, 813, 6331]
    """
    return _generating_functions(vertices)[0][vertices]


def class_count(vertices: int) -> int:
    """Return the number of classes of g-valued trees with ``vertices`` vertices. Two trees are in one class
    if they differ only in the choice of the root (:mod:`orderconds.series.action_switching`).

    The classes are counted with a variant of Otter's method for free trees (Ann. of Math. 49 (1948) 583).

    >>> [class_count(n) for n in range(1, 7)]
    [1, 2, 10, 58, 398, 2946]
    """
    t, p = _generating_functions(vertices)
    w = [1]
    for n in range(1, vertices + 1):
        w.append(sum(t[k] * w[n - k] for k in range(1, n + 1)))
    return t[vertices] - sum((p[k] - w[k]) * t[vertices - k] for k in range(1, vertices))


def _generating_functions(order: int) -> tuple[list[int], list[int]]:
    """Return two lists. For n = 0, 1, ..., ``order``, entry n of the first list is the number of g-valued
    trees with n vertices (:mod:`orderconds.series.action_trees`). The second list counts g*-valued trees."""
    size = order + 1

    def times(a: list[int], b: list[int]) -> list[int]:
        return [sum(a[k] * b[n - k] for k in range(n + 1)) for n in range(size)]

    t, p = [0] * size, [0] * size
    for _ in range(2 * size):
        w = [1] + [0] * order
        for n in range(1, size):
            w[n] = sum(t[k] * w[n - k] for k in range(1, n + 1))
        # The sequence e is Euler's transform of the sequence p.
        e = [1] + [0] * order
        for n in range(1, size):
            e[n] = (
                sum(sum(d * p[d] for d in range(1, k + 1) if k % d == 0) * e[n - k] for k in range(1, n + 1))
                // n
            )
        we = times(w, e)
        t, p = [0, *we[:-1]], [0, *times(w, we)[:-1]]
        p = [a + b for a, b in zip(p, [0, *w[1:]], strict=True)]
    return t, p


def _lie_counts(t: list[int], order: int) -> list[int]:
    """Return the dimensions of the subspaces of weight 0, ..., ``order`` of a free Lie algebra, by Witt's
    formula. The algebra has ``t[n]`` letters of weight n."""
    # Entry n of ``power`` is n times the coefficient of x^n in log(1/(1 - T)), where T = sum_n t[n] x^n.
    power = [0] * (order + 1)
    for n in range(1, order + 1):
        power[n] = n * t[n] + sum(t[k] * power[n - k] for k in range(1, n))
    return [0] + [
        sum(_moebius(d) * power[n // d] for d in range(1, n + 1) if n % d == 0) // n
        for n in range(1, order + 1)
    ]


def _moebius(n: int) -> int:
    sign, k = 1, 2
    while n > 1:
        if n % k == 0:
            n //= k
            if n % k == 0:
                return 0
            sign = -sign
        k += 1
    return sign
