"""Kicks: exact flows of potentials. A kick changes the momentum and not the position."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from codegen.flows.part import Formula, Part
from codegen.groups.capabilities import Coadjoint
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain
from codegen.ir.expr import Expr, evaluate
from codegen.scene.canonical_equations import force
from codegen.scene.flow import Flow


@dataclass(frozen=True)
class Kick(Flow):
    """The flow of a potential H = V(q).

    In the time tau, the momentum mu increases by tau n, where n is the force. The components of the
    force are n_a = -d/deps V(exp(eps e_a) q) at eps = 0. Here e_a are the basis elements of the Lie algebra.
    """

    force: tuple[Expr, ...]
    timed: bool = False

    @property
    def expressions(self) -> tuple[Expr, ...]:
        """The attribute ``force``."""
        return self.force

    def advance(
        self, d: Domain, group: Coadjoint, values: Mapping[str, S], tau: S, q: Vector[S], mu: Vector[S]
    ) -> tuple[Vector[S], Vector[S]]:
        """Return (q, mu + tau n), where n is the attribute ``force``."""
        n: list[S] = evaluate(self.force, d, dict(values))
        return q, tuple(m + tau * x for m, x in zip(mu, n, strict=True))

    def field(
        self, d: Domain, group: Coadjoint, values: Mapping[str, S], q: Vector[S], mu: Vector[S]
    ) -> tuple[Vector[S], Vector[S]]:
        """Return the velocity 0 and the force of the potential."""
        return (d.rational(0),) * group.dim, tuple(evaluate(self.force, d, dict(values)))

    def text(self) -> str:
        """Return a short description of the flow."""
        return "kick"


def recognise(formula: Formula) -> Part | None:
    """Return a part with the flow :class:`Kick`. If the formula depends on the momentum, return None."""
    if not formula.orbit.vanish(formula.by_mu):
        return None
    n = force(formula.root.space, formula.problem.group, formula.qs, formula.by_q)
    return formula.whole(Kick(n, formula.timed))
