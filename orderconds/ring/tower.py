"""A number field to which radicals and named roots are adjoined, until the field contains all coefficients of
a method.

Let K = Q(a) be a real number field, and b a real root of a polynomial p over K. The root is adjoined in three
steps:

1. In the algebra K[x]/(p), find an element c whose powers span the algebra over Q. The program tries c = x
   (the residue class of the variable), then c = a x, then c = x + m a for m = 1, -1, 2, -2, ....
2. Factor the characteristic polynomial of c over Q.
3. Insert x = b into c. The result is a real number r. Choose the irreducible factor with the root r.

The number r generates K(b). Therefore the degree of the chosen factor is the degree of K(b) over Q. If K(b)
and K have equal degrees, then K contains b, and K is not extended.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from math import gcd

from flint import arb, arb_poly, fmpq, fmpq_mat, fmpq_poly, fmpz

from orderconds.ring.decimals import Enclosure
from orderconds.ring.field import Algebraic, Generator, NumberField, substituted
from orderconds.ring.precision import precision
from orderconds.ring.protocol import Element, Ring
from orderconds.ring.rationals import QQ
from orderconds.ring.roots import isolate

MAX_DEGREE = 24
"""The largest degree over Q of the field of a :class:`Tower`."""
MAX_DIMENSION = 64
"""A root of p is adjoined to a field K only if the dimension of the algebra K[x]/(p) over Q is at most
MAX_DIMENSION."""


class DegreeError(ArithmeticError):
    """This error is raised if the degree of a field would exceed MAX_DEGREE, or if the dimension of an
    algebra would exceed MAX_DIMENSION."""


class Tower:
    """A number field that is extended when a root is adjoined. Elements that were created before an extension
    remain valid.

    >>> tower = Tower()
    >>> r = tower.root(tower.rational(2), 2)
    >>> tower.root(tower.rational(8), 2) == 2 * r, tower.field.degree
    (True, 2)
    """

    def __init__(self) -> None:
        self.field = NumberField(fmpq_poly([0, 1]), lambda bits: arb(0), (), ())
        self._radicals: list[tuple[Algebraic, int, Algebraic]] = []

    def rational(self, p: int, q: int = 1) -> Algebraic:
        """Return p/q."""
        return self.field.rational(p, q)

    def constant(self, value: Fraction, unit: Fraction) -> Algebraic:
        """Return the rational number ``value``.

        The argument ``unit`` is the error bound of ``value``. Raises TypeError if ``unit`` is not zero,
        because a number field cannot represent a rounded decimal.
        """
        if unit:
            raise TypeError("a number field cannot represent a rounded decimal")
        return self.field.rational(value.numerator, value.denominator)

    def ring(self) -> tuple[Ring, Callable[[Algebraic], Element]]:
        """Return the largest field of this tower, and a function that converts elements of the tower to
        elements of this field. If the largest field has degree 1 over Q, the ring QQ is returned in place of
        this field."""
        if self.field.degree == 1:
            return QQ, lambda x: x.rational_value
        return self.field, self.field.lift

    def size(self, x: Algebraic) -> int:
        """Return the number of bits of the largest integer in the polynomial that represents x."""
        polynomial = x.polynomial
        return max(int(polynomial.numer().height_bits()), int(polynomial.denom().bit_length()))

    def root(self, x: Algebraic, index: int) -> Algebraic:
        """Return the real ``index``-th root of x, and adjoin the root to the field if necessary.

        Raises ValueError if x is negative and ``index`` is even. Raises :class:`DegreeError` if the field
        would become too large.
        """
        sign = x.field.sign(x)
        if sign == 0 or index == 1:
            return x
        if sign < 0:
            if index % 2 == 0:
                raise ValueError("an even root of a negative number")
            return -self.root(-x, index)
        if x.is_rational:
            return self._rational_root(x.rational_value, index)
        return self._radical(x, index)

    def _rational_root(self, x: fmpq, index: int) -> Algebraic:
        """Return x^(1/index) as a rational number times a root of an integer."""
        inside = fmpz(x.p) * fmpz(x.q) ** (index - 1)
        outside, rest = fmpz(1), []
        for prime, exponent in _factors(inside):
            outside *= prime ** (exponent // index)
            if exponent % index:
                rest.append((prime, exponent % index))
        common = gcd(index, *(exponent for _, exponent in rest))
        radicand = fmpz(1)
        for prime, exponent in rest:
            radicand *= prime ** (exponent // common)
        root = self.field.one
        if radicand > 1:
            root = self._radical(self.field.rational(int(radicand)), index // common)
        return root.__mul__(fmpq(outside, x.q))

    def _radical(self, x: Algebraic, index: int) -> Algebraic:
        x = self.field.lift(x)
        for radicand, known, root in self._radicals:
            if known == index and radicand == x:
                return root

        def enclosure(bits: int) -> arb:
            inside = x.field.ball(x, bits + 8)
            with precision(bits + 16):
                return inside.root(index)

        powers = [x] + [self.field.zero] * (index - 1)
        symbol = x.field.text(x)
        root = self._adjoin(powers, enclosure, lambda n: Generator(symbol, index, n, enclosure))
        self._radicals.append((x, index, root))
        return root

    def named_root(self, minpoly: Sequence[Fraction], near: Fraction, unit: Fraction, name: str) -> Algebraic:
        """Return the real root of the polynomial ``minpoly`` in the interval [near - unit, near + unit].
        ``minpoly`` lists the coefficients by ascending powers.

        Raises ValueError if the interval does not contain exactly one root, and :class:`DegreeError` if the
        field would become too large.
        """
        coefficients = [fmpq(c.numerator, c.denominator) for c in minpoly]
        centre, radius = (fmpq(x.numerator, x.denominator) for x in (near, unit))
        factor, enclosure = isolate(coefficients, centre, radius)
        powers = [self.field.one * -c for c in factor.coeffs()[:-1]]
        return self._adjoin(powers, enclosure, lambda n: Generator(name, 0, n, enclosure, factor))

    def _adjoin(
        self, powers: list[Algebraic], enclosure: Enclosure, generator: Callable[[int], Generator]
    ) -> Algebraic:
        """Return a real root b of the equation x^k = sum_j powers[j] x^j, where k = len(powers). The function
        ``enclosure`` computes balls around b."""
        field = self.field
        if len(powers) == 1:
            return powers[0]
        dimension = field.degree * len(powers)
        if dimension > MAX_DIMENSION:
            raise DegreeError(f"an exact root needs an algebra of dimension {dimension}, which is too large")
        multiplier, relation = _primitive(field, powers)

        def primitive(bits: int) -> arb:
            a, b = field.enclosure(bits + 8), enclosure(bits + 8)
            with precision(bits + 16):
                return a * b if multiplier is None else b + multiplier * a

        modulus = _satisfied(relation.characteristic, primitive)
        degree = int(modulus.degree())
        a, b = relation.a % modulus, relation.b % modulus
        if degree == field.degree:
            return Algebraic(field, _in_powers_of(a, b, modulus))
        if degree > MAX_DEGREE:
            raise DegreeError(
                f"the coefficients generate a number field of degree {degree}, which is too large"
            )
        below = tuple(substituted(image, a, modulus) for image in field.images)
        added = generator(degree // field.degree)
        self.field = NumberField(modulus, primitive, (*field.generators, added), (*below, b), field, a)
        return Algebraic(self.field, b)


class _Relation:
    """A description of the algebra K[x]/(p), where K = Q(a) is a number field and p is a polynomial over K.
    Every element of the algebra is a polynomial in one element c, with rational coefficients.

    - ``characteristic``: the characteristic polynomial of c over Q.
    - ``a``: the element a as a polynomial in c.
    - ``b``: the residue class of x as a polynomial in c.
    """

    def __init__(self, solution: fmpq_mat, dimension: int) -> None:
        column = [fmpq_poly([solution[i, j] for i in range(dimension)]) for j in range(3)]
        self.characteristic = fmpq_poly([0] * dimension + [1]) - column[0]
        self.a, self.b = column[1], column[2]


def _primitive(field: NumberField, powers: list[Algebraic]) -> tuple[int | None, _Relation]:
    """Find an element c of the algebra K[x]/(p) such that the powers of c span the algebra over Q.

    Let K be ``field``, let a be the generator of K over Q, and let k be the length of ``powers``. The
    polynomial p is x^k - powers[k-1] x^(k-1) - ... - powers[0]. The elements x, a x, x + a, x - a, x + 2 a,
    x - 2 a, ... of the algebra are tried in this order.

    Return a pair. The first entry is None if c = a x. Otherwise c = x + m a, and the first entry is the
    integer m. The second entry describes the algebra (:class:`_Relation`).
    """
    dimension = field.degree * len(powers)
    for multiplier in _multipliers(field.degree):
        vector = [field.one] + [field.zero] * (len(powers) - 1)
        columns = []
        for _ in range(dimension + 1):
            columns.append(vector)
            vector = _times(vector, powers, multiplier)
        a = [Algebraic(field, fmpq_poly([0, 1]) % field.modulus), *columns[0][1:]]
        b = [field.zero, field.one, *columns[0][2:]]
        left = _flat(columns[:-1], field.degree)
        try:
            return multiplier, _Relation(left.solve(_flat([columns[-1], a, b], field.degree)), dimension)
        except ZeroDivisionError:
            continue
    raise AssertionError("found no generator of the algebra, although the algebra is separable over Q")


def _multipliers(degree: int) -> Iterator[int | None]:
    yield 0
    if degree > 1:
        yield None
        for m in range(1, 10_000):
            yield m
            yield -m


def _times(vector: list[Algebraic], powers: list[Algebraic], multiplier: int | None) -> list[Algebraic]:
    """Multiply two polynomials in x, and divide the product by a polynomial p. Return the remainder. The
    coefficients of all polynomials are elements of one number field. Let a be the generator of this field
    over Q, and let n be the length of ``powers``.

    - The first polynomial is v_0 + v_1 x + ..., where ``vector`` is the list [v_0, v_1, ...]. The returned
      list contains the coefficients of the remainder in the same way.
    - The second polynomial is x + m a with m = ``multiplier``. If ``multiplier`` is None, the second
      polynomial is the product of a and x.
    - The polynomial p is x^n - powers[n-1] x^(n-1) - ... - powers[0].
    """
    field = powers[0].field
    top = vector[-1]
    shifted = [x + top * p for x, p in zip([field.zero, *vector[:-1]], powers, strict=True)]
    if multiplier == 0:
        return shifted
    a = Algebraic(field, fmpq_poly([0, 1]) % field.modulus)
    if multiplier is None:
        return [x * a for x in shifted]
    return [x + y * a * multiplier for x, y in zip(shifted, vector, strict=True)]


def _flat(columns: list[list[Algebraic]], degree: int) -> fmpq_mat:
    """Return the matrix over Q with one column for each list in ``columns``. Each element of a list is
    represented by a polynomial with ``degree`` rational coefficients. The column contains the coefficients of
    all elements."""
    rows = [
        [column[j].polynomial[i] for column in columns] for j in range(len(columns[0])) for i in range(degree)
    ]
    return fmpq_mat(len(rows), len(columns), [x for row in rows for x in row])


def _satisfied(characteristic: fmpq_poly, enclosure: Enclosure) -> fmpq_poly:
    """Return the monic irreducible factor of ``characteristic`` that vanishes at the real number enclosed by
    ``enclosure``."""
    factors = [factor / factor.leading_coefficient() for factor, _ in characteristic.factor()[1]]
    bits = 64
    while len(factors) > 1:
        at = enclosure(bits)
        with precision(bits):
            factors = [factor for factor in factors if arb_poly(factor)(at).contains(0)]
        bits *= 2
    return factors[0]


def _in_powers_of(a: fmpq_poly, b: fmpq_poly, modulus: fmpq_poly) -> fmpq_poly:
    """Return the polynomial p with p(a) = b in the field Q[x]/(modulus). The element ``a`` must generate this
    field."""
    degree, power, powers = int(modulus.degree()), fmpq_poly([1]) % modulus, []
    for _ in range(degree):
        powers.append(power)
        power = power * a % modulus
    left = fmpq_mat(degree, degree, [p[i] for i in range(degree) for p in powers])
    return fmpq_poly(left.solve(fmpq_mat(degree, 1, [b[i] for i in range(degree)])).entries())


def _factors(n: fmpz) -> list[tuple[fmpz, int]]:
    """Return a factorization of a positive integer n, as pairs (factor, exponent). If n has more than 128
    bits, the last factor may be composite."""
    factors = []
    if n.bit_length() > 128:
        for prime in (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37):
            exponent = 0
            while n % prime == 0:
                n, exponent = n // prime, exponent + 1
            if exponent:
                factors.append((fmpz(prime), exponent))
        return [*factors, (n, 1)] if n > 1 else factors
    return [(prime, int(exponent)) for prime, exponent in n.factor()]
