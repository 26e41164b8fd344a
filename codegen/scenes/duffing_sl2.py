"""Duffing's equation as a field of SL(2), acting linearly on the plane: a step keeps the stiffness constant.

The field is f = X - (1 + x^2) Y (H. Marthinsen's thesis, section 2.2), where X and Y are the off-diagonal
unit matrices. If the stiffness is constant, the flow is a linear oscillation with the frequency sqrt(1 +
x^2), and the flow preserves area. The scene ``duffing`` explains the role of the group.
"""

from codegen.groups import SL2, Linear
from codegen.scenes.duffing import duffing, x

scene = duffing("SL(2) acting linearly", SL2(), Linear(), [1, -1 - x**2, 0])
