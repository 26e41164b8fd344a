"""Drifts: exact flows of kinetic energies on abelian groups. A drift does not change the momentum."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from codegen.flows.part import Formula, Part
from codegen.groups.capabilities import Coadjoint
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain
from codegen.ir.expr import Expr, evaluate
from codegen.scene.flow import Flow


@dataclass(frozen=True)
class Drift(Flow):
    """The flow of a kinetic energy H = T(mu) on an abelian group, where mu is the momentum.

    The flow over the time tau replaces the group element q by exp(tau xi) q. Here xi = dT/dmu is the
    velocity. The momentum is constant.
    """

    velocity: tuple[Expr, ...]

    @property
    def expressions(self) -> tuple[Expr, ...]:
        """The attribute ``velocity``."""
        return self.velocity

    def advance(
        self, d: Domain, group: Coadjoint, values: Mapping[str, S], tau: S, q: Vector[S], mu: Vector[S]
    ) -> tuple[Vector[S], Vector[S]]:
        """Return (exp(tau xi) q, mu), where xi is the velocity dT/dmu."""
        xi: list[S] = evaluate(self.velocity, d, dict(values))
        return group.mul(d, group.exp(d, tuple(tau * x for x in xi)), q), mu

    def field(
        self, d: Domain, group: Coadjoint, values: Mapping[str, S], q: Vector[S], mu: Vector[S]
    ) -> tuple[Vector[S], Vector[S]]:
        """Return the velocity dT/dmu and the force 0."""
        return tuple(evaluate(self.velocity, d, dict(values))), (d.rational(0),) * group.dim

    def text(self) -> str:
        """Return a short description of the flow."""
        return "drift"


def recognise(formula: Formula) -> Part | None:
    """Return a part with the flow :class:`Drift`.

    If the group is not abelian, or the formula depends on the time or on the group element, return None.
    """
    if formula.timed or not formula.problem.group.abelian or not formula.orbit.vanish(formula.by_q):
        return None
    return formula.whole(Drift(tuple(formula.by_mu)))
