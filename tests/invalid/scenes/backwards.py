# 8: the span (1, 0); expected a start time less than the end time
from sympy import Matrix, symbols

from codegen.groups import SO3, Rotation
from codegen.scene import FieldScene

y = Matrix(symbols("y0:3", real=True))
scene = FieldScene(group=SO3(), action=Rotation(), y=y, f=y, y0=[1, 0, 0], span=(1, 0))
