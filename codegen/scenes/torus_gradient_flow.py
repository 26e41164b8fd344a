"""Gradient flow x' = -grad phi on a torus: SO(2) x SO(2) acts on pairs of points on circles.

The scene is from section 2.4.1 of H. Marthinsen's thesis (Figure 2.5). The points on the circles are (cos
theta, sin theta) and (cos varphi, sin varphi). The function phi = (y - 8)^2 with y = (1 + cos theta) sin
varphi is the squared distance of a point of the torus from the plane y = 8. Let gamma = dphi/dtheta and
delta = dphi/dvarphi. The velocity of (theta, varphi) is (-gamma, -delta). The thesis prints phi = |y - 8|,
but its gamma and delta are the derivatives of (y - 8)^2.
"""

from sympy import Matrix, Rational, atan2, cos, sin, symbols

from codegen.groups import SO2, LeftMultiplication, Product
from codegen.scene import FieldScene
from codegen.scene.figure import Run, TorusCurves

a = Matrix(symbols("a0:2", real=True))
b = Matrix(symbols("b0:2", real=True))
C = 2 * ((1 + a[0]) * b[1] - 8)
gamma, delta = -C * a[1] * b[1], C * (1 + a[0]) * b[0]

scene = FieldScene(
    title="Gradient flow on a torus, SO(2) x SO(2)",
    group=Product(SO2(), SO2()),
    action=LeftMultiplication(),
    y=[*a, *b],
    f=[-gamma, -delta],
    y0=[0, 1, Rational(3, 5), Rational(-4, 5)],
    span=(0, Rational(1, 2)),
    velocity=[gamma * a[1], -gamma * a[0], delta * b[1], -delta * b[0]],
    invariants={"first_radius": a.dot(a), "second_radius": b.dot(b)},
)

theta, varphi = symbols("theta varphi", real=True)
figures = [
    TorusCurves(
        name="flow",
        title="Gradient flow on the torus",
        caption="Arrows show -grad phi. Their length is sqrt(|grad phi|). The lines are levels of phi.",
        source="Fig. 2.5 of Marthinsen's thesis",
        angles=(atan2(b[1], b[0]), atan2(a[1], a[0])),
        axes=("φ", "θ"),
        variables=(varphi, theta),
        state=(cos(theta), sin(theta), cos(varphi), sin(varphi)),
        directions=(-delta, -gamma),
        levels=((1 + a[0]) * b[1] - 8) ** 2,
        runs=(Run("rkmk(2):rk4", 0.005, 200),),
    ),
]
