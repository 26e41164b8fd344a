"""Duffing's equation in the frame of SL(2) acting linearly on the plane: a spring as stiff as it is now.

f = X - (1 + x^2) Y of H. Marthinsen's thesis, section 2.2, X and Y the off-diagonal unit matrices;
``duffing`` says what the frame means. The field is frozen to linear oscillations of the frequency sqrt(1 +
x^2), and the area is kept.
"""

from codegen.groups import SL2, Linear
from codegen.scenes.duffing import duffing, x

scene = duffing("SL(2) acting linearly", SL2(), Linear(), [1, -1 - x**2, 0])
