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

    def subtract(rate: Fraction, e: list[Fraction]) -> None:
        terms.append((rate, e))
        for i in n:
            for j in n:
                rest[i][j] -= rate * e[i] * e[j]

    while any(any(row) for row in rest):
        diagonal = [i for i in n if rest[i][i]]
        if diagonal:
            k = diagonal[0]
            subtract(rest[k][k], [rest[i][k] / rest[k][k] for i in n])
            continue
        # A mixed term of the variables x and y is split into squares: 2 x y = ((x + y)^2 - (x - y)^2)/2.
        i, j = next((i, j) for i in n for j in n if rest[i][j])
        rate = rest[i][j] / 2
        for sign in (1, -1):
            subtract(sign * rate, [Fraction(int(k == i) + sign * int(k == j)) for k in n])
    return terms


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
