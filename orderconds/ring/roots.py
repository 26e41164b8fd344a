"""Real roots of polynomials with rational coefficients. A root is given by a polynomial and an interval that
contains no other real root of the polynomial. Balls around the root can be computed to any precision."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache

from flint import arb, fmpq, fmpq_poly

from orderconds.ring.decimals import Enclosure, endpoints
from orderconds.ring.precision import precision


def isolate(coefficients: Sequence[fmpq], near: fmpq, unit: fmpq) -> tuple[fmpq_poly, Enclosure]:
    """Return a monic irreducible factor of a polynomial, and the real root of the factor in [near - unit,
    near + unit].

    Raises ValueError if the interval does not contain exactly one real root of the polynomial. The
    ``coefficients`` of the polynomial are listed by ascending powers.

    >>> factor, root = isolate([fmpq(-2), fmpq(0), fmpq(0), fmpq(1)], fmpq(126, 100), fmpq(1, 100))
    >>> factor, root(64).overlaps(arb(2).root(3))
    (x^3 + (-2), True)
    """
    monic, k = _factor_and_place(coefficients, near, unit)
    return monic, lambda bits: real_roots(monic, bits)[k]


def place_of_root(minpoly: Sequence[Fraction], near: Fraction, unit: Fraction) -> tuple[list[Fraction], int]:
    """Return the monic irreducible factor of ``minpoly`` that has a real root in the interval [near - unit,
    near + unit]. Also return the index of this root. The factor and ``minpoly`` are lists of coefficients, by
    ascending powers.

    Raises ValueError if the interval does not contain exactly one real root of ``minpoly``. The real roots of
    the factor are numbered from 0, in ascending order.

    >>> minpoly = [Fraction(-2), Fraction(0), Fraction(1)]
    >>> coefficients, place = place_of_root(minpoly, Fraction(7, 5), Fraction(1, 10))
    >>> [str(c) for c in coefficients], place
    (['-2', '0', '1'], 1)
    """
    monic, place = _factor_and_place([_rational(x) for x in minpoly], _rational(near), _rational(unit))
    return [Fraction(int(c.p), int(c.q)) for c in monic.coeffs()], place


def _rational(x: Fraction) -> fmpq:
    return fmpq(x.numerator, x.denominator)


def _factor_and_place(coefficients: Sequence[fmpq], near: fmpq, unit: fmpq) -> tuple[fmpq_poly, int]:
    """Find the real root that a polynomial has in [near - unit, near + unit]. Return the monic irreducible
    factor with this root, and the index of the root.

    Raises ValueError if the interval does not contain exactly one real root of the polynomial. The real roots
    of the factor are numbered from 0, in ascending order.
    """
    polynomial = fmpq_poly(list(coefficients))
    if polynomial.degree() < 1:
        raise ValueError("a constant polynomial has no root")
    places = []
    for factor, _ in polynomial.factor()[1]:
        monic = factor / factor.leading_coefficient()
        places += [(monic, k) for k, x in enumerate(real_roots(monic, 256)) if _meets(x, near, unit)]
    if len(places) != 1:
        raise ValueError(f"{len(places) or 'no'} real roots within {unit} of {near}")
    return places[0]


def isolating(monic: fmpq_poly, root: Enclosure) -> str:
    """Return a decimal that identifies ``root`` among the real roots of the polynomial ``monic``.

    Let u be one unit in the last place of the decimal. The decimal differs from ``root`` by at most u, and
    from every other real root of ``monic`` by more than u.

    >>> from flint import fmpq_poly
    >>> from orderconds.ring.precision import precision
    >>> def root(bits):
    ...     with precision(bits):
    ...         return arb(2).sqrt()
    ...
    >>> isolating(fmpq_poly([-2, 0, 1]), root)
    '1.4142135624'
    """
    places = 10
    while True:
        unit = fmpq(1, 10**places)
        low, _ = endpoints(root(4 * places + 64))
        figures = int((low / unit).round())
        try:
            isolate(monic.coeffs(), figures * unit, unit)
        except ValueError:
            places *= 2
        else:
            digits = str(abs(figures)).rjust(places + 1, "0")
            return f"{'-' if figures < 0 else ''}{digits[:-places]}.{digits[-places:]}"


def _meets(x: arb, near: fmpq, unit: fmpq) -> bool:
    low, high = endpoints(x)
    return bool(low <= near + unit and near - unit <= high)


def real_roots(monic: fmpq_poly, bits: int) -> tuple[arb, ...]:
    """Return balls around the real roots of the polynomial ``monic``, in ascending order. Despite the name of
    the parameter, the leading coefficient need not be 1.

    >>> [float(x) for x in real_roots(fmpq_poly([-1, 0, 4]), 64)]
    [-0.5, 0.5]
    """
    return _ascending(tuple(str(c) for c in monic.coeffs()), bits)


@lru_cache(maxsize=256)
def _ascending(coefficients: tuple[str, ...], bits: int) -> tuple[arb, ...]:
    polynomial = fmpq_poly([fmpq(c) for c in coefficients])
    with precision(bits + 32):
        roots = [x for x, _ in polynomial.complex_roots() if x.imag == 0]
    return tuple(sorted((x.real for x in roots), key=lambda x: endpoints(x)[0]))
