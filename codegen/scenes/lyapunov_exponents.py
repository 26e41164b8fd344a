"""Lyapunov exponents of Lorenz's system.

The scenes use the method of L. Dieci and E. Van Vleck (H. Marthinsen's thesis, section 2.4.4). The trajectory
satisfies x' = F(x), and A is the Jacobian of F. The frame Q, an element of St(3, k), has k orthonormal
columns. Let P = Q Q^T. The generator of the frame is (1 - P) A P - P A^T (1 - P) + Q S Q^T. Here S is the
skew matrix that equals Q^T A Q below the diagonal. In equation (2.24) the thesis prints the generator as
A - P A + Q S Q^T, but this matrix is not skew for k < 3. The state also contains the integrals of the k
diagonal entries of Q^T A Q over time. Each integral, divided by the time, tends to an exponent: 0.9056, 0 or
-14.5723 (J. C. Sprott, Chaos and Time-Series Analysis, Oxford 2003).
"""

from sympy import Matrix, Rational, Symbol, eye, symbols

from codegen.groups import SO3, FactorwiseAction, LeftMultiplication, Product, Rn, Stiefel
from codegen.scene import FieldScene, param
from codegen.scene.figure import Run, SpaceCurves, TimeSeries
from codegen.scene.problem import Problem

sigma, rho, beta = param("sigma", 10), param("rho", 28), param("beta", Rational(8, 3))
x = Matrix(symbols("x0:3", real=True))
F = Matrix([sigma * (x[1] - x[0]), x[0] * (rho - x[2]) - x[1], x[0] * x[1] - beta * x[2]])
A = F.jacobian(x)


def lyapunov(k: int) -> Problem:
    """Return the scene for the k largest exponents, k = 1, 2 or 3."""
    Q = Matrix(3, k, symbols(f"q0:3(0:{k})", real=True))
    integrals = [Symbol(f"s{i}", real=True) for i in range(k)]
    B = Q.T * A * Q
    S = Matrix(k, k, lambda i, j: B[i, j] if i > j else -B[j, i] if i < j else 0)
    outside = eye(3) - Q * Q.T if k < 3 else Matrix.zeros(3, 3)
    tilt = outside * A * Q
    W = tilt * Q.T - Q * tilt.T + Q * S * Q.T
    rates = [B[i, i] for i in range(k)]
    return FieldScene(
        title="Lyapunov exponents of Lorenz's system",
        group=Product(SO3(), Rn(3 + k)),
        action=FactorwiseAction(Stiefel(k), LeftMultiplication()),
        y=[*Q, *x, *integrals],
        f=[W[2, 1], W[0, 2], W[1, 0], *F, *rates],
        y0=[*eye(3)[:, :k], 1, 1, 20, *(0 for _ in rates)],
        span=(0, 1),
    )


scene = lyapunov(3)

t = Symbol("t")
figures = [
    SpaceCurves(
        name="attractor",
        title="The trajectory of Lorenz's system",
        caption="5000 steps of size 1/100.",
        point=tuple(x),
        axes=("x₁", "x₂", "x₃"),
        direction=(-60.0, 15.0),
        runs=(Run("rkmk(2):rk4", 0.01, 5000),),
    ),
    TimeSeries(
        name="exponents",
        title="Approximations of the Lyapunov exponents of Lorenz's system against time",
        caption="Steps of size 1/100. The exponents are 0.9056, 0 and -14.5723.",
        quantities={f"exponent {i + 1}": Symbol(f"s{i}", real=True) / t for i in range(3)},
        axis="integral / t",
        window=(1.0, 100.0),
        runs=(Run("rkmk(2):rk4", 0.01, 10_000, stride=20),),
    ),
]
