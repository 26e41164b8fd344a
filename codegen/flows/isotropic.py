"""Isotropic flows: exact flows of H = r mu.mu/2. The flow rotates q about the momentum mu."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from codegen.groups.capabilities import Coadjoint
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain
from codegen.scene.flow import Flow


@dataclass(frozen=True)
class Isotropic(Flow):
    """The flow of H = r mu.mu/2 on a group whose adjoint action preserves the dot product.

    The number r is the attribute ``rate``. The momentum mu is constant. The group element q rotates about mu.
    """

    rate: Fraction

    def advance(
        self, d: Domain, group: Coadjoint, values: Mapping[str, S], tau: S, q: Vector[S], mu: Vector[S]
    ) -> tuple[Vector[S], Vector[S]]:
        """Return (exp(x) q, mu). The components of x are those of mu, multiplied by tau and ``rate``."""
        step: S = tau * d.rational(self.rate.numerator, self.rate.denominator)
        return group.expmul(d, tuple(step * m for m in mu), q), mu

    def field(
        self, d: Domain, group: Coadjoint, values: Mapping[str, S], q: Vector[S], mu: Vector[S]
    ) -> tuple[Vector[S], Vector[S]]:
        """Return the velocity r mu and the force 0, where r is the attribute ``rate``."""
        rate: S = d.rational(self.rate.numerator, self.rate.denominator)
        return tuple(rate * m for m in mu), (d.rational(0),) * group.dim

    def text(self) -> str:
        """Return a short description of the flow."""
        return "rotation about the momentum"
