"""A moving frame beside the point that it carries: SE(2) acts on itself and on the plane at once.

The point z and the frame have the same velocity field, which depends on both, so the point keeps its
coordinates in the frame.
"""

from sympy import Matrix, Rational, symbols

from codegen.groups import SE2, DiagonalAction, LeftMultiplication, Motion
from codegen.scene import FieldScene

G = SE2()
c, s, a, b = G.symbols("g")
z = Matrix(symbols("z0:2", real=True))
inside = Matrix([[c, s], [-s, c]]) * (z - Matrix([a, b]))

scene = FieldScene(
    title="Frame and trajectory",
    group=G,
    action=DiagonalAction(LeftMultiplication(), Motion()),
    y=[c, s, a, b, *z],
    f=[1 + z[0] / 2, c - z[1], s + a * z[0] / 4],
    y0=[1, 0, 0, 0, 1, Rational(1, 2)],
    span=(0, 2),
    invariants={"ahead": inside[0], "aside": inside[1]},
)
