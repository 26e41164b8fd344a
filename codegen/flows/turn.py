"""Turns: rotations about an axis that is fixed in the body or in space."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from codegen.groups.capabilities import Coadjoint
from codegen.groups.linear_algebra import S, Vector, dot
from codegen.ir.domain import Domain
from codegen.scene.flow import Flow


@dataclass(frozen=True)
class Turn(Flow):
    """A rotation about the fixed axis e: the flow of H = r (e.P)^2/2 + c e.P, where P is the momentum.

    The attributes are e = ``axis``, r = ``rate`` and c = ``offset``. Because e.P is conserved, the rotation
    angle after the time tau is tau (r e.P + c).

    - If the axis is fixed in the body (``body`` is true), P = Ad*_q mu. The flow multiplies q from the right,
      and mu is constant.
    - If the axis is fixed in space, P = mu. The flow multiplies q from the left and changes mu by the
      coadjoint action.
    """

    axis: tuple[Fraction, ...]
    rate: Fraction
    offset: Fraction
    body: bool

    def advance(
        self, d: Domain, group: Coadjoint, values: Mapping[str, S], tau: S, q: Vector[S], mu: Vector[S]
    ) -> tuple[Vector[S], Vector[S]]:
        """Return the new state (q, mu) after the time tau.

        Let g be the group element exp(a e). Here e is the axis, and a is the rotation angle after the time
        tau (:class:`Turn`).

        - If the axis is fixed in the body, the new state is (q g, mu).
        - If the axis is fixed in space, the new state is (g q, Ad*_{g^-1} mu).
        """
        axis: Vector[S] = tuple(d.rational(x.numerator, x.denominator) for x in self.axis)
        angle = tau * self._speed(d, self._axis(d, group, q), mu)
        g = group.exp(d, tuple(angle * x for x in axis))
        if self.body:
            return group.mul(d, q, g), mu
        return group.mul(d, g, q), group.Adtinv(d, g, mu)

    def field(
        self, d: Domain, group: Coadjoint, values: Mapping[str, S], q: Vector[S], mu: Vector[S]
    ) -> tuple[Vector[S], Vector[S]]:
        """Return the velocity xi and the force n.

        The class docstring defines the angular speed s and the axis e.

        - If the axis is fixed in space, xi = s e and n = 0.
        - If the axis is fixed in the body, xi = s Ad_q e and n = ad*_xi mu. Then mu' = n - ad*_xi mu = 0.
        """
        axis = self._axis(d, group, q)
        speed = self._speed(d, axis, mu)
        zero: Vector[S] = (d.rational(0),) * group.dim
        n = tuple(speed * x for x in group.adt(d, axis, mu)) if self.body else zero
        return tuple(speed * e for e in axis), n

    def _axis(self, d: Domain, group: Coadjoint, q: Vector[S]) -> Vector[S]:
        """Return the axis in the space frame."""
        axis: Vector[S] = tuple(d.rational(x.numerator, x.denominator) for x in self.axis)
        return group.Ad(d, q, axis) if self.body else axis

    def _speed(self, d: Domain, axis: Vector[S], mu: Vector[S]) -> S:
        """Return the angular speed: ``rate`` times the dot product of the axis and mu, plus ``offset``.

        The argument ``axis`` is the axis in the space frame.
        """
        rate: S = d.rational(self.rate.numerator, self.rate.denominator)
        speed = rate * dot(mu, axis)
        if self.offset:
            speed = speed + d.rational(self.offset.numerator, self.offset.denominator)
        return speed

    def text(self) -> str:
        """Return a short description of the turn for messages and headers."""
        axis = ", ".join(map(str, self.axis))
        return f"turn about the axis ({axis}) fixed in {'the body' if self.body else 'space'}"
