"""Matrices acting on column vectors."""

from __future__ import annotations

from codegen.groups.actions.base import Action
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import MatrixElements, Rotations
from codegen.groups.linear_algebra import S, Vector, dot, matvec, rescaled
from codegen.ir.domain import Domain


class Linear(Action):
    """Matrices acting on column vectors: g.y = g y."""

    name = "linear maps"
    needs = MatrixElements

    def point_size(self, group: LieGroup) -> int:
        """Return n for a group of n x n matrices."""
        return group.require(MatrixElements).order

    def act(self, d: Domain, group: LieGroup, g: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return g y."""
        return matvec(g, y)

    def actexp(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return exp(x) y. For some groups the result is computed without the matrix exp(x)."""
        rotations = group.offers(Rotations)
        if rotations is None:
            return group.require(MatrixElements).exp_times(d, x, y)
        return rotations.rotate(d, x, y)

    def to_orbit(self, d: Domain, group: LieGroup, y: Vector[S], start: Vector[S]) -> Vector[S]:
        """If the group consists of rotations, scale y approximately to the length of ``start``.

        For other groups, return y. Let e = 1 - (y.y)/(start.start) with the dot product. The scale
        factor is 1 + e/2 + 3 e^2/8. The relative error of the length is O(e^3).
        """
        if group.offers(Rotations) is None:
            return y
        squared = dot(start, start)
        # If ``squared`` is zero, ``quotient`` returns 0 instead of dividing by zero, and the result is y.
        defect = d.call("quotient", squared - dot(y, y), squared)
        return rescaled(d, y, defect)

    def velocity(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return A y, where A is the matrix of x."""
        return matvec(group.require(MatrixElements).hat(d, x), y)
