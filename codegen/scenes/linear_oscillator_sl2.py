"""Linear oscillators with a time-dependent frequency, as the action of SL(2) on four columns (q, p).

(q, p)' = A(t) (q, p) with A = X - (omega^2 + eps sin(alpha t)) Y, where X and Y are the off-diagonal unit
matrices (H. Marthinsen's thesis, paper 3, Table 4.1). The generator depends on the time alone, so the scene
is a linear problem in time: Magnus, Fer and Cayley methods accept it. Every step of these methods is a
symplectic matrix. ``linear_oscillator`` is the same equation on T*R^4.

The stated steps are *projection* (4.18), *ExpNonCan* and *ExpSymNonCan* of Table 4.1. The arguments of the
last two exponentials are products of matrices. For this equation the products are in sl(2).
"""

from fractions import Fraction

from sympy import Matrix, Rational, Symbol, sin

from codegen.groups import SL2, Columns
from codegen.scene import LinearScene, param
from codegen.scene.matrix_step import IDENTITY, A, bracket, expm, h, logm, projected

eps, alpha, omega = param("eps", Rational(1, 10)), param("alpha", Rational(123, 1000)), param("omega", 1)
stiffness = omega**2 + eps * sin(alpha * Symbol("t"))
y = Matrix([Symbol(f"{letter}{k}", real=True) for letter in "qp" for k in range(4)])
q, p = y[:4, :], y[4:, :]

scene = LinearScene(
    title="Linear oscillator with changing frequency, SL(2) acting on 2 x 4 matrices",
    group=SL2(),
    action=Columns(4),
    y=y,
    A=[1, -stiffness, 0],
    y0=[1, 2, 3, 4, 4, 1, 2, 3],
    span=(0, 3),
    velocity=[*p, *(-stiffness * q)],
    invariants={"angular_momentum": q[0] * p[1] - q[1] * p[0]},
    steps={
        "projection": (expm(projected(logm(IDENTITY + h * A(0)))), 1),
        "exp_non_can": (expm(h * A(0) * (IDENTITY + h * A(0) * bracket(A(0), A(1)))), 1),
        "exp_sym_non_can": (
            expm(h * A(Fraction(1, 2)) * (IDENTITY + h * A(Fraction(1, 2)) * bracket(A(0), A(1)))),
            2,
        ),
    },
)
