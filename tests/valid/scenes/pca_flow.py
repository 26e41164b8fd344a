"""Principal components: the gradient flow X' = (1 - X X^T) A X of trace(X^T A X) on the Stiefel manifold.

X has two orthonormal columns of five rows, and A_ij = min(i, j). The flow finds the space of the two largest
eigenvalues of A, 12.34353752 and 1.44869057, but not the eigenvectors: the eigenvalues of X^T A X (Ritz
values) tend to them. SO(5) acts by rotation, with the generator [A, X X^T].
"""

from sympy import Matrix, eye, symbols

from codegen.groups import MatrixGroup, Stiefel
from codegen.scene import FieldScene

n, p = 5, 2
PAIRS = [(i, j) for i in range(n) for j in range(i)]


def skew(i, j):
    """Return the matrix with 1 at (i, j) and -1 at (j, i)."""
    return [[int((r, c) == (i, j)) - int((r, c) == (j, i)) for c in range(n)] for r in range(n)]


A = Matrix(n, n, lambda i, j: min(i, j) + 1)
X = Matrix(n, p, symbols(f"x0:{n}(0:{p})", real=True))
generator = A * X * X.T - X * X.T * A


def flow(coordinates):
    """Return the scene in coordinates of RKMK."""
    return FieldScene(
        title="Principal components, five and two",
        group=MatrixGroup(f"SO({n})", [skew(i, j) for i, j in PAIRS]),
        action=Stiefel(p),
        y=list(X),
        f=[generator[i, j] for i, j in PAIRS],
        y0=eye(n)[:, :p],
        span=(0, 1),
        velocity=list((eye(n) - X * X.T) * A * X),
        coordinates=coordinates,
        name="pca_flow",
    )


scene = flow("exp")
