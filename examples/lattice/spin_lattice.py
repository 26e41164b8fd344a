"""Heisenberg spins on a plane lattice: the Landau-Lifshitz equation with exchange, anisotropy and damping.

Each site has a spin S of length one. It turns about the effective field H, the sum of J S over the four
neighbours, an anisotropy about the third axis, and an external field: S' = w x S with w = H + alpha S x H.
Without damping (alpha = 0) the energy is constant. The lattice is periodic.
"""

from sympy import Matrix, Rational, symbols, zeros

from codegen.groups import SO3, Rotation
from codegen.scene import SiteScene, neighbour, param

S = Matrix(symbols("S0:3", real=True))
J, K, B, alpha = param("J", 1), param("K", Rational(1, 2)), param("B", Rational(1, 5)), param("alpha", 0)
around = [neighbour(S, offset) for offset in ((1, 0), (-1, 0), (0, 1), (0, -1))]
H = J * sum(around, zeros(3, 1)) + Matrix([0, 0, K * S[2] + B])

scene = SiteScene(
    group=SO3(),
    action=Rotation(),
    y=S,
    f=H + alpha * S.cross(H),
    y0=[Rational(3, 5), 0, Rational(4, 5)],
    span=(0, 10),
    invariants={"length": S.dot(S)},
)
