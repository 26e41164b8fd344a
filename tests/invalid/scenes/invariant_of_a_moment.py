# 9: the invariant energy changes at the rate
from sympy import Matrix, Symbol, symbols

from codegen.groups import LeftMultiplication, Rn
from codegen.scene import FieldScene

t = Symbol("t")
y = Matrix(symbols("y0:2", real=True))
scene = FieldScene(
    group=Rn(2),
    action=LeftMultiplication(),
    y=y,
    f=[y[1], -(1 + t) * y[0]],
    y0=[1, 0],
    span=(0, 1),
    invariants={"energy": y[1] ** 2 + (1 + t) * y[0] ** 2},
)
