"""Laurent polynomials over Q: polynomials in which negative powers of the variables are allowed.

The formulas of some families (``sprk``, ``vcg``) contain divisions by the weights b_i. An element is stored
as a polynomial divided by a monomial, in lowest terms.
"""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq, fmpq_mpoly, fmpq_mpoly_ctx

from orderconds.ring.protocol import Element, Key

Exponents = tuple[int, ...]


class LaurentPolynomials:
    """The ring of Laurent polynomials over Q in the variables ``names``. The terms of an element are sorted
    in degree-lexicographic order, the largest term first.

    >>> R = LaurentPolynomials(["b1", "b2"])
    >>> b1, b2 = R.generators
    >>> R.text((b1 + b2) / b1 - 1)
    'b1^-1*b2'
    """

    def __init__(self, names: Sequence[str]) -> None:
        self.names = tuple(names)
        self.name = f"QQ[{', '.join(self.names)}, inverses]"
        self._context = fmpq_mpoly_ctx.get(list(self.names), "deglex")
        self.unit: Exponents = (0,) * len(self.names)
        self.zero, self.one = self.rational(0), self.rational(1)
        self.generators = tuple(Laurent(self, g, self.unit) for g in self._context.gens())

    def __repr__(self) -> str:
        return self.name

    def rational(self, p: int, q: int = 1) -> Laurent:
        """Return the constant p/q."""
        return Laurent(self, self._context.constant(fmpq(p, q)), self.unit)

    def monomial(self, exponents: Exponents, scale: Element = 1) -> fmpq_mpoly:
        """Return ``scale`` times the monomial with the given nonnegative exponents."""
        return self._context.from_dict({exponents: scale})

    def is_zero(self, x: Laurent) -> bool:
        """Return True if x = 0."""
        return bool(x.numerator.is_zero())

    def terms(self, x: Laurent) -> tuple[tuple[Exponents, fmpq], ...]:
        """Return a pair (exponents, coefficient) for each term. The leading term is the first."""
        return tuple(
            (tuple(int(e) - d for e, d in zip(exponents, x.denominator, strict=True)), c)
            for exponents, c in x.numerator.terms()
        )

    def text(self, x: Laurent) -> str:
        """Return x as text: a sum of terms that begins with the leading term."""
        return " + ".join(self._render(*term) for term in self.terms(x)).replace("+ -", "- ") or "0"

    def key(self, x: Laurent) -> Key:
        """Return a triple (exponents, p, q) for each term. The coefficient of the term is p/q."""
        return tuple((exponents, int(c.p), int(c.q)) for exponents, c in self.terms(x))

    def approximate(self, x: Laurent, digits: int = 20) -> str:
        """Return the result of :meth:`text`. The coefficients are exact, so ``digits`` is ignored."""
        return self.text(x)

    def _render(self, exponents: Exponents, c: fmpq) -> str:
        powers = [n if e == 1 else f"{n}^{e}" for n, e in zip(self.names, exponents, strict=True) if e]
        sign = "-" if c < 0 else ""
        return sign + "*".join(powers if abs(c) == 1 and powers else [str(abs(c)), *powers])


class Laurent:
    """A polynomial ``numerator`` divided by a monomial, in lowest terms. ``denominator`` contains the
    exponents of the monomial, one for each variable."""

    __slots__ = ("denominator", "numerator", "ring")

    def __init__(self, ring: LaurentPolynomials, numerator: fmpq_mpoly, denominator: Exponents) -> None:
        self.ring, self.numerator, self.denominator = ring, numerator, denominator

    def __repr__(self) -> str:
        return self.ring.text(self)

    def _lowest(self, numerator: fmpq_mpoly, denominator: Exponents) -> Laurent:
        ring = self.ring
        if numerator.is_zero():
            return ring.zero
        if any(denominator):
            shared = numerator.gcd(ring.monomial(denominator))
            numerator = numerator / shared
            powers = shared.monoms()[0]
            denominator = tuple(d - int(e) for d, e in zip(denominator, powers, strict=True))
        return Laurent(ring, numerator, denominator)

    def _other(self, other: object) -> Laurent | None:
        if isinstance(other, int):
            return self.ring.rational(other)
        return other if isinstance(other, Laurent) else None

    def __add__(self, other: object) -> Laurent:
        y = self._other(other)
        if y is None:
            return NotImplemented
        if self.denominator == y.denominator:
            return self._lowest(self.numerator + y.numerator, self.denominator)
        common = tuple(map(max, self.denominator, y.denominator))
        scaled = [
            x.numerator * self.ring.monomial(tuple(c - d for c, d in zip(common, x.denominator, strict=True)))
            for x in (self, y)
        ]
        return self._lowest(scaled[0] + scaled[1], common)

    __radd__ = __add__

    def __neg__(self) -> Laurent:
        return Laurent(self.ring, -self.numerator, self.denominator)

    def __sub__(self, other: object) -> Laurent:
        y = self._other(other)
        return NotImplemented if y is None else self + -y

    def __rsub__(self, other: object) -> Laurent:
        return -self + other

    def __mul__(self, other: object) -> Laurent:
        y = self._other(other)
        if y is None:
            return NotImplemented
        denominator = tuple(d + e for d, e in zip(self.denominator, y.denominator, strict=True))
        return self._lowest(self.numerator * y.numerator, denominator)

    __rmul__ = __mul__

    def __truediv__(self, other: object) -> Laurent:
        """Divide by a non-zero monomial. Raises ZeroDivisionError for all other divisors."""
        y = self._other(other)
        if y is None:
            return NotImplemented
        terms = self.ring.terms(y)
        if len(terms) != 1:
            raise ZeroDivisionError(f"{y!r} has no inverse in {self.ring}")
        exponents, scale = terms[0]
        up = self.ring.monomial(tuple(max(0, -e) for e in exponents), 1 / scale)
        down = tuple(d + max(0, e) for d, e in zip(self.denominator, exponents, strict=True))
        return self._lowest(self.numerator * up, down)

    def __eq__(self, other: object) -> bool:
        y = self._other(other)
        return y is not None and self.numerator == y.numerator and self.denominator == y.denominator

    def __hash__(self) -> int:
        return hash(self.ring.key(self))
