"""Geometrically exact rod on T*SE(3). The rod is clamped at one end and swings under gravity.

As in the scene ``free_rod``, the rod is a chain of N cross sections. Section i is at the distance i ds from
the clamp. The free end of the rod has the distance ds/2 from section N. J. C. Simo and L. Vu-Quoc (Comput.
Methods Appl. Mech. Engrg. 66 (1988) 125-161) compute the motion of such rods.
"""

from sympy import eye

from codegen.scene import param
from codegen.scenes.free_rod import rod

scene = rod(
    ends={(-1,): [*eye(3), 0, 0, 0]},
    gravity=param("g", 1),
    title="Geometrically exact rod under gravity, clamped at one end: a chain on T*SE(3)",
)
