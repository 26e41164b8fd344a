"""Four-level quantum system with a chirped pulse: U(4) acts on the complex amplitudes.

The equation is psi' = -i H(t) psi in the frame that rotates with the pulse. The energy gaps between
neighbouring levels differ, as in a transmon (J. Koch et al., Charge-insensitive qubit design derived from the
Cooper pair box, Phys. Rev. A 76 (2007), 042319). The Hamiltonian is

    H(t) = delta cos(nu t) N - (a/2) N (N - 1) + (rabi/2) sin^2(nu t) (L + L^T).

Here N = diag(0, 1, 2, 3), and L has the entries sqrt(1), sqrt(2), sqrt(3) above the diagonal. The parameter a
is the anharmonicity, ``rabi`` the strength of the pulse, ``delta`` the largest detuning, and pi/nu the
duration of the pulse.

The state consists of the 8 real numbers (Re psi, Im psi).
"""

from sympy import Matrix, Rational, Symbol, cos, diag, sin, sqrt

from codegen.groups import Linear, Unitary
from codegen.scene import FieldScene, param

LEVELS = 4
t = Symbol("t")
delta, anharmonicity, rabi = param("delta", 30), param("a", 12), param("rabi", 20)
nu = param("nu", Rational(157, 500))
N = diag(*range(LEVELS))
L = Matrix(LEVELS, LEVELS, lambda j, k: sqrt(k) if k == j + 1 else 0)
H = delta * cos(nu * t) * N - anharmonicity / 2 * N * (N - Matrix.eye(LEVELS))
H += rabi / 2 * sin(nu * t) ** 2 * (L + L.T)
y = Matrix([Symbol(f"{part}{k}", real=True) for part in ("re", "im") for k in range(LEVELS)])
u, v = y[:LEVELS, :], y[LEVELS:, :]

# The coordinates of -i H in the Lie algebra: the real and imaginary parts of the entries above the diagonal,
# and then the imaginary parts of the diagonal.
pairs = [(j, k) for j in range(LEVELS) for k in range(j + 1, LEVELS)]
f = [x for j, k in pairs for x in (0, -H[j, k])] + [-H[j, j] for j in range(LEVELS)]

scene = FieldScene(
    title="Driven four-level quantum system, U(4) acting on complex amplitudes",
    group=Unitary(LEVELS),
    action=Linear(),
    y=y,
    f=f,
    y0=[Rational(3, 5), 0, 0, 0, 0, Rational(4, 5), 0, 0],
    span=(0, 10),
    velocity=[*(H * v), *(-H * u)],
    invariants={"norm": y.dot(y)},
)
