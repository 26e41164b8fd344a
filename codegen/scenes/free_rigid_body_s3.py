"""Free rigid body: the attitude is a unit quaternion, and S^3 acts on itself.

The equation is q' = f(q) q with f(q) = q v q^c and v = I^-1 E(q^c) m0/2 (H. Marthinsen's thesis, section
2.6). Here q^c is the conjugate of q, and E maps a unit quaternion to its rotation matrix. I is the inertia.
The angular momentum m0 in space is constant.

The initial angular velocity I^-1 m0 is (1, 1/2, -1), and the energy is 31.125. In the thesis, the exponent -1
of I is missing. The printed equation I m0 = (1, 1/2, -1) would give the energy 0.501.
"""

from sympy import Expr, Matrix, Rational, diag

from codegen.groups import S3, LeftMultiplication
from codegen.scene import FieldScene
from codegen.scene.figure import Deviation, PlaneCurves, Run

G = S3()
q = G.point("q")
I = diag(1, 5, 60)  # noqa: E741 (the inertia tensor's name)
m0 = I * Matrix([1, Rational(1, 2), -1])
axis = Matrix(q[1:])


def turned(real: Expr, v: Matrix) -> Matrix:
    """Return the vector v rotated by a unit quaternion.

    The real part of the quaternion is ``real``. The imaginary part is always ``axis``, a variable of this
    module.
    """
    c = 2 * axis.cross(v)
    return v + real * c + axis.cross(c)


m = turned(-q[0], m0)  # the angular momentum in the body frame

scene = FieldScene(
    title="Free rigid body with attitude, S^3",
    group=G,
    action=LeftMultiplication(),
    y=q,
    f=turned(q[0], I.inv() * m) / 2,
    y0=[1, 0, 0, 0],
    span=(0, 2),
    invariants={"length": q.dot(q), "energy": m.dot(I.inv() * m) / 2},
)

runs = (
    Run("discrete_gradient:midpoint", 1 / 64, 64_000, "discrete gradient, h = 1/64", stride=16),
    Run("ambient:dormand_prince5", 1 / 4, 4000, "Dormand-Prince, tolerance 1e-6", tolerance=1e-6),
    Run("ambient:dormand_prince5", 1 / 4, 4000, "Dormand-Prince, tolerance 1e-14", tolerance=1e-14),
    Run("rkmk(0):heun", 1 / 64, 64_000, "Heun RKMK, h = 1/64", stride=16),
)
figures = [
    PlaneCurves(
        name="momentum",
        title="Momentum in the body up to t = 1000, four methods",
        caption="Dots are states at time intervals of 1/4. The exact curve is closed, with m3 near -60.",
        source="Fig. 2.7 of Marthinsen's thesis",
        point=(m[0], m[1]),
        axes=("m₁", "m₂"),
        panels=True,
        dots=True,
        runs=runs,
    ),
    Deviation(
        name="energy",
        title="Energy error up to t = 1000, four methods",
        caption="The initial energy is 31.125. Heun RKMK leaves the energy surface, but stays on the group.",
        source="Fig. 2.7 of Marthinsen's thesis",
        quantity="energy",
        axis="largest energy error so far",
        runs=runs,
    ),
]
