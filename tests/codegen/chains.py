"""Chains and lattices for tests."""

from functools import cache

from sympy import Matrix, Rational, Symbol, sin, symbols, zeros

from codegen.groups import SO3, Rotation
from codegen.scene import SiteScene, left, neighbour, param, right

S = Matrix(symbols("S0:3", real=True))
START = [Rational(3, 5), 0, Rational(4, 5)]


def spins(offsets, name, extra=None, **options):
    """Return damped spins that are coupled to the neighbours with these offsets."""
    K, alpha = param("K", Rational(1, 2)), param("alpha", Rational(1, 10))
    around = sum((neighbour(S, offset) for offset in offsets), zeros(3, 1))
    H = around + Matrix([0, 0, K * S[2] + Rational(1, 5)]) + (extra or zeros(3, 1))
    given = {"group": SO3(), "action": Rotation(), "y": S, "f": H + alpha * S.cross(H), "y0": START}
    return SiteScene(**(given | {"span": (0, 4), "name": name} | options))


@cache
def chain():
    """Return a periodic chain of spins."""
    return spins([(1,), (-1,)], "chain", invariants={"length": S.dot(S)})


@cache
def open_chain():
    """Return a chain of spins with a driven end and a free end."""
    t = Symbol("t")
    ends = {(-1,): [sin(t), 0, Rational(1, 2)], (1,): [0, 0, 0]}
    return spins([(1,), (-1,)], "open_chain", Matrix([sin(t), 0, 0]), boundary="open", outside=ends)


@cache
def plane():
    """Return a periodic plane lattice with neighbours at several distances."""
    return spins([(1, 0), (-1, 0), (0, 1), (0, -2), (1, 1)], "plane")


@cache
def open_plane():
    """Return an open plane lattice whose outside depends on the site."""
    ends = {(1, 0): [0, 0, 0], (-1, 0): S, (0, 1): [0, S[0] / 2, 0], (0, -1): 2 * S}
    return spins(list(ends), "open_plane", boundary="open", outside=ends)


@cache
def oscillators():
    """Return a chain of pendulums in R^2, coupled by springs, with one clamped end."""
    from codegen.groups import LeftMultiplication, Rn

    y = Matrix(symbols("q p", real=True))
    q, p = y
    force = left(y)[0] - 2 * q + right(y)[0] - sin(q)
    return SiteScene(
        group=Rn(2),
        action=LeftMultiplication(),
        y=y,
        f=[p, force],
        y0=[1, 0],
        span=(0, 1),
        boundary="open",
        outside={(-1,): [0, 0], (1,): y},
        name="oscillators",
    )
