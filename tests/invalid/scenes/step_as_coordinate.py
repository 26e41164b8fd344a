# 9: a symbol called h; expected another name; h is the step size
from sympy import Matrix, symbols

from codegen.groups import SO3, Rotation
from codegen.scene import FieldScene

y = Matrix(symbols("y0:3", real=True))
z = symbols("a h b")
scene = FieldScene(group=SO3(), action=Rotation(), y=z, f=list(z), y0=[1, 0, 0], span=(0, 1))
