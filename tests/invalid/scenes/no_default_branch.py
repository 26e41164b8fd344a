# 8: the Piecewise formula
from sympy import Piecewise

from codegen.groups import LeftMultiplication, Rn
from codegen.scene import FieldScene

y = Rn(1).point("y")
scene = FieldScene(
    group=Rn(1), action=LeftMultiplication(), y=y, f=[Piecewise((1, y[0] > 0))], y0=[1], span=(0, 1)
)
