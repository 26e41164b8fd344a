"""Functions of ad_x as quadratic polynomials in ad_x, on a Lie algebra with ad_x^3 = -z ad_x.

The number z depends on x. On such an algebra each power series in ad_x with the constant term 1 is equal to
1 + b ad_x + c ad_x^2. The coefficients b and c are functions of z. For the series exp(ad_x), b and c are
Stumpff functions of z.

On so(3), z = x.x. On sl(2), z is four times the determinant of the 2 x 2 matrix of x, and z can be negative.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from codegen.groups.bernoulli import bernoulli_over_factorial
from codegen.groups.linear_algebra import S
from codegen.ir.ad_series import Factor
from codegen.ir.domain import Domain


def ad_polynomial(d: Domain, word: Sequence[Factor], z: S, *, signed: bool = False) -> tuple[S, S]:
    """Return b and c such that the product of the factors in ``word`` is 1 + b t + c t^2.

    The factors are functions of a variable t with t^3 = -z t (:mod:`codegen.ir.ad_series`). If z can be
    negative, set ``signed`` to true.
    """
    zero: S = d.rational(0)
    rates = [f.scale * f.power for f in word if f.function == "exp"]
    differences = [f for f in word if f.function == "dexp" and f.power == 1]
    rest = [f for f in word if f.function != "exp" and f not in differences]
    total, shift = (zero, zero), sum(rates, Fraction(0))
    if differences:
        first, *more = differences
        # With a = ``shift`` and s = ``first.scale``, exp(a t) dexp(s t) = (exp((a + s) t) - exp(a t))/(s t).
        ends = [(shift + first.scale, 1 / first.scale), (shift, -1 / first.scale)]
        total = _exponentials(d, [(k, r) for k, r in ends if k], 1, z, signed)
        rest = [*more, *rest]
    elif shift:
        total = _exponentials(d, [(shift, Fraction(1))], 0, z, signed)
    for factor in rest:
        if signed and factor.function == "dexp" and factor.power < 0:
            b, c = _inverse_dexp(d, factor.scale, z)
        else:
            b, c = _single(d, factor, z, signed)
            if factor.power < 0:
                b, c = _inverted(d, b, c, z)
        e, f = total
        total = (e + b - z * (e * c + f * b), f + c + e * b - z * (f * c))
    return total


def _exponentials(
    d: Domain, terms: Sequence[tuple[Fraction, Fraction]], j: int, z: S, signed: bool
) -> tuple[S, S]:
    """Return numbers b and c such that F(t) = b t + c t^2 for t = ad_x.

    If ``terms`` is one pair (k, r), F(t) is the series of r exp(k t)/t^j without the terms with t^-1 and t^0.
    If ``terms`` contains several pairs, the series of the pairs are added. Because of t^3 = -z t, the powers
    t^3, t^4, ... are multiples of t or t^2. The number j is 0 or 1. If z can be negative, ``signed`` is true.
    """
    sums = []
    name = "signed_stumpff" if signed else "stumpff"
    for power in (1 + j, 2 + j):
        weights: dict[Fraction, Fraction] = {}
        for k, r in terms:
            weights[k * k] = weights.get(k * k, Fraction(0)) + r * k**power
        value: S = d.rational(0)
        for square, weight in weights.items():
            if weight:
                argument = z if square == 1 else d.rational(square.numerator, square.denominator) * z
                value = value + d.rational(weight.numerator, weight.denominator) * d.call(
                    f"{name}{power}", argument
                )
        sums.append(value)
    return sums[0], sums[1]


def _single(d: Domain, factor: Factor, z: S, signed: bool) -> tuple[S, S]:
    """Return b and c with phi(s t) = 1 + b t + c t^2 for a matrix t with t^3 = -z t.

    The argument ``factor`` contains the function phi (dexp or dexpinv) and the number s. The exponent of
    ``factor`` is ignored.
    """
    s = factor.scale
    if factor.function == "dexp":
        return _exponentials(d, [(s, 1 / s)], 1, z, signed)
    # By t^3 = -z t, odd powers of t are multiples of t, and even powers are multiples of t^2. Horner's rule
    # is applied to the odd powers and to the even powers separately.
    sums: list[S] = [d.rational(0), d.rational(0)]
    for k in range(factor.order, 0, -1):
        weight = bernoulli_over_factorial(k) * s**k
        place = (k + 1) % 2
        sums[place] = d.rational(weight.numerator, weight.denominator) - z * sums[place]
    return sums[0], sums[1]


def _inverse_dexp(d: Domain, s: Fraction, z: S) -> tuple[S, S]:
    """Return b and c in 1/dexp(s t) = 1 + b t + c t^2, where t^3 = -z t.

    The results are b = -s/2 and c = s^2 (c_2 - c_3)/(4 c_1). Here c_k is the value of the Stumpff function
    with index k at s^2 z/4.
    """
    argument: S = d.rational((s * s).numerator, 4 * (s * s).denominator) * z
    c1, c2, c3 = (d.call(f"signed_stumpff{k}", argument) for k in (1, 2, 3))
    weight: S = d.rational((s * s).numerator, 4 * (s * s).denominator)
    # If z <= 0, c2 is at least 3 c3, so the difference c2 - c3 does not lose digits by cancellation.
    return d.rational(-s.numerator, 2 * s.denominator), weight * ((c2 - c3) / c1)


def _inverted(d: Domain, b: S, c: S, z: S) -> tuple[S, S]:
    """Return the coefficients of t and t^2 in 1/(1 + b t + c t^2), where t^3 = -z t."""
    one: S = d.rational(1)
    p = one - c * z
    scale = one / (p * p + b * b * z)
    return -(b * scale), (b * b - p * c) * scale
