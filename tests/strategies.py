"""What tests draw from: groups and their elements over every domain, polynomial scenes, tableaux.

Everything is drawn by seeded generators, so that a failure repeats. Exact samples are rational numbers or
power series with small coefficients.
"""

from __future__ import annotations

import math
import random
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from sympy import Matrix, Rational, Symbol

from codegen.groups import (
    GL,
    S3,
    SE2,
    SE3,
    SE23,
    SL2,
    SO2,
    SO3,
    SU2,
    Cotangent,
    Galilean,
    LeftMultiplication,
    LieGroup,
    Linear,
    MatrixGroup,
    Motion,
    Product,
    Rn,
    Rotation,
    Semidirect,
)
from codegen.groups.capabilities import Coadjoint
from codegen.groups.linear_algebra import invert
from codegen.groups.representations import MatrixColumns
from codegen.ir.domain import FloatDomain, PreciseDomain, SeriesDomain
from codegen.ir.interpret import interpret
from codegen.lower import lower, problem_for
from codegen.method import Method
from codegen.scene import FieldScene, HamiltonianScene
from orderconds.ring import QQ
from orderconds.tableau import CommutatorFree, RungeKutta, Stage, Tableau, find

ORDER = 5
"""Exact samples are series in h up to this power."""


def heisenberg() -> MatrixGroup:
    """Upper triangular 3 x 3 matrices with ones on the diagonal: the smallest non-abelian nilpotent group."""
    return MatrixGroup(
        "Heisenberg", [[[int((i, j) == p) for j in range(3)] for i in range(3)] for p in PLACES]
    )


PLACES = ((0, 1), (1, 2), (0, 2))

GROUPS: dict[str, LieGroup] = {
    "SO(3)": SO3(),
    "R^3": Rn(3),
    "GL(2)": GL(2),
    "Heisenberg": heisenberg(),
    "S^3": S3(),
    "SE(2)": SE2(),
    "SL(2)": SL2(),
    "SO(3) x R^2": Product(SO3(), Rn(2)),
    "SO(2)": SO2(),
    "SU(2)": SU2(),
    "SE(3)": SE3(),
    "SE(3) over SU(2)": SE3(SU2()),
    "SE_2(3)": SE23(),
    "Gal(3)": Galilean(),
    "affine": Semidirect(GL(2), MatrixColumns(), "affine"),
}
"""The groups that tests draw from."""
BASE_GROUPS: dict[str, Any] = {name: group for name, group in GROUPS.items() if group.offers(Coadjoint)}
"""The groups with a coadjoint action, so that T*G is a group."""
ALL_GROUPS: dict[str, Any] = GROUPS | {f"T*{name}": Cotangent(group) for name, group in BASE_GROUPS.items()}


@dataclass
class Sampler:
    """Elements of one group over one domain; ``size`` scales what is drawn from the algebra."""

    group: Any
    domain: Any
    kind: str
    tolerance: Any
    rng: random.Random

    def scalar(self) -> Any:
        """Return a number; over power series one without constant term, so that exponentials are exact."""
        if isinstance(self.domain, SeriesDomain):
            some = (QQ.rational(self.rng.randint(-4, 4), self.rng.randint(1, 3)) for _ in range(ORDER))
            return self.domain.ring.from_coefficients((QQ.zero, *some))
        return self.domain.rational(1) * self.rng.uniform(-1, 1)

    def vector(self) -> tuple[Any, ...]:
        """Return an element of the algebra or its dual, of the kind that is sampled."""
        x = tuple(self.scalar() for _ in range(self.group.dim))
        if self.kind == "near the identity":
            return tuple(a * 1e-7 for a in x)
        if self.kind == "half a turn":
            length = math.sqrt(sum(float(a) ** 2 for a in x[:3]))
            return tuple(a * (math.pi / length) for a in x)
        if self.kind == "one axis":
            return (x[0], *(a * 0 for a in x[1:]))
        return x

    def covector(self) -> tuple[Any, ...]:
        """Return an element of the dual with constant terms."""
        return tuple(
            self.domain.rational(self.rng.randint(-5, 5), 3) + self.scalar() for _ in range(self.group.dim)
        )

    def element(self) -> tuple[Any, ...]:
        """Return a group element: a product of two exponentials."""
        exp = self.group.exp
        return self.group.mul(self.domain, exp(self.domain, self.vector()), exp(self.domain, self.vector()))

    def equal(self, a: tuple[Any, ...], b: tuple[Any, ...]) -> bool:
        """Return True if two tuples agree: exactly, or to rounding relative to the larger."""
        pairs = list(zip(a, b, strict=True))
        if isinstance(self.domain, SeriesDomain):
            return all(self.domain.ring.is_zero(x - y) is True for x, y in pairs)
        scale = max(1, *(abs(x) for x in a), *(abs(x) for x in b))
        return all(abs(x - y) <= self.tolerance * scale for x, y in pairs)


