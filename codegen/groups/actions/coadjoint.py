"""The coadjoint action of a group on the dual of its Lie algebra."""

from __future__ import annotations

from codegen.groups.actions.base import Action
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import Coadjoint
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain


class CoadjointAction(Action):
    """A group acting on the dual of its Lie algebra, g.mu = Ad*_{g^-1} mu, as in Lie-Poisson systems.

    The velocity is x.mu = -ad*_x mu. Let H(mu) be a Hamiltonian. The field f = dH/dmu gives the Lie-Poisson
    equation mu' = -ad*_f mu. The field f = -dH/dmu gives the Lie-Poisson equation with the opposite sign. The
    orbits are coadjoint orbits, so all Casimir functions are conserved.
    """

    name = "coadjoint action"
    needs = Coadjoint

    def point_size(self, group: LieGroup) -> int:
        """Return the dimension of the dual of the algebra."""
        return group.dim

    def act(self, d: Domain, group: LieGroup, g: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return Ad*_{g^-1} y."""
        return group.require(Coadjoint).Adtinv(d, g, y)

    def velocity(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return -ad*_x y."""
        return tuple(-a for a in group.require(Coadjoint).adt(d, x, y))
