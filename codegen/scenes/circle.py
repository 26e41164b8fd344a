"""A point on a circle: Euler's method leaves the circle, and Lie-Euler stays on it.

The equation is z' = (w + a x) J z for z = (x, y), where J is the rotation by a right angle (H. Marthinsen's
thesis, Figure 1.1). The group SO(2) acts by rotation. In commands, Euler's method is ``ambient:euler`` and
Lie-Euler is ``rkmk(0):euler``.
"""

from sympy import Rational, symbols

from codegen.groups import SO2, LeftMultiplication
from codegen.scene import FieldScene, param
from codegen.scene.figure import PlaneCurves, Run

x, y = symbols("x y", real=True)
w, a = param("w", 1), param("a", Rational(1, 2))
f = w + a * x

scene = FieldScene(
    title="Point on a circle, SO(2)",
    group=SO2(),
    action=LeftMultiplication(),
    y=[x, y],
    f=[f],
    y0=[1, 0],
    span=(0, 3),
    velocity=[-f * y, f * x],
    invariants={"radius": x**2 + y**2},
)

figures = [
    PlaneCurves(
        name="spiral",
        title="Euler's method leaves the circle, Lie-Euler stays on it",
        caption="120 steps of size 1/10. The reference is the exact solution.",
        source="Fig. 1.1 of Marthinsen's thesis",
        point=(x, y),
        marked=True,
        runs=(
            Run("ambient:euler", 0.1, 120, "Euler"),
            Run("rkmk(0):euler", 0.1, 120, "Lie-Euler"),
        ),
        reference=Run("rkmk:butcher6", 0.02, 600),
    ),
]