SAMPLES = (
    "doubles, uniform",
    "doubles, near the identity",
    "doubles, half a turn",
    "doubles, one axis",
    "40 digits, uniform",
    "40 digits, near the identity",
    "exact, series",
)


def sampler(group: Any, sample: str, seed: int = 0) -> Sampler:
    """Return the sampler of that name."""
    numbers, kind = sample.split(", ")
    rng = random.Random(f"{group.name} {sample} {seed}")
    if numbers == "doubles":
        return Sampler(group, FloatDomain(0.1), kind, 1e-13, rng)
    if numbers == "40 digits":
        return Sampler(group, PreciseDomain(Fraction(1, 10), 40), kind, 1e-37, rng)
    return Sampler(group, SeriesDomain(QQ, ORDER), kind, 0, rng)


def inverse(group: Any, d: Any, g: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return g^-1, independently of the group's own operations where it can be."""
    if isinstance(group, Cotangent):
        a = inverse(group.base, d, g[: group.base.size])
        moved = group.base.Adtinv(d, a, g[group.base.size :])
        return a + tuple(-m for m in moved)
    if isinstance(group, Rn):
        return tuple(-x for x in g)
    if isinstance(group, Product):
        pairs = zip(group.factors, group.parts(g), strict=True)
        return tuple(x for factor, own in pairs for x in inverse(factor, d, own))
    if isinstance(group, S3):
        return (g[0], *(-x for x in g[1:]))
    if isinstance(group, Semidirect):
        q, a = g[: group.linear.size], g[group.linear.size :]
        back = inverse(group.linear, d, q)
        moved = group.move(d, back + tuple(x * 0 for x in a), a)
        return back + tuple(-x for x in moved)
    if isinstance(group, SO2):
        return (g[0], -g[1])
    if isinstance(group, SE2):
        c, s, a, b = g
        return (c, -s, -(c * a + s * b), s * a - c * b)
    return invert(d, g, round(group.size**0.5))


def quadratic(rng: random.Random, symbols: Any, terms: int = 6) -> Any:
    """Return a random polynomial of degree two with small integer coefficients."""
    total = rng.randint(-2, 2) + sum(rng.randint(-2, 2) * s for s in symbols)
    for _ in range(terms):
        total += rng.choice((-2, -1, 1, 2)) * rng.choice(symbols) * rng.choice(symbols)
    return total


def polynomials(rng: random.Random, n: int, degree: int = 6) -> list[Any]:
    """Return n random polynomials in the time; their degree exceeds that of quadrature rules of order six."""
    t = Symbol("t") / 2
    return [sum(rng.choice((-2, -1, 1, 2)) * t**k for k in range(degree + 1)) / 2 for _ in range(n)]


def rationals(rng: random.Random, n: int) -> list[Any]:
    """Return n small rational numbers, none of them zero."""
    return [Rational(rng.choice((-3, -2, -1, 1, 2, 3)), rng.randint(1, 4)) for _ in range(n)]


def quarter_turn() -> Any:
    """Return a rational rotation without symmetry: Cayley's of (1, 2, -1)/2."""
    x = Matrix([[0, 1, 2], [-1, 0, -1], [-2, 1, 0]]) / 2
    return (Matrix.eye(3) - x).inv() * (Matrix.eye(3) + x)


def field_scene(name: str, seed: int = 0, time: bool = False) -> Any:
    """Return a polynomial field: on ``R^3``, on ``S^2`` and its axis (SO(3) by rotation), on ``GL(2)``."""
    rng = random.Random(f"{name} {seed}")
    group, action, n = {
        "R^3": (Rn(3), LeftMultiplication(), 3),
        "S^2": (SO3(), Rotation(), 3),
        "SO(3)": (SO3(), LeftMultiplication(), 9),
        "GL(2)": (GL(2), LeftMultiplication(), 4),
        "Heisenberg": (heisenberg(), Rotation(), 3),
        "S^3": (S3(), LeftMultiplication(), 4),
        "SL(2)": (SL2(), Linear(), 2),
        "SE(2)": (SE2(), Motion(), 2),
        "SO(3) x R^2": (Product(SO3(), Rn(2)), LeftMultiplication(), 11),
    }[name]
    y = [Symbol(f"y{k}", real=True) for k in range(n)]
    f = [quadratic(rng, y) + (Symbol("t") * rng.choice(y) if time else 0) for _ in range(group.dim)]
    start = {"SO(3)": quarter_turn(), "SO(3) x R^2": quarter_turn(), "S^3": UNIT}.get(name, [])
    y0 = [*start, *rationals(rng, n - len(start))]
    return FieldScene(group=group, action=action, y=Matrix(y), f=Matrix(f), y0=y0, span=(0, 1), name=name)


def linear_scene(name: str, action: Any = None, y0: Any = None, seed: int = 0, degree: int = 6) -> Any:
    """Return y' = A(t).y with a random polynomial A: by default a group acting on itself from the left."""
    rng = random.Random(f"linear {name} {seed}")
    group, on = ALL_GROUPS[name], action or LeftMultiplication()
    start = group.identity(FloatDomain(0.0)) if y0 is None else y0
    y = [Symbol(f"y{k}", real=True) for k in range(len(start))]
    f = polynomials(rng, group.dim, degree)
    exact = [Rational(*Fraction(x).as_integer_ratio()) for x in start]
    return FieldScene(group=group, action=on, y=y, f=f, y0=exact, span=(0, 1), name=f"linear on {name}")


def hamiltonian_scene(name: str, seed: int = 0, time: bool = False) -> Any:
    """Return a cubic Hamiltonian without symmetry on T*G, for G one of :data:`BASE_GROUPS`."""
    rng = random.Random(f"{name} {seed}")
    group = BASE_GROUPS[name]
    q, mu = group.point("q"), group.dual("p")
    H = quadratic(rng, list(mu)) + quadratic(rng, list(q))
    for _ in range(5):
        H += rng.choice((-1, 1)) * rng.choice(q) * rng.choice(mu) * rng.choice((*q, *mu))
    if time:
        H += Symbol("t") * (rng.choice(q) + rng.choice(mu) * rng.choice(mu))
    start = {
        "SO(3)": lambda: list(quarter_turn()),
        "R^3": lambda: rationals(rng, 3),
        "GL(2)": lambda: [1, Rational(1, 2), Rational(-1, 3), 1],
        "Heisenberg": lambda: [1, Rational(1, 2), 2, 0, 1, Rational(-1, 3), 0, 0, 1],
        "S^3": lambda: UNIT,
        "SE(2)": lambda: [Rational(3, 5), Rational(-4, 5), *rationals(rng, 2)],
        "SL(2)": lambda: [2, Rational(1, 2), 2, 1],
        "SO(3) x R^2": lambda: [*quarter_turn(), *rationals(rng, 2)],
    }[name]()
    mu0 = rationals(rng, group.dim)
    return HamiltonianScene(group=group, q=q, mu=mu, H=H, q0=start, mu0=mu0, span=(0, 1), name=f"T*{name}")


def top_scene(B: Any, w: Any = (0, 0, 0), body: bool = True) -> Any:
    """Return a top P.BP/2 + w.P + V on T*SO(3) in its two parts, P the momentum in the body or in space."""
    group = SO3()
    g, mu = group.point("g"), group.dual("mu")
    P = g.T * mu if body else mu
    T, V = P.dot(Matrix(B) * P) / 2 + Matrix(w).dot(P), g[2, 1] + g[0, 0] * g[1, 2]
    return HamiltonianScene(
        group=group,
        q=g,
        mu=mu,
        H=T + V,
        parts={"T": T, "V": V},
        q0=quarter_turn(),
        mu0=[1, Rational(1, 2), Rational(-2, 3)],
        span=(0, 1),
        name="top",
    )


def butcher(name: str, A: Any, b: Any) -> Tableau:
    """Return a tableau with rational coefficients given by spellings."""
    rows = [*A, b]
    exact = [tuple(QQ.rational(*Fraction(x).as_integer_ratio()) for x in row) for row in rows]
    return Tableau(name, "rk", QQ, RungeKutta(tuple(exact[:-1]), exact[-1]))


UNIT = [Rational(k, 9) for k in (2, 4, -5, 6)]
"""A quaternion of length one."""


def full(s: int, seed: int = 0) -> Tableau:
    """Return a random implicit tableau without zeros, of order 1: the weights add up to 1."""
    rng = random.Random(f"full {s} {seed}")

    def entry() -> Fraction:
        return Fraction(rng.choice((-3, -2, -1, 1, 2, 3)), rng.randint(2, 5))

    A = [[entry() for _ in range(s)] for _ in range(s)]
    while True:
        b = [entry() for _ in range(s - 1)]
        b.append(1 - sum(b))
        if b[-1]:
            return butcher(f"full{s}", A, b)


def full_exponentials(s: int, seed: int = 0) -> Tableau:
    """Return a random commutator-free tableau of order 1: two exponentials everywhere, no zeros.

    The second stage starts from the first.
    """
    rng = random.Random(f"exponentials {s} {seed}")

    def row() -> tuple[Any, ...]:
        return tuple(QQ.rational(rng.choice((-3, -2, -1, 1, 2, 3)), rng.randint(3, 5)) for _ in range(s))

    stages = tuple(Stage(0 if i == 1 else None, (row(), row())) for i in range(s))
    first = row()
    rest = [QQ.one - sum(first, QQ.zero), *(QQ.rational(1, k + 4) for k in range(s - 1))]
    rest[0] = rest[0] - sum(rest[1:], QQ.zero)
    return Tableau(f"cf_full{s}", "cf", QQ, CommutatorFree(stages, Stage(None, (first, tuple(rest)))))


def shipped(name: str) -> Tableau:
    """Return a tableau of the library."""
    return Tableau.load(find(name))


def starting(scene: Any, domain: Any) -> dict[str, Any]:
    """Return the inputs of a program at a scene's initial state, at the time 1/3."""
    values, first, coordinates = {"t": domain.rational(1, 3)}, 0, scene.initial(domain)
    for block in scene.state:
        values[block.name] = coordinates[first : first + len(block.symbols)]
        first += len(block.symbols)
    return values


def same(scene: Any, before: Any, after: Any, ring: Any = QQ, order: int = 4) -> bool:
    """Return True if two programs compute equal steps: exact in power series, and up to rounding in
    doubles."""
    exact = SeriesDomain(ring, order)
    results = [interpret(p, scene, exact, starting(scene, exact)) for p in (before, after)]
    assert sorted(results[0]) == sorted(results[1])
    pairs = [pair for n in results[0] for pair in zip(results[0][n], results[1][n], strict=True)]
    if not all(exact.ring.is_zero(x - y) is True for x, y in pairs):
        return False
    doubles = FloatDomain(2.0**-8)
    results = [interpret(p, scene, doubles, starting(scene, doubles)) for p in (before, after)]
    pairs = [pair for n in results[0] for pair in zip(results[0][n], results[1][n], strict=True)]
    return all(abs(x - y) < 1e-12 * max(1.0, abs(x)) for x, y in pairs)


def lowered(family: str, tableau: Any, scene: Any, cutoff: int | None = None) -> tuple[Any, Any]:
    """Return the problem and the program of a method on a scene, before all passes."""
    made = shipped(tableau) if isinstance(tableau, str) else tableau
    method = Method(family, made, cutoff)
    return problem_for(scene, method), lower(scene, method)
