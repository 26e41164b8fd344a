# 9: velocity[1] is 1.0 where y0 = 1.0, y1 = 0.0, y2 = 0.0, t = 0.0; expected -1.0, from f.y
from sympy import Matrix, symbols

from codegen.groups import SO3, Rotation
from codegen.scene import FieldScene

y = Matrix(symbols("y0:3", real=True))
e3 = Matrix([0, 0, 1])
scene = FieldScene(
    group=SO3(), action=Rotation(), y=y, f=-e3, y0=[1, 0, 0], span=(0, 1), velocity=e3.cross(y)
)
