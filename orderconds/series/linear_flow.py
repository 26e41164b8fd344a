"""Products of exponentials or of Cayley transforms for the equation Y' = A(t) Y.

An exponent is a linear combination of words, given by a function that maps a word to its coefficient. The
letter k denotes the matrix A_k in A(t) = sum_k t^(k-1) A_k, and has the weight k. The first letter of a word
acts first: the word (k, l) denotes the matrix product A_l A_k.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
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
"""The keys are the names of two transforms. The name ``exp`` denotes the exponential, and ``cay`` denotes the
Cayley transform. Each value is a pair of functions. The first function returns the power series coefficients
of the transform, without the constant term 1. The second function returns the coefficients of the inverse."""


def product_logarithm(ring: Ring, exponents: Sequence[Values], transform: str = "exp") -> Values:
    """Return the logarithm of the product of the exponentials of ``exponents``, as a function that maps a
    word to its coefficient. The exponential of ``exponents[0]`` acts first.

    If ``transform`` is ``cay``, the Cayley transform cay(x) = (1 - x/2)^-1 (1 + x/2) replaces the
    exponential, and its inverse replaces the logarithm.

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
    forward, backward = (_in_ring(ring, series) for series in TRANSFORMS[transform])
    step = _one_plus(ring, exponents[0], forward)
    for exponent in exponents[1:]:
        step = _product(ring, step, _one_plus(ring, exponent, forward))
    return cache(lambda word: power_series(step, word, backward(len(word)), ring.zero))


def _one_plus(ring: Ring, f: Values, scales: Callable[[int], Sequence[Element]]) -> Values:
    return cache(lambda word: power_series(f, word, scales(len(word)), ring.zero) if word else ring.one)


def _product(ring: Ring, f: Values, g: Values) -> Values:
    return cache(lambda word: convolution(f, g, word, ring.zero))


def _in_ring(ring: Ring, series: Scales) -> Callable[[int], Sequence[Element]]:
    return cache(lambda n: tuple(ring.rational(q.numerator, q.denominator) for q in series(n)))
