"""Two free rigid bodies coupled by a ball joint, on T*(SO(3) x SO(3)).

The common centre of mass of the two bodies is at rest. The joint is at the point d_k of body k, on a
principal axis of the body. Body k has the inertia J_k, the attitude g_k, and the angular momentum P_k in the
body frame. The reduced mass of the two bodies is eps. The Hamiltonian is

    H = (sum_k P_k.w_k - b.S^-1 b)/2,    w_k = J_k^-1 P_k,    b = g_2 (w_2 x d_2) - g_1 (w_1 x d_1),
    S = E/eps + sum_k g_k C_k g_k^T,     C_k = hat(d_k)^T J_k^-1 hat(d_k).

Here E is the identity matrix, and hat(d) is the matrix of v -> d x v. The energy and the total angular
momentum are conserved.

R. Grossman, P. S. Krishnaprasad and J. E. Marsden, The dynamics of two coupled rigid bodies, in: Dynamical
Systems Approaches to Nonlinear Problems in Systems and Circuits (SIAM, 1988), 373-378.
"""

from sympy import Matrix, Rational, diag, eye

from codegen.groups import SO3, Product
from codegen.scene import HamiltonianScene, param

G = Product(SO3(), SO3())
q, mu = G.point("q"), G.dual("mu")
g1, g2, mu1, mu2 = (Matrix(3, 3, q[:9]), Matrix(3, 3, q[9:]), Matrix(mu[:3]), Matrix(mu[3:]))
J1, J2, eps = (
    diag(1, 2, Rational(5, 2)),
    diag(Rational(3, 2), Rational(1, 2), 1),
    param("eps", Rational(1, 2)),
)
d1, d2 = Matrix([0, 0, 1]), Matrix([Rational(3, 4), 0, 0])


def resistance(d: Matrix, J: Matrix) -> Matrix:
    """Return hat(d)^T J^-1 hat(d), where hat(d) is the matrix of v -> d x v."""
    hat = Matrix([[0, -d[2], d[1]], [d[2], 0, -d[0]], [-d[1], d[0], 0]])
    return hat.T * J.inv() * hat


# The vector b and the matrix S are in the frame of the first body.
P1, P2, Q = g1.T * mu1, g2.T * mu2, g1.T * g2
w1, w2 = J1.inv() * P1, J2.inv() * P2
b = Q * w2.cross(d2) - w1.cross(d1)
S = eye(3) / eps + resistance(d1, J1) + Q * resistance(d2, J2) * Q.T
x, y, z = S[:, 0], S[:, 1], S[:, 2]
adjugate = Matrix([y.cross(z).T, z.cross(x).T, x.cross(y).T])
relief = b.dot(adjugate * b) / x.dot(y.cross(z))

scene = HamiltonianScene(
    title="Two rigid bodies coupled by a ball joint, T*(SO(3) x SO(3))",
    group=G,
    q=q,
    mu=mu,
    H=(P1.dot(w1) + P2.dot(w2) - relief) / 2,
    q0=[*eye(3), *eye(3)],
    mu0=[1, Rational(-1, 2), Rational(3, 2), Rational(-1, 2), 1, Rational(1, 2)],
    span=(0, 2),
    invariants={f"momentum_{axis}": mu[k] + mu[k + 3] for k, axis in enumerate("xyz")},
)
