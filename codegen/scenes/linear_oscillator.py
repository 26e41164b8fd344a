"""Linear oscillator with a frequency that changes in time, on T*R^4: every family is classical there.

H = ((omega^2 + eps sin(alpha t)) q.q + p.p)/2 with omega = 1 (Paper 3 of Bogfjellmo's thesis, Table 4.1). On
R^n brackets vanish and exponentials are sums: RKMK, CG and CF methods are Runge-Kutta methods, variational
ones are symplectic partitioned ones. Time enters through the stages alone, so an error in the time of a
stage is visible at once.
"""

from sympy import Matrix, Rational, Symbol, sin

from codegen.groups import Rn
from codegen.scene import HamiltonianScene, param

G = Rn(4)
q, p = G.point("q"), G.dual("p")
eps, alpha, omega = param("eps", Rational(1, 10)), param("alpha", Rational(123, 1000)), param("omega", 1)
stiffness = omega**2 + eps * sin(alpha * Symbol("t"))
T, V = p.dot(p) / 2, stiffness * q.dot(q) / 2

scene = HamiltonianScene(
    title="Linear oscillator with changing frequency, T*R^4 (Paper 3)",
    group=G,
    q=q,
    mu=p,
    H=T + V,
    parts={"T": T, "V": V},
    q0=Matrix([1, 2, 3, 4]),
    mu0=Matrix([4, 1, 2, 3]),
    span=(0, 3),
    xi=p,
    n=-stiffness * q,
    invariants={"angular_momentum": q[0] * p[1] - q[1] * p[0]},
)
