"""Gauss, Radau and Lobatto methods with any number of stages, computed exactly from their definitions.

Let s be the number of stages. The nodes c_1, ..., c_s are the roots of the s-th Legendre polynomial or of a
related polynomial. The weights b_1, ..., b_s integrate polynomials of degree below s exactly. Let l_j be the
Lagrange polynomial of the node c_j. One of five rules defines the matrix A (left: the name of the rule):

============  ============================================================================================
rows          a_ij is the integral of l_j from 0 to c_i (Gauss, Radau IIA, Lobatto IIIA)
columns       a_ij is b_j / b_i times the integral of l_i from c_j to 1 (Radau IA, Lobatto IIIB)
first column  A satisfies the assumption C(s - 1), and a_i1 = b_1 for all i (Lobatto IIIC)
last column   A satisfies the assumption C(s - 1), and a_is = 0 for all i (Lobatto IIIC*)
mean          A is the mean of two matrices (Lobatto IIID: of IIIC and IIIC*; Lobatto IIIE: of IIIA and IIIB)
============  ============================================================================================

Here C(s - 1) is Butcher's simplifying assumption: row i of A integrates polynomials of degree below s - 1
from 0 to c_i exactly.

With at least three stages, both the Radau IIA method and the Lobatto IIIA method have an embedded method for
step-size control. For Radau IIA, the embedded method omits the last node. For Lobatto IIIA, it omits the
middle node, or the first of the two middle nodes.

Sources: Hairer and Wanner, *Solving Ordinary Differential Equations II*, Section IV.5; Jay, *Lobatto
methods*, Encyclopedia of Applied and Computational Mathematics, 2015.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from flint import fmpq, fmpq_poly

from orderconds.argument import CONSTRUCTED_STAGES, integer, text
from orderconds.errors import InputError, UnknownName
from orderconds.ring.decimals import endpoints
from orderconds.ring.field import Algebraic
from orderconds.ring.roots import real_roots
from orderconds.ring.tower import DegreeError, Tower
from orderconds.tableau.methods import Embedded, RungeKutta
from orderconds.tableau.record import Tableau

Matrix = list[list[Algebraic]]


class Nodes:
    """The nodes, weights and Lagrange polynomials of a quadrature. The nodes are in ascending order.

    ``s`` is the number of nodes. ``left`` is true if 0 is a node, and ``right`` is true if 1 is a node.
    """

    def __init__(self, s: int, left: bool, right: bool) -> None:
        tower = Tower()
        nodes = roots(nodal_polynomial(s, left, right), tower)
        field = tower.field
        self.c = sorted((field.lift(x) for x in nodes), key=float)
        self.tower, self.s = tower, s
        self.lagrange = [self._lagrange(j) for j in range(s)]
        self.b = [self.integral(j, self.one) for j in range(s)]

    @property
    def one(self) -> Algebraic:
        """The number 1 as an element of the field."""
        return self.tower.field.one

    def _lagrange(self, j: int) -> list[Algebraic]:
        """Return the coefficients of the Lagrange polynomial l_j, lowest power first."""
        result = [self.one]
        for k, node in enumerate(self.c):
            if k != j:
                scale = 1 / (self.c[j] - node)
                shifted = [self.tower.field.zero, *result]
                result = [
                    (x - node * y) * scale
                    for x, y in zip(shifted, [*result, self.tower.field.zero], strict=True)
                ]
        return result

    def integral(self, j: int, x: Algebraic) -> Algebraic:
        """Return the integral of the Lagrange polynomial l_j from 0 to x, by Horner's rule."""
        result = self.tower.field.zero
        for k in reversed(range(self.s)):
            result = (result + self.lagrange[j][k] * self.tower.rational(1, k + 1)) * x
        return result

    def without(self, left_out: int) -> list[Algebraic]:
        """Return the weights of the quadrature that omits one node. The omitted node has the index k =
        ``left_out``, counted from 0.

        Let s be the number of nodes, and let e_j be the leading coefficient of the Lagrange polynomial of
        node j. If a polynomial p has a degree below s - 1, the sum of all e_j p(c_j) is zero. Let b_j be the
        weights of the quadrature with all nodes. The new weights are b_j - (b_k/e_k) e_j, so the new weight
        of node k is zero. The new weights integrate polynomials of degree below s - 1 exactly.

        >>> Nodes(3, True, True).without(1)
        [Algebraic(1/2), Algebraic(0), Algebraic(1/2)]
        """
        leading = [polynomial[-1] for polynomial in self.lagrange]
        share = self.b[left_out] / leading[left_out]
        return [x - share * y for x, y in zip(self.b, leading, strict=True)]

    def rows(self) -> Matrix:
        """Return the matrix A of the Gauss, Radau IIA or Lobatto IIIA method with these nodes. The module
        docstring defines A."""
        return [[self.integral(j, x) for j in range(self.s)] for x in self.c]

    def columns(self) -> Matrix:
        """Return the matrix A of the Radau IA or Lobatto IIIB method with these nodes. The module docstring
        defines A."""
        b, stages = self.b, range(self.s)
        return [[b[j] / b[i] * (b[i] - self.integral(i, self.c[j])) for j in stages] for i in stages]

    def column(self, k: int, value: Algebraic) -> Matrix:
        """Return a matrix A that satisfies the assumption C(s - 1). All entries of column k are ``value``.

        Let e_j be the leading coefficient of the Lagrange polynomial of node j. Row i of A is row i of the
        matrix :meth:`rows` plus a multiple of (e_1, ..., e_s).
        """
        leading = [polynomial[-1] for polynomial in self.lagrange]
        return [
            [x + (value - row[k]) / leading[k] * y for x, y in zip(row, leading, strict=True)]
            for row in self.rows()
        ]

    def first_column(self) -> Matrix:
        """Return the matrix A of Lobatto IIIC. All entries of the first column are b_1."""
        return self.column(0, self.b[0])

    def last_column(self) -> Matrix:
        """Return the matrix A of Lobatto IIIC*. All entries of the last column are zero."""
        return self.column(self.s - 1, self.tower.field.zero)


