# 8: f at the initial state is not a finite real number; expected an initial state where f is smooth
from sympy import Matrix, sqrt, symbols

from codegen.groups import LeftMultiplication, Rn
from codegen.scene import FieldScene

y = Matrix(symbols("y0:2", real=True))
scene = FieldScene(
    group=Rn(2), action=LeftMultiplication(), y=y, f=-y / sqrt(y.dot(y)) ** 3, y0=[0, 0], span=(0, 1)
)
