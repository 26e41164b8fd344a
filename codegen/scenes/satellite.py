"""Satellite with gravity gradient on a circular orbit, T*SO(3). The momenta of its wheels are input signals.

The matrix g rotates vectors from the body frame to space. The total angular momentum mu, in space, includes
the wheels. The angular momentum of the wheels, in the body frame, is h = (h0, h1, h2). The angular velocity w
and the inertia tensor J, in the body frame, satisfy J w = g^T mu - h.

Let r be the unit vector from the Earth to the satellite, and let n be the angular speed of r. In the body
frame, the torque of the gravity gradient is 3 n^2 r x J r (P. C. Hughes, Spacecraft Attitude Dynamics, 1986,
chapters 6 and 8).
The unit of time is 1/n.
"""

from sympy import Matrix, Rational, Symbol, cos, eye, sin

from codegen.groups import SO3
from codegen.scene import HamiltonianScene, signal

G = SO3()
g, mu, t = G.point("g"), G.dual("mu"), Symbol("t")
J = Matrix([[12, 1, -1], [1, 10, 1], [-1, 1, 8]]) / 10
h = Matrix([signal("h0", sin(t) / 5), signal("h1", cos(t) / 10), signal("h2", Rational(1, 5))])
P = g.T * mu - h
r = g.T * Matrix([cos(t), sin(t), 0])
w, torque = g * J.inv() * P, 3 * g * r.cross(J * r)

scene = HamiltonianScene(
    title="Satellite with gravity gradient and reaction wheels, T*SO(3)",
    group=G,
    q=g,
    mu=mu,
    H=P.dot(J.inv() * P) / 2 + Rational(3, 2) * r.dot(J * r),
    q0=eye(3),
    mu0=[Rational(1, 2), Rational(-1, 4), 1],
    span=(0, 3),
    xi=w,
    n=mu.cross(w) + torque,
)
