# 8: the signal u has the name of a parameter
from sympy import Symbol, symbols

from codegen.groups import LeftMultiplication, Rn
from codegen.scene import FieldScene, param, signal

x, y = symbols("x y", real=True)
scene = FieldScene(
    group=Rn(2),
    action=LeftMultiplication(),
    y=[x, y],
    f=[signal("u", Symbol("t")), param("u", 1) * y],
    y0=[1, 0],
    span=(0, 1),
)
