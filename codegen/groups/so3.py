"""SO(3) as rotation matrices, so(3) and its dual as R^3."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

from codegen.groups.base import LieGroup, Scalars, bernoulli_over_factorial, cross, dot, matmul, matvec
from codegen.ir.domain import Domain
from codegen.ir.normal_form import Relation
from codegen.ir.number import Number
from codegen.ir.program import Factor


def word_coefficients(d: Domain, word: Sequence[Factor], z: Any) -> tuple[Any, Any]:
    """Return b and c where the product of the word's functions of t is 1 + b t + c t^2 and t^3 = -z t.

    exp(a t) dexp(s t) is found at once, as (exp((a + s) t) - exp(a t))/(s t); other factors are multiplied.
    """
    zero = d.rational(0)
    rates = [f.scale * f.power for f in word if f.function == "exp"]
    differences = [f for f in word if f.function == "dexp" and f.power == 1]
    rest = [f for f in word if f.function != "exp" and f not in differences]
    total, shift = (zero, zero), sum(rates, Fraction(0))
    if differences:
        first, *more = differences
        ends = [(shift + first.scale, 1 / first.scale), (shift, -1 / first.scale)]
        total = _exponentials(d, [(k, r) for k, r in ends if k], 1, z)
        rest = [*more, *rest]
    elif shift:
        total = _exponentials(d, [(shift, Fraction(1))], 0, z)
    for factor in rest:
        b, c = _inverted(d, *_single(d, factor, z), z) if factor.power < 0 else _single(d, factor, z)
        e, f = total
        total = (e + b - z * (e * c + f * b), f + c + e * b - z * (f * c))
    return total


def _exponentials(d: Domain, terms: Sequence[tuple[Fraction, Fraction]], j: int, z: Any) -> tuple[Any, Any]:
    """Return b and c of sum r exp(k t)/t^j over terms (k, r)."""
    sums = []
    for power in (1 + j, 2 + j):
        weights: dict[Fraction, Fraction] = {}
        for k, r in terms:
            weights[k * k] = weights.get(k * k, Fraction(0)) + r * k**power
        value = d.rational(0)
        for square, weight in weights.items():
            if weight:
                argument = z if square == 1 else d.rational(square.numerator, square.denominator) * z
                value = value + d.rational(weight.numerator, weight.denominator) * d.call(
                    f"stumpff{power}", argument
                )
        sums.append(value)
    return sums[0], sums[1]


def _single(d: Domain, factor: Factor, z: Any) -> tuple[Any, Any]:
    """Return b and c of dexp or of dexpinv cut off, without the power of the factor."""
    s = factor.scale
    if factor.function == "dexp":
        return _exponentials(d, [(s, 1 / s)], 1, z)
    found = [d.rational(0), d.rational(0)]
    for k in range(factor.order, 0, -1):
        weight = bernoulli_over_factorial(k) * s**k
        place = (k + 1) % 2
        found[place] = d.rational(weight.numerator, weight.denominator) - z * found[place]
    return found[0], found[1]


def _inverted(d: Domain, b: Any, c: Any, z: Any) -> tuple[Any, Any]:
    """Return b and c of the inverse: of 1 - c z + i b sqrt(z) on the plane that x is orthogonal to."""
    p = d.rational(1) - c * z
    scale = d.rational(1) / (p * p + b * b * z)
    return -(b * scale), (b * b - p * c) * scale


class SO3(LieGroup):
    """Rotations of R^3: a matrix row by row; so(3) and so(3)* are R^3 by the hat map and the dot product.

    [x, y] = x cross y, Ad_g x = g x, Ad*_g mu = g^T mu, ad*_x mu = -x cross mu, dexp*_x = dexp_{-x}. With
    z = x.x and the Stumpff functions c_k: exp(x) = 1 + c_1 hat(x) + c_2 hat(x)^2 (Rodrigues), dexp_x =
    1 + c_2 ad_x + c_3 ad_x^2.
    """

    name, layout = "SO(3)", ", row by row"
    dim, size = 3, 9

    def __init__(self, spare: int | None = None) -> None:
        self.spare = spare

    def variants(self) -> tuple[SO3, ...]:
        """Return this group, and as it is computed with a column that is the cross product of the others."""
        return (self, *(SO3(column) for column in range(3)))

    def identity(self, d: Domain) -> Scalars:
        """Return the unit matrix."""
        one, zero = d.rational(1), d.rational(0)
        return tuple(one if i == j else zero for i in range(3) for j in range(3))

    def mul(self, d: Domain, g: Scalars, k: Scalars) -> Scalars:
        """Return the matrix product."""
        return matmul(g, k, 3)

    def exp(self, d: Domain, x: Scalars) -> Scalars:
        """Return the rotation about x by the angle |x|."""
        z = dot(x, x)
        c1, c2 = d.call("stumpff1", z), d.call("stumpff2", z)
        a, b, c = (c1 * t for t in x)
        p, q, r = (c2 * t for t in x)
        xy, xz, yz = p * x[1], p * x[2], q * x[2]
        xx, yy, zz = p * x[0], q * x[1], r * x[2]
        one = d.rational(1)
        return (
            *(one - (yy + zz), xy - c, xz + b),
            *(xy + c, one - (xx + zz), yz - a),
            *(xz - b, yz + a, one - (xx + yy)),
        )

    def ad(self, d: Domain, x: Scalars, y: Scalars) -> Scalars:
        """Return x cross y."""
        return cross(x, y)

    def adt(self, d: Domain, x: Scalars, mu: Scalars) -> Scalars:
        """Return -x cross mu."""
        return cross(mu, x)

    def Ad(self, d: Domain, g: Scalars, x: Scalars) -> Scalars:
        """Return g x."""
        return matvec(g, x)

    def Adt(self, d: Domain, g: Scalars, mu: Scalars) -> Scalars:
        """Return g^T mu."""
        return tuple(dot(g[j::3], mu) for j in range(3))

    def Adtinv(self, d: Domain, g: Scalars, mu: Scalars) -> Scalars:
        """Return g mu."""
        return matvec(g, mu)

    def Adinv(self, d: Domain, g: Scalars, x: Scalars) -> Scalars:
        """Return g^T x."""
        return self.Adt(d, g, x)

    def dexpt(self, d: Domain, x: Scalars, mu: Scalars) -> Scalars:
        """Return dexp_{-x} mu = mu - c_2 x cross mu + c_3 x cross (x cross mu)."""
        z = dot(x, x)
        c2, c3 = d.call("stumpff2", z), d.call("stumpff3", z)
        v = cross(x, mu)
        w = cross(x, v)
        return tuple(m - c2 * p + c3 * q for m, p, q in zip(mu, v, w, strict=True))

    def series(self, d: Domain, word: Sequence[Factor], dual: bool, x: Scalars, v: Scalars) -> Scalars:
        """Return the product of functions of ad_x, or of ad*_x = -ad_x, applied to v.

        As ad_x^3 = -z ad_x with z = x.x, each is 1 + b ad_x + c ad_x^2; so are products and inverses.
        """
        b, c = word_coefficients(d, word, dot(x, x))
        first = cross(x, v)
        second = cross(x, first)
        return tuple(
            p - b * q + c * r if dual else p + b * q + c * r for p, q, r in zip(v, first, second, strict=True)
        )

    def series_sum(
        self,
        d: Domain,
        terms: Sequence[tuple[Any, Sequence[Factor], Scalars]],
        dual: bool,
        x: Scalars,
        total: Callable[[tuple[int, ...]], Scalars] | None = None,
    ) -> Scalars:
        """Return the sum of f W(ad_x) v over terms (f, W, v) in two brackets: A + x cross (B + x cross C).

        Terms with the same coefficient of ad_x, or of ad_x^2, are added before they are multiplied by it.
        ``total`` gives the sum of f v over some of the terms, by number, where the caller has a shorter one.
        """

        def added(numbers: tuple[int, ...]) -> Scalars:
            if total is not None:
                return total(numbers)
            owns = [tuple(f * a for a in v) for f, _, v in (terms[k] for k in numbers)]
            return tuple(sum(parts[1:], start=parts[0]) for parts in zip(*owns, strict=True))

        z = dot(x, x)
        groups: tuple[dict[Any, tuple[int, ...]], dict[Any, tuple[int, ...]]] = ({}, {})
        for k, (_, word, _) in enumerate(terms):
            b, c = word_coefficients(d, word, z)
            for group, factor in zip(groups, (-b if dual else b, c), strict=True):
                group[factor] = (*group.get(factor, ()), k)
        inner = (d.rational(0),) * 3
        for b, numbers in groups[0].items():
            inner = tuple(p + b * a for p, a in zip(inner, added(numbers), strict=True))
        for c, numbers in groups[1].items():
            inner = tuple(p + c * a for p, a in zip(inner, cross(x, added(numbers)), strict=True))
        plain = added(tuple(range(len(terms))))
        return tuple(p + q for p, q in zip(plain, cross(x, inner), strict=True))

    def velocity(self, d: Domain, x: Scalars, g: Scalars) -> Scalars:
        """Return hat(x) g: x cross every column."""
        columns = [cross(x, g[j::3]) for j in range(3)]
        return tuple(columns[j][i] for i in range(3) for j in range(3))

    def rate(self, d: Domain, v: Scalars, g: Scalars) -> Scalars:
        """Return x where v = x.g: the entries below and above the diagonal of v g^T."""
        return tuple(dot(v[3 * i : 3 * i + 3], g[3 * j : 3 * j + 3]) for i, j in ((2, 1), (0, 2), (1, 0)))

    def mulexp(self, d: Domain, g: Scalars, x: Scalars) -> Scalars:
        """Return g exp(x) row by row: rows that nothing reads cost nothing."""
        back = tuple(-a for a in x)
        return tuple(a for i in (0, 3, 6) for a in self.rotate(d, back, g[i : i + 3]))

    def spin(self, d: Domain, g: Scalars, x: Scalars) -> Scalars:
        """Return g hat(x), the derivative of g exp(eps x) at eps = 0: every row cross x."""
        return tuple(a for i in (0, 3, 6) for a in cross(g[i : i + 3], x))

    def relations(self, q: Sequence[str]) -> tuple[Relation, ...]:
        """Return g^T g = 1 as replacements of the products of two entries of the first row."""
        one, minus = Number.rational(1), Number.rational(-1)
        found: list[Relation] = []
        for j in range(3):
            for k in range(j, 3):
                rest = [(minus, (q[3 * i + j], q[3 * i + k])) for i in (1, 2)]
                found.append(((q[j], q[k]), [*([(one, ())] if j == k else []), *rest]))
        return tuple(found)

    def rotate(self, d: Domain, x: Scalars, y: Scalars) -> Scalars:
        """Return exp(x) y = y + c_1 x cross y + c_2 x cross (x cross y) without forming exp(x)."""
        z = dot(x, x)
        c1, c2 = d.call("stumpff1", z), d.call("stumpff2", z)
        v = cross(x, y)
        w = cross(x, v)
        return tuple(a + c1 * b + c2 * c for a, b, c in zip(y, v, w, strict=True))

    def left(self, d: Domain, x: Scalars, g: Scalars) -> Scalars:
        """Return exp(x) g: two columns rotated, and their cross product as the third, which is ``spare``."""
        if self.spare is None:
            return self.mul(d, self.exp(d, x), g)
        j, k = (self.spare + 1) % 3, (self.spare + 2) % 3
        columns = {i: self.rotate(d, x, g[i::3]) for i in sorted((j, k))}
        columns[self.spare] = cross(columns[j], columns[k])
        return tuple(columns[i % 3][i // 3] for i in range(9))

    def moved(self, d: Domain, x: Scalars, n: Scalars, mu: Scalars) -> Scalars:
        """Return exp(x) mu + dexp_x n; with a column to spare without the matrix exp(x)."""
        if self.spare is None:
            return super().moved(d, x, n, mu)
        z = dot(x, x)
        c1, c2, c3 = (d.call(f"stumpff{k}", z) for k in (1, 2, 3))
        v, w = cross(x, mu), cross(x, n)
        p, q = cross(x, v), cross(x, w)
        return tuple((mu[i] + n[i]) + ((c1 * v[i] + c2 * (p[i] + w[i])) + c3 * q[i]) for i in range(3))

    def laws(self, d: Domain, g: Scalars) -> tuple[tuple[str, Any], ...]:
        """Return g^T g = 1 and det g = 1."""
        one, columns = d.rational(1), [g[j::3] for j in range(3)]
        gram = [dot(columns[i], columns[j]) - (one if i == j else 0) for i in range(3) for j in range(i, 3)]
        determinant = dot(columns[0], cross(columns[1], columns[2])) - one
        return (*(("g^T g = 1", x) for x in gram), ("det g = 1", determinant))

    def hat(self, d: Domain, x: Scalars) -> Scalars:
        """Return the skew matrix of x, row by row."""
        zero = d.rational(0)
        return (zero, -x[2], x[1], x[2], zero, -x[0], -x[1], x[0], zero)
