"""Geometrically exact rod with free ends: a chain of rigid cross sections, on T*SE(3).

The model is the rod of J. C. Simo (Comput. Methods Appl. Mech. Engrg. 49 (1985) 55-70) with the strains of
shear, extension, bending and torsion. A site is a cross section with the frame R = (d1, d2, d3) and the
centre x. The director d3 is normal to the section. A rod of length L consists of L/ds equal pieces, and the
mass of each piece is concentrated in its cross section. The strains contain the mean directors
(d_a + d_a')/2 of two neighbouring sections (P. Betsch and P. Steinmann, Int. J. Numer. Methods Eng. 54 (2002)
1775-1788). For two neighbouring sections, the strains Gamma_a and the elastic energy V are

    Gamma_a = (d_a + d_a').(x' - x)/(2 ds) - delta_a3,
    V = ds/2 sum_a S_a Gamma_a^2 + 1/(2 ds) sum_a D_a |d_a' - d_a|^2.

A prime denotes the second section, and delta_a3 is the Kronecker delta. S = (GA, GA, EA) contains the
stiffnesses of shear and extension. K = (EI, EI, GJ) contains the stiffnesses of bending and torsion. The
numbers D_a are D_1 = D_2 = GJ/2 and D_3 = EI - GJ/2. Let theta be the vector of a small rotation from one
section to the next, and theta_a = theta.d_a. With these D_a, sum_a D_a |d_a' - d_a|^2 is equal to
sum_a K_a theta_a^2 up to terms of higher order in theta.

The code divides all energies and momenta by ds.
"""

from collections.abc import Mapping, Sequence

import sympy
from sympy import Matrix, Rational, eye

from codegen.groups import SE3
from codegen.scene import Bond, HamiltonianSiteScene, Problem, neighbour, param

GROUP = SE3()
q, mu = GROUP.point("q"), GROUP.dual("mu")
R, x = Matrix(3, 3, q[:9]), Matrix(q[9:])
ds = param("ds", Rational(1, 20))

# The section is a circle with the radius 1/10, and Poisson's ratio is 1/4.
MASS, INERTIA = 1, (Rational(1, 400), Rational(1, 400), Rational(1, 200))
EI, GJ = param("EI", 1), param("GJ", Rational(4, 5))
EA, GA = param("EA", 400), param("GA", Rational(27, 28) * 160)

p = Matrix(mu[3:])
P = R.T * (Matrix(mu[:3]) - x.cross(p))
kinetic = sum(P[a] ** 2 / (2 * INERTIA[a]) for a in range(3)) + p.dot(p) / (2 * MASS)

near = neighbour(q, (1,))
other, y = Matrix(3, 3, near[:9]), Matrix(near[9:])
gap, mean = (y - x) / ds, (R + other) / 2
strain = mean.T * gap - Matrix([0, 0, 1])
turns = [(other - R)[:, a] for a in range(3)]
stretching = sum(S * s**2 / 2 for S, s in zip((GA, GA, EA), strain, strict=True))
bending = sum(D * d.dot(d) for D, d in zip((GJ / 2, GJ / 2, EI - GJ / 2), turns, strict=True)) / (2 * ds**2)

Ends = Mapping[Sequence[int], Sequence[sympy.Expr]]
"""Coordinates of additional cross sections, just beyond the ends of the rod.

The section before the rod has the key (-1,). The section after the rod has the key (1,).
"""

normal = R[:, 0].cross(R[:, 1])
FREE: Ends = {(k,): [*R, *(x + k * ds * normal / normal.dot(R[:, 2]))] for k in (-1, 1)}
"""Additional cross sections for free ends. They exert no force and no torque on the rod."""


def rod(ends: Ends | None = None, gravity: sympy.Expr | None = None, title: str = "") -> Problem:
    """Return the scene of a rod. The acceleration ``gravity`` acts in the direction of -e1.

    An end without an entry in ``ends`` is free (see :data:`Ends`).
    """
    parts = {"kinetic": kinetic, **({} if gravity is None else {"weight": MASS * gravity * x[0]})}
    return HamiltonianSiteScene(
        title=title,
        group=GROUP,
        q=q,
        mu=mu,
        H=sum(parts.values()),
        parts=parts,
        bonds=[Bond((1,), stretching + bending)],
        q0=[*eye(3), 0, 0, 0],
        mu0=[0, 0, 0, 1, 0, 0],
        span=(0, 1),
        boundary="open",
        outside={**FREE, **(ends or {})},
    )


def straight(number: int, spacing: float) -> list[list[float]]:
    """Return the state of each section. The rod is straight, parallel to e3, and at rest.

    The sections have the positions ``spacing`` * e3, 2 * ``spacing`` * e3 and so on.
    """
    frame = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
    return [[*frame, 0.0, 0.0, (i + 1) * spacing, *[0.0] * 6] for i in range(number)]


scene = rod(title="Geometrically exact rod with free ends, a chain on T*SE(3)")
