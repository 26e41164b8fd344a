"""Which parts of a Hamiltonian have exact flows in closed form, found from the formulas alone.

V(q) is a kick. On T*R^n a function of the momentum alone is a drift, a quadratic function of both a linear
flow where its matrix squares to a diagonal. On other groups a quadratic function of the momentum in the body,
P = Ad*_q mu, or in space, P = mu, is split exactly: P.BP/2 = a P.P/2 + sum_k d_k (e_k.P)^2/2. The first
term (where Ad leaves the inner product alone) is a rotation about the momentum and commutes with all others,
each of these is a turn about a fixed axis. With one turn at most the flow is exact, as a symmetric top's is.
With more the part is several pieces, which do not commute, as an asymmetric top is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

from codegen.flows.flow import Drift, Flow, Isotropic, Kick, Linear, Turn
from codegen.ir.differentiate import gradient
from codegen.ir.domain import SeriesDomain
from codegen.ir.expr import Expr, evaluate, walk
from codegen.ir.number import Number
from codegen.scene.canonical_equations import force, velocity
from codegen.scene.consistency import Orbit
from codegen.scene.problem import TIME, Problem, orbit_of
from orderconds.ring import QQ

Matrix = list[list[Fraction]]


@dataclass(frozen=True)
class Piece:
    """Flows that commute, by name: together the exact flow of a part or of a summand of it."""

    flows: tuple[tuple[str, Flow], ...]

    @property
    def timed(self) -> bool:
        """Whether a flow of it holds the time."""
        return any(flow.timed for _, flow in self.flows)


@dataclass(frozen=True)
class Part:
    """A part of the scene: its pieces, none where no closed form is known, and why not."""

    name: str
    pieces: tuple[Piece, ...]
    reason: str = ""

    @property
    def exact(self) -> bool:
        """Whether the flow of the whole part is known."""
        return len(self.pieces) == 1


def recognise(scene: Problem) -> tuple[Part, ...]:
    """Return the parts of a Hamiltonian scene with their exact flows."""
    return tuple(_Reading(scene, name, root).part() for name, root in scene.parts.items())


def vanish(orbit: Orbit, roots: Sequence[Expr]) -> bool:
    """Whether formulas vanish at all points of the scene."""
    found = [orbit.values(roots, point) for point in orbit.points]
    return all(values is not None and all(orbit.sized(x, (1,)) for x in values) for values in found)


def bracket(scene: Problem, F: Expr, H: Expr) -> Expr:
    """Return the Poisson bracket {F, H}: the derivative of F along the flow of H on T*G."""
    space, names = F.space, scene.symbols
    q, mu = scene.state
    rates = velocity(scene.group, q.symbols, mu.symbols, H)
    total = space.zero
    for slope, rate in zip(gradient(F, names), rates, strict=True):
        total = total + slope * rate
    return total


@dataclass
class _Reading:
    """One part of a scene, examined."""

    scene: Problem
    name: str
    root: Expr

    @property
    def qs(self) -> tuple[str, ...]:
        return self.scene.state[0].symbols

    @property
    def mus(self) -> tuple[str, ...]:
        return self.scene.state[1].symbols

    @cached_property
    def orbit(self) -> Orbit:
        return orbit_of(self.scene)

    def part(self) -> Part:
        if self.name in self.scene.stated:
            return self._whole(self.scene.stated[self.name])
        timed = any(n.op == "sym" and n.payload == TIME for n in walk([self.root]))
        by_q, by_mu = (gradient(self.root, names) for names in (self.qs, self.mus))
        if self._vanish(by_mu):
            push = force(self.root.space, self.scene.group, self.qs, by_q)
            return self._whole(Kick(push, timed))
        if timed:
            return Part(self.name, (), "it depends on the momentum and on t")
        if self.scene.group.abelian and self._vanish(by_q):
            return self._whole(Drift(tuple(by_mu)))
        return self._linear(by_q, by_mu) if self.scene.group.abelian else self._quadratic(by_mu)

    def _whole(self, flow: Flow) -> Part:
        return Part(self.name, (Piece(((self.name, flow),)),))

    def _vanish(self, roots: Sequence[Expr]) -> bool:
        """Whether formulas vanish at all points of the scene."""
        return vanish(self.orbit, roots)

    def _exact(self, roots: Sequence[Expr], q: Sequence[Any]) -> list[Fraction] | None:
        """Return formulas at (q, mu = 0) as fractions; None where they are none."""
        read = {n.payload for n in walk(roots) if n.op == "sym"}
        if read & {*self.scene.runtime, TIME}:
            return None
        d = SeriesDomain(QQ, 0)
        state = (*q, *(d.rational(0) for _ in self.mus))
        try:
            found = evaluate(roots, d, self.scene.values(d, state))
        except (ArithmeticError, ValueError):
            return None
        return [Number(QQ, x.coefficients[0]).fraction() for x in found]

    def _matrix(self, slopes: Sequence[Expr], names: Sequence[str], q: Sequence[Any]) -> Matrix | None:
        rows = [self._exact(gradient(slope, names), q) for slope in slopes]
        return None if any(row is None for row in rows) else [row for row in rows if row is not None]

    def _linear(self, by_q: list[Expr], by_mu: list[Expr]) -> Part:
        """z' = L z + c on T*R^n, L = J times the Hessian."""
        d = SeriesDomain(QQ, 0)
        origin = [d.rational(0)] * len(self.qs)
        slopes = [*by_mu, *(-x for x in by_q)]
        names = (*self.qs, *self.mus)
        L, c = self._matrix(slopes, names, origin), self._exact(slopes, origin)
        if (
            L is None
            or c is None
            or not self._vanish([s - _affine(s, r, b, names) for s, r, b in zip(slopes, L, c, strict=True)])
        ):
            return Part(self.name, (), "it is no quadratic function of q and mu with constant coefficients")
        n = range(len(L))
        square = [[sum((L[i][k] * L[k][j] for k in n), Fraction(0)) for j in n] for i in n]
        if any(square[i][j] for i in n for j in n if i != j) or any(square[i][i] > 0 for i in n):
            return Part(self.name, (), "the square of its matrix is not diagonal and non-positive")
        squares = tuple(-square[i][i] for i in n)
        return self._whole(Linear(tuple(map(tuple, L)), tuple(c), squares))

    def _quadratic(self, by_mu: list[Expr]) -> Part:
        """A quadratic function of the momentum in the body or in space."""
        group = self.scene.group
        identity = group.identity(SeriesDomain(QQ, 0))
        B, w = self._matrix(by_mu, self.mus, identity), self._exact(by_mu, identity)
        if B is None or w is None:
            return Part(self.name, (), "its coefficients are not rational numbers")
        for body in (True, False):
            if self._is_form(B, w, body):
                return Part(self.name, tuple(self._pieces(B, w, body)))
        return Part(self.name, (), "it is no quadratic function of the momentum in the body or in space")

    def _is_form(self, B: Matrix, w: list[Fraction], body: bool) -> bool:
        """Whether H - H(e, 0) is P.BP/2 + w.P."""
        orbit, group = self.orbit, self.scene.group
        d = orbit.domain
        base = None
        for point in orbit.points:
            q, mu = (tuple(point[s] for s in names) for names in (self.qs, self.mus))
            P = group.Adt(d, q, mu) if body else mu
            terms = [d.rational(*x.as_integer_ratio()) * y for x, y in zip(w, P, strict=True)]
            for row, x in zip(B, P, strict=True):
                terms += [
                    d.rational(*(b / 2).as_integer_ratio()) * x * y for b, y in zip(row, P, strict=True)
                ]
            found = orbit.values([self.root], point)
            if found is None:
                return False
            rest = found[0] - sum(terms, d.rational(0))
            base = rest if base is None else base
            if not orbit.sized(rest - base, (*terms, base)):
                return False
        return True

    def _pieces(self, B: Matrix, w: list[Fraction], body: bool) -> list[Piece]:
        group = self.scene.group
        mean = _mean(B) if _invariant(group) else Fraction(0)
        rest = [[x - (mean if i == j else 0) for j, x in enumerate(row)] for i, row in enumerate(B)]
        turns = [
            Turn(tuple(e), rate, Fraction(0), body)
            for rate, e in sorted(_squares(rest), key=lambda s: -abs(s[0]))
        ]
        if any(w):
            turns = _with_offset(turns, w, body)
        flows: list[list[tuple[str, Flow]]] = []
        several = len(turns) + bool(mean) > 1
        for k, turn in enumerate(turns):
            number = str(k + 1) if len(turns) > 1 else ""
            flows.append([(f"{self.name}.turn{number}" if several else self.name, turn)])
        if mean:
            flow = (f"{self.name}.mean" if several else self.name, Isotropic(mean))
            flows = [[flow, *(flows[0] if flows else [])], *flows[1:]]
        return [Piece(tuple(f)) for f in flows]


