"""Geometrically exact rod that is clamped at one end and swings under gravity, a chain on T*SE(3).

The rod is that of ``free_rod``: a chain of N cross sections. The clamp is a further section before the first
one, and does not move. The distance of section i from the clamp is i ds. Each section carries the mass of the
piece around it, so the last section is at the distance ds/2 from the free end. The rod therefore has the
length (N + 1/2) ds. J. C. Simo and L. Vu-Quoc (Comput. Methods Appl. Mech. Engrg. 66 (1988) 125-161) compute
the motion of such rods.
"""

from sympy import eye

from codegen.scene import param
from codegen.scenes.free_rod import rod

scene = rod(
    ends={(-1,): [*eye(3), 0, 0, 0]},
    gravity=param("g", 1),
    title="Geometrically exact rod, clamped at one end under gravity, a chain on T*SE(3)",
)
