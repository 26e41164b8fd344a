"""Exact elementary differentials of the field of a scene, computed with nilpotent numbers.

An element x of the Lie algebra acts on a point y, and x.y is the resulting tangent vector. The vector field
that maps y to x.y is called a frozen field. The derivative of a function g along a frozen field is the
coefficient of eps in g(y + eps x.y), where eps^2 = 0.

The elements x_1, ..., x_k define k frozen fields. Let y_0 = y and y_j = y_{j-1} + eps_j x_j.y_{j-1}, where
eps_j^2 = 0. The derivative of g along the k frozen fields is the coefficient of the product eps_1 ... eps_k
in g(y_k). The scene must be polynomial in its coordinates.
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

    The step size ``h`` is 1, because elementary differentials do not depend on the step size.
    """

    def __init__(self, ring: Ring) -> None:
        self.ring = ring
        self.h = ring.one

    def number(self, value: Number) -> Element:
        """Return a number as an element of the ring.

        A number from another ring must be rational. Otherwise TypeError is raised.
        """
        if value.ring is self.ring:
            return value.element
        fraction = value.fraction()
        return self.ring.rational(fraction.numerator, fraction.denominator)

    def rational(self, p: int, q: int = 1) -> Element:
        """Return the fraction p/q as an element of the ring."""
        return self.ring.rational(p, q)

    def call(self, function: str, *args: Scalar) -> Scalar:
        """Raise ArithmeticError, because the scene must be polynomial in its coordinates.

        ``call`` is executed for each function in the formulas of the scene, for example ``sin``.
        """
        raise ArithmeticError(f"{function} is not polynomial")

    def vector(self, function: str, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Raise ArithmeticError, because the scene must be polynomial in its coordinates.

        ``vector`` is executed if a formula of the scene contains a function that returns several numbers, for
        example the entries of a matrix exponential.
        """
        raise ArithmeticError(f"{function} is not polynomial")

    def settled(self, old: Sequence[Scalar], new: Sequence[Scalar], previous: Scalar) -> tuple[bool, Scalar]:
        """Raise ArithmeticError, because the iteration for implicit equations is not exact.

        Other domains use this method to decide whether an iteration for implicit equations has converged.
        """
        raise ArithmeticError("elementary differentials cannot be computed for implicit equations")


def _coefficient(x: Scalar, mask: int, zero: Element) -> Element:
    if isinstance(x, Nilpotent):
        return x.parts.get(mask, zero)
    return x if mask == 0 else zero


class FrozenFields:
    """The elementary differentials of the field f of an autonomous scene at its initial point.

    The function f maps a point to an element of the Lie algebra. The elementary differential F(t) of an
    ordered tree t (:mod:`orderconds.trees.levels`) is also an element of the Lie algebra.
    """

    def __init__(self, scene: Problem, ring: Ring) -> None:
        self.scene, self.ring = scene, ring
        self.domain = RingDomain(ring)
        self.point: Vector = scene.initial(self.domain)
        self._known: dict[Tree, Vector] = {}

    def tree(self, tree: Tree) -> Vector:
        """Return the elementary differential F(t) of a tree t.

        Let b_1, ..., b_m be the branches of t, and let x_j = F(b_j). The action of x_j defines a vector field
        y -> x_j.y. Let D_j be the derivative along this vector field. Then F(t) is the value of
        D_1(D_2(...(D_m f)...)) at the initial point, where f is the field of the scene.
        """
        if tree not in self._known:
            point, mask = self._displaced(branches(tree))
            values = evaluate(self.scene.roots, self.domain, self.scene.values(self.domain, point))
            self._known[tree] = tuple(_coefficient(v, mask, self.ring.zero) for v in values)
        return self._known[tree]

    def forest(self, forest: Forest) -> Vector:
        """Return the elementary differential of an ordered forest.

        Each tree t of the forest defines a vector field y -> x.y. Here x is the elementary differential of t
        at the initial point (see :meth:`tree`), and x.y is the action of x on the point y. Let D_j be the
        derivative along the vector field of the j-th tree, and let m be the number of trees. The result
        contains D_1(D_2(...(D_m y_k)...)) at the initial point, for each coordinate y_k of the point y.
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
    """The elementary differentials of Hamilton's equations on T*R^n, for trees with directed edges.

    The elementary differential of a tree is a pair (xi, nu). Let (xi_b, nu_b) be the pair of a branch
    b at the root. Each branch has the kind 0 or 1 (:mod:`orderconds.trees.directed`). The Hamiltonian
    H(q, mu) is differentiated once for each branch:

    - A branch b of kind 0 gives the derivative with respect to q in the direction xi_b.
    - A branch b of kind 1 gives the derivative with respect to mu in the direction nu_b.

    Let K be the result. Then xi is the derivative of K with respect to mu, and -nu is the derivative of K
    with respect to q.
    """

    def __init__(self, scene: Problem, ring: Ring) -> None:
        self.scene, self.ring = scene, ring
        self.domain = RingDomain(ring)
        self.point: Vector = scene.initial(self.domain)
        self._known: dict[DirectedTree, Vector] = {}

    def tree(self, tree: DirectedTree) -> Vector:
        """Return the elementary differential of a tree: the velocity xi and the force nu, joined to one
        vector."""
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

    The elementary differential of a tree (:mod:`orderconds.series.action_trees`) is an element of the Lie
    algebra or of its dual space.
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
