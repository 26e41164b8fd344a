"""Real number fields, whose elements are exact algebraic numbers.

A field Q(a) is defined by the minimal polynomial of a real number a and by a function. The function computes
balls that contain a. An element of the field is represented by a polynomial in a, of smaller degree than the
minimal polynomial.

If an operation combines elements of two fields of a tower (:class:`orderconds.ring.tower.Tower`), the result
lies in the larger field.
"""

from __future__ import annotations

from functools import cached_property
from itertools import product

from flint import arb, arb_poly, fmpq, fmpq_mat, fmpq_poly
from msgspec import Struct

from orderconds.ring.decimals import Enclosure, decimal, nearest_float, rational_decimal, rational_float
from orderconds.ring.power import power
from orderconds.ring.precision import precision
from orderconds.ring.protocol import Element, Key
from orderconds.ring.roots import isolating

LARGE = 8
"""In fields of at least this degree, 1/x is computed from a linear system, not by Euclid's algorithm."""

REMEMBERED = 1000
"""Each field caches at most this number of converted elements of smaller fields."""


class Generator(Struct, frozen=True):
    """A root that is adjoined to a field. The root is a radical or a named root of a polynomial.

    - ``index``: n for an n-th root, and 0 for a named root.
    - ``symbol``: the radicand of a radical as text, or the name of a named root.
    - ``degree``: the degree of the field extension that the root generates.
    - ``minpoly``: the polynomial of a named root, and None for a radical.
    """

    symbol: str
    index: int
    degree: int
    enclosure: Enclosure
    minpoly: fmpq_poly | None = None

    def power(self, n: int) -> str:
        """Return the n-th power of this root as text, for n > 0."""
        if self.index == 0:
            return self.symbol if n == 1 else f"{self.symbol}^{n}"
        if self.index == 2 and n == 1:
            return f"sqrt({self.symbol})"
        base = self.symbol if self.symbol.isdigit() else f"({self.symbol})"
        return f"{base}^({n}/{self.index})"


