# 9: the initial state violates g^T g = 1 by 3.0; expected an element of T*SO(3)
from sympy import Matrix, diag

from codegen.groups import SO3
from codegen.scene import HamiltonianScene

G = SO3()
g, mu = G.point("g"), G.dual("mu")
scene = HamiltonianScene(
    group=G, q=g, mu=mu, H=mu.dot(mu), q0=diag(2, 1, 1), mu0=Matrix([1, 0, 0]), span=(0, 1)
)
