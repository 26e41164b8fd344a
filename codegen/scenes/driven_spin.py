"""Driven spin on the sphere: the Landau-Lifshitz equation with anisotropy, damping and a rotating field.

The equation is m' = w x m with w = H + alpha m x H and H = (a cos nu t, a sin nu t, K m_3 + b). K is the
anisotropy, alpha the damping, a the strength of the rotating field and b a constant field. For this
equation, no term of a numerical method vanishes, so a wrong term changes the result.

L. Landau and E. Lifshitz, On the theory of the dispersion of magnetic permeability in ferromagnetic bodies,
Phys. Z. Sowjetunion 8 (1935), 153-169.
"""

from sympy import Expr, Matrix, Rational, Symbol, cos, sin

from codegen.groups import SO3, Rotation
from codegen.scene import FieldScene, param
from codegen.scene.problem import Problem


def driven_spin(title: str, anisotropy: Expr, damping: Expr, drive: Expr, end: Expr) -> Problem:
    """Return the scene of a driven spin on the time interval from 0 to ``end``.

    ``anisotropy``, ``damping`` and ``drive`` are the default values of the parameters K, alpha and a.
    """
    G, t = SO3(), Symbol("t")
    m = G.dual("m")
    K, alpha, a = param("K", anisotropy), param("alpha", damping), param("a", drive)
    nu, b = param("nu", 2), param("b", Rational(1, 5))
    H = Matrix([a * cos(nu * t), a * sin(nu * t), K * m[2] + b])
    w = H + alpha * m.cross(H)
    return FieldScene(
        title=title,
        group=G,
        action=Rotation(),
        y=m,
        f=w,
        y0=[Rational(3, 5), 0, Rational(4, 5)],
        span=(0, end),
        velocity=H.cross(m) + alpha * (H * m.dot(m) - m * m.dot(H)),
        invariants={"radius": m.dot(m)},
    )


scene = driven_spin("Driven spin on the sphere", 3, Rational(1, 10), Rational(1, 2), 10)
