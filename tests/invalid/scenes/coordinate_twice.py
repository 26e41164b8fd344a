# 9: two coordinates have the same symbol
from sympy import Matrix, symbols

from codegen.groups import SO3, Rotation
from codegen.scene import FieldScene

y = Matrix(symbols("y0:3", real=True))
z = [y[0], y[1], y[0]]
scene = FieldScene(group=SO3(), action=Rotation(), y=z, f=z, y0=[1, 0, 0], span=(0, 1))
