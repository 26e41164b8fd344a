"""Functions of ad_x as quadratic polynomials in ad_x, on a Lie algebra with ad_x^3 = -z ad_x.

Here z is a number that depends on x. On such an algebra each power series in ad_x with the constant term 1
is equal to 1 + b ad_x + c ad_x^2. The coefficients b and c are functions of z. The same holds for products
and inverses of such series.

On so(3), z = x.x is never negative. On sl(2), the element x is a 2 x 2 matrix, and z = 4 det x may be
positive or negative. If the series is an exponential, b and c are computed by Stumpff functions.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from codegen.groups.bernoulli import bernoulli_over_factorial
from codegen.groups.linear_algebra import S
from codegen.ir.ad_series import Factor
from codegen.ir.domain import Domain


def ad_polynomial(d: Domain, word: Sequence[Factor], z: S, *, signed: bool = False) -> tuple[S, S]:
    """Return b and c for which the product ``word`` equals 1 + b t + c t^2, where t^3 = -z t.

    The factors of ``word`` are functions of t (:mod:`codegen.ir.ad_series`). If ``signed`` is true, z may be
    negative.

    All exponentials in ``word`` are combined into one exponential exp(a t). If ``word`` contains a factor
    dexp(s t), the product exp(a t) dexp(s t) is computed as (exp((a + s) t) - exp(a t))/(s t). The first such
    factor is used, and the remaining factors are multiplied one by one.
    """
    zero: S = d.rational(0)
    rates = [f.scale * f.power for f in word if f.function == "exp"]
    differences = [f for f in word if f.function == "dexp" and f.power == 1]
    rest = [f for f in word if f.function != "exp" and f not in differences]
    total, shift = (zero, zero), sum(rates, Fraction(0))
    if differences:
        first, *more = differences
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
    """Return the coefficient b of t and the coefficient c of t^2 in a sum of exponentials.

    The sum is taken over the pairs (k, r) in ``terms``, and its summands are r exp(k t)/t^j. In the series of
    a summand, powers above t^2 are reduced by the rule t^3 = -z t. The constant term and negative powers of t
    are ignored.
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
    """Return b and c with phi(s t) = 1 + b t + c t^2, where t^3 = -z t.

    The function phi of ``factor`` is dexp or dexpinv, and s is the scale of ``factor``. The power of
    ``factor`` is not applied.
    """
    s = factor.scale
    if factor.function == "dexp":
        return _exponentials(d, [(s, 1 / s)], 1, z, signed)
    # Because t^3 = -z t, odd powers of t are multiples of t, and even powers are multiples of t^2.
    # ``sums`` contains the coefficients of t and t^2. They are computed by Horner's rule.
    sums: list[S] = [d.rational(0), d.rational(0)]
    for k in range(factor.order, 0, -1):
        weight = bernoulli_over_factorial(k) * s**k
        place = (k + 1) % 2
        sums[place] = d.rational(weight.numerator, weight.denominator) - z * sums[place]
    return sums[0], sums[1]


def _inverse_dexp(d: Domain, s: Fraction, z: S) -> tuple[S, S]:
    """Return b and c with 1/dexp(s t) = 1 + b t + c t^2, where t^3 = -z t.

    The results are b = -s/2 and c = s^2 (c_2 - c_3)/(4 c_1). Here c_k is the value of the Stumpff function
    with index k at s^2 z/4. For z <= 0, c_2 is at least 3 c_3. Therefore c_2 - c_3 has no cancellation.
    """
    argument: S = d.rational((s * s).numerator, 4 * (s * s).denominator) * z
    c1, c2, c3 = (d.call(f"signed_stumpff{k}", argument) for k in (1, 2, 3))
    weight: S = d.rational((s * s).numerator, 4 * (s * s).denominator)
    return d.rational(-s.numerator, 2 * s.denominator), weight * ((c2 - c3) / c1)


def _inverted(d: Domain, b: S, c: S, z: S) -> tuple[S, S]:
    """Return the coefficients of t and t^2 in the inverse of 1 + b t + c t^2, where t^3 = -z t.

    The inverse is 1 + p t + q t^2 with unknown p and q. The formulas for p and q are derived at the complex
    number t = i sqrt(z), which satisfies t^3 = -z t. For this t, the real part of the inverse is 1 - q z, and
    its imaginary part is p sqrt(z).
    """
    one: S = d.rational(1)
    p = one - c * z
    scale = one / (p * p + b * b * z)
    return -(b * scale), (b * b - p * c) * scale
