"""Backward error analysis: modified vector fields and modified Hamiltonians of numerical methods.

One step of size h of a method equals the flow of a modified vector field f~ = f + h f_2 + ... over time h. A
tree t has the coefficient a(t) in the step and the coefficient b(t) in f~. The removal of an edge e divides t
into two trees: r_e contains the root of t, and u_e does not. An operator L maps a function c of trees to the
function (L c)(t) = sum_e c(r_e) b(u_e), where e runs through the edges of t. Then
a = sum_(j >= 1) (1/j!) L^(j-1) b (Hairer, Lubich and Wanner (HLW), *Geometric Numerical Integration*,
IX.9.1). For series over ordered forests, see Lundervold and Munthe-Kaas, Contemp. Math. 539 (2011) 295."""

from __future__ import annotations

from collections.abc import Callable
from math import factorial

from orderconds.errors import InputError
from orderconds.ring.protocol import Element, Ring
from orderconds.series.characters import ROOTED, Character, TreeAlgebra
from orderconds.trees.free import essential_free_trees, moves
from orderconds.trees.levels import Tree, symmetry, text
from orderconds.trees.rooted import rooted_trees


class VectorField:
    """A vector field f~, given by a B-series over trees or by a Lie-Butcher series over ordered forests.

    The field of a B-series is f~ = sum_t h^(|t|-1) b(t)/sigma(t) F(t). Here |t| is the number of vertices of
    the tree t, b(t) is the coefficient of t, sigma(t) is the order of the symmetry group of t, and F(t) is
    the elementary differential of t.

    The field of a Lie-Butcher series for matrices is f~ = sum_w h^(|w|-1) b(w) F(t_k) ... F(t_1), where w =
    t_1 ... t_k runs through all words of ordered trees.

    >>> from orderconds.ring import QQ
    >>> f = VectorField(QQ, ROOTED, lambda tree: QQ.rational(len(tree) == 1))
    >>> str(f.flow()(bytes((0, 1, 1, 1))))
    '1/4'
    """

    def __init__(self, ring: Ring, algebra: TreeAlgebra, value: Callable[[bytes], Element]) -> None:
        self.ring, self.algebra, self._value = ring, algebra, value
        self._known: dict[bytes, Element] = {b"": ring.zero}
        self._powers: dict[tuple[int, bytes], Element] = {}

    def define(self, value: Callable[[bytes], Element]) -> None:
        """Define this vector field by ``value``, a function from trees or forests to coefficients. To compute
        the coefficient of a tree, ``value`` may use the coefficients of smaller trees in this field."""
        self._value = value

    def __call__(self, forest: bytes) -> Element:
        """Return the coefficient of a tree or forest in the series of the vector field."""
        if forest not in self._known:
            self._known[forest] = self._value(forest)
        return self._known[forest]

    def flow(self) -> Character:
        """Return the coefficients of the exact flow of the field over time h.

        >>> from orderconds.ring import QQ
        >>> f = VectorField(QQ, ROOTED, lambda tree: QQ.rational(len(tree) == 1))
        >>> [str(f.flow()(tree)) for tree in (b"\\0\\1", b"\\0\\1\\1", b"\\0\\1\\2")]
        ['1/2', '1/3', '1/6']
        """
        return Character(self.ring, self.algebra, lambda forest: self(forest) + self.beyond_first(forest))

    def beyond_first(self, forest: bytes) -> Element:
        """Let t be the tree or forest ``forest``, and let b(t) be its coefficient in the vector field. The
        coefficient of t in the flow is b(t) + d(t), where d(t) is a polynomial in the coefficients b(u) of
        smaller trees or forests u. Return d(t)."""
        result = self.ring.zero
        for n in range(2, len(forest) + 1):
            result = result + self._power(n, forest) * self.ring.rational(1, factorial(n))
        return result

    def _power(self, n: int, forest: bytes) -> Element:
        if n == 1:
            return self(forest)
        if n > len(forest):
            return self.ring.zero
        if (n, forest) not in self._powers:
            result = self.ring.zero
            for components, rest in self.algebra.cuts(forest):
                if len(components) == 1 and rest:
                    result = result + self(components[0]) * self._power(n - 1, rest)
            self._powers[n, forest] = result
        return self._powers[n, forest]


def modified_field(step: Character) -> VectorField:
    """Return the field whose flow over time h equals the step (HLW IX.9.1).

    >>> from orderconds.ring import QQ
    >>> euler = Character(QQ, ROOTED, lambda tree: QQ.rational(len(tree) == 1))
    >>> b = modified_field(euler)
    >>> [str(b(tree)) for tree in (b"\\0", b"\\0\\1", b"\\0\\1\\1", b"\\0\\1\\2")]
    ['1', '-1/2', '1/6', '1/3']
    """
    field = VectorField(step.ring, step.algebra, lambda forest: step.ring.zero)
    field.define(lambda forest: step(forest) - field.beyond_first(forest))
    return field


def modified_hamiltonian(field: VectorField, order: int) -> tuple[tuple[Tree, Element], ...]:
    """Return the trees t and coefficients b(t)/sigma(t) of the modified Hamiltonian.

    The modified Hamiltonian is the sum of h^(|t|-1) b(t)/sigma(t) H(t) over free trees with at most ``order``
    vertices. Each free tree is represented by a rooted tree t. Here |t| is the number of vertices of t, b(t)
    is the coefficient of t in the field, and sigma(t) is the order of the symmetry group of t.

    For a tree t with the branches t_1, ..., t_m, the elementary Hamiltonian is H(t) = H^(m)(F(t_1), ...,
    F(t_m)). Here H^(m) is the m-th derivative of the Hamiltonian, and F denotes elementary differentials.

    Let u o v be the tree u with the additional branch v at its root. The trees u o u are omitted, because
    H(u o u) is zero (HLW IX.9.2).

    Raises :class:`~orderconds.errors.InputError` if the field is a Lie-Butcher series, or if one of the
    equations b(u o v) + b(v o u) = 0 cannot be proved.

    >>> from orderconds.ring import QQ
    >>> from orderconds.trees.levels import text
    >>> midpoint = Character(QQ, ROOTED, lambda tree: QQ.rational(1, 2 ** (len(tree) - 1)))
    >>> [(text(tree), str(x)) for tree, x in modified_hamiltonian(modified_field(midpoint), 4)]
    [('.', '1'), ('[..]', '-1/24')]
    """
    if field.algebra is not ROOTED:
        raise InputError("a Lie-Butcher series", where="modified Hamiltonian", expected="a B-series")
    terms = []
    for vertices in range(1, order + 1):
        _require_hamiltonian(field, vertices)
        for tree in essential_free_trees(vertices):
            if field.ring.is_zero(field(tree)) is not True:
                terms.append((tree, field(tree) * field.ring.rational(1, symmetry(tree))))
    return tuple(terms)


def _require_hamiltonian(field: VectorField, vertices: int) -> None:
    for tree in rooted_trees(vertices):
        for _, _, moved in moves(tree):
            vanishes = field.ring.is_zero(field(tree) + field(moved))
            if vanishes is not True:
                verb = "may not be" if vanishes is None else "is not"
                raise InputError(
                    f"b({text(tree)}) + b({text(moved)}) {verb} 0",
                    where="modified Hamiltonian",
                    expected="the modified field of a symplectic method",
                )
