"""Principal components: the gradient flow of tr(X^T A X)/2 on the Stiefel manifold, X' = (1 - X X^T) A X.

The scene is from section 2.4.2 of H. Marthinsen's thesis. X has two orthonormal columns of five rows, and
A_ij = min(i, j) is the covariance matrix of the first five positions of a random walk. The columns of X tend
to a basis of the eigenspace of the two largest eigenvalues, 12.34353752 and 1.44869057.
"""

from sympy import Min

from codegen.scene import StiefelScene, full, unknown

n, p = 5, 2
X = unknown(n, p)
A = full(n, n, lambda i, j: Min(i, j) + 1)

scene = StiefelScene(
    title="Principal components: a gradient flow of 5 x 2 matrices with orthonormal columns",
    x=X,
    velocity=A @ X - X @ X.T @ A @ X,
    span=(0, 1),
)
