"""Free rigid body: the angular momentum on its sphere, SO(3) acting by rotation.

H. Marthinsen's thesis, section 2.8: m' = f(m) x m with f = -I^-1 m; adding alpha m to f (isotropy, eq. 2.19)
leaves the field as it is but makes another method.
"""

from sympy import Matrix, Rational, cos, diag, sin

from codegen.groups import SO3, Rotation
from codegen.scene import FieldScene, param

G = SO3()
m = G.dual("m")
I = diag(2, 1, Rational(2, 3))  # noqa: E741 (the inertia tensor's name)
alpha = param("alpha", 0)
w = Rational(11, 10)

scene = FieldScene(
    title="Free rigid body on the sphere (thesis section 2.8)",
    group=G,
    action=Rotation(),
    y=m,
    f=-I.inv() * m + alpha * m,
    y0=Matrix([cos(w), 0, sin(w)]),
    span=(0, 2),
    invariants={"radius": m.dot(m), "energy": m.dot(I.inv() * m) / 2},
)
