"""Duffing's equation as a field of SE(2), the rigid motions of the plane: a step keeps the cubic force
constant.

The field is f = E_1 - x^3 E_2 (H. Marthinsen's thesis, section 2.2). Here E_1 = y d/dx - x d/dy generates
rotations, and E_2 = d/dy generates translations. The linear part of the equation is solved exactly. The scene
``duffing`` explains the role of the group.
"""

from codegen.groups import SE2, Motion
from codegen.scenes.duffing import duffing, x

scene = duffing("rigid motions of the plane", SE2(), Motion(), [-1, 0, -(x**3)])
