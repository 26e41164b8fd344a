"""Chains with polynomial equations, and rational states of four sites that are all different."""

from __future__ import annotations

from fractions import Fraction
from functools import cache

from sympy import Matrix, Rational, Symbol, eye, symbols

from codegen.groups import SO3, FactorwiseAction, LeftMultiplication, Product, Rn, Rotation
from codegen.scene import Bond, HamiltonianSiteScene, Pair, SiteScene, left, neighbour, right
from tests.codegen.bodies import CLAMP, spinning
from tests.codegen.chains import S, spins

F = Fraction
T = Symbol("t")
CLAMPED = Rational(1, 3)


@cache
def pushed_spins():
    """Return an open chain of damped spins with a driven end, in a field that depends on time."""
    ends = {(-1,): [T, T**2, Rational(1, 2)], (1,): [S[1], 0, S[0]]}
    return spins([(1,), (-1,)], "pushed_spins", Matrix([T, 0, 0]), boundary="open", outside=ends)


def conservative_spins(**options):
    """Return an open chain of spins without damping; the total energy is constant."""
    H = left(S) + right(S) + Matrix([S[0] ** 2, 0, S[2] / 2 + Rational(1, 5)])
    given = {
        "group": SO3(),
        "action": Rotation(),
        "y": S,
        "f": H,
        "y0": [Rational(3, 5), 0, Rational(4, 5)],
        "span": (0, 1),
        "energy": -(S[0] ** 3) / 3 - S[2] ** 2 / 4 - S[2] / 5,
        "bonds": (Bond((1,), -S.dot(right(S))),),
        "boundary": "open",
        "outside": (1, 0, Rational(1, 2)),
        "name": "conservative_spins",
    }
    return SiteScene(**(given | options))


@cache
def paired_spins():
    """Return a periodic chain of spins whose bonds and fields have exact flows."""
    single, sum_of_pair = Matrix([0, 0, S[2] / 2 + Rational(1, 5)]), S + right(S)
    return SiteScene(
        group=SO3(),
        action=Rotation(),
        y=S,
        f=left(S) + right(S) + single,
        y0=[Rational(3, 5), 0, Rational(4, 5)],
        span=(0, 1),
        parts={"bonds": Pair((1,), sum_of_pair, sum_of_pair), "single": single},
        name="paired_spins",
    )


def unit_spins():
    """Return four points of the unit sphere."""
    pairs = [(F(1, 2), F(1, 3)), (F(-1, 4), F(2, 3)), (F(3, 2), F(1, 5)), (F(-2, 3), F(-1, 2))]
    return [[2 * a / (1 + r), 2 * b / (1 + r), (r - 1) / (1 + r)] for a, b in pairs for r in [a * a + b * b]]


def springs_with(name, kinetic, end=CLAMPED, stiffness=1):
    """Return an open chain of particles on a line, coupled by springs with cubic forces; one end has the
    position ``end``. ``kinetic`` is the kinetic energy as a function of the momentum."""
    G = Rn(1)
    (x,), (p,) = G.point("x"), G.dual("p")
    well = x**4 / 4 + x**3 / 3
    (y,) = neighbour([x], (1,))
    return HamiltonianSiteScene(
        group=G,
        q=[x],
        mu=[p],
        H=kinetic(p) + well,
        parts={"kinetic": kinetic(p), "well": well},
        bonds=[Bond((1,), stiffness * (y - x) ** 2 / 2 + (y - x) ** 4 / 4)],
        q0=[0],
        mu0=[Rational(1, 2)],
        span=(0, 1),
        boundary="open",
        outside={(-1,): [end], (1,): [x]},
        name=name,
    )


@cache
def quartic_springs():
    """Return the chain with the kinetic energy p^2/2."""
    return springs_with("quartic_springs", lambda p: p**2 / 2)


@cache
def driven_springs():
    """Return the chain with a driven end and springs whose stiffness depends on time."""
    return springs_with("driven_springs", lambda p: p**2 / 2, T**2 - T / 3, 1 + T)


@cache
def fast_springs():
    """Return the chain with a kinetic energy that is not quadratic."""
    return springs_with("fast_springs", lambda p: p**2 / 2 + p**4 / 4)


@cache
def driven_qubits():
    """Return an open chain of spins in a field that depends on the time, on a static detuning of the spin,
    and on those of its neighbours."""
    y = Matrix(symbols("S0:3 w", real=True))
    w, near, far = y[3], left(y)[3], right(y)[3]
    f = [w + T * near, T**2 - far * T, 1 + T * w * near + far / 2, 0]
    return SiteScene(
        group=Product(SO3(), Rn(1)),
        action=FactorwiseAction(Rotation(), LeftMultiplication()),
        y=y,
        f=f,
        y0=[1, 0, 0, 1],
        span=(0, 1),
        boundary="open",
        outside={(-1,): [0, 0, 0, T**3], (1,): [0, 0, 0, w / 2]},
        name="driven_qubits",
    )


def detuned_spins():
    """Return four points of the unit sphere, each with a detuning."""
    return [[*x, w] for x, w in zip(unit_spins(), (F(1), F(-1, 2), F(2), F(1, 3)), strict=True)]


@cache
def bent_springs():
    """Return a periodic chain of particles whose mass depends on the position."""
    G = Rn(1)
    (x,), (p,) = G.point("x"), G.dual("p")
    (y,) = neighbour([x], (1,))
    return HamiltonianSiteScene(
        group=G,
        q=[x],
        mu=[p],
        H=p**2 * (1 + x**2) / 2 + x * p**3 / 5,
        bonds=[Bond((1,), (y - x) ** 2 / 2 + y**2 * x / 3)],
        q0=[0],
        mu0=[Rational(1, 2)],
        span=(0, 1),
        name="bent_springs",
    )


def plane_states():
    """Return positions and momenta of four particles."""
    return [[F(1, 2), F(-1, 3)], [F(-1, 4), F(1)], [F(2, 3), F(1, 5)], [F(-1), F(-1, 2)]]


@cache
def turning_bodies():
    """Return a chain of asymmetric rigid bodies with fixed points. One end is clamped. The state outside the
    other end follows the last site, and exerts a force that has no energy."""
    q = SO3().point("q")
    return spinning(boundary="open", outside={(-1,): CLAMP, (1,): q * CLAMP}, name="turning_bodies")


@cache
def clamped_bodies():
    """Return the same chain with clamps at both ends."""
    ends = {(-1,): CLAMP, (1,): [1, 0, 0, 0, 0, -1, 0, 1, 0]}
    return spinning(boundary="open", outside=ends, name="clamped_bodies")


def frames():
    """Return four rotations, each with a momentum."""
    listed = []
    for a, b, c in ((1, 2, 0), (0, -1, 3), (2, 1, 1), (-1, 1, 2)):
        x = Matrix([[0, -c, b], [c, 0, -a], [-b, a, 0]]) / 6
        R = (eye(3) - x).inv() * (eye(3) + x)
        listed.append([F(int(e.p), int(e.q)) for e in R] + [F(a, 3), F(b, 4), F(c, 5)])
    return listed
