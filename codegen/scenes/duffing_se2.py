"""Duffing's equation with the group SE(2): Lie-Euler keeps the cubic force constant in a step.

The field E_1 = (y, -x) generates rotations, and E_2 = (0, 1) generates translations. The vector field of the
equation is E_1 - x^3 E_2 (H. Marthinsen's thesis, section 2.2). In a step of Lie-Euler, the coefficient x^3
keeps its value from the beginning of the step. The flow with this constant coefficient is a rotation about a
point of the x-axis.
"""

from codegen.groups import SE2, Motion
from codegen.scenes.duffing import duffing, x

scene = duffing("rigid motions of the plane", SE2(), Motion(), [-1, 0, -(x**3)])
