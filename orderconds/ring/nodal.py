"""Vectors with one entry for each stage, represented by rational polynomials in the nodes.

Suppose that the nodes c_1, ..., c_s of a method are different, and that they are the roots of a polynomial M
of degree s over Q. Each vector with s entries then has the form (p(c_1), ..., p(c_s)) for exactly one
polynomial p of degree below s. The componentwise product of two vectors corresponds to the product of their
polynomials modulo M.

Let A be the matrix of the method, b the vector of the weights, and c^k the vector of the powers c_i^k. The
module requires two more properties of the method:

- The polynomial of each vector A c^k has rational coefficients.
- Each number sum_i b_i c_i^k is rational.

Order conditions of such a method can be computed with rational polynomials. Rational arithmetic is faster
than arithmetic in a large number field.

Candidates for the rational coefficients are computed with balls (intervals) and then verified exactly in the
number field.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

from flint import arb, arb_mat, fmpq, fmpq_poly

from orderconds.ring.decimals import endpoints
from orderconds.ring.field import Algebraic, NumberField
from orderconds.ring.precision import precision
from orderconds.ring.protocol import Element, Ring

BITS = 512
"""The precision, in bits, of the polynomial interpolation at the nodes."""

Matrix = Sequence[Sequence[Element]]


class NodalAlgebra:
    """The algebra Q[z]/M of a method, where M is the monic polynomial whose roots are the nodes c_i.

    A polynomial p represents the vector v with the entries p(c_i). Let P be the antiderivative of p with
    P(0) = 0. Let A be a matrix (a_ij) of the method, which may have several matrices. Let b be the vector of
    the weights.

    For a collocation method, P modulo M represents the vector A v, and the scalar product of b and v is P(1).
    For other methods, two attributes store corrections of P and of P(1):

    - ``corrections[kind]``: a list of pairs (k, d) for the matrix A = ``matrices[kind]``, where ``matrices``
      is the argument of :func:`nodal_algebra`. If z^k represents the vector v, the polynomial
      z^(k+1)/(k+1) + d modulo M represents A v.
    - ``moments``: a list of pairs (k, d). The scalar product of the weights with the vector of the powers
      c_i^k is 1/(k+1) + d.

    Pairs with d = 0 are omitted.

    The polynomials have the type ``fmpq_poly`` and a degree below the number of stages.

    >>> from orderconds.tableau import Tableau, find
    >>> gauss3 = Tableau.load(find("gauss3"))
    >>> algebra = nodal_algebra(gauss3.ring, (gauss3.method.A,), gauss3.method.b)
    >>> algebra.modulus, algebra.corrections, algebra.moments
    (x^3 + (-3/2)*x^2 + 3/5*x + (-1/20), ([],), [])
    >>> algebra.weigh(algebra.apply(0, algebra.apply(0, algebra.one)))
    1/6
    """

    def __init__(
        self,
        modulus: fmpq_poly,
        maps: Sequence[Sequence[fmpq_poly]],
        functional: Sequence[fmpq],
    ) -> None:
        self.modulus = modulus
        self.one = fmpq_poly([1])
        powers = [fmpq_poly([0] * k + [1]) for k in range(len(functional))]
        self.corrections = tuple(
            [(k, q) for k, p in enumerate(images) if (q := p - powers[k].integral() % modulus)]
            for images in maps
        )
        self.moments = [(k, q) for k, m in enumerate(functional) if (q := m - fmpq(1, k + 1))]

    def multiply(self, x: fmpq_poly, y: fmpq_poly) -> fmpq_poly:
        """Return the product x y modulo the polynomial M of the algebra. If x and y represent two vectors,
        the result represents their componentwise product."""
        return x * y % self.modulus

    def apply(self, kind: int, x: fmpq_poly) -> fmpq_poly:
        """Return the polynomial that represents the vector A v. Here v is the vector that x represents, and A
        is ``matrices[kind]``, where ``matrices`` is the argument of :func:`nodal_algebra`."""
        image = x.integral() % self.modulus
        for k, correction in self.corrections[kind]:
            image = image + correction * x[k]
        return image

    def weigh(self, x: fmpq_poly) -> fmpq:
        """Return the sum of b_i x(c_i), with the weights b_i and the nodes c_i."""
        total = x.integral()(1)
        for k, correction in self.moments:
            total = total + correction * x[k]
        return total

    def rational_maps(self) -> tuple[list[list[fmpq]], list[list[fmpq]]]:
        """Return the matrices of the linear maps A - e b^T and A in the basis c^0, ..., c^(s-1).

        The vector c^k has the entries c_1^k, ..., c_s^k, where c_1, ..., c_s are the nodes. Here A is the
        first matrix of the method, b is the vector of the weights, and e is the vector of ones.

        >>> from orderconds.tableau import Tableau, find
        >>> gauss2 = Tableau.load(find("gauss2"))
        >>> nodal_algebra(gauss2.ring, (gauss2.method.A,), gauss2.method.b).rational_maps()[1]
        [[0, -1/12], [1, 1/2]]
        """
        stages = range(int(self.modulus.degree()))
        basis = [fmpq_poly([0] * k + [1]) for k in stages]
        images, moments = [self.apply(0, p) for p in basis], [self.weigh(p) for p in basis]
        A = [[image[i] for image in images] for i in stages]
        return [[x - m for x, m in zip(A[0], moments, strict=True)], *A[1:]], A


def nodal_algebra(ring: Ring, matrices: Sequence[Matrix], b: Sequence[Element]) -> NodalAlgebra | None:
    """Return the :class:`NodalAlgebra` of a method. The nodes are c_i = sum_j a_ij, where the a_ij are the
    entries of the first matrix. The vector c^k has the entries c_i^k.

    The result is None in each of the following cases:

    - ``ring`` is not a :class:`NumberField`, or its degree is 1.
    - Two nodes are equal.
    - The polynomial M with the roots c_i has an irrational coefficient.
    - The polynomial that interpolates the points (c_i, v_i) has an irrational coefficient, where v = A c^k
      for some k and some matrix A in ``matrices``.
    - For some k, the number sum_i b_i c_i^k is irrational.

    >>> from orderconds.tableau import Tableau, find
    >>> crouzeix3 = Tableau.load(find("crouzeix3"))
    >>> nodal_algebra(crouzeix3.ring, (crouzeix3.method.A,), crouzeix3.method.b) is None
    True
    """
    if not isinstance(ring, NumberField) or ring.degree == 1:
        return None
    return _built(_Key(ring, tuple(matrices), b))


class _Key:
    """The key of a method in the cache of :func:`_built`. Two keys are equal if their matrices and weights
    consist of the same Python objects. Equal numbers in different objects give different keys."""

    def __init__(self, ring: NumberField, matrices: tuple[Matrix, ...], b: Sequence[Element]) -> None:
        self.ring, self.matrices, self.b = ring, matrices, b
        self.entries = tuple(id(x) for row in (*(row for A in matrices for row in A), b) for x in row)

    def __hash__(self) -> int:
        return hash(self.entries)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Key) and self.entries == other.entries


@lru_cache(maxsize=8)
def _built(key: _Key) -> NodalAlgebra | None:
    ring, b = key.ring, [key.ring.lift(x) for x in key.b]
    matrices = [[[ring.lift(x) for x in row] for row in A] for A in key.matrices]
    nodes = [sum(row, ring.zero) for row in matrices[0]]
    stages = range(len(nodes))
    if any(nodes[i] == nodes[j] for i in stages for j in range(i)):
        return None
    coefficients = [ring.one]
    for node in nodes:
        coefficients = [
            x - node * y for x, y in zip([ring.zero, *coefficients], [*coefficients, ring.zero], strict=True)
        ]
    if not all(x.is_rational for x in coefficients):
        return None
    powers = [[ring.one] * len(nodes)]
    for _ in stages[1:]:
        powers.append([x * node for x, node in zip(powers[-1], nodes, strict=True)])
    functional = [_dot(b, power, ring) for power in powers]
    if not all(x.is_rational for x in functional):
        return None
    guess = _Guess(ring, nodes)
    maps = []
    for A in matrices:
        images = [
            _rational_polynomial([_dot(row, p, ring) for row in A], powers, guess, ring) for p in powers
        ]
        if any(image is None for image in images):
            return None
        maps.append([image for image in images if image is not None])
    modulus = fmpq_poly([x.rational_value for x in coefficients])
    return NodalAlgebra(modulus, maps, [x.rational_value for x in functional])


class _Guess:
    """Guess the rational coefficients of a polynomial from its values at the nodes."""

    def __init__(self, ring: NumberField, nodes: Sequence[Algebraic]) -> None:
        self.ring, self.size = ring, len(nodes)
        with precision(BITS):
            at = [ring.ball(x, BITS) for x in nodes]
            self.inverse = arb_mat([[x**k for k in range(self.size)] for x in at]).inv()

    def __call__(self, values: Sequence[Algebraic]) -> list[fmpq]:
        with precision(BITS):
            coefficients = self.inverse * arb_mat(self.size, 1, [self.ring.ball(x, BITS) for x in values])
        return [simplest(coefficients[k, 0]) for k in range(self.size)]


def simplest(x: arb) -> fmpq:
    """Among the rational numbers in the ball x, return one with the smallest denominator.

    >>> with precision(64):
    ...     simplest(arb(22) / 7)
    22/7
    """
    low, high = endpoints(x)
    terms: list[fmpq] = []
    while True:
        whole = low.floor()
        if whole == low or whole + 1 <= high:
            terms.append(whole if whole == low else whole + 1)
            break
        terms.append(whole)
        low, high = 1 / (high - whole), 1 / (low - whole)
    value = fmpq(terms[-1])
    for term in reversed(terms[:-1]):
        value = term + 1 / value
    return value


def _rational_polynomial(
    values: Sequence[Algebraic], powers: Sequence[Sequence[Algebraic]], guess: _Guess, ring: NumberField
) -> fmpq_poly | None:
    """Let p be the polynomial with the coefficients ``guess(values)``. If p(c_i) = ``values[i]`` for all
    nodes c_i of the method, return p. Otherwise return None. ``powers[k]`` contains the powers c_i^k."""
    coefficients = guess(values)
    for i, value in enumerate(values):
        at_node = sum((power[i] * c for power, c in zip(powers, coefficients, strict=True)), ring.zero)
        if at_node != value:
            return None
    return fmpq_poly(coefficients)


def _dot(x: Sequence[Element], y: Sequence[Element], ring: Ring) -> Element:
    return sum((p * q for p, q in zip(x, y, strict=True)), ring.zero)
