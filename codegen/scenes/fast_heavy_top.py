"""Fast heavy top, on T*SO(3): a symmetric top with a spin of 150 rad/s.

The scene is a benchmark of multibody dynamics (Brüls and Cardona 2010). R is the attitude. In the body frame,
W is the angular velocity, X the centre of mass, and I the inertia about the fixed point. The weight is F =
(0, 0, -m g), where m is the mass and g is the acceleration of gravity. The equations are

    R' = R hat(W),   I W' = cross(I W, W) + cross(X, R^T F),

where hat(W) is the matrix of v -> cross(W, v). The angular momentum in space is mu = R I W, with mu' =
cross(R X, F). X lies on the symmetry axis. The energy and the angular momenta about the vertical and about
the symmetry axis are conserved.
"""

from sympy import Matrix, Rational, diag, eye

from codegen.groups import SO3
from codegen.scene import HamiltonianScene
from codegen.scene.stiff_variant import StiffVariant

G = SO3()
g, mu = G.point("g"), G.dual("mu")
I = diag(Rational("15.234375"), Rational("0.46875"), Rational("15.234375"))  # noqa: E741
mass, gravity, X = 15, Rational("9.81"), Matrix([0, 1, 0])
W0 = Matrix([0, 150, Rational("-4.61538")])
e3 = Matrix([0, 0, 1])
w = g * I.inv() * g.T * mu
T = mu.dot(w) / 2
V = mass * gravity * e3.dot(g * X)

scene = HamiltonianScene(
    title="Fast heavy top with body inertia, T*SO(3) (Brüls and Cardona 2010)",
    group=G,
    q=g,
    mu=mu,
    H=T + V,
    parts={"T": T, "V": V},
    q0=eye(3),
    mu0=I * W0,
    span=(0, 2),
    xi=w,
    n=(g * X).cross(-mass * gravity * e3) + mu.cross(w),
    invariants={"momentum_about_vertical": mu[2], "momentum_about_body_axis": mu.dot(g * X)},
)


def stiff_variants() -> list[StiffVariant]:
    """Return thin heavy tops. The largest moment of inertia is 1e3 or 1e6 times the smallest moment."""
    return [_thin_top(ratio) for ratio in (10**3, 10**6)]


def _thin_top(ratio: int) -> StiffVariant:
    inertia = diag(1, 1, Rational(1, ratio))
    kinetic = mu.dot(g * inertia.inv() * g.T * mu) / 2
    potential = e3.dot(g * e3)
    thin = HamiltonianScene(
        name="thin_top",
        group=G,
        q=g,
        mu=mu,
        H=kinetic + potential,
        parts={"T": kinetic, "V": potential},
        q0=eye(3),
        mu0=Matrix([Rational(1, 10), Rational(1, 5), Rational(1, 2) / ratio]),
        span=(0, 1),
    )
    label = f"inertia ratio {ratio:.0e}"
    return StiffVariant(f"top with {label}", label, thin, float(ratio) / 10)
