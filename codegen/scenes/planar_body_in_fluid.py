"""Body in a planar ideal fluid: Kirchhoff's equations on se(2)*, under the coadjoint action of SE(2).

The state mu = (m, p, r) is the impulse of body and fluid in the frame of the body. The angular impulse is m,
and the linear impulse is (p, r). The Hamiltonian is H = m^2/(2 J) + p^2/(2 A) + r^2/(2 B) + D m p. J is the
moment of inertia, and D couples rotation and translation. The masses A and B include the added masses of the
fluid. The equation is mu' = ad*_{dH} mu (H. Lamb, Hydrodynamics, 6th edition, section 124; H. Marthinsen's
thesis, section 2.2.2).
"""

from sympy import Matrix, Rational, symbols

from codegen.groups import SE2, CoadjointAction
from codegen.scene import FieldScene, param

m, p, r = symbols("m p r", real=True)
J, A, B, D = param("J", 1), param("A", Rational(1, 3)), param("B", 2), param("D", Rational(1, 4))
H = m**2 / (2 * J) + p**2 / (2 * A) + r**2 / (2 * B) + D * m * p
w, u, v = (H.diff(x) for x in (m, p, r))

scene = FieldScene(
    title="Body in a planar ideal fluid, Kirchhoff's equations on se(2)*",
    group=SE2(),
    action=CoadjointAction(),
    y=[m, p, r],
    f=Matrix([-w, -u, -v]),
    y0=[1, Rational(1, 2), Rational(-2, 3)],
    span=(0, 4),
    velocity=[p * v - r * u, r * w, -p * w],
    invariants={"energy": H, "casimir": p**2 + r**2},
)
