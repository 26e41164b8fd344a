"""A field whose third coordinate stays zero, although its formula contains both others."""

from sympy import Matrix, Rational, symbols

from codegen.groups import LeftMultiplication, Rn
from codegen.scene import FieldScene

a, b, c = symbols("a b c")

scene = FieldScene(
    title="Third coordinate zero",
    group=Rn(3),
    action=LeftMultiplication(),
    y=Matrix([a, b, c]),
    f=Matrix([a / 3, a / 3, a - b + c**2]),
    y0=[Rational(1, 3), Rational(1, 3), 0],
    span=(0, 2),
)