class NumberField:
    """The real field Q(a), where the primitive element a is a real root of the irreducible polynomial
    ``modulus``. The function ``enclosure(bits)`` returns a ball around a.

    - ``generators``: the roots that were adjoined to Q, in the order in which they were adjoined.
    - ``images``: the generators as polynomials in a.
    - ``parent``: the field to which the last generator was adjoined. If this field is Q, ``parent`` is None.
    - ``parent_image``: the primitive element of ``parent`` as a polynomial in a. If this field is Q,
      ``parent_image`` is None.
    - ``reciprocals``: a cache of the inverses of elements of the field.
    """

    def __init__(
        self,
        modulus: fmpq_poly,
        enclosure: Enclosure,
        generators: tuple[Generator, ...],
        images: tuple[fmpq_poly, ...],
        parent: NumberField | None = None,
        parent_image: fmpq_poly | None = None,
    ) -> None:
        self.modulus, self.generators, self.images = modulus, generators, images
        self.parent, self.parent_image = parent, parent_image
        self.degree = int(modulus.degree())
        self.height: int = 0 if parent is None else parent.height + 1
        self.name = f"QQ({', '.join(g.power(1) for g in generators)})" if generators else "QQ()"
        self._enclosure = enclosure
        self._enclosed: dict[int, arb] = {}
        self.reciprocals: dict[str, Algebraic] = {}
        self._lifts: dict[int, tuple[Algebraic, Algebraic]] = {}
        self.zero = Algebraic(self, fmpq_poly([0]))
        self.one = Algebraic(self, fmpq_poly([1]))

    def __repr__(self) -> str:
        return self.name

    @cached_property
    def _identity(self) -> Key:
        """Two fields are equal if their names, moduli and named roots are equal."""
        return self.name, str(self.modulus), self.named_roots

    def __eq__(self, other: object) -> bool:
        if self is other:
            return True
        return isinstance(other, NumberField) and self._identity == other._identity

    def __hash__(self) -> int:
        return hash(self.name)

    def enclosure(self, bits: int) -> arb:
        """Return a ball around the primitive element, with relative radius about 2^-bits."""
        if bits not in self._enclosed:
            self._enclosed[bits] = self._enclosure(bits)
        return self._enclosed[bits]

    def rational(self, p: int, q: int = 1) -> Algebraic:
        """Return p/q."""
        return Algebraic(self, fmpq_poly([fmpq(p, q)]))

    def is_zero(self, x: Algebraic) -> bool:
        """Return True if x = 0. The decision is exact."""
        return bool(x.polynomial.is_zero())

    def lift(self, x: Algebraic) -> Algebraic:
        """Return x as an element of this field. TypeError is raised unless x is an element of this field or
        of a smaller field in its tower."""
        if x.field == self:
            return x
        if self.parent is None or self.parent_image is None or x.field.height >= self.height:
            raise TypeError(f"{x.field} is not a subfield of {self} in the same tower")
        known = self._lifts.get(id(x))
        if known is not None and known[0] is x:
            return known[1]
        below = self.parent.lift(x).polynomial
        if below.degree() <= 0:
            return Algebraic(self, below)
        image = fmpq_poly([0])
        for basis, c in zip(self._parent_powers, below.coeffs(), strict=False):
            image = image + basis * c
        lifted = Algebraic(self, image)
        # The converted number is cached, because many numbers are converted repeatedly.
        if len(self._lifts) >= REMEMBERED:
            self._lifts.clear()
        self._lifts[id(x)] = (x, lifted)
        return lifted

    @cached_property
    def _parent_powers(self) -> tuple[fmpq_poly, ...]:
        """The powers 1, a, a^2, ... as polynomials in b. Here a is the primitive element of the parent field,
        and b is the primitive element of this field."""
        assert self.parent is not None
        powers = [fmpq_poly([1])]
        for _ in range(self.parent.degree - 1):
            powers.append(powers[-1] * self.parent_image % self.modulus)
        return tuple(powers)

    @property
    def named_roots(self) -> tuple[tuple[str, tuple[str, ...], str], ...]:
        """A triple (name, minimal polynomial, decimal) for each generator that has a name. Among the real
        roots of the polynomial, the generator is the one closest to the decimal."""
        return tuple(
            (g.symbol, tuple(str(c) for c in g.minpoly.coeffs()), isolating(g.minpoly, g.enclosure))
            for g in self.generators
            if g.minpoly is not None
        )

    @cached_property
    def monomials(self) -> tuple[tuple[int, ...], ...]:
        """The exponent tuples of a basis of the field over Q. The basis elements are products of powers of
        the generators."""
        ranges = [range(g.degree) for g in reversed(self.generators)]
        return tuple(tuple(reversed(exponents)) for exponents in product(*ranges))

    @cached_property
    def _to_monomials(self) -> fmpq_mat:
        columns = []
        for exponents in self.monomials:
            value = fmpq_poly([1])
            for image, n in zip(self.images, exponents, strict=True):
                for _ in range(n):
                    value = value * image % self.modulus
            columns.append(value)
        return _columns(columns, self.degree).inv()

    def coordinates(self, x: Algebraic) -> tuple[fmpq, ...]:
        """Return the rational coordinates of x with respect to the basis :attr:`monomials`."""
        polynomial = self.lift(x).polynomial
        return tuple((self._to_monomials * _columns([polynomial], self.degree)).entries())

    def text(self, x: Algebraic) -> str:
        """Return x as text in the grammar of tableau files. The text is a polynomial in the
        generators of the field.

        >>> from orderconds.ring.tower import Tower
        >>> tower = Tower()
        >>> x = tower.rational(1, 4) - tower.root(tower.rational(3), 2) / 6
        >>> x.field.text(x)
        '1/4 - sqrt(3)/6'
        """
        terms = []
        for exponents, c in zip(self.monomials, self.coordinates(x), strict=True):
            if c != 0:
                powers = [g.power(n) for g, n in zip(self.generators, exponents, strict=True) if n]
                terms.append(("- " if c < 0 else "+ ") + _term(abs(c), "*".join(powers)))
        text = " ".join(terms).removeprefix("+ ")
        return "-" + text[2:] if text.startswith("- ") else text or "0"

    def key(self, x: Algebraic) -> Key:
        """Return a pair (numerator, denominator) for each coefficient of the polynomial that represents x."""
        return tuple((int(c.p), int(c.q)) for c in x.polynomial.coeffs())

    def ball(self, x: Algebraic, bits: int) -> arb:
        """Return a ball around x with relative radius at most 2^-bits."""
        x = self.lift(x)
        if self.is_zero(x):
            return arb(0)
        working = bits + 32
        while True:
            at = self.enclosure(working)
            with precision(working):
                value = arb_poly(x.polynomial)(at)
            if value.rel_accuracy_bits() >= bits:
                return value
            working *= 2

    def sign(self, x: Algebraic) -> int:
        """Return the sign of x: -1, 0 or 1."""
        return 0 if self.is_zero(x) else 1 if self.ball(x, 8) > 0 else -1

    def approximate(self, x: Algebraic, digits: int = 20) -> str:
        """Return x as a decimal that is correctly rounded to ``digits`` significant digits."""
        if x.is_rational:
            return rational_decimal(x.rational_value, digits)
        return decimal(lambda bits: self.ball(x, bits), digits)

    def nearest_float(self, x: Algebraic) -> float:
        """Return the double nearest to x."""
        if x.is_rational:
            return rational_float(x.rational_value)
        return nearest_float(lambda bits: self.ball(x, bits))


