# 8: velocity[0] is 1.0 where y0 = 1.0, y1 = 0.0, y2 = 0.0, t = 0.0; expected 0.0, from f.y
from sympy import Matrix, symbols

from codegen.groups import SO3, Rotation
from codegen.scene import FieldScene

y = Matrix(symbols("y0:3", real=True))
scene = FieldScene(group=SO3(), action=Rotation(), y=y, f=y, y0=[1, 0, 0], span=(0, 1), velocity=y)
