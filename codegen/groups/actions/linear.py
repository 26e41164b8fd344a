"""Matrices acting on column vectors."""

from __future__ import annotations

from codegen.groups.actions.base import Action
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import MatrixElements, Rotations
from codegen.groups.linear_algebra import S, Vector, matvec
from codegen.ir.domain import Domain


class Linear(Action):
    """Matrices acting on column vectors: g.y = g y."""

    name = "linear maps"
    needs = MatrixElements

    def act(self, d: Domain, group: LieGroup, g: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return g y."""
        return matvec(g, y)

    def actexp(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return exp(x) y; if the group consists of rotations, the matrix exp(x) is not formed."""
        rotations = group.offers(Rotations)
        return matvec(group.exp(d, x), y) if rotations is None else rotations.rotate(d, x, y)

    def velocity(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return hat(x) y."""
        return matvec(group.require(MatrixElements).hat(d, x), y)
