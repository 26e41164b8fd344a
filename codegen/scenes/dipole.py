"""Dipole on a stick, on T*SO(3): a pendulum with a charged dipole at its end, near a fixed charge.

The scene is from section 3.6 of H. Marthinsen's thesis. The thesis prints the gravity term of the Hamiltonian
with a plus sign. This scene uses the minus sign, because only the minus sign agrees with Fig. 3.3 of the
thesis. For vcg:midpoint with h = 0.01 on the interval (0, 1000), the figure shows energy errors of about
1e-3. With the minus sign the error is 1.0e-3, and with the plus sign 1.0e-4.
"""

import math
from dataclasses import replace
from fractions import Fraction

from sympy import Matrix, Rational, diag, sqrt

from codegen.groups import SO3
from codegen.scene import HamiltonianScene, param
from codegen.scene.figure import Deviation, Motion, Orders, Run
from codegen.scene.run_time import with_runtime
from codegen.scene.stiff_variant import StiffVariant

G = SO3()
g, mu = G.point("g"), G.dual("mu")
a, beta, depth = Rational(1, 10), param("beta", 1), param("depth", Rational(3, 2))
I = diag(1 + a**2, 1, a**2)  # noqa: E741 (the inertia tensor's name)
e2, e3, z = Matrix([0, 1, 0]), Matrix([0, 0, 1]), Matrix([0, 0, -depth])
r = [sqrt(v.dot(v)) for v in (g * Matrix([0, s * a, -1]) - z for s in (1, -1))]
T = sum(p**2 / (2 * i) for p, i in zip(g.T * mu, I.diagonal(), strict=True))
V = -e3.dot(g * e3) + beta * (1 / r[0] - 1 / r[1])
g0 = Matrix([[1, 0, 0], [0, 0, -1], [0, 1, 0]])

scene = HamiltonianScene(
    title="Dipole on a stick, T*SO(3)",
    group=G,
    q=g,
    mu=mu,
    H=T + V,
    parts={"T": T, "V": V},
    q0=g0,
    mu0=g0 * I * g0.T * e2,
    span=(0, Rational(1, 2)),
)

figures = [
    Orders(
        name="orders",
        title="Errors for the dipole against the step size",
        caption="The error at t = 1/2 is |mu - mu_ref| + |g - g_ref|: the Euclidean norm for the momentum "
        "mu, and the spectral norm for the matrix g.",
        source="Fig. 3.2 of Marthinsen's thesis",
        halvings=5,
        orders=(2, 3, 4, 6),
        runs=(
            Run("vrkmk(0):gauss1", 0.1, 0),
            Run("vrkmk(1):kutta3", 0.1, 0),
            Run("vrkmk(2):gauss2", 0.1, 0),
            Run("vrkmk(4):gauss3", 0.1, 0),
            Run("vcg:midpoint", 0.1, 0),
            Run("vcg:triple_jump", 0.1, 0),
            Run("vcg:yoshida6", 0.1, 0),
        ),
    ),
    Orders(
        name="found_methods",
        title='Errors for the dipole: methods found with the command "orderconds solve"',
        caption="Methods of the families vcf and vcg, compared with VRKMK4 and VCG4 of Marthinsen's thesis.",
        halvings=5,
        orders=(4, 6),
        runs=(
            Run("vrkmk(2):gauss2", 0.1, 0),
            Run("vcg:triple_jump", 0.1, 0),
            Run("vcg:vcg4_s3", 0.1, 0),
            Run("vcf:vcf_gauss2", 0.1, 0),
            Run("vcf:vcf4_s3", 0.1, 0),
            Run("vcf:vcf_gauss3", 0.1, 0),
        ),
    ),
    Deviation(
        name="energy",
        title="Energy error of the dipole over 100 000 steps",
        caption="Steps of size 0.01. Each point is the maximum over 1000 consecutive steps.",
        source="Fig. 3.3 of Marthinsen's thesis",
        quantity="energy",
        axis="largest energy error",
        window=1000,
        runs=(
            Run("vrkmk(0):gauss1", 0.01, 100_000),
            Run("vcg:midpoint", 0.01, 100_000),
            Run("vrkmk(2):gauss2", 0.01, 100_000),
            Run("vcg:triple_jump", 0.01, 100_000),
        ),
    ),
    Motion(
        name="motion",
        title="Motion of the dipole",
        caption="800 steps of size 0.01. The animation pauses while the pointer is on the picture.",
        bars={
            "stick": ((0, 0, 0), tuple(-g * e3)),
            "dipole": (tuple(g * Matrix([0, a, -1])), tuple(g * Matrix([0, -a, -1]))),
        },
        trace=tuple(-g * e3),
        fixed={"fixed charge": (0, 0, -1.5)},
        runs=(Run("vrkmk(2):gauss2", 0.01, 800, stride=8),),
    ),
]


def stiff_variants() -> list[StiffVariant]:
    """Return dipoles that pass the fixed charge at distances of about 1/10, 1/100 and 1/1000."""
    return [_passing(Fraction(1, d)) for d in (10, 100, 1000)]


def _passing(gap: Fraction) -> StiffVariant:
    # Each charge of the dipole is at the distance sqrt(1 + a^2) from the pivot, here rounded to 15 decimals.
    reach = Fraction(f"{math.sqrt(1 + float(a) ** 2):.15f}")
    near = replace(with_runtime(scene, (f"depth={reach + gap}",)), span=(Fraction(0), Fraction(5, 2)))
    about = f"passes the fixed charge at a distance of {float(gap):g}"
    # With the acceleration 1/gap^2, a charge moves by about ``gap`` in the time gap^(3/2).
    return StiffVariant(f"dipole that {about}", about, near, float(1 / gap) ** 1.5)
