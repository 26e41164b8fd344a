"""A free rigid body as a Lie-Poisson system on so(3)*: m' = m x dH, with H = m.I^-1 m/2.

The coadjoint action has the velocity -ad*_x m = x cross m, so the generator is f = -dH.
"""

from sympy import Matrix, Rational, diag, symbols

from codegen.groups import SO3, CoadjointAction
from codegen.scene import FieldScene

m = Matrix(symbols("m0:3", real=True))
H = m.dot(diag(2, 1, Rational(2, 3)).inv() * m) / 2

scene = FieldScene(
    title="Free rigid body, Lie-Poisson",
    group=SO3(),
    action=CoadjointAction(),
    y=m,
    f=[-H.diff(x) for x in m],
    y0=[Rational(3, 5), Rational(1, 4), Rational(4, 5)],
    span=(0, 2),
    invariants={"energy": H, "casimir": m.dot(m)},
    velocity=m.cross(Matrix([H.diff(x) for x in m])),
)
