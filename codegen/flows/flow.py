"""Exact flows of parts of a Hamiltonian on T*G, in closed form over any domain.

A splitting needs nothing else: each part H_k of H = sum H_k moves (q, mu) for a time tau along q' = xi.q,
mu' = n - ad*_xi mu with xi = D_2 H_k, n = -(D_1 H_k).q^-1 (thesis eq. 2.27). The classes here are those whose
motion has a closed form; :mod:`codegen.flows.recognise` finds out which parts of a scene are of them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Protocol

from codegen.groups.base import Scalars, dot
from codegen.ir.domain import Domain
from codegen.ir.expr import Expr, evaluate

Field = tuple[Scalars, Scalars]
"""xi and n."""


class Flow(Protocol):
    """The exact flow of one part. ``timed`` says that the part depends on t, which stands still meanwhile."""

    @property
    def timed(self) -> bool:
        """Whether values hold the time."""

    def advance(
        self, d: Domain, group: Any, values: Mapping[str, Any], tau: Any, q: Scalars, mu: Scalars
    ) -> tuple[Scalars, Scalars]:
        """Return (q, mu) after the time tau; ``values`` are those of all symbols at the start."""

    def field(self, d: Domain, group: Any, values: Mapping[str, Any], q: Scalars, mu: Scalars) -> Field:
        """Return (xi, n), what the flow is the motion of."""

    def text(self) -> str:
        """Say what the motion is."""


@dataclass(frozen=True)
class Kick:
    """H = V(q): q stands still and mu moves by tau n(q), n = -(D_1 V).q^-1."""

    force: tuple[Expr, ...]
    timed: bool = False

    def advance(
        self, d: Domain, group: Any, values: Mapping[str, Any], tau: Any, q: Scalars, mu: Scalars
    ) -> tuple[Scalars, Scalars]:
        """Return (q, mu + tau n)."""
        n = evaluate(self.force, d, dict(values))
        return q, tuple(m + tau * x for m, x in zip(mu, n, strict=True))

    def field(self, d: Domain, group: Any, values: Mapping[str, Any], q: Scalars, mu: Scalars) -> Field:
        """Return (0, n)."""
        return _zero(d, group), tuple(evaluate(self.force, d, dict(values)))

    def text(self) -> str:
        """Name it."""
        return "kick"


@dataclass(frozen=True)
class Drift:
    """H = T(mu) on an abelian group: mu stands still and q moves by tau xi(mu), xi = D_2 T."""

    velocity: tuple[Expr, ...]
    timed: bool = False

    def advance(
        self, d: Domain, group: Any, values: Mapping[str, Any], tau: Any, q: Scalars, mu: Scalars
    ) -> tuple[Scalars, Scalars]:
        """Return (exp(tau xi) q, mu)."""
        xi = evaluate(self.velocity, d, dict(values))
        return group.mul(d, group.exp(d, tuple(tau * x for x in xi)), q), mu

    def field(self, d: Domain, group: Any, values: Mapping[str, Any], q: Scalars, mu: Scalars) -> Field:
        """Return (xi, 0)."""
        return tuple(evaluate(self.velocity, d, dict(values))), _zero(d, group)

    def text(self) -> str:
        """Name it."""
        return "drift"


@dataclass(frozen=True)
class Isotropic:
    """H = rate mu.mu/2 for an inner product that Ad leaves alone: mu stands still, q turns about it."""

    rate: Fraction
    timed = False

    def advance(
        self, d: Domain, group: Any, values: Mapping[str, Any], tau: Any, q: Scalars, mu: Scalars
    ) -> tuple[Scalars, Scalars]:
        """Return (exp(tau rate mu) q, mu)."""
        step = tau * _rational(d, self.rate)
        return group.left(d, tuple(step * m for m in mu), q), mu

    def field(self, d: Domain, group: Any, values: Mapping[str, Any], q: Scalars, mu: Scalars) -> Field:
        """Return (rate mu, 0)."""
        rate = _rational(d, self.rate)
        return tuple(rate * m for m in mu), _zero(d, group)

    def text(self) -> str:
        """Name it."""
        return "rotation about the momentum"


@dataclass(frozen=True)
class Turn:
    """H = rate (e.P)^2/2 + offset e.P, P the momentum in the body or in space: a turn about the fixed axis e.

    e.P is kept, so the angle is tau (rate e.P + offset). In the body P = Ad*_q mu and q turns from the right
    while mu stands still; in space P = mu and both turn from the left.
    """

    axis: tuple[Fraction, ...]
    rate: Fraction
    offset: Fraction
    body: bool
    timed = False

    def advance(
        self, d: Domain, group: Any, values: Mapping[str, Any], tau: Any, q: Scalars, mu: Scalars
    ) -> tuple[Scalars, Scalars]:
        """Return (q exp(angle e), mu) in the body, (g q, Ad*_{g^-1} mu) with g = exp(angle e) in space."""
        axis = tuple(_rational(d, x) for x in self.axis)
        angle = tau * self._speed(d, self._axis(d, group, q), mu)
        if self.body:
            return group.right(d, q, axis, angle), mu
        g = group.exp(d, tuple(angle * x for x in axis))
        return group.mul(d, g, q), group.Adtinv(d, g, mu)

    def field(self, d: Domain, group: Any, values: Mapping[str, Any], q: Scalars, mu: Scalars) -> Field:
        """Return ((rate e.P + offset) e, 0) in space, e turned with the body and mu kept by n in the body."""
        axis = self._axis(d, group, q)
        speed = self._speed(d, axis, mu)
        n = group.adt(d, axis, mu) if self.body else _zero(d, group)
        return tuple(speed * e for e in axis), tuple(speed * x if self.body else x for x in n)

    def _axis(self, d: Domain, group: Any, q: Scalars) -> Scalars:
        """Return the axis in space."""
        axis = tuple(_rational(d, x) for x in self.axis)
        return tuple(group.Ad(d, q, axis)) if self.body else axis

    def _speed(self, d: Domain, axis: Scalars, mu: Scalars) -> Any:
        speed = _rational(d, self.rate) * dot(mu, axis)
        return speed + _rational(d, self.offset) if self.offset else speed

    def text(self) -> str:
        """Name it."""
        axis = ", ".join(map(str, self.axis))
        return f"turn about the axis ({axis}) fixed in {'the body' if self.body else 'space'}"


@dataclass(frozen=True)
class Linear:
    """A quadratic H on T*R^n: z' = L z + c for z = (q, mu), where L^2 = -diag(w), w >= 0.

    With the Stumpff functions C_k = c_k(w tau^2): z -> (C_0 + tau C_1 L) z + (tau C_1 + tau^2 C_2 L) c.
    """

    matrix: tuple[tuple[Fraction, ...], ...]
    constant: tuple[Fraction, ...]
    squares: tuple[Fraction, ...]
    timed = False

    def advance(
        self, d: Domain, group: Any, values: Mapping[str, Any], tau: Any, q: Scalars, mu: Scalars
    ) -> tuple[Scalars, Scalars]:
        """Return the moved (q, mu)."""
        z = (*q, *mu)
        new = []
        for i, square in enumerate(self.squares):
            argument = _rational(d, square) * (tau * tau) if square else None
            first = tau * _stumpff(d, 1, argument)
            rate = _applied(d, self.matrix[i], z, self.constant[i])
            total = z[i] if argument is None else d.call("stumpff0", argument) * z[i]
            if rate is not None:
                total = total + first * rate
            push = _applied(d, self.matrix[i], tuple(_rational(d, c) for c in self.constant), Fraction(0))
            if push is not None and any(self.constant):
                total = total + tau * tau * _stumpff(d, 2, argument) * push
            new.append(total)
        return tuple(new[: len(q)]), tuple(new[len(q) :])

    def field(self, d: Domain, group: Any, values: Mapping[str, Any], q: Scalars, mu: Scalars) -> Field:
        """Return L z + c."""
        z = (*q, *mu)
        rows = [_applied(d, row, z, c) for row, c in zip(self.matrix, self.constant, strict=True)]
        rates = tuple(d.rational(0) if rate is None else rate for rate in rows)
        return rates[: len(q)], rates[len(q) :]

    def text(self) -> str:
        """Name it."""
        return "linear flow"


TAU = "tau"
"""The elapsed time in formulas of a stated flow."""


@dataclass(frozen=True)
class Stated:
    """A flow that the scene states: formulas of (q, mu) after the time tau, checked where it is read."""

    formulas: tuple[Expr, ...]
    timed = False

    def advance(
        self, d: Domain, group: Any, values: Mapping[str, Any], tau: Any, q: Scalars, mu: Scalars
    ) -> tuple[Scalars, Scalars]:
        """Return the formulas' values."""
        found = tuple(evaluate(self.formulas, d, {**values, TAU: tau}))
        return found[: len(q)], found[len(q) :]

    def field(self, d: Domain, group: Any, values: Mapping[str, Any], q: Scalars, mu: Scalars) -> Field:
        """Refuse: the formulas tell where it leads, not what drives it."""
        raise ArithmeticError("a stated flow has no field of its own")

    def text(self) -> str:
        """Name it."""
        return "as the scene states it"


def _rational(d: Domain, x: Fraction) -> Any:
    return d.rational(x.numerator, x.denominator)


def _zero(d: Domain, group: Any) -> Scalars:
    return (d.rational(0),) * int(group.dim)


def _stumpff(d: Domain, k: int, argument: Any) -> Any:
    """Return c_k; ``argument`` None stands for zero, where c_k = 1/k!."""
    return d.rational(1, max(k, 1)) if argument is None else d.call(f"stumpff{k}", argument)


def _applied(d: Domain, row: tuple[Fraction, ...], z: Scalars, constant: Fraction) -> Any:
    """Return row.z + constant, or None where every entry of the row and the constant vanish."""
    total: Any = _rational(d, constant) if constant else None
    for c, x in zip(row, z, strict=True):
        if c:
            term = x if c == 1 else _rational(d, c) * x
            total = term if total is None else total + term
    return total
