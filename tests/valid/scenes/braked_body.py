"""A body on a spring with play, in a medium whose drag is a table."""

from sympy import Abs, Max

from codegen.groups import LeftMultiplication, Rn
from codegen.scene import FieldScene, param, table

y = Rn(2).point("y")
x, v = y
drag = table([0, 0.5, 1.5, 3], [0, 0.02, 0.11, 0.4], Abs(v))
stiffness = param("stiffness", 1.25)

scene = FieldScene(
    group=Rn(2),
    action=LeftMultiplication(),
    y=y,
    f=[v, -stiffness * Max(x - 0.2, 0) + stiffness * Max(-x - 0.2, 0) - drag * v],
    y0=[1, 0.25],
    span=(0, 4),
)
