"""Functions that write a quadratic form with rational coefficients as a sum of few squares."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

Matrix = Sequence[Sequence[Fraction]]
"""A symmetric matrix, given by its rows."""

Square = tuple[Fraction, list[Fraction]]
"""A pair (d, e) of a number d and a vector e. The pair represents the function d (e.x)^2 of a vector x."""


def squares(B: Matrix) -> list[Square]:
    """Return pairs (d, e) of a number d and a vector e. The sum of the matrices d e e^T is B.

    The pairs are computed by Lagrange's reduction of a quadratic form.

    >>> squares([[Fraction(0), Fraction(1)], [Fraction(1), Fraction(0)]])
    [(Fraction(1, 2), [Fraction(1, 1), Fraction(1, 1)]), (Fraction(-1, 2), [Fraction(1, 1), Fraction(-1, 1)])]
    """
    rest, n = [list(row) for row in B], range(len(B))
    terms: list[Square] = []
    while any(any(row) for row in rest):
        # The vector v = ``pivot`` determines the square (B v)(B v)^T/(v^T B v). Each subtraction of such a
        # square reduces the rank by one.
        pivot = _pivot(rest)
        image = [sum((row[i] * sign for i, sign in pivot), Fraction(0)) for row in rest]
        head = image[pivot[0][0]]
        e = [x / head for x in image]
        rate = head * head / sum((image[i] * sign for i, sign in pivot), Fraction(0))
        terms.append((rate, e))
        rest = [[rest[i][j] - rate * e[i] * e[j] for j in n] for i in n]
    return terms


def _pivot(B: Matrix) -> list[tuple[int, int]]:
    """Return a vector v with a large absolute value of v^T B v, as pairs of an index and the entry 1 or -1.

    If abs(v^T B v) were small compared with the entries of B, the terms in :func:`squares` would be large
    and cancel.
    """
    n = range(len(B))
    k = max(n, key=lambda i: abs(B[i][i]))
    mixed = [(i, j) for i in n for j in n if i < j]
    i, j = max(mixed, key=lambda p: abs(B[p[0]][p[1]]), default=(k, k))
    if 2 * abs(B[k][k]) < abs(B[i][j]):
        # With this sign of the second entry, abs(v^T B v) is abs(B[i][i] + B[j][j]) + 2 abs(B[i][j]).
        return [(i, 1), (j, 1 if B[i][j] * (B[i][i] + B[j][j]) >= 0 else -1)]
    return [(k, 1)]


def shifted(B: Matrix, a: Fraction) -> list[list[Fraction]]:
    """Return B - a I, where I is the identity matrix."""
    return [[x - (a if i == j else 0) for j, x in enumerate(row)] for i, row in enumerate(B)]


def isotropic_part(B: Matrix) -> Fraction:
    """Return a number a for which the quadratic form x^T (B - a I) x is a sum of few terms.

    I is the identity matrix. Each term is d (e.x)^2 with a number d and a vector e. The function
    :func:`squares` computes d and e for all terms.

    >>> isotropic_part([[Fraction(2), Fraction(0)], [Fraction(0), Fraction(2)]])
    Fraction(2, 1)
    """
    n = len(B)
    candidates = sorted(B[i][i] for i in range(n))
    if all(not B[i][j] for i in range(n) for j in range(n) if i != j):
        doubled = [x for x in candidates if candidates.count(x) > 1]
        return doubled[0] if doubled else candidates[n // 2]
    for i in range(n):
        for k in range(n):
            for j in range(n):
                if len({i, j, k}) == 3 and B[j][k]:
                    # The appended number s solves (B[i][i] - s) B[j][k] - B[i][j] B[i][k] = 0. Hence a
                    # 2 x 2 minor of the symmetric matrix B - s I is zero.
                    candidates.append(B[i][i] - B[i][j] * B[i][k] / B[j][k])
    return min(candidates, key=lambda a: (len(squares(shifted(B, a))), candidates.index(a)))
