"""Toda's lattice of three particles as an isospectral flow: L' = [B(L), L] for symmetric matrices L.

Sources: H. Marthinsen's thesis, section 2.2.2 (isospectral flows); H. Flaschka, The Toda lattice II, Physical
Review B 9 (1974), 1924-1925. B(L) is the skew matrix that is equal to L above the diagonal. SO(3) acts by
conjugation, so a step preserves the eigenvalues of L. For large times L tends to the diagonal matrix of the
eigenvalues in decreasing order.
"""

from sympy import Matrix, symbols

from codegen.groups import SO3, Conjugation
from codegen.scene import FieldScene

L = Matrix(3, 3, symbols("l0:3(0:3)", real=True))
# The vector f of so(3) has the skew matrix B = [[0, -f2, f1], [f2, 0, -f0], [-f1, f0, 0]].
f = Matrix([-L[1, 2], L[0, 2], -L[0, 1]])
B = Matrix([[0, L[0, 1], L[0, 2]], [-L[0, 1], 0, L[1, 2]], [-L[0, 2], -L[1, 2], 0]])

scene = FieldScene(
    title="Toda's lattice of three particles, SO(3) acting on symmetric matrices",
    group=SO3(),
    action=Conjugation(),
    y=list(L),
    f=f,
    y0=Matrix([[1, 1, 0], [1, 0, 1], [0, 1, -1]]),
    span=(0, 5),
    velocity=list(B * L - L * B),
    invariants={"trace": L.trace(), "square": (L * L).trace(), "determinant": L.det()},
)
