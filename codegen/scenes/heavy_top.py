"""Heavy top of H. Marthinsen's thesis, section 2.5, on T*SO(3). The kinetic energy is right-invariant.

The kinetic energy is mu.I^-1 mu/2, where mu is the right-trivialised momentum. The inertia tensor I is
fixed in space, not in the body. `orderconds longrun heavy_top --properties` measures the properties in
Table 2.1 of the thesis.
"""

from sympy import Matrix, diag, eye

from codegen.groups import SO3
from codegen.scene import HamiltonianScene
from codegen.scene.figure import Motion, Run, SphereCurves

G = SO3()
g, mu = G.point("g"), G.dual("mu")
I = 1000 * diag(1, 5, 6)  # noqa: E741 (the inertia tensor's name)
e3 = Matrix([0, 0, 1])
T = mu.dot(I.inv() * mu) / 2
V = e3.dot(g * e3)

scene = HamiltonianScene(
    title="Heavy top with inertia fixed in space, T*SO(3)",
    group=G,
    q=g,
    mu=mu,
    H=T + V,
    parts={"T": T, "V": V},
    q0=eye(3),
    mu0=10 * I * Matrix([1, 1, 1]),
    span=(0, 1),
    invariants={"momentum_about_body_axis": mu.dot(g * e3)},
)

figures = [
    SphereCurves(
        name="centre",
        title="Centre of mass of the heavy top, four theta-methods",
        caption="5000 steps of size 0.01. The curves of the symplectic (SLGI) methods stay in narrow bands.",
        source="Fig. 2.6 of Marthinsen's thesis",
        point=tuple(g * e3),
        runs=(
            Run("rkmk(0):euler", 0.01, 5000, "RKMK, theta = 0"),
            Run("rkmk(0):midpoint", 0.01, 5000, "RKMK, theta = 1/2"),
            Run("slgi:euler", 0.01, 5000, "SLGI, theta = 0"),
            Run("slgi:midpoint", 0.01, 5000, "SLGI, theta = 1/2"),
        ),
    ),
    Motion(
        name="motion",
        title="Motion of the heavy top",
        caption="200 steps of size 0.005. The animation pauses while the pointer is on the picture.",
        bars={
            "axis, from the fixed point to the centre of mass": ((0, 0, 0), tuple(g * e3)),
            "a line across the axis": (tuple(g * e3 - g[:, 0] / 4), tuple(g * e3 + g[:, 0] / 4)),
        },
        trace=tuple(g * e3),
        runs=(Run("slgi:midpoint", 0.005, 200),),
    ),
]
