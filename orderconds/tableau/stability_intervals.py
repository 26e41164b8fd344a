"""The stability intervals of a Runge-Kutta method on the real and the imaginary axis, in exact arithmetic.

Let R = P/Q be the stability function. The real stability interval is the largest interval [-r, 0] with
|R(x)| <= 1 for all x in it. The imaginary stability interval is the largest interval [0, r] with |R(iy)| <= 1
for all y in it. The number r is the length. Equality is allowed: the length is infinite if |R(iy)| = 1 for
all y.

Each of the two conditions means that a polynomial E is not negative:

- At the point -x of the real axis with x >= 0, the polynomial is E(x) = Q(-x)^2 - P(-x)^2.
- At the point iy of the imaginary axis, the polynomial is E(t) = |Q(iy)|^2 - |P(iy)|^2 with t = y^2.

The interval ends where E becomes negative for the first time. Common factors of P and Q do not change this
point: they multiply E by a square. At a pole of R, E is negative.

The first sign change of E is isolated with Descartes' rule of signs and bisection (Collins and Akritas 1976),
with the exact signs of the coefficients. If the coefficients are balls (intervals), a length is returned only
if the computation is valid for all numbers in the balls.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import cast

from msgspec import Struct

from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.stability import (
    Limited,
    Polynomial,
    SignedRing,
    Undecided,
    padded,
    product,
    squared_modulus,
    squarefree,
)

Coefficients = Sequence[Element]
"""The coefficients of a polynomial, in ascending order of the powers. The last coefficients can be zero."""

FIRST_TRY = 64
"""The limit on the number of subintervals in the first search, before multiple zeros are removed. The methods
of the library need at most 18 subintervals. A multiple zero would need infinitely many."""

MOST = 5000
"""The limit on the number of subintervals in the second search. If the first search fails, the second search
follows, but only for a polynomial whose coefficients all have known signs. The second search uses another
polynomial with the same sign changes, but with simple zeros only. The limit bounds the work for zeros that
are extremely close to each other."""

ACCURACY = 60
"""A zero is enclosed in an interval of relative length 2^-ACCURACY, less than the rounding of a double."""

COARSE = 13
"""If the coefficients are balls, it can be impossible to enclose a zero in an interval of relative length
2^-60 (:data:`ACCURACY`). In this case, an interval of relative length at most 2^-COARSE, about 10^-4, is
accepted. A longer interval would not determine the four digits that the program prints."""


class Intervals(Struct, frozen=True):
    """The lengths of the stability intervals on the negative real and the positive imaginary axis.

    A length is ``math.inf`` if the interval is proved to be unbounded. A length is None if it is undecided:
    the coefficients are balls that are too wide, the computation would take too long, or a positive length is
    not in the range of doubles.
    """

    real: float | None
    imaginary: float | None


class Vanishing(Struct, frozen=True):
    """The known zero coefficients of two polynomials. If P/Q is the stability function, the two polynomials
    are Q(-x)^2 - P(-x)^2 and |Q(iy)|^2 - |P(iy)|^2.

    ``real[k]`` is true if the coefficient of x^k is zero, and ``imaginary[k]`` is true if the coefficient of
    y^(2k) is zero. False means that nothing is known.
    """

    real: tuple[bool, ...] = ()
    imaginary: tuple[bool, ...] = ()


def stability_intervals(
    P: Coefficients, Q: Coefficients, ring: Ring, order: int = 0, vanishing: Vanishing | None = None
) -> Intervals:
    """Return the lengths of the stability intervals of R = P/Q. P and Q must satisfy P(0) = Q(0).

    If the coefficients of P and Q are balls, the coefficients of the two polynomials Q(-x)^2 - P(-x)^2 and
    |Q(iy)|^2 - |P(iy)|^2 are also balls. If such a ball contains zero and other numbers, the ball does not
    determine whether the coefficient is zero. The parameters ``order`` and ``vanishing`` state that some of
    the coefficients of the two polynomials are zero:

    - ``order`` is a proved order of the method. The stability function satisfies
      R(z) = e^z + O(z^(order + 1)). Therefore |R(iy)|^2 - 1 = O(y^(order + 1)).
    - ``vanishing`` states which coefficients of the two polynomials are zero. To determine ``vanishing``,
      replace the rounded decimals in the tableau by random rational numbers, and call
      :func:`vanishing_coefficients`.

    >>> from orderconds.ring import QQ
    >>> one, half = QQ.one, QQ.rational(1, 2)
    >>> stability_intervals([one, one], [one], QQ)
    Intervals(real=2.0, imaginary=0.0)
    >>> stability_intervals([one, half], [one, -half], QQ)
    Intervals(real=inf, imaginary=inf)
    """
    P, Q = padded(P, Q, ring)
    zeros = vanishing or Vanishing()
    order_zeros = (True,) * (order // 2 + 1)
    on_real = _with_zeros(_real_difference(P, Q, ring), ring, zeros.real)
    on_axis = _with_zeros(_axis_difference(P, Q, ring), ring, zeros.imaginary, order_zeros)
    if ring.is_zero(on_axis[-1]) is True:
        # The last coefficients of ``on_axis`` and ``on_real`` are equal: both are Q[-1]^2 - P[-1]^2.
        on_real[-1] = ring.zero
    return Intervals(_length(on_real, ring, lambda t: t), _length(on_axis, ring, math.sqrt))


def vanishing_coefficients(P: Coefficients, Q: Coefficients, ring: Ring) -> Vanishing:
    """Return which coefficients of Q(-x)^2 - P(-x)^2 and of |Q(iy)|^2 - |P(iy)|^2 are zero.

    The coefficients of P and Q are elements of ``ring``, which is an exact ring.

    >>> from orderconds.ring import QQ
    >>> vanishing_coefficients([QQ.one, QQ.one], [QQ.one], QQ)
    Vanishing(real=(True, False, False), imaginary=(True, False))
    """
    P, Q = padded(P, Q, ring)
    rows = _real_difference(P, Q, ring), _axis_difference(P, Q, ring)
    return Vanishing(*(tuple(ring.is_zero(x) is True for x in row) for row in rows))


def _real_difference(P: Coefficients, Q: Coefficients, ring: Ring) -> list[Element]:
    """Return Q(-x)^2 - P(-x)^2 as a polynomial in x."""
    top, bottom = ([x if k % 2 == 0 else -x for k, x in enumerate(p)] for p in (P, Q))
    squares = product(bottom, bottom, ring), product(top, top, ring)
    return [q - p for q, p in zip(*squares, strict=True)]


def _axis_difference(P: Coefficients, Q: Coefficients, ring: Ring) -> list[Element]:
    """Return |Q(iy)|^2 - |P(iy)|^2 as a polynomial in y^2."""
    moduli = squared_modulus(Q, ring), squared_modulus(P, ring)
    return [q - p for q, p in zip(*moduli, strict=True)]


def _with_zeros(E: list[Element], ring: Ring, *proofs: Sequence[bool]) -> list[Element]:
    """Return a copy of ``E`` with exact zeros. Entry k of the copy is the exact zero of the ring if
    ``proof[k]`` is true for at least one ``proof`` in ``proofs``."""
    return [ring.zero if any(k < len(proof) and proof[k] for proof in proofs) else x for k, x in enumerate(E)]


def _length(E: Coefficients, ring: Ring, convert: Callable[[float], float]) -> float | None:
    """Return the length ``convert(t)`` of a stability interval, where t is the largest number such that
    E >= 0 on [0, t]. Return ``math.inf`` if E is never negative, and None if the length is undecided
    (:class:`Intervals`)."""
    limited = cast("SignedRing", Limited(ring))
    try:
        zero = _first_descent(E, limited)
        if zero is None:
            return math.inf
        low, high = zero
        length = convert(float((low + high) / 2))
    except (Undecided, OverflowError, ZeroDivisionError):
        return None
    # If a positive length underflows to 0.0, return None, because 0.0 means that there is no interval.
    return length if length or not high else None


def _first_descent(E: Coefficients, ring: SignedRing) -> tuple[Fraction, Fraction] | None:
    """Return an enclosure of the smallest t >= 0 such that E is negative immediately to the right of t.

    E is a polynomial in t, and its coefficients can be balls (intervals). The result is None if there is no
    such point. Raises :class:`Undecided` if the balls are too wide, or if the search needs too many
    subintervals.
    """
    signs = [ring.sign(x) for x in E]
    support = [k for k, sign in enumerate(signs) if sign != 0]
    if not support:
        return None
    F = list(E[support[0] : support[-1] + 1])
    if (start := signs[support[0]]) is None:
        raise Undecided
    if start < 0:
        return Fraction(0), Fraction(0)
    try:
        return _first_zero(F, ring, FIRST_TRY)
    except Undecided:
        if None in signs or any(ring.is_zero(x) is None for x in F):
            raise
    return _first_zero(_odd_part(F, ring), ring, MOST)


def _odd_part(F: Polynomial, ring: SignedRing) -> Polynomial:
    """Return the product of the factors that have odd multiplicity in F.

    Each factor occurs once in the product. The product changes its sign at the same points as F, and all
    zeros of the product are simple. The sign of the product is chosen such that the value at 0 is positive.
    Raises :class:`Undecided` if the sign of the value at 0 is unknown.
    """
    result = [ring.one]
    for multiplicity, factor in enumerate(squarefree(F, ring), start=1):
        if multiplicity % 2:
            result = product(result, factor, ring)
    start = ring.sign(result[0])
    if start is None:
        raise Undecided
    return result if start == 1 else [-x for x in result]


def _first_zero(F: Polynomial, ring: SignedRing, limit: int) -> tuple[Fraction, Fraction] | None:
    """Return an enclosure of the first t > 0 where F changes its sign, or None if F never changes its sign.

    F(0) must be positive. The substitution x = t/(1 + t) maps the half-line t >= 0 to [0, 1). The interval
    [0, 1) is divided into subintervals. On each subinterval, let u be the variable that increases linearly
    from 0 to 1. Let n be the degree of F. Then (1 - x)^n F(t) is a polynomial in x, and therefore in u.
    Descartes' rule of signs is applied to the polynomial in u. Raises :class:`Undecided` after ``limit``
    subintervals.
    """
    backward = _shifted(F[::-1], -1, ring)[::-1]
    intervals = [(backward, Fraction(0), Fraction(1))]
    for _ in range(limit):
        if not intervals:
            return None
        q, a, b = intervals.pop()
        multiplicity = next(k for k, x in enumerate(q) if ring.sign(x) != 0)
        if multiplicity % 2:
            return _unmapped(a), _unmapped(a)
        q = q[multiplicity:]
        changes = _variations(_shifted(q[::-1], 1, ring), ring)
        if changes == 0:
            continue
        if changes == 1:
            return _refined(F, ring, _unmapped(a), None if b == 1 else _unmapped(b))
        middle, n = (a + b) / 2, len(q)
        left = [x * 2 ** (n - 1 - k) for k, x in enumerate(q)]
        intervals += [(_shifted(left, 1, ring), middle, b), (left, a, middle)]
    if intervals:
        raise Undecided
    return None


def _unmapped(x: Fraction) -> Fraction:
    return x / (1 - x)


def _shifted(p: Coefficients, by: int, ring: Ring) -> list[Element]:
    """Return p(x + ``by``) for ``by`` = 1 or -1."""
    result = list(p)
    for start in range(len(result) - 1):
        for k in range(len(result) - 2, start - 1, -1):
            result[k] = result[k] + result[k + 1] if by == 1 else result[k] - result[k + 1]
    return result


def _variations(p: Coefficients, ring: SignedRing) -> int | None:
    """Return the number of sign changes in the coefficients, or None if a sign is unknown."""
    signs = [ring.sign(x) for x in p]
    if None in signs:
        return None
    known = [sign for sign in signs if sign]
    return sum(x != y for x, y in pairwise(known))


def _refined(F: Polynomial, ring: SignedRing, a: Fraction, b: Fraction | None) -> tuple[Fraction, Fraction]:
    """Return a short enclosure of the only sign change of F between a and b.

    The value None of b denotes infinity. F is positive before the sign change and negative after it.
    """

    def sign(t: Fraction) -> int | None:
        at, value = ring.rational(t.numerator, t.denominator), ring.zero
        for c in reversed(F):
            value = value * at + c
        return ring.sign(value)

    low, high = a, max(Fraction(1), 2 * a) if b is None else b
    while b is None and sign(high) != -1:
        low, high = (high, 2 * high) if sign(high) == 1 else (low, 2 * high)
    while low == 0:
        # The sign change is between 0 and ``high``. Halve ``high`` until F(high / 2) is positive. Then the
        # sign change is between ``high / 2`` and ``high``.
        low, high = (high / 2, high) if (side := sign(high / 2)) == 1 else (low, high / 2)
        if side is None:
            raise Undecided
    while high - low > low / 2**ACCURACY:
        middle = (low + high) / 2
        side = sign(middle)
        if side is None:
            low, high = _nearest(sign, 1, low, middle), _nearest(sign, -1, high, middle)
            break
        low, high = (middle, middle) if side == 0 else (middle, high) if side == 1 else (low, middle)
    if high - low > low / 2**COARSE:
        raise Undecided
    return low, high


def _nearest(
    sign: Callable[[Fraction], int | None], wanted: int, inner: Fraction, unknown: Fraction
) -> Fraction:
    """Move ``inner`` towards ``unknown`` by bisection, and return the last point where ``sign`` returns
    ``wanted``.

    At the point ``inner``, ``sign`` must return ``wanted``. At the point ``unknown``, ``sign`` must return
    None, which means that the sign is unknown.
    """
    for _ in range(COARSE):
        middle = (inner + unknown) / 2
        inner, unknown = (middle, unknown) if sign(middle) == wanted else (inner, middle)
    return inner
