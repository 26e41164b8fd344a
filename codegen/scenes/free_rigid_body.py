"""Free rigid body: the angular momentum moves on a sphere, and SO(3) acts by rotation.

The equation is m' = f(m) x m with f = -I^-1 m and the inertia I (H. Marthinsen's thesis, section 2.2,
equation (2.8)). The scene adds the term alpha m to f, where the parameter alpha is the isotropy. This term
changes only the numerical solutions, because m x m = 0. The Lie-Euler step is m -> exp(h (f + alpha m)) m.
The thesis states this step in equation (2.19), but without the factor h.
"""

from sympy import Matrix, Rational, cos, diag, sin

from codegen.groups import SO3, Rotation
from codegen.scene import FieldScene, param
from codegen.scene.figure import Run, Scan, SphereCurves, Sweep
from codegen.scene.stiff_variant import RADIANS, StiffVariant

G = SO3()
m = G.dual("m")
I = diag(2, 1, Rational(2, 3))  # noqa: E741 (the inertia tensor's name)
alpha = param("alpha", 0)
w = Rational(11, 10)

scene = FieldScene(
    title="Free rigid body on the sphere",
    group=G,
    action=Rotation(),
    y=m,
    f=-I.inv() * m + alpha * m,
    y0=Matrix([cos(w), 0, sin(w)]),
    span=(0, 2),
    invariants={"radius": m.dot(m), "energy": m.dot(I.inv() * m) / 2},
)

isotropy = Run("rkmk(0):euler", 1.0, 1, "Lie-Euler, alpha from 0 to 25", sweep=Sweep("alpha", 0.0, 25.0, 400))
exact = Run("rkmk:butcher6", 0.01, 100)
figures = [
    SphereCurves(
        name="isotropy",
        title="Results of one Lie-Euler step on the sphere for different values of the parameter alpha",
        caption="One step of size 1 for each alpha. The reference is the exact solution up to t = 1.",
        source="Fig. 2.2 of Marthinsen's thesis",
        point=tuple(m),
        axes=("m₁", "m₂", "m₃"),
        direction=(40.0, 35.0),
        panels=False,
        runs=(isotropy,),
        reference=exact,
    ),
    Scan(
        name="best_isotropy",
        title="Error of one Lie-Euler step as a function of the parameter alpha",
        caption="One step of size 1.",
        source="Fig. 2.2 of Marthinsen's thesis",
        runs=(isotropy,),
        reference=exact,
        axis="distance from the exact solution",
    ),
]


def stiff_variants() -> list[StiffVariant]:
    """Return bodies with moments of inertia 1, 1/2 and 1/ratio, for ratios of 1e3, 1e6 and 1e12."""
    return [thin_body(ratio) for ratio in (10**3, 10**6, 10**12)]


def thin_body(ratio: int) -> StiffVariant:
    """Return a free rigid body with moments of inertia 1, 1/2 and 1/ratio."""
    inertia = diag(1, Rational(1, 2), Rational(1, ratio))
    thin = FieldScene(
        name="thin_body",
        group=G,
        action=Rotation(),
        y=m,
        f=-inertia.inv() * m,
        y0=Matrix([Rational(3, 5), 0, Rational(4, 5)]),
        span=(0, min(Rational(1), Rational(RADIANS, ratio))),
        invariants={"radius": m.dot(m), "energy": m.dot(inertia.inv() * m) / ratio},
    )
    label = f"inertia ratio {ratio:.0e}"
    return StiffVariant(f"free body with {label}", label, thin, float(ratio))
