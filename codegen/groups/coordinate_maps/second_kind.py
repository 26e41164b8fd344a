"""Coordinates of the second kind: products of exponentials of the basis elements."""

from __future__ import annotations

from codegen.errors import SceneError
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import Coadjoint, MatrixElements
from codegen.groups.coordinate_maps.base import CoordinateMap
from codegen.groups.linear_algebra import S, Vector, matmul, solved_near_identity, units
from codegen.ir.domain import Domain


class SecondKind(CoordinateMap):
    """The map tau(x) = exp(x_1 e_1) exp(x_2 e_2) ... exp(x_n e_n) for the basis e_1, ..., e_n of the algebra.

    Let E_k = exp(x_k e_k). The right-trivialised differential dtau_x v is the sum of
    v_k Ad_{E_1} ... Ad_{E_{k-1}} e_k for k = 1, ..., n (Owren and Marthinsen 2001). The linear system
    dtau_x v = y is solved by Gaussian elimination without row exchanges. If a pivot is zero, the step fails
    with the status TOO_FAR.
    """

    name = "second_kind"
    text = (
        "product of exponentials of the basis elements (second kind), exp(x_1 e_1) ... exp(x_d e_d), with "
        "its exact inverse differential"
    )

    def check(self, group: LieGroup, where: str = "") -> None:
        """Raise :class:`codegen.errors.SceneError` if the group has no adjoint map."""
        if group.offers(Coadjoint) is None:
            raise SceneError(
                f"{group.name} has no adjoint map, but coordinates of the second kind need an adjoint map",
                where=where,
                expected="a group with an adjoint map",
                hint='write coordinates="exp", or derive the class of the group from Coadjoint and define '
                "the adjoint map in the derived class",
            )

    def element(self, d: Domain, group: LieGroup, x: Vector[S]) -> Vector[S]:
        """Return exp(x_1 e_1) ... exp(x_n e_n), where n is the dimension of the algebra."""
        g = group.expbasis(d, 0, x[0])
        for k, t in enumerate(x[1:], start=1):
            g = group.mul(d, g, group.expbasis(d, k, t))
        return g

    def inverse_differential(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return the solution v of the linear system dtau_x v = y."""
        n = group.dim
        basis: tuple[Vector[S], ...] = units(d, n)
        # Both sides of the system dtau_x v = y are multiplied by Ad_g^-1 with g = exp(x_1 e_1). The matrix of
        # the new system needs fewer operations.
        columns: list[Vector[S]] = []
        for k in reversed(range(1, n)):
            columns = [basis[k], *(_adjoint(d, group, k, x[k], c) for c in columns)]
        columns.insert(0, basis[0])
        matrix = tuple(column[i] for i in range(n) for column in columns)
        return solved_near_identity(matrix, _adjoint(d, group, 0, -x[0], y), n)


def _adjoint(d: Domain, group: LieGroup, k: int, t: S, v: Vector[S]) -> Vector[S]:
    """Return Ad_g v for g = exp(t e_k)."""
    g = group.expbasis(d, k, t)
    matrices = group.offers(MatrixElements)
    if matrices is None:
        return group.require(Coadjoint).Ad(d, g, v)
    # The inverse of g is computed as exp(-t e_k), which costs less than inverting the matrix g.
    n, back = matrices.order, group.expbasis(d, k, -t)
    return matrices.vee(d, matmul(matmul(g, matrices.hat(d, v), n), back, n))
