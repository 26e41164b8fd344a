# 10: 9 coordinates of q and 2 of mu; expected 9 and 3 coordinates for SO(3)
from sympy import Matrix, symbols

from codegen.groups import SO3
from codegen.scene import HamiltonianScene

G = SO3()
q, mu = G.point("q"), G.dual("mu")
p = Matrix(symbols("p0:2"))
scene = HamiltonianScene(group=G, q=q, mu=p, H=p[0], q0=Matrix.eye(3), mu0=[1, 0], span=(0, 1))
