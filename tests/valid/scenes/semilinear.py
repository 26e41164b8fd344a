"""A semilinear equation u' = L u + N(u) by the affine action: diffusion on three points with a reaction.

The group has one generator with the matrix L and one for each translation, and f(u) = (1, N(u)). Lie-Euler is
the exponential Euler method.
"""

from sympy import Matrix, Rational, symbols

from codegen.groups import AffineAction, MatrixGroup
from codegen.scene import FieldScene

n = 3
L = [[-4, 2, 0], [2, -4, 2], [0, 2, -4]]


def affine(linear, translation):
    """Return the matrix [[linear, translation], [0, 0]]."""
    return [[*row, c] for row, c in zip(linear, translation, strict=True)] + [[0] * (n + 1)]


BASIS = [affine(L, [0] * n)] + [affine([[0] * n] * n, [int(i == j) for i in range(n)]) for j in range(n)]

u = Matrix(symbols(f"u0:{n}", real=True))
N = Matrix([x - x**3 + Rational(k + 1, 10) for k, x in enumerate(u)])

scene = FieldScene(
    title="Diffusion with a reaction",
    group=MatrixGroup("maps exp(t L) u + b", BASIS),
    action=AffineAction(),
    y=u,
    f=[1, *N],
    y0=[Rational(1, 2), 1, Rational(-1, 4)],
    span=(0, 1),
    velocity=list(Matrix(L) * u + N),
)
