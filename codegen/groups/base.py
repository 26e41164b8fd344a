"""What a group offers, and what follows for every group from its bracket."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import cache
from math import comb, factorial
from typing import Any

from codegen.ir.domain import Domain

Scalars = tuple[Any, ...]
"""A flat tuple of scalars of one domain."""


@cache
def bernoulli_over_factorial(k: int) -> Fraction:
    """Return B_k/k! with B_1 = -1/2, the coefficients of dexp^{-1}.

    >>> [str(bernoulli_over_factorial(k)) for k in range(5)]
    ['1', '-1/2', '1/12', '0', '-1/720']
    """
    values = [Fraction(1)]
    for m in range(1, k + 1):
        values.append(-sum((comb(m + 1, j) * values[j] for j in range(m)), Fraction(0)) / (m + 1))
    return values[k] / factorial(k)


def _last(order: int) -> int:
    """Return the greatest k <= order whose Bernoulli number is not zero."""
    return max(k for k in range(order + 1) if bernoulli_over_factorial(k))


def _combined(d: Domain, terms: Sequence[tuple[Fraction, Scalars]]) -> Scalars:
    """Return the sum of c x over terms (c, x), the empty tuple where there are none."""
    total: Scalars = ()
    for c, x in terms:
        scaled = tuple(d.rational(c.numerator, c.denominator) * a for a in x)
        total = tuple(a + b for a, b in zip(total, scaled, strict=True)) if total else scaled
    return total


class LieGroup:
    """A Lie group in coordinates: ``dim`` of its algebra, ``size`` of an element.

    Subclasses give ``identity exp mul ad velocity`` and, where variational methods are wanted, ``Ad Adt
    Adtinv adt dexpt``. ``velocity(d, x, g)`` is x.g, the derivative of exp(eps x) g at eps = 0, in the
    coordinates of g.
    """

    name: str
    dim: int
    size: int
    abelian = False
    layout = ""
    """What to add to the name to say how an element's coordinates are ordered: ``, row by row``."""

    def identity(self, d: Domain) -> Scalars:
        """Return the neutral element."""
        raise AttributeError(f"{self.name} has no identity")

    def exp(self, d: Domain, x: Scalars) -> Scalars:
        """Return exp(x)."""
        raise AttributeError(f"{self.name} has no exponential")

    def mul(self, d: Domain, g: Scalars, k: Scalars) -> Scalars:
        """Return g k."""
        raise AttributeError(f"{self.name} has no product")

    def ad(self, d: Domain, x: Scalars, y: Scalars) -> Scalars:
        """Return [x, y]."""
        raise AttributeError(f"{self.name} has no bracket")

    def adt(self, d: Domain, x: Scalars, mu: Scalars) -> Scalars:
        """Return ad*_x mu."""
        raise AttributeError(f"{self.name} has no dual bracket")

    def velocity(self, d: Domain, x: Scalars, g: Scalars) -> Scalars:
        """Return x.g, the derivative of exp(eps x) g at eps = 0."""
        raise AttributeError(f"{self.name} has no velocity")

    def rate(self, d: Domain, v: Scalars, g: Scalars) -> Scalars:
        """Return x where v = x.g, for v that is such a derivative: the inverse of :meth:`velocity`."""
        raise AttributeError(f"{self.name} has no rate")

    def laws(self, d: Domain, g: Scalars) -> tuple[tuple[str, Any], ...]:
        """Return the equations that coordinates of an element satisfy: a name, and what must be zero."""
        return ()

    def dexpinv(self, d: Domain, x: Scalars, y: Scalars, order: int) -> Scalars:
        """Return dexp^{-1}_{(order),x} y = sum over k <= order of B_k/k! ad_x^k y."""
        return self._bernoulli_sum(d, lambda power: self.ad(d, x, power), y, order)

    def _bernoulli_sum(
        self, d: Domain, advance: Callable[[Scalars], Scalars], first: Scalars, order: int
    ) -> Scalars:
        """Return sum over k <= order of B_k/k! advance^k(first)."""
        total, power = first, first
        for k in range(1, _last(order) + 1):
            power = advance(power)
            b = bernoulli_over_factorial(k)
            if b:
                factor = d.rational(b.numerator, b.denominator)
                total = tuple(s + factor * t for s, t in zip(total, power, strict=True))
        return total

    def dexpinvt(self, d: Domain, x: Scalars, mu: Scalars, order: int) -> Scalars:
        """Return (dexp^{-1}_{(order),x})* mu = sum over k <= order of B_k/k! (ad*_x)^k mu."""
        return self._bernoulli_sum(d, lambda power: self.adt(d, x, power), mu, order)

    def P(self, d: Domain, x: Scalars, y: Scalars, mu: Scalars, order: int) -> Scalars:
        """Return P*_(order)(x, y) mu, paired with z what mu is with the derivative of dexpinv_x y along z.

        That is -sum over 1 <= k <= order of B_k/k! sum_{i<k} ad*_{ad_x^{k-1-i} y} (ad*_x)^i mu (thesis eq.
        3.16), summed over k first, for the operator is linear in its subscript.
        """
        last = _last(order)
        brackets, powers = [y], [mu]
        for _ in range(1, last):
            brackets.append(self.ad(d, x, brackets[-1]))
            powers.append(self.adt(d, x, powers[-1]))
        total = (d.rational(0),) * self.dim
        for i, power in enumerate(powers):
            terms = [(-bernoulli_over_factorial(k), brackets[k - 1 - i]) for k in range(i + 1, last + 1)]
            subscript = _combined(d, [(c, z) for c, z in terms if c])
            if last and subscript:
                pairs = zip(total, self.adt(d, subscript, power), strict=True)
                total = tuple(a + b for a, b in pairs)
        return total

    def variants(self) -> tuple[Any, ...]:
        """Return this group with the ways in which :meth:`left` can be computed, the plain one first."""
        return (self,)

    def left(self, d: Domain, x: Scalars, g: Scalars) -> Scalars:
        """Return exp(x) g."""
        return self.mul(d, self.exp(d, x), g)

    def moved(self, d: Domain, x: Scalars, n: Scalars, mu: Scalars) -> Scalars:
        """Return Ad*_{exp(-x)} mu + dexp*_{-x} n, the momentum after exp(x, n) on T*G."""
        group: Any = self  # with a coadjoint action, which not every group has
        turned = group.Adtinv(d, self.exp(d, x), mu)
        pushed = group.dexpt(d, tuple(-a for a in x), n)
        return tuple(a + b for a, b in zip(pushed, turned, strict=True))

    def right(self, d: Domain, g: Scalars, axis: Scalars, angle: Any) -> Scalars:
        """Return g exp(angle axis)."""
        return self.mul(d, g, self.exp(d, tuple(angle * e for e in axis)))

    def symbols(self, name: str) -> list[Any]:
        """Return sympy symbols of a group element's coordinates: ``name``, row and column digits."""
        from sympy import Symbol

        n = round(self.size**0.5)
        return [Symbol(f"{name}{i}{j}", real=True) for i in range(n) for j in range(n)]

    def point(self, name: str) -> Any:
        """Return a sympy matrix of symbols for a group element."""
        from sympy import Matrix

        n = round(self.size**0.5)
        return Matrix(n, n, self.symbols(name))

    def dual(self, name: str) -> Any:
        """Return a sympy column of symbols for a covector: ``name`` with an index."""
        from sympy import Matrix, Symbol

        return Matrix([Symbol(f"{name}{i}", real=True) for i in range(self.dim)])


def dot(a: Scalars, b: Scalars) -> Any:
    """Return sum a_i b_i, added from the left."""
    total = a[0] * b[0]
    for x, y in zip(a[1:], b[1:], strict=True):
        total = total + x * y
    return total


def cross(a: Scalars, b: Scalars) -> Scalars:
    """Return the cross product of two 3-vectors."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def matmul(a: Scalars, b: Scalars, n: int) -> Scalars:
    """Return the product of two n x n matrices, row by row."""
    rows = range(n)
    return tuple(dot(a[n * i : n * i + n], b[j::n]) for i in rows for j in rows)


def matvec(a: Scalars, v: Scalars) -> Scalars:
    """Return the matrix a, row by row, times the vector v."""
    n = len(v)
    return tuple(dot(a[i : i + n], v) for i in range(0, len(a), n))
