"""A Lie-Poisson system on se(2)*: a rigid body in the plane with momenta of a fluid, mu' = -ad*_{dH} mu.

H = a m^2/2 + b p^2/2 + c r^2/2 + m p/4 for mu = (m, p, r). The action is the coadjoint action of SE(2), so a
step keeps the Casimir function p^2 + r^2 up to rounding.
"""

from sympy import Matrix, Rational, symbols

from codegen.groups import SE2, CoadjointAction
from codegen.scene import FieldScene

m, p, r = symbols("m p r", real=True)
H = m**2 / 2 + p**2 * Rational(3, 2) + r**2 / 4 + m * p / 4

scene = FieldScene(
    title="Lie-Poisson system on se(2)*",
    group=SE2(),
    action=CoadjointAction(),
    y=[m, p, r],
    f=Matrix([H.diff(x) for x in (m, p, r)]),
    y0=[1, Rational(1, 2), Rational(-2, 3)],
    span=(0, 4),
    invariants={"energy": H, "casimir": p**2 + r**2},
)
