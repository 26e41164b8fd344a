# 9: the symbol w in f[0] has no value
from sympy import Matrix, symbols

from codegen.groups import SO3, Rotation
from codegen.scene import FieldScene

y = Matrix(symbols("y0:3", real=True))
w = symbols("w")
scene = FieldScene(group=SO3(), action=Rotation(), y=y, f=w * y, y0=[1, 0, 0], span=(0, 1))
