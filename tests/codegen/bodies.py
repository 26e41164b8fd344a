"""Hamiltonian chains and lattices for tests."""

from functools import cache

from sympy import Matrix, Rational, eye

from codegen.groups import SE3, SO3, Product, Rn
from codegen.scene import Bond, HamiltonianScene, HamiltonianSiteScene, neighbour, param

CLAMP = Matrix([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
STIFFNESS = Matrix([[3, 1, 0], [0, 2, Rational(1, 2)], [0, 1, 1]])


def kinetic(R, mu):
    """Return the kinetic energy of a body in the frame R."""
    P = R.T * mu
    return P[0] ** 2 / 2 + P[1] ** 2 / 4 + P[2] ** 2 / 5


def bond(R, other):
    """Return an energy that is not symmetric in the two bodies."""
    weight = param("k", Rational(3, 2))
    return weight * (STIFFNESS.T * R.T * other).trace() + (R[:, 0].dot(other[:, 1])) ** 2 / 3


def potential(R):
    """Return the potential of one body."""
    return R[2, 2] + R[0, 1] * R[1, 1] / 2


def spinning(offsets=((1,),), **options):
    """Return asymmetric bodies, each with a fixed point, coupled to the neighbours with these offsets."""
    G = SO3()
    q, mu = G.point("q"), G.dual("mu")
    T, U = kinetic(q, Matrix(mu)), potential(q)
    given = {
        "group": G,
        "q": q,
        "mu": mu,
        "H": T + U,
        "parts": {"kinetic": T, "weight": U},
        "bonds": [Bond(o, bond(q, Matrix(3, 3, neighbour(q, o)))) for o in offsets],
        "q0": eye(3),
        "mu0": [1, Rational(1, 2), Rational(-1, 3)],
        "span": (0, 1),
        "name": "spinning",
    }
    return HamiltonianSiteScene(**(given | options))


@cache
def bodies():
    """Return a periodic chain."""
    return spinning()


@cache
def open_bodies():
    """Return a chain with a clamped end, and with another end at which the state outside follows the site."""
    q = SO3().point("q")
    return spinning(boundary="open", outside={(-1,): CLAMP, (1,): q * CLAMP}, name="open_bodies")


@cache
def sheet():
    """Return a periodic plane lattice with bonds along one axis and along a diagonal."""
    return spinning(((0, 1), (1, 1)), name="sheet")


def joined(number, pairs):
    """Return the Hamiltonian scene of bodies with bonds between the given pairs, without a lattice."""
    G = Product(*[SO3()] * number)
    q, mu = G.point("q"), G.dual("mu")
    Rs = [Matrix(3, 3, q[9 * i : 9 * i + 9]) for i in range(number)]
    T = sum(kinetic(R, Matrix(mu[3 * i : 3 * i + 3])) for i, R in enumerate(Rs))
    V = sum(potential(R) for R in Rs) + sum(bond(Rs[i], Rs[j]) for i, j in pairs)
    start = [*eye(3)] * number
    moments = [1, Rational(1, 2), Rational(-1, 3)] * number
    return HamiltonianScene(group=G, q=q, mu=mu, H=T + V, q0=start, mu0=moments, span=(0, 1), name="joined")


@cache
def springs():
    """Return a chain of bodies on SE(3) with springs between points beside their centres."""
    G = SE3()
    q, mu = G.point("q"), G.dual("mu")
    R, x = Matrix(3, 3, q[:9]), Matrix(q[9:])
    near = neighbour(q, (1,))
    other, y = Matrix(3, 3, near[:9]), Matrix(near[9:])
    p = Matrix(mu[3:])
    T = kinetic(R, Matrix(mu[:3]) - x.cross(p)) + p.dot(p) / 2
    arm = Matrix([Rational(1, 2), 0, Rational(1, 4)])
    gap = x + R * arm - y + other * arm
    return HamiltonianSiteScene(
        group=G,
        q=q,
        mu=mu,
        H=T,
        parts={"kinetic": T},
        bonds=[Bond((1,), 2 * gap.dot(gap))],
        q0=[*eye(3), 0, 0, 0],
        mu0=[0, 1, 0, 0, 0, 1],
        span=(0, 1),
        boundary="open",
        outside={(-1,): [*R, *(x - 2 * R * arm)], (1,): [*R, *(x + 2 * R * arm)]},
        name="springs",
    )


@cache
def string():
    """Return a periodic chain of points on a line, coupled by springs."""
    G = Rn(1)
    (x,), (p,) = G.point("x"), G.dual("p")
    return HamiltonianSiteScene(
        group=G,
        q=[x],
        mu=[p],
        H=p**2 / 2,
        parts={"kinetic": p**2 / 2},
        bonds=[Bond((1,), (neighbour([x], (1,))[0] - x) ** 2 / 2)],
        q0=[0],
        mu0=[Rational(1, 2)],
        span=(0, 1),
        name="string",
    )
