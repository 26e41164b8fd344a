# 8: floor(y0) has infinitely many jumps
from sympy import floor

from codegen.groups import LeftMultiplication, Rn
from codegen.scene import FieldScene

y = Rn(1).point("y")
scene = FieldScene(group=Rn(1), action=LeftMultiplication(), y=y, f=[floor(y[0])], y0=[1], span=(0, 1))
