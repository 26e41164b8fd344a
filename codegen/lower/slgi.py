"""Symplectic Lie group integrators on T*G, section 2.5 of Marthinsen's thesis.

A step leads from (q0, mu0) to (q1, mu1). The coefficients of the tableau are a_ij and b_i. Let
(xi_i, n_i) = f(Q_i, M_i) be the velocity and the force of stage i. In the thesis, f contains the factor h.
The unknowns are the xi_i and n_i. The point of stage i is Q_i. The force n_j of stage j acts at the point
Q_j, and nu_j is this force after the transport from Q_j to q0. The exponents X_i and Y, the points Q_i and
the transported forces nu_j are

    X_i = h sum_j a_ij xi_j,   Y = h sum_j b_j xi_j,   Q_i = exp(X_i) q0,   nu_j = Ad*_{exp X_j} n_j.

The stage momenta M_i and the result of the step are

    M_i = dexp*_{-Y}(mu0 + h sum_j b_j nu_j) - h sum_j (b_j a_ji/b_i) dexp*_{X_j} n_j,
    q1 = exp(Y) q0,   mu1 = Ad*_{exp(-Y)}(mu0 + h sum_j b_j nu_j).

The order of every symplectic Lie group integrator of this form is at most two. The theta-method has one stage
with the coefficients a_11 = theta and b_1 = 1. For the theta-method, let xi, n and M be the velocity xi_1,
the force n_1 and the momentum M_1 of this stage. The momenta M and mu1 of the theta-method are

    M = dexp*_{-h xi} mu0 + h (1 - theta) dexp*_{-(1 - theta) h xi} n,
    mu1 = Ad*_{exp(-h xi)} mu0 + h Ad*_{exp(-(1 - theta) h xi)} n.
"""

from __future__ import annotations

from codegen.ir.program import Program
from codegen.ir.values import ONE, Coefficient, Kind, Var
from codegen.lower.variational import VariationalLowering, begin
from codegen.method import Method
from codegen.scene.problem import Problem


class SymplecticIntegrator(VariationalLowering):
    """Symplectic Lie group integrators of section 2.5 of Marthinsen's thesis."""

    family = "slgi"

    def lower(self, problem: Problem, method: Method) -> Program:
        """Return the program of one step of a symplectic Lie group integrator.

        :class:`orderconds.errors.ZeroWeight` is raised if some b_i = 0.
        """
        return _program(problem, method)


# For methods with one stage, this identity simplifies the momentum (a and b are numbers, x is a vector):
#
#     b dexp*_{-b x} Ad*_{exp(a x)} - a dexp*_{a x} = (b - a) dexp*_{-(b - a) x}.
def _program(scene: Problem, method: Method) -> Program:
    stages, tableau, A, b = begin(scene, method)
    q, mu = stages.inputs
    build, s = stages.builder, tableau.s
    xi = [build.fresh(f"xi{i + 1}", Kind.ALG) for i in range(s)]
    n = [build.fresh(f"n{i + 1}", Kind.DUAL) for i in range(s)]
    shared: dict[str, Var] = {}

    def several() -> list[Var]:
        """Append the momenta M_i of all stages to the program, and return their variables."""
        X = [stages.combination(f"X{i + 1}", Kind.ALG, row, xi) for i, row in enumerate(tableau.A)]
        Y = stages.combination("Y", Kind.ALG, tableau.b, xi)
        minus = build.lin("y", Kind.ALG, [(Coefficient(-ONE.value), Y)])
        nu = [build.adjoint(f"nu{j + 1}", build.exp(f"g{j + 1}", X[j]), n[j]) for j in range(s)]
        terms = [(ONE, mu)] + [(stages.times_h(b[j]), nu[j]) for j in range(s)]
        total = build.lin("mubar", Kind.DUAL, terms)
        moved = build.dual_dexp("Lambda", minus, total)
        direct = [build.dual_dexp(f"d{j + 1}", X[j], n[j]) for j in range(s)]
        shared.update(g=build.exp("g", Y), mubar=total)
        momenta = []
        for i in range(s):
            own = [(stages.times_h(-(b[j] * (A[j][i] / b[i]))), direct[j]) for j in range(s)]
            momenta.append(build.lin(f"M{i + 1}", Kind.DUAL, [(ONE, moved), *own]))
        return momenta

    def one() -> list[Var]:
        """For a method with one stage, append the momentum M to the program, and return [M]."""
        # Let mu be the momentum at the beginning of the step, xi the velocity of the stage, and n its force.
        # With r = b_1 - a_11, y = -h b_1 xi, z = -h r xi, the stage momentum is dexp*_y mu + h r dexp*_z n.
        rest = b[0] - A[0][0]
        minus = build.lin("y", Kind.ALG, [(stages.times_h(-b[0]), xi[0])])
        after = build.lin("z", Kind.ALG, [(stages.times_h(-rest), xi[0])])
        free = build.dual_dexp("L", minus, mu)
        forced = build.dual_dexp("F", after, n[0])
        shared.update(after=after)
        return [build.lin("M1", Kind.DUAL, [(ONE, free), (stages.times_h(rest), forced)])]

    def images() -> list[Var]:
        pairs = []
        for i, M in enumerate(one() if s == 1 else several()):
            x = stages.combination(f"X{i + 1}", Kind.ALG, tableau.A[i], xi)
            Q = build.mul(f"Q{i + 1}", build.exp(f"g{i + 1}", x), q)
            pairs.append(build.hamilton(f"f{i + 1}", f"r{i + 1}", Q, M, *stages.at(tableau.c[i])))
        return [f for f, _ in pairs] + [r for _, r in pairs]

    def starts() -> list[Var]:
        x, r = build.hamilton("xi0", "n0", q, mu, *stages.at(None))
        return [x] * s + [r] * s

    def update() -> dict[str, Var]:
        if s > 1:
            g = shared["g"]
            return {"q": build.mul("q1", g, q), "mu": build.adjoint("mu1", g, shared["mubar"], inverse=True)}
        g = build.exp("g", stages.combination("Y", Kind.ALG, tableau.b, xi))
        free = build.adjoint("mu_free", g, mu, inverse=True)
        forced = build.adjoint("mu_forced", build.exp("g_after", shared["after"]), n[0])
        terms = [(ONE, free), (stages.times_h(b[0]), forced)]
        return {"q": build.mul("q1", g, q), "mu": build.lin("mu1", Kind.DUAL, terms)}

    return stages.program(xi + n, images, starts, update)
