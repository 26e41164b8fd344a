"""Groups with ad_x^3 = -z ad_x for a scalar z. Each function of ad_x is a quadratic polynomial in ad_x."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import ClassVar

from codegen.groups.ad_polynomial import ad_polynomial
from codegen.groups.capabilities import ClosedFormSeries, Term
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.ad_series import Factor
from codegen.ir.domain import Domain

DEXP = (Factor("dexp", Fraction(1)),)
"""The function dexp, as a product with one factor (see :mod:`codegen.ir.ad_series`)."""


class CubicAd(ClosedFormSeries):
    """A group with ad_x^3 = -z ad_x, where the number z is a quadratic form of x.

    Let c_2 and c_3 be Stumpff functions. Then dexp_x = 1 + c_2(z) ad_x + c_3(z) ad_x^2. If z can be negative,
    the subclass sets ``signed`` to true.
    """

    signed: ClassVar[bool] = False

    @abstractmethod
    def squared_rate(self, d: Domain, x: Vector[S]) -> S:
        """Return the number z with ad_x^3 = -z ad_x. The non-zero eigenvalues of ad_x are sqrt(-z) and
        -sqrt(-z).
        """

    def series(self, d: Domain, word: Sequence[Factor], dual: bool, x: Vector[S], v: Vector[S]) -> Vector[S]:
        """Return W(ad_x) v, where W is the product of the factors in ``word``. If ``dual`` is true, return
        W(ad*_x) v.
        """
        b, c = ad_polynomial(d, word, self.squared_rate(d, x), signed=self.signed)
        bracket = self.adt if dual else self.ad
        first = bracket(d, x, v)
        second = bracket(d, x, first)
        return tuple(p + b * q + c * r for p, q, r in zip(v, first, second, strict=True))

    def series_sum(
        self,
        d: Domain,
        terms: Sequence[Term[S]],
        dual: bool,
        x: Vector[S],
        total: Callable[[tuple[int, ...]], Vector[S]] | None = None,
    ) -> Vector[S]:
        """Return the sum of f W(ad_x) v over the triples (f, W, v) in ``terms``.

        In each triple, f is a number, W(t) is a product of functions of t, and v is a vector. If ``dual`` is
        true, ad*_x replaces ad_x. The argument ``total`` is described in :meth:`ClosedFormSeries.series_sum`.
        """
        z, bracket = self.squared_rate(d, x), self.adt if dual else self.ad
        none: Vector[S] = (d.rational(0),) * self.dim
        inner, innermost, plain = none, none, none
        for f, word, v in terms:
            b, c = ad_polynomial(d, word, z, signed=self.signed)
            own = tuple(f * a for a in v)
            inner = tuple(p + b * a for p, a in zip(inner, own, strict=True))
            innermost = tuple(p + c * a for p, a in zip(innermost, own, strict=True))
            plain = tuple(p + a for p, a in zip(plain, own, strict=True))
        if total is not None:
            plain = total(tuple(range(len(terms))))
        inner = tuple(p + q for p, q in zip(inner, bracket(d, x, innermost), strict=True))
        return tuple(p + q for p, q in zip(plain, bracket(d, x, inner), strict=True))

    def dexpt(self, d: Domain, x: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return dexp*_x mu = mu + c_2(z) ad*_x mu + c_3(z) (ad*_x)^2 mu.

        The number z is the result of :meth:`squared_rate`, and the c_k are the Stumpff functions.
        """
        return self.series(d, DEXP, True, x, mu)
