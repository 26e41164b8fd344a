"""The Allen-Cahn equation u_t = eps u_xx + u - u^3 on six points, with a group of affine maps.

The equation u' = L u + N(u) with N(u) = u - u^3 is from section 2.2.2 of H. Marthinsen's thesis. L is eps
times the second difference quotient. The points have the spacing 1/7, and u = 0 at both ends. The group
consists of the maps u -> exp(t L) u + c. An element (A, c) of its Lie algebra consists of a multiple A of L
and a translation c. The equation is u' = f(u).u, where f(u) is the element with A = L and c = N(u). Lie-Euler
is the exponential Euler method exp(h L) u + h phi(h L) N(u) with phi(z) = (exp(z) - 1)/z. The bracket of
(A1, c1) and (A2, c2) has the translation A1 c2 - A2 c1. In the thesis, this translation has an additional
term c1, which is an error.

Methods with negative coefficients, for example ``cg3``, integrate diffusion backwards in a part of each step.
With long steps, such a method gives no correct digit.
"""

from sympy import Matrix, Rational, symbols

from codegen.groups import AffineAction, MatrixGroup
from codegen.scene import FieldScene

n, eps = 6, Rational(1, 10)
L = eps * (n + 1) ** 2 * Matrix(n, n, lambda i, j: {0: -2, 1: 1}.get(abs(i - j), 0))
u = Matrix(symbols(f"u0:{n}", real=True))
N = u - u.applyfunc(lambda x: x**3)


def affine(linear: Matrix, translation: Matrix) -> Matrix:
    """Return the matrix [[linear, translation], [0, 0]]."""
    return Matrix.vstack(linear.row_join(translation), Matrix.zeros(1, n + 1))


unit, zero = Matrix.eye(n), Matrix.zeros(n, n)
basis = [affine(L, zero[:, 0]), *(affine(zero, unit[:, k]) for k in range(n))]

scene = FieldScene(
    title="Allen-Cahn equation on six points, affine maps",
    group=MatrixGroup("maps exp(t L) u + c", [matrix.tolist() for matrix in basis]),
    action=AffineAction(),
    y=u,
    f=[1, *N],
    y0=[Rational(1, 2), 1, Rational(-1, 4), Rational(-3, 4), Rational(1, 2), Rational(3, 4)],
    span=(0, 1),
    velocity=L * u + N,
)
