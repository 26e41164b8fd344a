"""Independent components: a flow of W in SO(3) that separates three mixed signals by their kurtosis.

The scene is from section 2.4.3 of H. Marthinsen's thesis. The mixed signals x are whitened, so their
covariance matrix is the identity. Let y = W x, and let E denote the mean over all samples. The flow is
W' = Omega W with Omega_ij = E[y_i y_j^3] - E[y_i^3 y_j]. The flow decreases the sum of the kurtoses E[y_i^4]
of the components of y.
"""

from itertools import combinations_with_replacement, product
from math import fsum, prod, sin, sqrt, tau
from operator import mul
from random import Random

from sympy import Expr, Matrix, Rational, eye

from codegen.groups import SO3, LeftMultiplication
from codegen.scene import FieldScene

SAMPLES, PLACES = 2000, range(3)
MIXING = ((0.8, 0.5, -0.4), (-0.5, 0.9, 0.3), (0.4, -0.2, 0.7))

draw = Random(2013)
sources = [
    [draw.choice((-1.0, 1.0)) for _ in range(SAMPLES)],
    [draw.uniform(-1, 1) for _ in range(SAMPLES)],
    [sin(draw.uniform(0, tau)) for _ in range(SAMPLES)],
]
mixed = [[sum(map(mul, row, sample)) for sample in zip(*sources, strict=True)] for row in MIXING]


def mean(*factors: list[float]) -> float:
    """Multiply the given signals sample by sample, and return the mean of the products."""
    return fsum(map(prod, zip(*factors, strict=True))) / SAMPLES


signals: list[list[float]] = []  # the mixed signals, whitened by the method of Gram and Schmidt
for signal in mixed:
    rest = [a - mean(signal) for a in signal]
    for other in signals:
        share = mean(rest, other)
        rest = [a - share * b for a, b in zip(rest, other, strict=True)]
    length = sqrt(mean(rest, rest))
    signals.append([a / length for a in rest])

# The moments are rounded to twelve decimals, because the last digits of a float may depend on the machine.
moments: dict[tuple[int, ...], Rational] = {
    places: Rational(f"{mean(*(signals[k] for k in places)):.12f}")
    for places in combinations_with_replacement(PLACES, 4)
}

G = SO3()
W = G.point("w")


def cubic(i: int, d: int) -> Expr:
    """Return the mean E[y_i^3 x_d] as a polynomial in W.

    The vector x contains the whitened signals, and y is W x.
    """
    terms = product(PLACES, repeat=3)
    return sum(W[i, a] * W[i, b] * W[i, c] * moments[*sorted((a, b, c, d))] for a, b, c in terms)


cubics = Matrix(3, 3, cubic) * W.T  # E[y_i^3 y_j]
Omega = cubics.T - cubics

scene = FieldScene(
    title="Independent components by kurtosis, SO(3)",
    group=G,
    action=LeftMultiplication(),
    y=W,
    f=[Omega[2, 1], Omega[0, 2], Omega[1, 0]],
    y0=eye(3),
    span=(0, 2),
)
