# 8: the invariant height changes at the rate
from sympy import Matrix, symbols

from codegen.groups import SO3, Rotation
from codegen.scene import FieldScene

y = Matrix(symbols("y0:3", real=True))
scene = FieldScene(
    group=SO3(),
    action=Rotation(),
    y=y,
    f=[y[0], 2 * y[1], 3 * y[2]],
    y0=[1, 1, 0],
    span=(0, 1),
    invariants={"radius": y.dot(y), "height": y[2]},
)
