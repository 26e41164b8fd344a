"""Toda's lattice of three particles on a ring, in the variables of Flaschka."""

from sympy import Matrix, Rational, symbols

from codegen.groups import LeftMultiplication, Rn
from codegen.scene import FieldScene

a = symbols("a0:3")
b = symbols("b0:3")

scene = FieldScene(
    title="Toda's lattice",
    group=Rn(6),
    action=LeftMultiplication(),
    y=Matrix([*a, *b]),
    f=Matrix(
        [
            *(a[k] * (b[(k + 1) % 3] - b[k]) for k in range(3)),
            *(2 * (a[k] ** 2 - a[k - 1] ** 2) for k in range(3)),
        ]
    ),
    y0=[Rational(1, 2), Rational(1, 2), Rational(1, 2), 1, 0, -1],
    span=(0, 5),
    invariants={
        "momentum": sum(b),
        "energy": sum(x**2 for x in b) + 2 * sum(x**2 for x in a),
    },
)
