"""Spherical pendulum: a unit mass on a unit rod under unit gravity, carried by rotations of the rod.

The rod points along g e3; its momentum mu in space is that of the mass, so mu is orthogonal to the rod, and
stays so. H = mu.mu/2 + height. Energy, the momentum about the vertical and the spin about the rod are kept.
"""

from sympy import Matrix, Rational

from codegen.groups import SO3
from codegen.scene import HamiltonianScene

G = SO3()
g, mu = G.point("g"), G.dual("mu")
e3 = Matrix([0, 0, 1])
rod = g * e3
T, V = mu.dot(mu) / 2, e3.dot(rod)
g0 = Matrix([[1, 0, 0], [0, 0, 1], [0, -1, 0]])

scene = HamiltonianScene(
    title="Spherical pendulum, T*SO(3)",
    group=G,
    q=g,
    mu=mu,
    H=T + V,
    parts={"T": T, "V": V},
    q0=g0,
    mu0=Matrix([Rational(1, 5), 0, Rational(-4, 5)]),
    span=(0, 2),
    invariants={"momentum_about_vertical": mu[2], "spin_about_rod": mu.dot(rod)},
)
