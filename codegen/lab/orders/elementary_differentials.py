"""Exact elementary differentials of a scene over any ring, computed with nilpotent numbers.

For x in the Lie algebra, a group action defines the frozen field y -> x.y. The derivative along a frozen
field is computed by substituting y + eps x.y for y, with eps^2 = 0. After k substitutions, the coefficient
of eps_1 ... eps_k is the k-th derivative. This works for every scene that is polynomial in its coordinates.
"""

from __future__ import annotations

from collections.abc import Sequence

from codegen.groups import SO3, MatrixGroup, Rn
from codegen.ir.domain import Domain
from codegen.ir.expr import evaluate
from codegen.ir.number import Number
from codegen.lab.scalars import Scalar, Vector
from codegen.scene.problem import Problem
from orderconds.ring.protocol import Element, Ring
from orderconds.series.action_fields import ActionFields, Nilpotent
from orderconds.trees.directed import DirectedTree
from orderconds.trees.directed import branches as directed_branches
from orderconds.trees.levels import Forest, Tree, branches, trees_of


class RingDomain(Domain):
    """An exact ring as a domain, for polynomial scenes. There is no step size: ``h`` is one."""

    def __init__(self, ring: Ring) -> None:
        self.ring = ring
        self.h = ring.one

    def number(self, value: Number) -> Element:
        """Return an exact number of the ring, or a rational one."""
        if value.ring is self.ring:
            return value.element
        fraction = value.fraction()
        return self.ring.rational(fraction.numerator, fraction.denominator)

    def rational(self, p: int, q: int = 1) -> Element:
        """Return p/q."""
        return self.ring.rational(p, q)

    def call(self, function: str, *args: Scalar) -> Scalar:
        """Raise ArithmeticError: the scene is not polynomial."""
        raise ArithmeticError(f"{function} is not polynomial")

    def settled(self, old: Sequence[Scalar], new: Sequence[Scalar], previous: Scalar) -> tuple[bool, Scalar]:
        """Raise ArithmeticError: there is nothing to iterate."""
        raise ArithmeticError("elementary differentials are not iterated")


def _coefficient(x: Scalar, mask: int, zero: Element) -> Element:
    if isinstance(x, Nilpotent):
        return x.parts.get(mask, zero)
    return x if mask == 0 else zero


class FrozenFields:
    """The elementary differentials of the field of an autonomous scene at its initial point.

    Trees and forests are ordered (:mod:`orderconds.trees.levels`), the first tree of a forest acts first.
    """

    def __init__(self, scene: Problem, ring: Ring) -> None:
        self.scene, self.ring = scene, ring
        self.domain = RingDomain(ring)
        self.point: Vector = scene.initial(self.domain)
        self._known: dict[Tree, Vector] = {}

    def tree(self, tree: Tree) -> Vector:
        """Return F(t) in the algebra: f differentiated along the frozen fields of the branches."""
        if tree not in self._known:
            point, mask = self._displaced(branches(tree))
            values = evaluate(self.scene.roots, self.domain, self.scene.values(self.domain, point))
            self._known[tree] = tuple(_coefficient(v, mask, self.ring.zero) for v in values)
        return self._known[tree]

    def forest(self, forest: Forest) -> Vector:
        """Return the coordinates of the point differentiated along the frozen fields of a forest."""
        point, mask = self._displaced(forest)
        return tuple(_coefficient(v, mask, self.ring.zero) for v in point)

    def _displaced(self, forest: Forest) -> tuple[Vector, int]:
        point, bit = self.point, 1
        for tree in trees_of(forest):
            x = tuple(Nilpotent({bit: a}) for a in self.tree(tree))
            velocity = self.scene.action.velocity(self.domain, self.scene.group, x, point)
            point = tuple(a + b for a, b in zip(point, velocity, strict=True))
            bit <<= 1
        return point, bit - 1


class CanonicalFields:
    """The elementary differentials of Hamilton's equations on T*R^n, over trees with directed edges.

    A vertex is H, differentiated by q along xi for each branch of kind 0 and by mu along n for each
    branch of kind 1 (:mod:`orderconds.trees.directed`).
    """

    def __init__(self, scene: Problem, ring: Ring) -> None:
        self.scene, self.ring = scene, ring
        self.domain = RingDomain(ring)
        self.point: Vector = scene.initial(self.domain)
        self._known: dict[DirectedTree, Vector] = {}

    def tree(self, tree: DirectedTree) -> Vector:
        """Return (xi, n) = (D_mu, -D_q) of the derivative of H at the root."""
        if tree not in self._known:
            n, point, bit = self.scene.dimension(), list(self.point), 1
            for kind, child in directed_branches(tree):
                below = self.tree(child)
                for k in range(n):
                    at = n * kind + k
                    point[at] = point[at] + Nilpotent({bit: below[at]})
                bit <<= 1
            values = evaluate(self.scene.roots, self.domain, self.scene.values(self.domain, point))
            self._known[tree] = tuple(_coefficient(v, bit - 1, self.ring.zero) for v in values)
        return self._known[tree]


def action_fields(scene: Problem, ring: Ring) -> ActionFields:
    """Return the elementary velocities and covectors of an autonomous polynomial Hamiltonian scene.

    The group is represented by its own matrices, or for R^n by translations of affine space.
    """
    domain, q_size = RingDomain(ring), len(scene.state[0].symbols)
    group = scene.group
    basis = tuple(_matrix(domain, group, unit, True) for unit in _units(domain, group.dim))
    start = scene.initial(domain)
    hamiltonian = scene.hamiltonian
    assert hamiltonian is not None

    def energy(q: Scalar, mu: Scalar) -> Scalar:
        values = scene.values(domain, (*element_coordinates(group, q), *mu))
        return evaluate([hamiltonian], domain, values)[0]

    def coordinates(x: Scalar) -> Vector:
        return _algebra_coordinates(domain, group, x)

    point = _matrix(domain, group, start[:q_size], False)
    return ActionFields(ring, energy, point, start[q_size:], basis, coordinates)


def _units(domain: Domain, n: int) -> list[Vector]:
    return [tuple(domain.rational(int(i == j)) for j in range(n)) for i in range(n)]


def _matrix(domain: Domain, group: object, x: Vector, algebra: bool) -> tuple[Vector, ...]:
    """Return the matrix of an element of the group or its algebra; the affine one for R^n."""
    if isinstance(group, Rn):
        zero, n = domain.rational(0), group.dim
        one = domain.rational(int(not algebra))
        rows = [(*(one if i == j else zero for j in range(n)), x[i]) for i in range(n)]
        return (*rows, (*((zero,) * n), one))
    flat = _hat(domain, group, x) if algebra else x
    n = round(len(flat) ** 0.5)
    return tuple(flat[n * i : n * i + n] for i in range(n))


def _hat(domain: Domain, group: object, x: Vector) -> Vector:
    assert isinstance(group, SO3 | MatrixGroup)
    return tuple(group.hat(domain, x))


def element_coordinates(group: object, matrix: Scalar) -> Vector:
    """Return the coordinates of a group element, or of a difference of two, from its matrix."""
    if isinstance(group, Rn):
        return tuple(row[-1] for row in matrix[:-1])
    return tuple(x for row in matrix for x in row)


def _algebra_coordinates(domain: Domain, group: object, matrix: Scalar) -> Vector:
    if isinstance(group, Rn):
        return tuple(row[-1] for row in matrix[:-1])
    if isinstance(group, SO3):
        return (matrix[2][1], matrix[0][2], matrix[1][0])
    assert isinstance(group, MatrixGroup)
    return group.vee(domain, element_coordinates(group, matrix))
