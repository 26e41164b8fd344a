# 9: the exponent in y0**(1/3) is not a multiple of 1/2; expected an integer or half-integer exponent
from sympy import Matrix, Rational, symbols

from codegen.groups import SO3, Rotation
from codegen.scene import FieldScene

y = Matrix(symbols("y0:3", real=True))
f = [v ** Rational(1, 3) for v in y]
scene = FieldScene(group=SO3(), action=Rotation(), y=y, f=f, y0=[1, 0, 0], span=(0, 1))
