# 8: 'y0' of type str is not a formula; expected a sympy formula or a number
from sympy import Matrix, symbols

from codegen.groups import SO3, Rotation
from codegen.scene import FieldScene

y = Matrix(symbols("y0:3", real=True))
scene = FieldScene(group=SO3(), action=Rotation(), y=y, f=["y0", 1, 2], y0=[1, 0, 0], span=(0, 1))
