# 8: the symbol y0 in y0[0] has no value; expected numbers and parameters
from sympy import Matrix, symbols

from codegen.groups import SO3, Rotation
from codegen.scene import FieldScene

y = Matrix(symbols("y0:3", real=True))
scene = FieldScene(group=SO3(), action=Rotation(), y=y, f=y, y0=[y[0], 0, 0], span=(0, 1))
