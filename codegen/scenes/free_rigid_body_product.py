"""Free rigid body on SO(3) x R^3. The attitude is a rotation, and the momentum is a vector in R^3.

The equations are g' = g hat(W), W = I^-1 P and P' = P x W (Hairer and Vilmart 2006). Here g is the attitude,
I the inertia, and hat(W) the matrix of v -> W x v. W is the angular velocity and P the angular momentum, both
in the body frame.

With a Lie group method the attitude stays a rotation, but numerical errors change |P| and the energy.
"""

from sympy import Matrix, Rational, diag, eye

from codegen.groups import SO3, LeftMultiplication, Product, Rn
from codegen.scene import FieldScene

rotations, vectors = SO3(), Rn(3)
g, P = rotations.point("g"), vectors.point("P")
I = diag(Rational(3, 5), Rational(4, 5), 1)  # noqa: E741 (the inertia tensor's name)
P0 = Matrix([Rational(9, 5), Rational(2, 5), Rational(-9, 10)])
W = I.inv() * P
space = g * P


def hat(w: Matrix) -> Matrix:
    """Return the matrix that maps v to the cross product w x v."""
    return Matrix([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


scene = FieldScene(
    title="Free rigid body with attitude, SO(3) x R^3 (Hairer and Vilmart 2006)",
    group=Product(rotations, vectors),
    action=LeftMultiplication(),
    y=[*g, *P],
    f=[*(g * W), *P.cross(W)],
    y0=[*eye(3), *P0],
    span=(0, 10),
    velocity=[*(g * hat(W)), *P.cross(W)],
    invariants={
        "energy": P.dot(W) / 2,
        "length_of_momentum": P.dot(P),
        **{f"momentum_{k}": space[k] for k in range(3)},
    },
)