def _affine(s: Expr, row: Sequence[Fraction], constant: Fraction, names: Sequence[str]) -> Expr:
    space = s.space
    total = space.const(Number.rational(*constant.as_integer_ratio()))
    for x, name in zip(row, names, strict=True):
        total = total + space.const(Number.rational(*x.as_integer_ratio())) * space.sym(name)
    return total


def _invariant(group: Any) -> bool:
    """Whether Ad leaves the dot product of coordinates alone: <[x, y], z> is alternating."""
    d = SeriesDomain(QQ, 0)
    units = [tuple(d.rational(int(i == j)) for j in range(group.dim)) for i in range(group.dim)]
    brackets = [[group.ad(d, x, y) for y in units] for x in units]
    n = range(group.dim)
    return all(d.ring.is_zero(brackets[i][j][k] + brackets[i][k][j]) for i in n for j in n for k in n)


def _mean(B: Matrix) -> Fraction:
    """Return a multiple of the identity that leaves few and small squares.

    The double eigenvalue of a 3 x 3 matrix where there is one, else the middle one of a diagonal matrix.
    """
    n = len(B)
    candidates = sorted(B[i][i] for i in range(n))
    if all(not B[i][j] for i in range(n) for j in range(n) if i != j):
        doubled = [x for x in candidates if candidates.count(x) > 1]
        return doubled[0] if doubled else candidates[n // 2]
    for i in range(n):
        for k in range(n):
            for j in range(n):
                if len({i, j, k}) == 3 and B[j][k]:
                    candidates.append(B[i][i] - B[i][j] * B[i][k] / B[j][k])
    return min(candidates, key=lambda a: (len(_squares(_shifted(B, a))), candidates.index(a)))


def _shifted(B: Matrix, a: Fraction) -> Matrix:
    return [[x - (a if i == j else 0) for j, x in enumerate(row)] for i, row in enumerate(B)]


def _squares(B: Matrix) -> list[tuple[Fraction, list[Fraction]]]:
    """Return (d, e) with B = sum d e e^T, by Lagrange's reduction.

    >>> _squares([[Fraction(0), Fraction(1)], [Fraction(1), Fraction(0)]])
    [(Fraction(1, 2), [Fraction(1, 1), Fraction(1, 1)]), (Fraction(-1, 2), [Fraction(1, 1), Fraction(-1, 1)])]
    """
    B, n = [list(row) for row in B], range(len(B))
    found: list[tuple[Fraction, list[Fraction]]] = []

    def take(rate: Fraction, e: list[Fraction]) -> None:
        found.append((rate, e))
        for i in n:
            for j in n:
                B[i][j] -= rate * e[i] * e[j]

    while any(any(row) for row in B):
        diagonal = [i for i in n if B[i][i]]
        if diagonal:
            k = diagonal[0]
            take(B[k][k], [B[i][k] / B[k][k] for i in n])
            continue
        i, j = next((i, j) for i in n for j in n if B[i][j])
        rate = B[i][j] / 2
        for sign in (1, -1):
            take(sign * rate, [Fraction(int(k == i) + sign * int(k == j)) for k in n])
    return found


def _with_offset(turns: list[Turn], w: list[Fraction], body: bool) -> list[Turn]:
    """Add w.P to the turn about its axis, or as a turn of its own."""
    for k, turn in enumerate(turns):
        i = next(i for i, x in enumerate(turn.axis) if x)
        ratio = w[i] / turn.axis[i]
        if all(x == ratio * e for x, e in zip(w, turn.axis, strict=True)):
            return [*turns[:k], Turn(turn.axis, turn.rate, ratio, body), *turns[k + 1 :]]
    return [*turns, Turn(tuple(w), Fraction(0), Fraction(1), body)]
