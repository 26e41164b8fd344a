# 8: a coordinate of the initial state is not a finite real number; expected real numbers
from sympy import Matrix, log, symbols

from codegen.groups import LeftMultiplication, Rn
from codegen.scene import FieldScene, param

y, a = Matrix(symbols("y0:1", real=True)), param("a", -1)
scene = FieldScene(group=Rn(1), action=LeftMultiplication(), y=y, f=y, y0=[log(a)], span=(0, 1))
