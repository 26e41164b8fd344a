"""Body in an ideal fluid: Kirchhoff's equations on se(3)*, with the coadjoint action of SE(3).

The state (m, p) consists of the angular and the linear impulse of body and fluid, in the body frame. The
equations are m' = m x w + p x v and p' = p x w, with the angular velocity w = dH/dm and the velocity v =
dH/dp. The Hamiltonian is H = (m.J^-1 m + p.M^-1 p)/2 + m.C p with constant matrices J, M and C. The coadjoint
action preserves the Casimir functions p.p and m.p.

G. Kirchhoff, Ueber die Bewegung eines Rotationskoerpers in einer Fluessigkeit, Journal fuer die reine und
angewandte Mathematik 71 (1870), 237-262; H. Marthinsen's thesis, section 2.2.2.
"""

from sympy import Matrix, Rational, diag, symbols

from codegen.groups import SE3, CoadjointAction
from codegen.scene import FieldScene

m, p = Matrix(symbols("m0:3", real=True)), Matrix(symbols("p0:3", real=True))
J, M = diag(2, 1, Rational(2, 3)), diag(3, 2, 1)
C = Matrix([[Rational(1, 10), 0, 0], [0, 0, Rational(1, 5)], [0, Rational(1, 5), Rational(-1, 10)]])
H = (m.dot(J.inv() * m) + p.dot(M.inv() * p)) / 2 + m.dot(C * p)
w, v = (Matrix([H.diff(x) for x in part]) for part in (m, p))

scene = FieldScene(
    title="Body in an ideal fluid, Kirchhoff's equations on se(3)*",
    group=SE3(),
    action=CoadjointAction(),
    y=[*m, *p],
    f=[*(-w), *(-v)],
    y0=[1, Rational(1, 5), Rational(-1, 2), Rational(3, 5), Rational(-1, 2), Rational(4, 5)],
    span=(0, 4),
    velocity=[*(m.cross(w) + p.cross(v)), *p.cross(w)],
    invariants={"energy": H, "impulse": p.dot(p), "pitch": m.dot(p)},
)
