"""The eigenspace of the largest eigenvalues of a tridiagonal matrix, as a flow on a Stiefel manifold.

The gradient flow X' = (1 - X X^T) A X of trace(X^T A X) moves 800 x 4 matrices with orthonormal columns. Its
limit spans the eigenvectors of the four largest eigenvalues of A.
"""

from codegen.scene import StiefelScene, banded, unknown

n, k = 800, 4
X = unknown(n, k)
A = banded(n, {-1: -1, 0: 2, 1: -1})

scene = StiefelScene(
    title="Eigenspace of a tridiagonal matrix, 800 x 4",
    x=X,
    velocity=A @ X - X @ X.T @ A @ X,
    span=(0, 1),
)
