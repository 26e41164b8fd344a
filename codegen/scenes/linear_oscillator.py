"""Linear oscillator with a time-dependent frequency, on T*R^4: every method reduces to a classical method.

The Hamiltonian is H = ((omega^2 + eps sin(alpha t)) q.q + p.p)/2 with omega = 1 (H. Marthinsen's thesis,
paper 3, Table 4.1). In the group R^4, brackets vanish, and exponentials are translations. Therefore RKMK, CG
and CF methods are Runge-Kutta methods, and variational methods are symplectic partitioned Runge-Kutta
methods.
"""

from dataclasses import replace
from fractions import Fraction

from sympy import Matrix, Rational, Symbol, sin

from codegen.groups import Rn
from codegen.scene import HamiltonianScene, param
from codegen.scene.run_time import with_runtime
from codegen.scene.stiff_variant import RADIANS, StiffVariant

G = Rn(4)
q, p = G.point("q"), G.dual("p")
eps, alpha, omega = param("eps", Rational(1, 10)), param("alpha", Rational(123, 1000)), param("omega", 1)
stiffness = omega**2 + eps * sin(alpha * Symbol("t"))
T, V = p.dot(p) / 2, stiffness * q.dot(q) / 2

scene = HamiltonianScene(
    title="Linear oscillator with changing frequency, on T*R^4",
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


def stiff_variants() -> list[StiffVariant]:
    """Return oscillators with the frequencies 1e3 and 1e6. Each one turns by RADIANS in its time span."""
    return [_oscillator(omega) for omega in (10**3, 10**6)]


def _oscillator(omega: int) -> StiffVariant:
    label = f"frequency {omega:.0e}"
    span = (Fraction(0), min(Fraction(3), Fraction(RADIANS, omega)))
    fast = replace(with_runtime(scene, (f"omega={omega}",)), span=span)
    return StiffVariant(f"oscillator at {label}", label, fast, float(omega))
