# 10: both arguments "wrench" and "parts" are given; the parts are T
from sympy import eye

from codegen.groups import SO3
from codegen.scene import HamiltonianScene

G = SO3()
q, mu = G.point("q"), G.dual("mu")
T = mu.dot(mu) / 2
scene = HamiltonianScene(
    group=G, q=q, mu=mu, H=T, parts={"T": T}, wrench=[0, 0, 1], q0=eye(3), mu0=[1, 0, 0], span=(0, 1)
)
