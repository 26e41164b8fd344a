"""The coadjoint action of a group on the dual of its Lie algebra."""

from __future__ import annotations

from codegen.groups.actions.base import Action
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import Coadjoint
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain


class CoadjointAction(Action):
    """A group acting on the dual of its Lie algebra, g.mu = Ad*_{g^-1} mu, as in Lie-Poisson systems.

    The velocity is x.mu = -ad*_x mu. Let H(mu) be a Hamiltonian with the derivative H'(mu). For the
    Lie-Poisson equation mu' = -ad*_{H'(mu)} mu, use the field f(mu) = H'(mu). For the Lie-Poisson equation
    mu' = ad*_{H'(mu)} mu, use f(mu) = -H'(mu).
    """

    name = "coadjoint action"
    needs = Coadjoint

    def point_size(self, group: LieGroup) -> int:
        """Return the dimension of the dual of the algebra."""
        return group.dim

    def act(self, d: Domain, group: LieGroup, g: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return g.y = Ad*_{g^-1} y, where Ad* is the transpose of Ad."""
        return group.require(Coadjoint).Adtinv(d, g, y)

    def velocity(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return x.y = -ad*_x y, where ad* is the transpose of ad."""
        return tuple(-a for a in group.require(Coadjoint).adt(d, x, y))
