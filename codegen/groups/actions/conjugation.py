"""Conjugation of matrices: P -> g P g^-1. Isospectral flows use this action."""

from __future__ import annotations

from codegen.groups.actions.base import Action
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import MatrixElements
from codegen.groups.linear_algebra import S, Vector, matmul
from codegen.ir.domain import Domain


class Conjugation(Action):
    """The matrices g act on n x n matrices P by g.P = g P g^-1. Isospectral flows, such as the flow of the
    Toda lattice, use this action.

    A point contains the entries of the matrix P row by row.
    """

    name = "conjugation"
    needs = MatrixElements

    def point_size(self, group: LieGroup) -> int:
        """Return n^2, the number of entries of an n x n matrix."""
        return group.size

    def act(self, d: Domain, group: LieGroup, g: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return g y g^-1."""
        matrices = group.require(MatrixElements)
        return matmul(matmul(g, y, matrices.order), matrices.inverse(d, g), matrices.order)

    def velocity(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return the commutator A y - y A of matrices, where A is the matrix of x."""
        matrices = group.require(MatrixElements)
        a, n = matrices.hat(d, x), matrices.order
        pairs = zip(matmul(a, y, n), matmul(y, a, n), strict=True)
        return tuple(p - q for p, q in pairs)
