# 9: mu0[0] must be constant: replace t by a number
from sympy import Symbol, eye

from codegen.groups import SO3
from codegen.scene import HamiltonianScene

G = SO3()
q, mu = G.point("q"), G.dual("mu")
scene = HamiltonianScene(group=G, q=q, mu=mu, H=mu.dot(mu), q0=eye(3), mu0=[Symbol("t"), 0, 0], span=(0, 1))
