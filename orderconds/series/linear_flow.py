"""Methods for Y' = A(t) Y in words: A_i = h A(c_i h) = sum_k c_i^(k-1) h^k X_k put in what they exponentiate.

Letter k stands for X_k, the coefficient of t^(k-1) in A, and weighs k; words are in the order of action.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import cache

from orderconds.ring.protocol import Element, Ring
from orderconds.words.convolution import (
    cayley_scales,
    convolution,
    exponential_scales,
    inverse_cayley_scales,
    logarithm_scales,
    power_series,
)
from orderconds.words.shuffle import Word

Values = Callable[[Word], Element]
Scales = Callable[[int], Sequence[Fraction]]
TRANSFORMS = {
    "exp": (exponential_scales, logarithm_scales),
    "cay": (cayley_scales, inverse_cayley_scales),
}
"""For each map its series and that of its inverse, without constant terms."""


def node_powers(ring: Ring, c: Sequence[Element]) -> Callable[[int, int], Element]:
    """Return the function (i, n) -> c_i^n, each power computed once.

    >>> from orderconds.ring import QQ
    >>> node_powers(QQ, [QQ.rational(1, 2)])(0, 3)
    1/8
    """

    @cache
    def power(i: int, n: int) -> Element:
        return ring.one if n == 0 else power(i, n - 1) * c[i]

    return power


def exponent_values(ring: Ring, c: Sequence[Element], series: Mapping[Word, Element]) -> Values:
    """Return the values on words, not empty, of an exponent given by words of nodes.

    >>> from orderconds.ring import QQ
    >>> midpoint = exponent_values(QQ, [QQ.rational(1, 2)], {(0,): QQ.one})
    >>> midpoint((3,)), midpoint((1, 1))
    (1/4, 0)
    """
    power = node_powers(ring, c)

    @cache
    def value(word: Word) -> Element:
        result = ring.zero
        for nodes, scale in series.items():
            if len(nodes) == len(word):
                for i, k in zip(nodes, word, strict=True):
                    if k > 1:
                        scale = scale * power(i, k - 1)
                result = result + scale
        return result

    return value


def product_logarithm(ring: Ring, exponents: Sequence[Values], transform: str = "exp") -> Values:
    """Return the values of Omega with exp(Omega) = the product of exp(exponents), the first acting first.

    With ``transform`` ``cay`` both are cay(x) = (1 - x/2)^-1 (1 + x/2). A single exponent is its own.

    >>> from orderconds.ring import QQ
    >>> A, B = ({(k,): QQ.one}.get for k in (1, 2))
    >>> both = product_logarithm(QQ, [lambda word: A(word, QQ.zero), lambda word: B(word, QQ.zero)])
    >>> both((1, 2)), both((2, 1))
    (1/2, -1/2)
    """
    if not exponents:
        return lambda word: ring.zero
    if len(exponents) == 1:
        return exponents[0]
    forward, backward = TRANSFORMS[transform]
    step = _one_plus(ring, exponents[0], forward)
    for exponent in exponents[1:]:
        step = _product(ring, step, _one_plus(ring, exponent, forward))
    return cache(lambda word: power_series(step, word, _in_ring(ring, backward, len(word)), ring.zero))


def _one_plus(ring: Ring, f: Values, series: Scales) -> Values:
    return cache(
        lambda word: power_series(f, word, _in_ring(ring, series, len(word)), ring.zero) if word else ring.one
    )


def _product(ring: Ring, f: Values, g: Values) -> Values:
    return cache(lambda word: convolution(f, g, word, ring.zero))


def _in_ring(ring: Ring, series: Scales, n: int) -> tuple[Element, ...]:
    return tuple(ring.rational(q.numerator, q.denominator) for q in series(n))
