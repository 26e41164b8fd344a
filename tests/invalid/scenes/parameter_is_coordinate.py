# 9: the parameter y1 has the name of a coordinate
from sympy import Matrix, symbols

from codegen.groups import SO3, Rotation
from codegen.scene import FieldScene, param

y = Matrix(symbols("y0:3", real=True))
a = param("y1", 1)
scene = FieldScene(group=SO3(), action=Rotation(), y=y, f=a * y, y0=[1, 0, 0], span=(0, 1))
