"""Top on the hyperbolic plane: SL(2) moves points z of the upper half-plane by z -> (a z + b)/(c z + d).

J is the moment of the action for the area dx dy / y^2, so that J(z) is a point of a sheet of a hyperboloid.
The generator of the motion is the gradient of the energy (J.A J)/2, as for a rigid body on its sphere.
"""

from sympy import Matrix, Rational, diag, symbols

from codegen.groups import SL2
from codegen.groups.actions.base import Action
from codegen.scene import FieldScene


class Moebius(Action):
    """Moebius transformations of the upper half-plane by real 2 x 2 matrices of determinant 1."""

    name = "Moebius transformation"

    def act(self, d, group, g, y):
        a, b, c, e = g
        real, imaginary = c * y[0] + e, c * y[1]
        size = real * real + imaginary * imaginary
        return ((a * y[0] + b) * real + a * y[1] * imaginary) / size, y[1] / size

    def velocity(self, d, group, x, y):
        double = x[2] + x[2]
        across = x[1] * y[1]
        return (
            x[0] + double * y[0] - x[1] * y[0] * y[0] + across * y[1],
            double * y[1] - across * (y[0] + y[0]),
        )


x, y = symbols("x y", real=True)
J = Matrix([-1 / y, (x**2 + y**2) / y, -2 * x / y])
A = diag(1, Rational(1, 2), Rational(1, 8))

scene = FieldScene(
    title="Top on the hyperbolic plane",
    group=SL2(),
    action=Moebius(),
    y=[x, y],
    f=A * J,
    y0=[Rational(1, 2), 1],
    span=(0, 2),
    invariants={"energy": J.dot(A * J) / 2},
)
