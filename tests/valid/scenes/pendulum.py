"""A spherical pendulum whose support moves, with everything that a scene may hold."""

from sympy import Matrix, Rational, Symbol, cos, sqrt

from codegen.groups import SO3
from codegen.scene import HamiltonianScene, param

G = SO3()
g, mu = G.point("g"), G.dual("mu")
length, rate = param("length", Rational(3, 2)), param("rate", 2)
V = length * (g * Matrix([0, 0, 1]))[2] * (1 + cos(rate * Symbol("t")) / 4)

scene = HamiltonianScene(
    title="Pendulum with a moving support",
    group=G,
    q=g,
    mu=mu,
    H=mu.dot(mu) / 2 + V + 1 / sqrt(4 + g[2, 0] ** 2),
    parts={"T": mu.dot(mu) / 2, "V": V, "W": 1 / sqrt(4 + g[2, 0] ** 2)},
    q0=Matrix.eye(3),
    mu0=[length, 0, Rational(1, 2)],
    span=(0, 10),
    invariants={"vertical": mu[2]},
)
