"""Exact elementary differentials of the field of a scene, computed with nilpotent numbers.

An element x of the Lie algebra acts on a point y, and x.y is the resulting tangent vector. The vector field
that maps y to x.y is called a frozen field. To compute the derivative of a function along a frozen field, y
is replaced by y + eps x.y, where eps^2 = 0. After k replacements with different numbers eps_1, ..., eps_k,
the coefficient of the product eps_1 ... eps_k is the k-th derivative. The scene must be polynomial in its
coordinates.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import isqrt

from codegen.groups import LieGroup
from codegen.groups.capabilities import MatrixRepresentation
from codegen.groups.linear_algebra import units
from codegen.ir.domain import Domain
from codegen.ir.expr import evaluate
from codegen.ir.number import Number
from codegen.lab.number_types import Scalar, Vector
from codegen.scene.problem import Problem
from orderconds.ring.protocol import Element, Ring
from orderconds.series.action_fields import ActionFields, Nilpotent
from orderconds.trees.directed import DirectedTree
from orderconds.trees.directed import branches as directed_branches
from orderconds.trees.levels import Forest, Tree, branches, trees_of


class RingDomain(Domain):
    """Arithmetic in an exact ring, for scenes that are polynomial in their coordinates.

    Every domain needs a step size ``h``. Here it is 1. This value has no effect, because elementary
    differentials do not depend on the step size.
    """

    def __init__(self, ring: Ring) -> None:
        self.ring = ring
        self.h = ring.one

    def number(self, value: Number) -> Element:
        """Return a number as an element of the ring.

        Raises TypeError if the number does not belong to the ring and is not rational.
        """
        if value.ring is self.ring:
            return value.element
        fraction = value.fraction()
        return self.ring.rational(fraction.numerator, fraction.denominator)

    def rational(self, p: int, q: int = 1) -> Element:
        """Return the fraction p/q as an element of the ring."""
        return self.ring.rational(p, q)

    def call(self, function: str, *args: Scalar) -> Scalar:
        """Raise ArithmeticError, because a scene with function calls is not polynomial."""
        raise ArithmeticError(f"{function} is not polynomial")

    def vector(self, function: str, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Raise ArithmeticError, because a scene with function calls is not polynomial."""
        raise ArithmeticError(f"{function} is not polynomial")

    def settled(self, old: Sequence[Scalar], new: Sequence[Scalar], previous: Scalar) -> tuple[bool, Scalar]:
        """Raise ArithmeticError, because this arithmetic cannot solve implicit equations by iteration."""
        raise ArithmeticError("elementary differentials cannot be computed with implicit equations")


def _coefficient(x: Scalar, mask: int, zero: Element) -> Element:
    if isinstance(x, Nilpotent):
        return x.parts.get(mask, zero)
    return x if mask == 0 else zero


class FrozenFields:
    """The elementary differentials of the field f of an autonomous scene at its initial point.

    The function f maps a point to an element of the Lie algebra. Trees and forests are ordered
    (:mod:`orderconds.trees.levels`). :meth:`tree` assigns an element F(t) of the Lie algebra to each tree t.
    Let F(t).y be the tangent vector that F(t) generates at a point y. The vector field that maps y to F(t).y
    is called the frozen field of t.
    """

    def __init__(self, scene: Problem, ring: Ring) -> None:
        self.scene, self.ring = scene, ring
        self.domain = RingDomain(ring)
        self.point: Vector = scene.initial(self.domain)
        self._known: dict[Tree, Vector] = {}

    def tree(self, tree: Tree) -> Vector:
        """Return the elementary differential F(t) of a tree t, an element of the Lie algebra.

        F(t) is a derivative of f at the initial point. Each branch b of t adds one differentiation along the
        vector field that maps y to F(b).y.
        """
        if tree not in self._known:
            point, mask = self._displaced(branches(tree))
            values = evaluate(self.scene.roots, self.domain, self.scene.values(self.domain, point))
            self._known[tree] = tuple(_coefficient(v, mask, self.ring.zero) for v in values)
        return self._known[tree]

    def forest(self, forest: Forest) -> Vector:
        """Return a derivative of the coordinates at the initial point.

        Each tree t of the forest adds one differentiation along the vector field that maps y to F(t).y.
        """
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

    A vertex denotes a derivative of the Hamiltonian H(q, mu). Each branch at the vertex adds one
    differentiation. Its direction comes from the pair (xi, nu) that :meth:`tree` returns for the branch. A
    branch of kind 0 differentiates H with respect to q in the direction xi. A branch of kind 1 differentiates
    H with respect to mu in the direction nu (:mod:`orderconds.trees.directed`).
    """

    def __init__(self, scene: Problem, ring: Ring) -> None:
        self.scene, self.ring = scene, ring
        self.domain = RingDomain(ring)
        self.point: Vector = scene.initial(self.domain)
        self._known: dict[DirectedTree, Vector] = {}

    def tree(self, tree: DirectedTree) -> Vector:
        """Return the elementary differential of a tree: the pair (xi, nu) = (D_mu K, -D_q K).

        Here K is the derivative of the Hamiltonian H in the directions of all branches at the root. D_mu and
        D_q are the derivatives with respect to mu and q. The pair is returned as one list of numbers.
        """
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
    """Return the elementary differentials of an autonomous polynomial Hamiltonian scene at its initial point.

    There are two kinds of differentials: velocities in the Lie algebra, and covectors in its dual. Group
    elements are represented by matrices. The group R^n is represented by the matrices of translations.
    """
    domain, q_size = RingDomain(ring), len(scene.state[0].symbols)
    group = scene.group.require(MatrixRepresentation, where=scene.name)
    algebra: tuple[Vector, ...] = units(domain, group.dim)
    basis = tuple(_rows(group.hat(domain, unit)) for unit in algebra)
    start = scene.initial(domain)
    hamiltonian = scene.hamiltonian
    assert hamiltonian is not None

    def energy(q: Scalar, mu: Scalar) -> Scalar:
        values = scene.values(domain, (*element_coordinates(group, q), *mu))
        return evaluate([hamiltonian], domain, values)[0]

    def coordinates(x: Scalar) -> Vector:
        return group.vee(domain, tuple(entry for row in x for entry in row))

    point = _rows(group.matrix(domain, start[:q_size]))
    return ActionFields(ring, energy, point, start[q_size:], basis, coordinates)


def _rows(flat: Vector) -> tuple[Vector, ...]:
    n = isqrt(len(flat))
    return tuple(flat[n * i : n * i + n] for i in range(n))


def element_coordinates(group: LieGroup, matrix: Sequence[Vector]) -> Vector:
    """Return the coordinates of a matrix that is a group element or a difference of two group elements."""
    return group.require(MatrixRepresentation).element(tuple(x for row in matrix for x in row))
