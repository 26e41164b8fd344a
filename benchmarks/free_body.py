"""A free rigid body on SE(3): attitude and position for constant momenta in space.

m is the angular momentum about the origin of space and p the linear momentum, so m - a x p is the angular
momentum about the centre of mass a. The angular velocity in space is w = R I^-1 R^T (m - a x p). The centre
has the velocity p/2 for a body of mass 2, and the velocity at the origin is u = p/2 - w x a.
"""

from sympy import Matrix, Rational, diag, eye

from codegen.groups import SE3, LeftMultiplication
from codegen.scene import FieldScene

G = SE3()
g = G.point("g")
R, a = Matrix(3, 3, list(g[:9])), Matrix(g[9:])
I = diag(Rational(3, 5), Rational(4, 5), 1)  # noqa: E741 (the inertia tensor's name)
m = Matrix([Rational(9, 5), Rational(2, 5), Rational(-9, 10)])
p = Matrix([1, 2, -1])
w = R * (I.inv() * (R.T * (m - a.cross(p))))

scene = FieldScene(
    title="Free rigid body with attitude and position, SE(3)",
    group=G,
    action=LeftMultiplication(),
    y=g,
    f=[*w, *(p / 2 - w.cross(a))],
    y0=[*eye(3), Rational(1, 2), 0, -1],
    span=(0, 1),
)
