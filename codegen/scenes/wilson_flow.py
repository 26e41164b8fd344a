"""Wilson flow of a plaquette, the smallest lattice gauge field: SU(3)^4 acts on four link matrices.

A link is a matrix V in SU(3). The equation of a link is V' = -g0^2 (dS(V)) V, where g0 is the coupling
constant and S is the Wilson action. Let V^H be the conjugate transpose of V. The plaquette P = V0 V1 V2^H
V3^H gives g0^2 S = 2 Re tr(1 - P).

For V0 and V1, the generator -g0^2 dS(V) is computed from the product P. For V2 and V3, the generator is
computed from the product P^H = V3 V2 V1^H V0^H. The factors of the product are permuted cyclically until V is
the first factor. Let X be the permuted product. The generator is the traceless anti-Hermitian part of -X.

A link V is stored as a real 6 x 3 matrix: Re V above Im V.

Source: M. Luescher, Properties and uses of the Wilson flow in lattice QCD, JHEP 08 (2010) 071, section 2.
"""

from random import Random

from sympy import Add, Expr, Matrix, Rational, eye, symbols

from codegen.groups import SU, Columns, FactorwiseAction, Product
from codegen.scene import FieldScene

draw = Random(1006)


def full(c: Matrix) -> Matrix:
    """Return the real 6 x 6 matrix [[Re V, -Im V], [Im V, Re V]] of a complex 3 x 3 matrix V.

    ``c`` is the 6 x 3 matrix of V: Re V above Im V. The transpose of the result is the 6 x 6 matrix of V^H.
    """
    return c.row_join(Matrix.vstack(-c[3:, :], c[:3, :]))


def product(*factors: Matrix) -> Matrix:
    """Return the product of matrices.

    This is much faster than the product of sympy, which tests for each entry whether it may be infinite.
    """
    *others, total = factors
    for a in reversed(others):
        entries = [
            [Add(*(a[i, k] * total[k, j] for k in range(a.cols))) for j in range(total.cols)]
            for i in range(a.rows)
        ]
        total = Matrix(entries)
    return total


def start() -> Matrix:
    """Return a random link matrix in SU(3), stored as a real 6 x 3 matrix."""
    link = full(Matrix.vstack(eye(3), Matrix.zeros(3, 3)))
    for j, k in ((0, 1), (0, 2), (1, 2)):
        a, b, c, d = (draw.choice((-1, 1)) * Rational(x, 5) for x in draw.sample((1, 2, 2, 4), 4))
        X, Y = eye(3), Matrix.zeros(3, 3)
        X[j, j], X[j, k], X[k, j], X[k, k] = a, c, -c, a
        Y[j, j], Y[j, k], Y[k, j], Y[k, k] = b, d, d, -b
        link = link * full(Matrix.vstack(X, Y))
    return link[:, :3]


def generator(loop: Matrix) -> list[Expr]:
    """Return the coordinates in su(3) of the traceless anti-Hermitian part of -X.

    ``loop`` contains the complex 3 x 3 matrix X as a real 6 x 3 matrix: Re X above Im X.
    """
    X, Y = loop[:3, :], loop[3:, :]
    pairs = [(0, 1), (0, 2), (1, 2)]
    above = [x for j, k in pairs for x in ((X[k, j] - X[j, k]) / 2, -(Y[j, k] + Y[k, j]) / 2)]
    mean = Y.trace() / 3
    return [*above, mean - Y[0, 0], Y[2, 2] - mean]


V = [Matrix(6, 3, symbols(f"v{k}_0:6(0:3)", real=True)) for k in range(4)]
A, B, C, D = map(full, V)
loops = [
    product(A, B, C.T, D.T[:, :3]),
    product(B, C.T, D.T, V[0]),
    product(C, B.T, A.T, V[3]),
    product(D, C, B.T, A.T[:, :3]),
]

scene = FieldScene(
    title="Wilson flow of one plaquette of a lattice gauge field, SU(3)^4",
    group=Product(*(SU(3) for _ in V)),
    action=FactorwiseAction(*(Columns(3) for _ in V)),
    y=[x for link in V for x in link],
    f=[x for loop in loops for x in generator(loop)],
    y0=[x for _ in V for x in start()],
    span=(0, 1),
)
