"""A- and L-stability of a Runge-Kutta method, decided in exact arithmetic from the stability function.

The stability function is R(z) = P(z)/Q(z) with Q = det(I - zA) and P = det(I - z(A - 1 b^T)), where 1 is the
vector of ones. Common factors of P and Q are removed. The method is A-stable if and only if two conditions
hold:

- Every zero of Q has positive real part (Routh's test).
- |P(iy)| <= |Q(iy)| for all real y (Sturm's test for |Q(iy)|^2 - |P(iy)|^2, a polynomial in y^2).

An A-stable method is L-stable if and only if deg P < deg Q (Hairer and Wanner, *Solving Ordinary Differential
Equations II*, Sections IV.3 and IV.5).
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Protocol, cast

from flint import fmpq
from msgspec import Struct

from orderconds.ring import QQ, Balls, NumberField
from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.methods import RungeKutta

Polynomial = list[Element]
"""The coefficients of a polynomial, in ascending order of the powers. The last coefficient is not zero."""


LARGEST = 100
"""The limit on the number of rows of the matrix A, or of each diagonal block if A is block triangular. For a
block of this size with rational entries, the computation takes about a second."""

EFFORT = 10**11
"""The limit on the work in Euclid's algorithm for polynomials, whose coefficients grow fast. The work is an
estimated number of bit operations. The limit corresponds to about a second."""


class SignedRing(Ring, Protocol):
    """A ring whose elements have signs."""

    def sign(self, x: Element) -> int | None:
        """Return the sign (-1, 0 or 1), or None if the ring cannot decide."""


class StabilityFunction(Struct, frozen=True):
    """The stability function R = numerator/denominator in lowest terms. The fields contain the coefficients
    of the two polynomials, in ascending order of the powers."""

    numerator: tuple[Element, ...]
    denominator: tuple[Element, ...]


def stability(method: RungeKutta, ring: Ring) -> dict[str, bool | None]:
    """Decide whether the method is A-stable and L-stable. Both values are None if the computation would take
    too long, or if the sign of a ball (interval) is unknown.

    >>> half, one = QQ.rational(1, 2), QQ.one
    >>> stability(RungeKutta(((half,),), (one,)), QQ)
    {'a_stable': True, 'l_stable': False}
    >>> stability(RungeKutta(((one,),), (one,)), QQ)
    {'a_stable': True, 'l_stable': True}
    """
    if all(ring.is_zero(x) is True for i, row in enumerate(method.A) for x in row[i:]):
        # A polynomial stability function is unbounded unless it is constant.
        return {"a_stable": False, "l_stable": False}
    if any(ring.is_zero(x) is None for row in (*method.A, method.b) for x in row):
        return {"a_stable": None, "l_stable": None}
    try:
        a_stable, l_stable = _decided(method, ring)
    except Undecided:
        return {"a_stable": None, "l_stable": None}
    return {"a_stable": a_stable, "l_stable": l_stable}


def _decided(method: RungeKutta, ring: Ring) -> tuple[bool, bool]:
    if _largest_block(method, ring) > LARGEST:
        raise Undecided
    from orderconds.ring.nodal import nodal_algebra
    from orderconds.tableau.rational_stability import determinant, stable

    if ring is QQ:
        less = [[a - w for a, w in zip(row, method.b, strict=True)] for row in method.A]
        if (verdict := stable(determinant(less), determinant(method.A))) is not None:
            return verdict
    elif (algebra := nodal_algebra(ring, (method.A,), method.b)) is not None:
        maps = algebra.rational_maps()
        if (verdict := stable(*map(determinant, maps))) is not None:
            return verdict
    limited = cast("SignedRing", Limited(ring))
    R = stability_function(method, limited)
    a_stable = poles_right(R.denominator, limited) and bounded_on_axis(R, limited)
    return a_stable, a_stable and len(R.numerator) < len(R.denominator)


def stability_of_midpoints(gamma: Sequence[Element], ring: Ring) -> dict[str, bool | None]:
    """Decide whether a composition of midpoint rules with step sizes gamma_i h is A-stable and L-stable. The
    stability function is R = prod (1 + gamma_i z/2)/(1 - gamma_i z/2).

    At infinity, |R| = 1, so the composition is never L-stable. If gamma_j = -gamma_i, the factors of gamma_i
    and gamma_j cancel. The composition is A-stable if and only if no negative gamma_i remains.

    >>> stability_of_midpoints([QQ.rational(1, 2), QQ.rational(1, 2)], QQ)
    {'a_stable': True, 'l_stable': False}
    """
    signed = cast("SignedRing", ring)
    signs = [signed.sign(x) for x in gamma]
    if all(sign in (0, 1) for sign in signs):
        return {"a_stable": True, "l_stable": False}
    for x, sign in zip(gamma, signs, strict=True):
        if sign == -1 and all(ring.is_zero(x + y) is False for y in gamma):
            return {"a_stable": False, "l_stable": False}
    if None in signs:
        return {"a_stable": None, "l_stable": False}
    left = list(gamma)
    for x, sign in zip(gamma, signs, strict=True):
        partner = next((i for i, y in enumerate(left) if ring.is_zero(x + y)), None)
        if sign == -1 and partner is not None:
            left.pop(partner)
            left.pop(next(i for i, y in enumerate(left) if y is x))
    return {"a_stable": all(signed.sign(x) in (0, 1) for x in left), "l_stable": False}


class Undecided(Exception):
    """Stability cannot be decided: the sign of a ball (interval) is unknown, or the computation would take
    too long."""


class Limited:
    """A ring that raises :class:`Undecided` if the total work exceeds :data:`EFFORT`."""

    def __init__(self, ring: Ring) -> None:
        self.ring, self.left = ring, EFFORT

    def __getattr__(self, name: str) -> object:
        return getattr(self.ring, name)

    def spend(self, work: int) -> None:
        """Subtract ``work`` from the remaining part of the limit :data:`EFFORT`."""
        self.left -= work
        if self.left < 0:
            raise Undecided


def _bits(x: Element) -> int:
    """Return the number of bits of the numerator plus the number of bits of the denominator of a rational
    number x. For an element x of a number field, return the maximum over its rational coefficients."""
    coefficients = x.polynomial.coeffs() if hasattr(x, "polynomial") else [x]
    return max((int(fmpq(c).p).bit_length() + int(fmpq(c).q).bit_length() for c in coefficients), default=1)


def _spend(ring: Ring, count: int, numbers: Sequence[Element], quadratic: bool) -> None:
    """Subtract the estimated work of ``count`` multiplications from the work that is still allowed. The
    estimate is quadratic in the number of bits of ``numbers`` if ``quadratic`` is true, and linear
    otherwise."""
    if isinstance(ring, Limited) and not isinstance(ring.ring, Balls):
        field = ring.ring
        degree = int(field.modulus.degree()) if isinstance(field, NumberField) else 1
        bits = 1000 + degree * max(map(_bits, numbers), default=1)
        ring.spend(count * bits * (bits if quadratic else 1000))


def _largest_block(method: RungeKutta, ring: Ring) -> int:
    sizes, start = [0], 0
    for end in range(1, method.s + 1):
        if all(ring.is_zero(x) is True for row in method.A[:end] for x in row[end:]):
            sizes.append(end - start)
            start = end
    return max(sizes)


def _sign(x: Element, ring: SignedRing) -> int:
    sign = ring.sign(x)
    if sign is None:
        raise Undecided
    return int(sign)


def stability_function(method: RungeKutta, ring: Ring) -> StabilityFunction:
    """Return the stability function R in lowest terms (Hairer and Wanner II, (IV.3.2), (IV.3.3)). The ring
    should be an exact field.

    >>> R = stability_function(RungeKutta(((QQ.rational(1, 2),),), (QQ.one,)), QQ)
    >>> [str(x) for x in R.numerator], [str(x) for x in R.denominator]
    (['1', '1/2'], ['1', '-1/2'])
    """
    P, Q = (_trimmed(p, ring) for p in determinants(method, ring))
    common = _gcd(P, Q, ring)
    return StabilityFunction(tuple(_quotient(P, common, ring)), tuple(_quotient(Q, common, ring)))


def determinants(method: RungeKutta, ring: Ring) -> tuple[list[Element], list[Element]]:
    """Return the polynomials P and Q of the stability function P/Q. P and Q can have common factors, and
    their last coefficients can be zero.

    >>> P, Q = determinants(RungeKutta(((QQ.zero,),), (QQ.one,)), QQ)
    >>> [str(x) for x in P], [str(x) for x in Q]
    (['1', '1'], ['1', '0'])
    """
    less = [[a - w for a, w in zip(row, method.b, strict=True)] for row in method.A]
    if ring is QQ:
        from orderconds.tableau.rational_stability import determinant

        P, Q = determinant(less).coeffs(), determinant(method.A).coeffs()
        return padded(P, Q, ring)
    return _determinant(less, ring), _determinant(method.A, ring)


def _determinant(A: Sequence[Sequence[Element]], ring: Ring) -> list[Element]:
    """Return det(I - zA) as a polynomial in z, by the method of Faddeev and LeVerrier."""
    result = [ring.one]
    start = 0
    for end in range(1, len(A) + 1):
        if all(ring.is_zero(x) is True for row in A[:end] for x in row[end:]):
            block = [row[start:end] for row in A[start:end]]
            result = product(result, _block_determinant(block, ring), ring)
            start = end
    return result


def _block_determinant(A: Sequence[Sequence[Element]], ring: Ring) -> list[Element]:
    stages = range(len(A))
    _spend(ring, len(A) ** 4, [x for row in A for x in row], quadratic=False)
    coefficients = [ring.one]
    M = [[ring.zero for _ in stages] for _ in stages]
    for k in range(1, len(A) + 1):
        last = coefficients[-1]
        M = [
            [
                sum((A[i][m] * M[m][j] for m in stages), ring.zero) + (last if i == j else ring.zero)
                for j in stages
            ]
            for i in stages
        ]
        trace = sum((A[i][m] * M[m][i] for i in stages for m in stages), ring.zero)
        coefficients.append(trace * ring.rational(-1, k))
    return coefficients


def poles_right(Q: Sequence[Element], ring: SignedRing) -> bool:
    """Return True if every zero of Q has positive real part. An equivalent condition is that all entries in
    the first column of Routh's scheme of Q(-z) are positive, or all are negative.

    >>> [poles_right([QQ.rational(x) for x in Q], QQ) for Q in ((2, -3, 1), (1, 0, 1))]
    [True, False]
    """
    p = [x if k % 2 == 0 else -x for k, x in enumerate(Q)][::-1]
    even, odd = list(p[0::2]), list(p[1::2])
    sign = _sign(p[0], ring)
    while odd:
        if _sign(odd[0], ring) != sign:
            return False
        ratio = even[0] / odd[0]
        below = [*odd[1:], *[ring.zero] * (len(even) - len(odd))]
        even, odd = odd, [x - ratio * y for x, y in zip(even[1:], below, strict=True)]
    return True


def bounded_on_axis(R: StabilityFunction, ring: SignedRing) -> bool:
    """Return True if |R(iy)| <= 1 for all real y.

    For R = P/Q, the condition is |Q(iy)|^2 - |P(iy)|^2 >= 0, a polynomial inequality in y^2.

    >>> from orderconds.tableau import Tableau, find
    >>> gauss1 = Tableau.load(find("gauss1"))
    >>> bounded_on_axis(stability_function(gauss1.method, gauss1.ring), gauss1.ring)
    True
    """
    moduli = padded(squared_modulus(R.denominator, ring), squared_modulus(R.numerator, ring), ring)
    E = _trimmed([q - p for q, p in zip(*moduli, strict=True)], ring)
    if not E:
        return True
    if _sign(E[-1], ring) < 0:
        return False
    return not any(
        multiplicity % 2 and positive_roots(factor, ring)
        for multiplicity, factor in enumerate(squarefree(E, ring), start=1)
    )


def squared_modulus(p: Sequence[Element], ring: Ring) -> Polynomial:
    """Return |p(iy)|^2 for real y as a polynomial in y^2.

    >>> [str(x) for x in squared_modulus([QQ.rational(x) for x in (1, 1)], QQ)]
    ['1', '1']
    """
    real = [x if k % 2 == 0 else -x for k, x in enumerate(p[0::2])]
    imaginary = [x if k % 2 == 0 else -x for k, x in enumerate(p[1::2])]
    square, rest = product(real, real, ring), [ring.zero, *product(imaginary, imaginary, ring)]
    return [x + y for x, y in zip(*padded(square, rest, ring), strict=True)]


def positive_roots(p: Sequence[Element], ring: SignedRing) -> int:
    """Return the number of distinct positive zeros of p, by a Sturm chain.

    >>> positive_roots([QQ.rational(x) for x in (2, -3, 1)], QQ)
    2
    """
    chain = [list(p), _derivative(p, ring)]
    while chain[-1]:
        chain.append([-x for x in _remainder(chain[-2], chain[-1], ring)])
    chain.pop()
    return _changes([q[0] for q in chain], ring) - _changes([q[-1] for q in chain], ring)


def _changes(values: Sequence[Element], ring: SignedRing) -> int:
    signs = [sign for x in values if (sign := _sign(x, ring))]
    return sum(x != y for x, y in pairwise(signs))


def squarefree(p: Polynomial, ring: Ring) -> list[Polynomial]:
    """Return square-free polynomials f_1, f_2, ... such that p is a constant multiple of f_1 f_2^2 f_3^3 ...
    (Yun 1976).

    >>> [[str(x) for x in f] for f in squarefree([QQ.rational(x) for x in (0, 1, 2, 1)], QQ)]
    [['0', '1'], ['1', '1']]
    """
    common = _gcd(p, _derivative(p, ring), ring)
    rest = _quotient(p, common, ring)
    factors = []
    while len(rest) > 1:
        shared = _gcd(rest, common, ring)
        factors.append(_quotient(rest, shared, ring))
        rest, common = shared, _quotient(common, shared, ring)
    return factors


def _derivative(p: Sequence[Element], ring: Ring) -> Polynomial:
    return _trimmed([x * k for k, x in enumerate(p)][1:], ring)


def _gcd(p: Sequence[Element], q: Sequence[Element], ring: Ring) -> Polynomial:
    a, b = list(p), list(q)
    while b:
        a, b = b, _remainder(a, b, ring)
    lead = a[-1]
    return [x / lead for x in a]


def _remainder(p: Sequence[Element], q: Sequence[Element], ring: Ring) -> Polynomial:
    return _divided(p, q, ring)[1]


def _quotient(p: Sequence[Element], q: Sequence[Element], ring: Ring) -> Polynomial:
    return _divided(p, q, ring)[0]


def _divided(p: Sequence[Element], q: Sequence[Element], ring: Ring) -> tuple[Polynomial, Polynomial]:
    _spend(ring, max(len(p) - len(q) + 1, 0) * len(q), [*p, *q], quadratic=True)
    rest, quotient = list(p), [ring.zero] * max(len(p) - len(q) + 1, 0)
    inverse = ring.one / q[-1]
    for shift in range(len(p) - len(q), -1, -1):
        factor = rest[shift + len(q) - 1] * inverse
        quotient[shift] = factor
        for k, x in enumerate(q):
            rest[shift + k] = rest[shift + k] - factor * x
    return _trimmed(quotient, ring), _trimmed(rest[: len(q) - 1], ring)


def product(p: Sequence[Element], q: Sequence[Element], ring: Ring) -> Polynomial:
    """Return the product of two polynomials. Its last coefficients may be zero.

    >>> [str(x) for x in product([QQ.rational(x) for x in (1, 1)], [QQ.rational(x) for x in (1, -1)], QQ)]
    ['1', '0', '-1']
    """
    result = [ring.zero] * max(len(p) + len(q) - 1, 0)
    for i, x in enumerate(p):
        for j, y in enumerate(q):
            result[i + j] = result[i + j] + x * y
    return result


def _trimmed(p: Polynomial, ring: Ring) -> Polynomial:
    while p:
        vanishes = ring.is_zero(p[-1])
        if vanishes is None:
            raise Undecided
        if not vanishes:
            break
        p = p[:-1]
    return p


def padded(p: Sequence[Element], q: Sequence[Element], ring: Ring) -> tuple[Polynomial, Polynomial]:
    """Return two polynomials with zeros appended to the shorter one, so that both have equal length.

    >>> [len(f) for f in padded([QQ.one], [QQ.one, QQ.one, QQ.one], QQ)]
    [3, 3]
    """
    size = max(len(p), len(q))
    return [*p, *[ring.zero] * (size - len(p))], [*q, *[ring.zero] * (size - len(q))]
