"""Free rigid body on S^3 x R^3.

The equations are q' = q (0, W)/2 and P' = P x W with W = I^-1 P (Hairer and Vilmart 2006). The unit
quaternion q rotates vectors from the body frame to space. The real part of a quaternion is its first
coordinate. I is the inertia. W is the angular velocity and P the angular momentum, both in the body frame.
"""

from sympy import Matrix, Rational, diag

from codegen.groups import S3, LeftMultiplication, Product, Rn
from codegen.scene import FieldScene

quaternions, vectors = S3(), Rn(3)
q, P = quaternions.point("q"), vectors.point("P")
I = diag(Rational(3, 5), Rational(4, 5), 1)  # noqa: E741 (the inertia tensor's name)
P0 = Matrix([Rational(9, 5), Rational(2, 5), Rational(-9, 10)])
W = I.inv() * P
axis = Matrix(q[1:])
twice = 2 * axis.cross(W)
w = W + q[0] * twice + axis.cross(twice)  # angular velocity in space: q W q^-1

scene = FieldScene(
    title="Free rigid body with a quaternion, S^3 x R^3 (Hairer and Vilmart 2006)",
    group=Product(quaternions, vectors),
    action=LeftMultiplication(),
    y=[*q, *P],
    f=[*(w / 2), *P.cross(W)],
    y0=[1, 0, 0, 0, *P0],
    span=(0, 10),
    velocity=[-axis.dot(W) / 2, *((q[0] * W + axis.cross(W)) / 2), *P.cross(W)],
    invariants={"energy": P.dot(W) / 2, "length_of_momentum": P.dot(P), "length": q.dot(q)},
)
