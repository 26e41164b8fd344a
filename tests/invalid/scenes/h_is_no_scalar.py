# 9: H has shape (3, 1); expected a scalar
from sympy import Matrix

from codegen.groups import SO3
from codegen.scene import HamiltonianScene

G = SO3()
q, mu = G.point("q"), G.dual("mu")
scene = HamiltonianScene(group=G, q=q, mu=mu, H=mu, q0=Matrix.eye(3), mu0=[1, 0, 0], span=(0, 1))
