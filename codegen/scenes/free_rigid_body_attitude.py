"""Free rigid body with its attitude, on T*SO(3). The motions are geodesics of a left-invariant metric.

The equations are g' = g hat(W), W = I^-1 P and P' = P x W (Hairer and Vilmart 2006). Here g is the attitude,
I the inertia, and hat(W) the matrix of v -> W x v. W is the angular velocity and P the angular momentum, both
in the body frame. The right-trivialised momentum mu = g P is the constant angular momentum in space.
"""

from sympy import Matrix, Rational, diag, eye

from codegen.groups import SO3
from codegen.scene import HamiltonianScene

G = SO3()
g, mu = G.point("g"), G.dual("mu")
I = diag(Rational(3, 5), Rational(4, 5), 1)  # noqa: E741 (the inertia tensor's name)
P0 = Matrix([Rational(9, 5), Rational(2, 5), Rational(-9, 10)])
w = g * I.inv() * g.T * mu
T = mu.dot(w) / 2

scene = HamiltonianScene(
    title="Free rigid body with attitude, T*SO(3) (Hairer and Vilmart 2006)",
    group=G,
    q=g,
    mu=mu,
    H=T,
    parts={"T": T},
    q0=eye(3),
    mu0=P0,
    span=(0, 10),
    xi=w,
    n=mu.cross(w),
    invariants={f"momentum_{k}": mu[k] for k in range(3)},
)
