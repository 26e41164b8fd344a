# 9: a point with 4 coordinates
from sympy import Matrix, symbols

from codegen.groups import SO3, Rotation
from codegen.scene import FieldScene

y = Matrix(symbols("y0:3", real=True))
z = Matrix(symbols("z0:4"))
scene = FieldScene(group=SO3(), action=Rotation(), y=z, f=z[:3], y0=[1, 0, 0, 0], span=(0, 1))
