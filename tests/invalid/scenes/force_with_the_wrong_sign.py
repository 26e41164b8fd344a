# 10: n[0] is 1.0 where g00 = 1.0, g01 = 0.0, g02 = 0.0, t = 0.0; expected -1.0, from the derivatives of H
from sympy import Matrix, eye

from codegen.groups import SO3
from codegen.scene import HamiltonianScene

G = SO3()
g, mu = G.point("g"), G.dual("mu")
e2, e3 = Matrix([0, 1, 0]), Matrix([0, 0, 1])
scene = HamiltonianScene(
    group=G,
    q=g,
    mu=mu,
    H=mu.dot(mu) / 2 + e3.dot(g * e2),
    q0=eye(3),
    mu0=[1, 0, 0],
    span=(0, 1),
    n=e3.cross(g * e2) * -1,
)
