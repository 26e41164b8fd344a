"""Chains and lattices for tests."""

from functools import cache

from sympy import Matrix, Rational, Symbol, sin, symbols, zeros

from codegen.groups import GL, SO3, SU, Rotation
from codegen.ir.domain import FloatDomain
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


def links(group, name):
    """Return a chain of matrices whose field is a multiple of differences between neighbours."""
    from codegen.groups import LeftMultiplication

    y = group.point("y")
    n = group.dim
    change = [(a - b) / 2 for a, b in zip(left(y)[:n], right(y)[:n], strict=True)]
    one = [Rational(int(float(x))) for x in group.identity(FloatDomain(0.0))]
    return SiteScene(group=group, action=LeftMultiplication(), y=y, f=change, y0=one, span=(0, 1), name=name)


@cache
def special_unitary_chain():
    """Return a chain of matrices in SU(3)."""
    return links(SU(3), "special_unitary_chain")


@cache
def linear_group_chain():
    """Return a chain of matrices in GL(2)."""
    return links(GL(2), "linear_group_chain")
