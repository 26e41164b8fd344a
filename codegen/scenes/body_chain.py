"""Chain of rigid bodies with elastic ball joints, on T*SE(3). The chain hangs under gravity.

Each body has joints at x + R b and x - R b, where x is its centre of mass, R its rotation matrix, and b a
constant vector. A stiff spring joins the point x - R b of a body to the point x' + R' b of the next body. The
spring replaces the constraint of a ball joint (R. Grossman, P. S. Krishnaprasad and J. E. Marsden 1988, see
``coupled_rigid_bodies``). A spring joins the point x + R b of the first body to the origin. The end of the
chain is free.
"""

from sympy import Matrix, Rational, eye

from codegen.groups import SE3
from codegen.scene import Bond, HamiltonianSiteScene, neighbour, param

G = SE3()
q, mu = G.point("q"), G.dual("mu")
R, x, p = Matrix(3, 3, q[:9]), Matrix(q[9:]), Matrix(mu[3:])
b = Matrix([0, 0, Rational(1, 2)])
inertia = (Rational(1, 5), Rational(1, 4), Rational(1, 10))
P = R.T * (Matrix(mu[:3]) - x.cross(p))
kinetic = sum(P[a] ** 2 / (2 * inertia[a]) for a in range(3)) + p.dot(p) / 2
weight = param("g", 1) * x[2]
near = neighbour(q, (1,))
gap = (x - R * b) - (Matrix(near[9:]) + Matrix(3, 3, near[:9]) * b)

scene = HamiltonianSiteScene(
    title="Chain of rigid bodies with elastic ball joints, on T*SE(3)",
    group=G,
    q=q,
    mu=mu,
    H=kinetic + weight,
    parts={"kinetic": kinetic, "weight": weight},
    bonds=[Bond((1,), param("k", 500) * gap.dot(gap) / 2)],
    q0=[*eye(3), 0, 0, Rational(-1, 2)],
    mu0=[0, 1, 0, 0, 0, 0],
    span=(0, 1),
    boundary="open",
    outside={(-1,): [*eye(3), *b], (1,): [*R, *(x - 2 * R * b)]},
)
