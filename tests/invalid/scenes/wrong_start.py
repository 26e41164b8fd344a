# 8: y0 has 2 components; expected 3 components
from sympy import Matrix, symbols

from codegen.groups import SO3, Rotation
from codegen.scene import FieldScene

y = Matrix(symbols("y0:3", real=True))
scene = FieldScene(group=SO3(), action=Rotation(), y=y, f=y, y0=[1, 0], span=(0, 1))
