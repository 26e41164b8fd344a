"""Duffing's equation in the frame of SE(2), rigid motions of the plane: the cubic force as it is now.

f = E_1 - x^3 E_2 of H. Marthinsen's thesis, section 2.2, E_1 = y d/dx - x d/dy a rotation, E_2 = d/dy a
translation; ``duffing`` says what the frame means. The linear part of the equation is solved exactly.
"""

from codegen.groups import SE2, Motion
from codegen.scenes.duffing import duffing, x

scene = duffing("rigid motions of the plane", SE2(), Motion(), [-1, 0, -(x**3)])
