"""Actuated rigid body: three thrusters or wheels turn a body.

In the space frame, the angular momentum mu satisfies mu' = g u. The vector u contains the torques in the body
frame, and the attitude g rotates the torques to the space frame. Each torque is a signal: a function of the
time t with a default formula. For actuated bodies see F. Bullo and A. D. Lewis, Geometric Control of
Mechanical Systems (Springer, 2005).
"""

from sympy import Matrix, Rational, Symbol, cos, diag, eye, sin

from codegen.groups import SO3
from codegen.scene import HamiltonianScene, signal

G = SO3()
g, mu, t = G.point("g"), G.dual("mu"), Symbol("t")
I = diag(Rational(3, 5), Rational(4, 5), 1)  # noqa: E741 (the inertia tensor's name)
P0 = Matrix([Rational(9, 5), Rational(2, 5), Rational(-9, 10)])
w = g * I.inv() * g.T * mu
formulas = (sin(t) / 2, Rational(1, 10), cos(2 * t) / 5)
u = Matrix([signal(f"u{k}", formula) for k, formula in enumerate(formulas)])

scene = HamiltonianScene(
    title="Rigid body turned by torques in the body frame, T*SO(3)",
    group=G,
    q=g,
    mu=mu,
    H=mu.dot(w) / 2,
    q0=eye(3),
    mu0=P0,
    span=(0, 5),
    xi=w,
    n=mu.cross(w),
    wrench=g * u,
)