class Algebraic:
    """An element of a number field: a ``polynomial`` in the primitive element. The degree of the polynomial
    is less than the degree of the field.

    Arithmetic operators also accept numbers of type ``fmpq`` or ``int``.
    """

    __slots__ = ("field", "polynomial")

    def __init__(self, field: NumberField, polynomial: fmpq_poly) -> None:
        self.field, self.polynomial = field, polynomial

    def __repr__(self) -> str:
        return f"Algebraic({self.field.text(self)})"

    @property
    def is_rational(self) -> bool:
        """True if this number lies in Q."""
        return bool(self.polynomial.degree() <= 0)

    @property
    def rational_value(self) -> fmpq:
        """The value of this number as a rational number. The attribute :attr:`is_rational` must be True."""
        return self.polynomial[0]

    @property
    def minimal_polynomial(self) -> fmpq_poly:
        """The monic irreducible polynomial over Q that has this number as a root.

        >>> from orderconds.ring.tower import Tower
        >>> tower = Tower()
        >>> x = tower.root(tower.rational(2), 2) + tower.root(tower.rational(3), 2)
        >>> x.minimal_polynomial
        x^4 + (-10)*x^2 + 1
        """
        # The characteristic polynomial of the multiplication by a number is a power of the number's minimal
        # polynomial.
        factor = _columns(self._multiples(), self.field.degree).charpoly().factor()[1][0][0]
        return factor / factor.leading_coefficient()

    def _pair(self, other: object) -> tuple[Algebraic, Algebraic] | None:
        if isinstance(other, Algebraic):
            if other.field == self.field:
                return self, other
            if other.field.height < self.field.height:
                return self, self.field.lift(other)
            return other.field.lift(self), other
        if isinstance(other, int | fmpq):
            return self, Algebraic(self.field, fmpq_poly([other]))
        return None

    def __add__(self, other: object) -> Algebraic:
        # Fast path: usually both operands are elements of one field, and no conversion is necessary.
        if type(other) is Algebraic and other.field is self.field:
            return Algebraic(self.field, self.polynomial + other.polynomial)
        if (pair := self._pair(other)) is None:
            return NotImplemented
        x, y = pair
        return Algebraic(x.field, x.polynomial + y.polynomial)

    __radd__ = __add__

    def __sub__(self, other: object) -> Algebraic:
        if (pair := self._pair(other)) is None:
            return NotImplemented
        x, y = pair
        return Algebraic(x.field, x.polynomial - y.polynomial)

    def __rsub__(self, other: Element) -> Algebraic:
        return (-self).__add__(other)

    def __neg__(self) -> Algebraic:
        return Algebraic(self.field, -self.polynomial)

    def __mul__(self, other: object) -> Algebraic:
        if type(other) is Algebraic and other.field is self.field:
            return Algebraic(self.field, self.polynomial * other.polynomial % self.field.modulus)
        if isinstance(other, int | fmpq):
            return Algebraic(self.field, self.polynomial * other)
        if (pair := self._pair(other)) is None:
            return NotImplemented
        x, y = pair
        return Algebraic(x.field, x.polynomial * y.polynomial % x.field.modulus)

    __rmul__ = __mul__

    def reciprocal(self) -> Algebraic:
        """Return 1/x for this number x. Raises ZeroDivisionError for x = 0."""
        if self.polynomial.is_zero():
            raise ZeroDivisionError("division by an algebraic number that is zero")
        key = str(self.polynomial)
        known = self.field.reciprocals
        if key not in known:
            inverse = self._solved() if self.field.degree >= LARGE else self._by_euclid()
            known[key] = Algebraic(self.field, inverse)
        return known[key]

    def _by_euclid(self) -> fmpq_poly:
        return self.polynomial.xgcd(self.field.modulus)[1]

    def _solved(self) -> fmpq_poly:
        """Return the polynomial that represents 1/x for this number x. The coefficients of the polynomial are
        the solution of a linear system."""
        degree = self.field.degree
        unit = fmpq_mat(degree, 1, [1] + [0] * (degree - 1))
        return fmpq_poly(_columns(self._multiples(), degree).solve(unit).entries())

    def _multiples(self) -> list[fmpq_poly]:
        """Return the polynomials that represent x a^k for k = 0, 1, ..., degree - 1. Here x is this number
        and a is the primitive element of the field."""
        columns, image = [], self.polynomial
        for _ in range(self.field.degree):
            columns.append(image)
            image = image * fmpq_poly([0, 1]) % self.field.modulus
        return columns

    def __truediv__(self, other: object) -> Algebraic:
        if (pair := self._pair(other)) is None:
            return NotImplemented
        x, y = pair
        if y.polynomial.degree() == 0:
            return Algebraic(x.field, x.polynomial / y.polynomial[0])
        return x * y.reciprocal()

    def __rtruediv__(self, other: Element) -> Algebraic:
        return self.reciprocal().__mul__(other)

    def __pow__(self, n: int) -> Algebraic:
        return power(self, n, self.field.one)

    def __eq__(self, other: object) -> bool:
        try:
            pair = self._pair(other)
        except TypeError:  # Neither field was constructed as an extension of the other.
            return False
        return pair is not None and bool(pair[0].polynomial == pair[1].polynomial)

    def __hash__(self) -> int:
        return hash(self.field.key(self))

    def __lt__(self, other: Element) -> bool:
        difference: Algebraic = self - other
        return difference.field.sign(difference) < 0

    def __float__(self) -> float:
        return self.field.nearest_float(self)


def _term(c: fmpq, monomial: str) -> str:
    """Return the positive rational c times a monomial as text, for example ``5*sqrt(3)/6``."""
    if not monomial:
        return str(c)
    top = monomial if c.p == 1 else f"{c.p}*{monomial}"
    return top if c.q == 1 else f"{top}/{c.q}"


def substituted(polynomial: fmpq_poly, at: fmpq_poly, modulus: fmpq_poly) -> fmpq_poly:
    """Substitute the polynomial ``at`` for the variable of ``polynomial``. Return the result modulo
    ``modulus``.

    >>> x = fmpq_poly([0, 1])
    >>> substituted(x * x, x + 1, x * x - 2)
    2*x + 3
    """
    result = fmpq_poly([0])
    for c in reversed(polynomial.coeffs()):
        result = (result * at + c) % modulus
    return result


def _columns(polynomials: list[fmpq_poly], degree: int) -> fmpq_mat:
    """Return the matrix with ``degree`` rows whose columns contain the coefficients of the polynomials."""
    rows = [[p[i] for p in polynomials] for i in range(degree)]
    return fmpq_mat(degree, len(polynomials), [x for row in rows for x in row])