def last(s: int) -> int:
    """Return the index of the last of s nodes.

    >>> last(3)
    2
    """
    return s - 1


def middle(s: int) -> int:
    """Return the index of the middle node of s nodes. For even s, return the first of the two middle nodes.

    >>> middle(3), middle(4)
    (1, 1)
    """
    return (s - 1) // 2


def mean(one: Callable[[Nodes], Matrix], other: Callable[[Nodes], Matrix]) -> Callable[[Nodes], Matrix]:
    """Return a function that computes a matrix A from the nodes. The matrix is the mean of the matrices that
    the functions ``one`` and ``other`` compute.

    >>> rule = mean(Nodes.first_column, Nodes.last_column)
    >>> rule(Nodes(2, True, True))[0]
    [Algebraic(1/4), Algebraic(-1/4)]
    """

    def rule(nodes: Nodes) -> Matrix:
        half = nodes.tower.rational(1, 2)
        pairs = zip(one(nodes), other(nodes), strict=True)
        return [[(x + y) * half for x, y in zip(p, q, strict=True)] for p, q in pairs]

    return rule


@dataclass(frozen=True)
class Kind:
    """A kind of method, such as Radau IIA. ``left`` is true if 0 is a node, and ``right`` is true if 1 is a
    node. ``matrix`` computes A from the nodes, and ``called`` is the name of the kind.

    For s stages, the embedded method omits the node with the index ``left_out(s)``. Without an embedded
    method, ``left_out`` is None.
    """

    left: bool
    right: bool
    matrix: Callable[[Nodes], Matrix]
    called: str
    left_out: Callable[[int], int] | None = None

    @property
    def least(self) -> int:
        """The least number of stages of a method of this kind."""
        return 2 if self.left and self.right else 1

    def order(self, s: int) -> int:
        """Return the order of the method with s stages. The result is also the order of the quadrature on the
        s nodes."""
        return 2 * s - self.left - self.right


KINDS = {
    "gauss": Kind(False, False, Nodes.rows, "Gauss"),
    "radau1a": Kind(True, False, Nodes.columns, "Radau IA"),
    "radau2a": Kind(False, True, Nodes.rows, "Radau IIA", last),
    "lobatto3a": Kind(True, True, Nodes.rows, "Lobatto IIIA", middle),
    "lobatto3b": Kind(True, True, Nodes.columns, "Lobatto IIIB"),
    "lobatto3c": Kind(True, True, Nodes.first_column, "Lobatto IIIC"),
    "lobatto3c_star": Kind(True, True, Nodes.last_column, "Lobatto IIIC*"),
    "lobatto3d": Kind(True, True, mean(Nodes.first_column, Nodes.last_column), "Lobatto IIID"),
    "lobatto3e": Kind(True, True, mean(Nodes.rows, Nodes.columns), "Lobatto IIIE"),
}
"""The kinds of methods that can be constructed."""

LEAST_WITH_ROW = 3
"""The least number of stages for which Radau IIA and Lobatto IIIA methods have an embedded method."""


