"""Duffing's equation with the group SL(2): Lie-Euler keeps the stiffness constant in a step.

The equation is z' = f z for z = (x, y), with the matrix f = X - (1 + x^2) Y (H. Marthinsen's thesis, section
2.2). The matrix X has the entry 1 above the diagonal, Y has the entry 1 below the diagonal, and all other
entries are 0. For a constant stiffness 1 + x^2, the flow is a linear oscillation with the frequency
sqrt(1 + x^2).
"""

from codegen.groups import SL2, Linear
from codegen.scenes.duffing import duffing, x

scene = duffing("SL(2) acting linearly", SL2(), Linear(), [1, -1 - x**2, 0])
