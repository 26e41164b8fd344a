"""Tests of A- and L-stability for methods with rational coefficients.

The criteria are those of :mod:`orderconds.tableau.stability`. The Flint library computes with the polynomials
and certifies the enclosures of their roots.
"""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq, fmpq_mat, fmpq_poly

Rows = Sequence[Sequence[fmpq]]


def determinant(A: Rows) -> fmpq_poly:
    """Return det(I - zA) as a polynomial in z.

    >>> determinant([[fmpq(1), fmpq(2)], [fmpq(0), fmpq(3)]])
    3*x^2 + (-4)*x + 1
    """
    return fmpq_poly(fmpq_mat([list(row) for row in A]).charpoly().coeffs()[::-1])


def stable(P: fmpq_poly, Q: fmpq_poly) -> tuple[bool, bool] | None:
    """Decide whether a method with the stability function P/Q is A-stable, and whether it is L-stable. Return
    None if a pole of P/Q may lie on the imaginary axis.

    >>> stable(fmpq_poly([1]), fmpq_poly([1, -1])), stable(fmpq_poly([2, 1]), fmpq_poly([2, -1]))
    ((True, True), (True, False))
    """
    common = P.gcd(Q)
    P, Q = P // common, Q // common
    if (poles := _poles_right(Q)) is None:
        return None
    a_stable = poles and _nowhere_negative(_modulus(Q) - _modulus(P))
    return a_stable, a_stable and P.degree() < Q.degree()


def _poles_right(Q: fmpq_poly) -> bool | None:
    poles = [pole.real for pole, _ in Q.complex_roots()] if Q.degree() > 0 else []
    if any(x < 0 for x in poles):
        return False
    return True if all(x > 0 for x in poles) else None


def _modulus(p: fmpq_poly) -> fmpq_poly:
    """Return |p(iy)|^2 as a polynomial in y^2, for real y."""
    signed = [x if k % 4 < 2 else -x for k, x in enumerate(p.coeffs())]
    real, imaginary = fmpq_poly(signed[0::2]), fmpq_poly(signed[1::2])
    return real * real + fmpq_poly([0, 1]) * imaginary * imaginary


def _nowhere_negative(E: fmpq_poly) -> bool:
    """Return True if the polynomial E satisfies E(x) >= 0 for all x >= 0. Negative numbers x do not matter,
    because x is the square of a real number (:func:`_modulus`)."""
    if E == 0:
        return True
    if E.leading_coefficient() < 0:
        return False
    roots = E.complex_roots() if E.degree() > 0 else []
    return not any(n % 2 and x.imag == 0 and x.real > 0 for x, n in roots)