def construct(kind: str, stages: int) -> Tableau:
    """Return the method of the given kind with the given number of stages.

    Raises :class:`UnknownName` for an unknown kind. Raises :class:`InputError` if ``stages`` is too small, or
    if the degree of the number field exceeds :data:`orderconds.ring.tower.MAX_DEGREE`.

    >>> construct("radau2a", 2).method
    RungeKutta(A=((5/12, -1/12), (3/4, 1/4)), b=(3/4, 1/4))
    """
    if text(kind, "kind", f"one of {', '.join(KINDS)}") not in KINDS:
        raise UnknownName(f"unknown kind {kind!r}", expected=f"one of {', '.join(KINDS)}")
    rule, stages = KINDS[kind], integer(stages, "stages", CONSTRUCTED_STAGES)
    if stages < rule.least:
        given = f"{kind} with {stages} stage{'' if stages == 1 else 's'}"
        raise InputError(given, expected=f"at least {rule.least} stages")
    try:
        nodes = Nodes(stages, rule.left, rule.right)
    except DegreeError as problem:
        raise InputError(
            f"{kind} with {stages} stages: {problem}", expected="nodes in a number field of degree at most 24"
        ) from None
    ring, lift = nodes.tower.ring()
    A = tuple(tuple(lift(x) for x in row) for row in rule.matrix(nodes))
    method = RungeKutta(A, tuple(lift(x) for x in nodes.b))
    if rule.left_out is None or stages < LEAST_WITH_ROW:
        return Tableau(f"{kind}{stages}", "rk", ring, method)
    row = tuple(lift(x) for x in nodes.without(rule.left_out(stages)))
    return Tableau(f"{kind}{stages}", "rk", ring, method, embedded=Embedded(row, stages - 1))


def nodal_polynomial(s: int, left: bool, right: bool) -> fmpq_poly:
    """Return a polynomial of degree s with the nodes as roots, by Rodrigues' formula. ``left`` is true if 0
    is a node, and ``right`` is true if 1 is a node.

    The result is the derivative of order ``s - left - right`` of ``x^(s - right) (x - 1)^(s - left)``.

    >>> nodal_polynomial(2, False, False)
    12*x^2 + (-12)*x + 2
    """
    x = fmpq_poly([0, 1])
    result = x ** (s - right) * (x - 1) ** (s - left)
    for _ in range(s - left - right):
        result = result.derivative()
    return result


def roots(polynomial: fmpq_poly, tower: Tower) -> list[Algebraic]:
    """Return the roots of a polynomial that has only real roots. For each irreducible factor, there are three
    cases:

    - The degree of the factor is one or two. The roots are expressed by square roots.
    - The roots are symmetric about their mean m. Each pair of roots is m + sqrt(x) and m - sqrt(x), where x
      is a root of a polynomial g of half the degree. The numbers x are computed by ``roots(g, tower)``.
    - In all other cases, all roots except the largest get the names c1, c2, ... in ascending order. The
      largest root is computed from these roots and the sum of all roots, which is known.

    >>> roots(fmpq_poly([0, -2, 0, 1]), Tower())
    [Algebraic(0), Algebraic(-sqrt(2)), Algebraic(sqrt(2))]
    """
    result: list[Algebraic] = []
    for factor, _ in polynomial.factor()[1]:
        result += _roots_of_irreducible(factor, tower)
    return result


def _roots_of_irreducible(factor: fmpq_poly, tower: Tower) -> list[Algebraic]:
    degree = int(factor.degree())
    if degree <= 2:
        return _quadratic(factor, tower)
    middle = -factor[degree - 1] / (degree * factor[degree])
    centred = factor(fmpq_poly([middle, 1]))
    if all(centred[k] == 0 for k in range(1, degree + 1, 2)):
        squares = roots(fmpq_poly([centred[k] for k in range(0, degree + 1, 2)]), tower)
        sides = [tower.root(x, 2) for x in squares]
        return [tower.constant(_fraction(middle), Fraction(0)) + sign * x for x in sides for sign in (-1, 1)]
    monic = factor / factor.leading_coefficient()
    coefficients = [_fraction(x) for x in monic.coeffs()]
    named = []
    for k, enclosed in enumerate(real_roots(monic, 256)[:-1]):
        near = endpoints(enclosed)[0]
        places = Fraction(1, 10**40)
        named.append(tower.named_root(coefficients, _fraction(near), places, f"c{k + 1}"))
    last = tower.constant(-coefficients[-2], Fraction(0))
    return [*named, last - sum(named[1:], named[0])]


def _quadratic(factor: fmpq_poly, tower: Tower) -> list[Algebraic]:
    c, b, a = (_fraction(factor[k]) for k in range(3))
    if a == 0:
        return [tower.constant(-c / b, Fraction(0))]
    root = tower.root(tower.constant(b * b - 4 * a * c, Fraction(0)), 2)
    return [
        (root * sign - tower.constant(b, Fraction(0))) / tower.constant(2 * a, Fraction(0))
        for sign in (-1, 1)
    ]


def _fraction(x: fmpq) -> Fraction:
    return Fraction(int(x.p), int(x.q))
