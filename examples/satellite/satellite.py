"""A satellite on a circular orbit: gravity gradient, and torques of three reaction wheels in the body frame.

q rotates from the body to space, and mu is the angular momentum in space. The orbit has the rate 1, so a
revolution takes the time 2 pi. The Earth attracts the near side of the satellite more than the far side; e is
the direction from the Earth to the satellite.
"""

from sympy import Matrix, Rational, Symbol, cos, diag, eye, sin

from codegen.groups import SO3
from codegen.scene import HamiltonianScene, signal

G = SO3()
q, mu, t = G.point("q"), G.dual("mu"), Symbol("t")
inertia = diag(Rational(6, 5), 1, Rational(4, 5))
P = q.T * mu  # the momentum in the body
e = q.T * Matrix([cos(t), sin(t), 0])  # in the body
u = Matrix([signal(f"u{k}", 0) for k in range(3)])

scene = HamiltonianScene(
    title="Satellite with gravity gradient and reaction wheels, T*SO(3)",
    group=G,
    q=q,
    mu=mu,
    H=P.dot(inertia.inv() * P) / 2 + Rational(3, 2) * e.dot(inertia * e),
    q0=eye(3),
    mu0=Matrix([Rational(1, 2), Rational(-1, 4), 1]),
    span=(0, 2),
    wrench=q * u,
)
