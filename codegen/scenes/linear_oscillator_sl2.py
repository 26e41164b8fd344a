"""Four linear oscillators with the same time-dependent frequency: SL(2) acts on the four columns (q, p).

The equation is (q, p)' = A(t) (q, p) with A = X - (omega^2 + eps sin(alpha t)) Y (H. Marthinsen's thesis,
paper 3, Table 4.1). The matrix X has the entry 1 above the diagonal, Y has the entry 1 below the diagonal,
and all other entries are 0.

The scene also defines three methods of the thesis by formulas: *projection* (equation 4.18), *ExpNonCan* and
*ExpSymNonCan* (Table 4.1). For ExpNonCan the thesis prints the error 2.61, and the formula gives 5.82e-2. For
ExpSymNonCan the thesis prints the error 0.149, and the formula gives 5.45e-2. For Fig. 4.2 the thesis prints
eps = 0.6, but only eps = 0.1 fits the axis of the figure.
"""

from fractions import Fraction

from sympy import Matrix, Rational, Symbol, sin

from codegen.groups import SL2, Columns
from codegen.scene import LinearScene, param
from codegen.scene.figure import Deviation, Run, TimeSeries
from codegen.scene.matrix_step import IDENTITY, A, bracket, expm, h, logm, projected

eps, alpha, omega = param("eps", Rational(1, 10)), param("alpha", Rational(123, 1000)), param("omega", 1)
stiffness = omega**2 + eps * sin(alpha * Symbol("t"))
y = Matrix([Symbol(f"{letter}{k}", real=True) for letter in "qp" for k in range(4)])
q, p = y[:4, :], y[4:, :]

scene = LinearScene(
    title="Linear oscillator with changing frequency, SL(2) acting on 2 x 4 matrices",
    group=SL2(),
    action=Columns(4),
    y=y,
    A=[1, -stiffness, 0],
    y0=[1, 2, 3, 4, 4, 1, 2, 3],
    span=(0, 3),
    velocity=[*p, *(-stiffness * q)],
    invariants={"angular_momentum": q[0] * p[1] - q[1] * p[0]},
    steps={
        "projection": (expm(projected(logm(IDENTITY + h * A(0)))), 1),
        "exp_non_can": (expm(h * A(0) * (IDENTITY + h * A(0) * bracket(A(0), A(1)))), 1),
        "exp_sym_non_can": (
            expm(h * A(Fraction(1, 2)) * (IDENTITY + h * A(Fraction(1, 2)) * bracket(A(0), A(1)))),
            2,
        ),
    },
)

H = (stiffness * q.dot(q) + p.dot(p)) / 2
both = {"H": H, "−u": -Symbol("u", real=True)}
strong, matrices, canonical = (
    f"linear_oscillator{end}" for end in ("_sl2+u[alpha=1/10,eps=3/10]", "_sl2+u", "+u")
)
figures = [
    TimeSeries(
        name="energies",
        title="Lie-Gauss: errors of the energies H and −u",
        caption="u is the momentum conjugate to the time; −u = H on exact solutions. "
        "eps = 0.3, alpha = 0.1, h = 0.3. "
        "The exact energy is replaced by the energy that Lie-Gauss gives with h = 0.03.",
        source="Fig. 4.1a of Marthinsen's thesis",
        quantities=both,
        axis="difference from the exact energy",
        difference=True,
        runs=(Run("magnus:magnus4", 0.3, 33_330, "Lie-Gauss", scene=strong, stride=11),),
        reference=Run("magnus:magnus4", 0.03, 333_300, scene=strong, stride=110),
    ),
    TimeSeries(
        name="close_up",
        title="Lie-Euler: numerical values of H and −u, and the exact energy",
        caption="u is the momentum conjugate to the time; −u = H on exact solutions. "
        "eps = 0.3, alpha = 0.1, h = 0.6. "
        'The curve "exact" is the result of Lie-Gauss with h = 0.03.',
        source="Fig. 4.1b of Marthinsen's thesis",
        quantities=both,
        axis="energy",
        reference_label="exact",
        window=(230.0, 300.0),
        runs=(Run("magnus:lie_euler", 0.6, 500, "Lie-Euler", scene=strong),),
        reference=Run("magnus:magnus4", 0.03, 10_000, scene=strong, stride=5),
    ),
    TimeSeries(
        name="symmetric_canonical",
        title="Energies of four methods: symmetric and canonical, only symmetric, only canonical, neither",
        caption="The energies are H and −u, where u is the momentum conjugate to the time; −u = H on exact "
        "solutions. "
        "eps = 0.1, alpha = 0.123, h = 0.3. "
        "The thesis prints eps = 0.6, but only eps = 0.1 fits its figure.",
        source="Fig. 4.2 of Marthinsen's thesis",
        quantities=both,
        axis="energy",
        runs=(
            Run("rk:midpoint", 0.3, 2334, "midpoint: symmetric and canonical", scene=canonical, stride=2),
            Run("rk:kahan", 0.3, 2334, "Kahan: symmetric", scene=canonical, stride=2),
            Run("step:projection", 0.3, 2334, "projection: canonical", scene=matrices, stride=2),
            Run("rk:lobatto3c2", 0.3, 2334, "Lobatto IIIC: neither", scene=canonical, stride=2),
        ),
    ),
    Deviation(
        name="energy_errors",
        title="Energy errors: the maximum over each block of 500 steps",
        caption="eps = 0.1, alpha = 0.123. All curves are for h = 0.3. "
        "The energy errors are differences from the energy that Lie-Gauss gives with h = 0.02.",
        source="Fig. 4.3 of Marthinsen's thesis",
        quantity=H,
        axis="largest difference from the exact energy",
        window=500,
        runs=(
            Run("rk:radau2a2", 0.3, 166_666, "Radau IIA", scene="linear_oscillator"),
            Run("vcg:euler", 0.3, 166_666, "symplectic Euler", scene="linear_oscillator"),
            Run("step:exp_non_can", 0.3, 166_666, "ExpNonCan"),
            Run("step:exp_sym_non_can", 0.3, 166_666, "ExpSymNonCan"),
            Run("rk:midpoint", 0.3, 166_666, "midpoint", scene="linear_oscillator"),
            Run("rk:triple_jump", 0.3, 166_666, "midpoint, triple jump", scene="linear_oscillator"),
            Run("rk:gauss2", 0.3, 166_666, "Gauss-Legendre", scene="linear_oscillator"),
            Run("magnus:lie_euler", 0.3, 166_666, "Lie-Euler"),
            Run("magnus:magnus2", 0.3, 166_666, "Lie-midpoint"),
            Run("magnus:lie_midpoint_triple_jump", 0.3, 166_666, "Lie-midpoint, triple jump"),
            Run("magnus:magnus4", 0.3, 166_666, "Lie-Gauss"),
        ),
        reference=Run("magnus:magnus4", 0.02, 2_499_990, stride=15),
    ),
]
