"""Recognition of high-precision numbers as algebraic numbers, by lattice reduction.

Let x be an approximate root of a polynomial of degree n with small integer coefficients c_0, ..., c_n. Choose
a large number N. For k = 0, ..., n, append the entry N x^k to the unit vector e_k of length n + 1. The
resulting vectors v_0, ..., v_n generate a lattice. The lattice contains the vector sum_k c_k v_k with the
entries c_0, ..., c_n and N p(x), where p is the polynomial. This vector is short, because p(x) is almost
zero. Lattice reduction finds short vectors in a lattice (Lenstra, Lenstra and Lovasz 1982).

The caller must verify the recognised number by exact arithmetic.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isqrt

from flint import arb, fmpq, fmpq_poly, fmpz, fmpz_mat, fmpz_poly

from orderconds.ring.decimals import endpoints
from orderconds.ring.precision import precision
from orderconds.ring.roots import isolating, real_roots

MAX_DEGREE = 6
"""The highest degree of an algebraic number that is recognised."""

MAX_TEXT = 160
"""The largest number of characters in a closed form."""


@dataclass(frozen=True)
class ClosedForm:
    """A formula for a number in a tableau file. ``text`` is the formula, and may contain the name ``r``.
    ``root`` contains the lines of the file that define ``r``."""

    text: str
    root: tuple[str, ...] = ()


def closed_forms(
    numbers: Mapping[str, arb], bits: int, radicals: Mapping[str, arb] | None = None
) -> dict[str, ClosedForm] | None:
    """Return the numbers as elements of one number field. Return None if no common field is found, or if a
    closed form has more than :data:`MAX_TEXT` characters.

    ``bits`` is the precision of the numbers in bits. ``radicals`` maps the text of each square root, for
    example ``sqrt(3)``, to the value of this square root. Each number must have a degree of at most
    :data:`MAX_DEGREE`. A closed form is a rational combination of basis elements. Three bases are tried:

    - 1 and the square roots
    - the products y r^k, where y is an element of the first basis, r is one of the numbers, d is the degree
      of r, and k = 0, ..., d - 1
    - the powers r^0, ..., r^(d-1) of an algebraic number r of degree d, where d is the largest of the degrees
      of the numbers

    In the second basis, r must not be a rational combination of the first basis. If several numbers meet this
    requirement, r is one with the lowest degree. Without ``radicals``, only the third basis is tried.

    >>> with precision(400):
    ...     root = arb(3).sqrt()
    ...     forms = closed_forms({"x": root / 6, "y": (1 - root) / 2, "z": arb(1) / 4}, 400)
    >>> {name: x.text for name, x in forms.items()}
    {'x': '1/6*sqrt(3)', 'y': '1/2 - 1/2*sqrt(3)', 'z': '1/4'}
    """
    with precision(bits):
        polynomials = {}
        for name, x in numbers.items():
            forms = minimal_polynomial(x, bits)
            if forms is None:
                return None
            polynomials[name] = forms
        if radicals:
            forms = _extended(numbers, polynomials, radicals, bits)
            if forms is not None:
                return forms
        degree = max((p.degree() for p in polynomials.values()), default=1)
        if degree == 1:
            return {name: ClosedForm(str(_root_of_linear(p))) for name, p in polynomials.items()}
        first = next(name for name, p in polynomials.items() if p.degree() == degree)
        if degree == 2:
            base, called, root = _square_root(polynomials[first])
        else:
            base, called, root = _named(numbers[first], polynomials[first])
        powers = {_power(called, k): base**k for k in range(degree)}
        return _combinations(numbers, powers, root, bits)


def _extended(
    numbers: Mapping[str, arb], polynomials: Mapping[str, fmpz_poly], radicals: Mapping[str, arb], bits: int
) -> dict[str, ClosedForm] | None:
    """Return the numbers as combinations of the first basis of :func:`closed_forms`. If some number is not a
    combination of the first basis, use the second basis for all numbers. Return None if no closed forms are
    found."""
    roots = {"": arb(1), **radicals}
    inside = [name for name, x in numbers.items() if combination(x, list(roots.values()), bits) is None]
    if not inside:
        return _combinations(numbers, roots, (), bits)
    first = min(inside, key=lambda name: polynomials[name].degree())
    degree = polynomials[first].degree()
    base, called, root = _named(numbers[first], polynomials[first])
    basis = {
        "*".join(filter(None, (radical, _power(called, k)))): y * base**k
        for radical, y in roots.items()
        for k in range(degree)
    }
    return _combinations(numbers, basis, root, bits) if len(basis) <= 2 * MAX_DEGREE else None


def _combinations(
    numbers: Mapping[str, arb], basis: Mapping[str, arb], root: tuple[str, ...], bits: int
) -> dict[str, ClosedForm] | None:
    result = {}
    for name, x in numbers.items():
        coefficients = combination(x, list(basis.values()), bits)
        if coefficients is None or len(text := _sum(coefficients, list(basis))) > MAX_TEXT:
            return None
        result[name] = ClosedForm(text, root)
    return result


def _power(base: str, k: int) -> str:
    return "" if k == 0 else base if k == 1 else f"{base}^{k}"


def minimal_polynomial(x: arb, bits: int) -> fmpz_poly | None:
    """Return the irreducible polynomial of least degree with a root at x. Return None if no such polynomial
    of degree at most :data:`MAX_DEGREE` is found.

    >>> with precision(300):
    ...     minimal_polynomial(arb(2).root(3), 300)
    x^3 + (-2)
    """
    for degree in range(1, MAX_DEGREE + 1):
        relation = _relation([x**k for k in range(degree + 1)], bits)
        if relation is not None and relation[-1]:
            polynomial = fmpz_poly(relation)
            factors = [f for f, _ in polynomial.factor()[1] if f.degree() == degree]
            return factors[0] if factors else None
    return None


def combination(x: arb, basis: Sequence[arb], bits: int) -> list[Fraction] | None:
    """Return x as a linear combination of the numbers in ``basis``: a list of rational coefficients. Return
    None if no such combination is found.

    >>> with precision(300):
    ...     [str(c) for c in combination((1 - arb(5).sqrt()) / 2, [arb(1), arb(5).sqrt()], 300)]
    ['1/2', '-1/2']
    """
    relation = _relation([x, *basis], bits)
    if relation is None or not relation[0]:
        return None
    return [Fraction(-int(c), int(relation[0])) for c in relation[1:]]


def _relation(values: Sequence[arb], bits: int) -> list[int] | None:
    """Return small integers c_k such that the sum of c_k ``values[k]`` is zero up to rounding errors, or
    None."""
    known = bits - 100
    scale = fmpz(2) ** known
    rows = []
    for k, value in enumerate(values):
        low, _ = endpoints(value.mid())
        rows.append([int(k == j) for j in range(len(values))] + [int((low * fmpq(scale)).round())])
    reduced = fmpz_mat(rows).lll()
    shortest = [int(reduced[0, k]) for k in range(len(values) + 1)]
    # A relation with large integers can hold by chance, up to rounding errors.
    longest = max(abs(c) for c in shortest).bit_length()
    if 2 * longest * (len(values) + 1) > known:
        return None
    return shortest[:-1]


def _root_of_linear(p: fmpz_poly) -> Fraction:
    return Fraction(-int(p[0]), int(p[1]))


def _square_root(p: fmpz_poly) -> tuple[arb, str, tuple[str, ...]]:
    """The roots of a quadratic polynomial p are u + v sqrt(n) and u - v sqrt(n), where n is an integer, and u
    and v are rational numbers. Return the number sqrt(n), the text of sqrt(n), and an empty tuple. The tuple
    is empty because no lines of a tableau file are needed to define sqrt(n)."""
    discriminant = int(p[1]) ** 2 - 4 * int(p[0]) * int(p[2])
    free = 1
    for prime, power in fmpz(discriminant).factor():
        free *= int(prime) ** (power % 2)
    assert isqrt(discriminant // free) ** 2 == discriminant // free
    return arb(free).sqrt(), f"sqrt({free})", ()


def _named(x: arb, p: fmpz_poly) -> tuple[arb, str, tuple[str, ...]]:
    """Let x be an approximate root of p. Return three values: x unchanged, the name ``r`` of the root in a
    tableau file, and the lines of the file that define ``r``."""
    monic = fmpq_poly([fmpq(c) for c in p.coeffs()]) / fmpq(p[p.degree()])
    place = min(
        range(len(real_roots(monic, 128))), key=lambda k: float(abs(real_roots(monic, 128)[k] - x).mid())
    )
    near = isolating(monic, lambda precise: real_roots(monic, precise)[place])
    coefficients = ", ".join(f'"{c}"' for c in monic.coeffs())
    return x, "r", ("[numbers.r]", f"minpoly = [{coefficients}]", f'near = "{near}"')


def _sum(coefficients: Sequence[Fraction], factors: Sequence[str]) -> str:
    text = ""
    for factor, c in zip(factors, coefficients, strict=True):
        if not c:
            continue
        size = str(abs(c)) if not factor else factor if abs(c) == 1 else f"{abs(c)}*{factor}"
        text += ((" - " if c < 0 else " + ") if text else ("-" if c < 0 else "")) + size
    return text or "0"
