"""Pipe-laying: a geometrically exact rod under gravity, with one clamped end and one end on a moving vessel.

The problem is from section 2.3.1 of H. Marthinsen's thesis. As in the scene ``free_rod``, the rod is a chain
of N cross sections, and neighbouring sections have the distance ds. Two additional sections are next to the
ends of the chain: a clamped section, and a section on the vessel. The vessel moves up and down, and pitches
about the axis e2. At time 0, the distance between the clamped section and the section on the vessel is the
parameter ``length``. This distance must be (N + 1) ds.
"""

from sympy import Matrix, Rational, Symbol, cos, eye, sin

from codegen.scene import param
from codegen.scenes.free_rod import rod

t = Symbol("t")
a, w, heave = param("a", Rational(1, 10)), param("w", 2), param("heave", Rational(1, 10))
length = param("length", 1)
angle = a * sin(w * t)
frame = Matrix([[cos(angle), 0, sin(angle)], [0, 1, 0], [-sin(angle), 0, cos(angle)]])

scene = rod(
    ends={(-1,): [*eye(3), 0, 0, 0], (1,): [*frame, heave * (1 - cos(w * t)), 0, length]},
    gravity=param("g", 1),
    title="Pipe-laying: a rod (chain on T*SE(3)) between a clamp and a moving vessel",
)
