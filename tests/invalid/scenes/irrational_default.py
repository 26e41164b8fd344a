# 8: parameter a: the default sqrt(2); expected a rational number
from sympy import Matrix, symbols

from codegen.groups import SO3, Rotation
from codegen.scene import FieldScene, param

y = Matrix(symbols("y0:3", real=True))
a = param("a", "sqrt(2)")
scene = FieldScene(group=SO3(), action=Rotation(), y=y, f=a * y, y0=[1, 0, 0], span=(0, 1))
