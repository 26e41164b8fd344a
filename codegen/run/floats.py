"""Arithmetic in doubles with the same roundings as in emitted code.

With different rounding errors, a trial step (:mod:`codegen.run.trial`) and the emitted code could need
different numbers of iterations.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache

from codegen.ir.domain import FloatDomain
from codegen.ir.ieee import ieee
from codegen.ir.precision import DOUBLE
from codegen.snippets.stumpff import SMALL, SWITCH, TINY, constants, curvatures, economised, limit, slopes


class EmittedFloats(FloatDomain):
    """Arithmetic with doubles. The rounding errors are the same as in emitted code.

    ``chain`` is the nesting depth of the Stumpff functions in a step (:mod:`codegen.ir.angle_depth`). For
    example, the nesting depth of c_1(c_1(z)) is 2, where c_1 is a Stumpff function.
    For arguments above a limit, the Stumpff functions return NaN. The limit depends on ``chain``
    (:func:`codegen.snippets.stumpff.limit`).
    """

    def __init__(self, h: float = 0.0, chain: int = 1) -> None:
        super().__init__(h)
        # The Stumpff functions return NaN for arguments above ``self.limit``.
        self.limit = limit(DOUBLE, chain)

    def together(self, orders: Sequence[int], z: float) -> list[float]:
        """Return the Stumpff functions c_k(z) for the indices k in ``orders``."""
        # The thresholds are those of the emitted functions, so the rounding errors are the same.
        if z <= TINY and len(orders) < 3:
            return [_short(k, z, "tiny") for k in orders]
        if z <= SMALL:
            return [_short(k, z, "small") for k in orders]
        return self._far(tuple(orders), z)

    def _far(self, orders: tuple[int, ...], z: float) -> list[float]:
        # For z <= SWITCH[k], c_k is computed by its Taylor polynomial. If several functions are requested,
        # the threshold is SWITCH[0].
        if z <= SWITCH[orders[0] if len(orders) == 1 else 0]:
            return [_series(k, z) for k in orders]
        # For z above ``self.limit``, c_k would have too few correct digits, so the result is NaN.
        allowed = z if z <= self.limit else math.nan
        if 2 not in orders:
            return self._by_angle(orders, z, math.sqrt(allowed))
        # For small s = sqrt(z), the formula c_2 = (1 - cos(s))/s^2 would lose digits.
        half = 0.5 * math.sqrt(allowed)
        sine, cosine = math.sin(half), math.cos(half)
        ratio = sine / half
        # Let r = sqrt(z)/2. Then c_1 = cos(r) sin(r)/r and c_2 = (sin(r)/r)^2/2.
        closed = {0: math.cos(2.0 * half), 1: ratio * cosine, 2: 0.5 * (ratio * ratio)}
        if 3 in orders:
            # For z up to SWITCH[3], the closed form c_3 = (1 - c_1)/z loses digits.
            closed[3] = _series(3, z) if z <= SWITCH[3] else (1.0 - ratio * cosine) / z
        return [closed[k] for k in orders]

    def _by_angle(self, orders: tuple[int, ...], z: float, s: float) -> list[float]:
        ratio = math.sin(s) / s
        closed = {0: math.cos(s), 1: ratio}
        if 3 in orders:
            closed[3] = _series(3, z) if z <= SWITCH[3] else (1.0 - ratio) / z
        return [closed[k] for k in orders]

    def call(self, function: str, *args: float) -> float:
        """Return the value of a mathematical function, with the same roundings as in emitted code."""
        (z, *_) = args
        if function.startswith("signed_stumpff"):
            k = int(function[-1])
            return self.together([k], z)[0] if z >= 0 else _hyperbolic(k, z)
        if function.startswith("stumpff"):
            return self.together([int(function[-1])], z)[0]
        if "slope" in function:
            return self._slope(int(function[-1]), z, signed=function.startswith("signed"))
        if "curvature" in function:
            return self._curvature(int(function[-1]), z)
        return super().call(function, *args)

    def _curvature(self, k: int, z: float) -> float:
        if z > 1.0:
            # For z <= 1, the formula with three Stumpff functions loses digits. Then a Taylor polynomial is
            # used.
            a, b, c = self.together([k - 2, k - 1, k], z)
            return 0.25 * ((a - float(2 * k + 1) * b) + float(k * (k + 2)) * c) / (z * z)
        *rest, total = curvatures(k)
        for term in reversed(rest):
            total = term + z * total
        return total

    def _slope(self, k: int, z: float, *, signed: bool) -> float:
        # The derivative of c_k is (c_(k-1) - k c_k)/(2 z). For |z| <= 1 the difference loses digits, so a
        # Taylor polynomial is used.
        if abs(z) > 1.0:
            if signed:
                before, c = (self.call(f"signed_stumpff{i}", z) for i in (k - 1, k))
            else:
                before, c = self.together([k - 1, k], z)
            return 0.5 * (before - float(k) * c) / z
        *rest, total = slopes(k)
        # The emitted function uses Horner's rule, too, so all roundings agree.
        for term in reversed(rest):
            total = term + z * total
        return total


def _hyperbolic(k: int, z: float) -> float:
    """Return the Stumpff function c_k(z) for z < 0."""
    r = math.sqrt(-z)
    if k == 0:
        return ieee("cosh", r)
    if k == 2:
        # For small r, the formula c_2 = (cosh(r) - 1)/r^2 would lose digits.
        half = 0.5 * r
        ratio = ieee("sinh", half) / half
        return 0.5 * (ratio * ratio)
    if k == 3 and z >= -SWITCH[3]:
        return _series(3, z)
    ratio = ieee("sinh", r) / r
    return ratio if k == 1 else (1.0 - ratio) / z


@cache
def _terms(k: int, name: str) -> tuple[float, ...]:
    if name == "series":
        return constants(k)
    # The rational coefficients from ``economised`` are rounded to doubles.
    return tuple(DOUBLE.round(c) for c in economised(k, TINY if name == "tiny" else SMALL))


def _short(k: int, z: float, name: str) -> float:
    """Return the Stumpff function c_k(z) for small z. ``name`` selects the polynomial: "tiny" or "small"."""
    terms, w = _terms(k, name), z * z
    total, factor = 0.0, 1.0
    # The emitted code (template ``stumpff_small``) adds the same terms in the same sequence, so all roundings
    # agree.
    for place in range(0, len(terms), 2):
        pair = terms[place] + z * terms[place + 1] if place + 1 < len(terms) else terms[place]
        total = pair if place == 0 else total + factor * pair
        factor = w if place == 0 else factor * w
    return total


def _series(k: int, z: float) -> float:
    """Return the Taylor polynomial of the Stumpff function c_k at z."""
    first, *rest = _terms(k, "series")
    w = z * z
    even, odd = _chain(rest[::2], w), _chain(rest[1::2], w)
    return first + z * (even + z * odd)


def _chain(terms: Sequence[float], w: float) -> float:
    # The terms are grouped in pairs, as in the emitted code, because the grouping determines the roundings.
    w2, total = w * w, 0.0
    pairs = [terms[k : k + 2] for k in range(0, len(terms), 2)]
    for number, pair in enumerate(reversed(pairs)):
        # If the number of terms is odd, the last pair contains only one term.
        value = pair[0] + w * pair[1] if len(pair) == 2 else pair[0]
        total = value if number == 0 else value + w2 * total
    return total
