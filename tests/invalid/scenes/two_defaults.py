# 9: the parameter a has two default values
from sympy import Matrix, symbols

from codegen.groups import SO3, Rotation
from codegen.scene import FieldScene, param

y = Matrix(symbols("y0:3", real=True))
a, b = param("a", 1), param("a", 2)
scene = FieldScene(group=SO3(), action=Rotation(), y=y, f=[a, b, 0], y0=[1, 0, 0], span=(0, 1))
