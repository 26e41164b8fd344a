"""Duffing's equation in the frame of SL(2) acting linearly on the plane: a step keeps the stiffness constant.

f = X - (1 + x^2) Y (H. Marthinsen's thesis, section 2.2), where X and Y are the off-diagonal unit matrices.
At constant stiffness the flow is a linear oscillation with the frequency sqrt(1 + x^2), which preserves area.
``duffing`` explains the role of the frame.
"""

from codegen.groups import SL2, Linear
from codegen.scenes.duffing import duffing, x

scene = duffing("SL(2) acting linearly", SL2(), Linear(), [1, -1 - x**2, 0])
