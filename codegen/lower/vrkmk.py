"""Variational Runge-Kutta-Munthe-Kaas methods on T*G, thesis eq. (3.16).

With Q_i = exp(X_i) q0, (xi_i, n_i) = f(Q_i, M_i) and P*_(r)(x, xi) the dual of the derivative of
dexp^{-1}_{(r),x} xi by x, the equations are

    m_i = b_i Lambda + sum_j a_ji lambda_j,   M_i = (dexp^{-1}_{(r),X_i})* m_i / b_i,
    lambda_i = -h b_i dexp*_{X_i} n_i + h P*_(r)(X_i, xi_i) m_i,
    v_i = dexp^{-1}_{(r),X_i} xi_i,   X_i = h sum_j a_ij v_j,   Y = h sum_j b_j v_j,
    Lambda = dexp*_{-Y}(mu0 + h sum_j b_j Ad*_{exp X_j} n_j),
    q1 = exp(Y) q0,   mu1 = Ad*_{exp(-Y)}(mu0 + h sum_j b_j Ad*_{exp X_j} n_j).

Given all v_i and m_i the scene is evaluated once a stage and everything else follows: they are the unknowns.
Where a_ji = 0 for all j <= i, m_i follows from Lambda and later stages; then Lambda is an unknown and m_i is
none. What no equation reads, the passes take out. The sum m_i is written out in mu0, n_j and m_j, so that the
terms cancel that cancel on an abelian group.
"""

from __future__ import annotations

from codegen.ir.operations import InverseDexpSlope
from codegen.ir.program import Program
from codegen.ir.values import ONE, Coefficient, Kind, Var
from codegen.lower.variational import VariationalLowering, begin, brackets
from codegen.method import Method
from codegen.scene.problem import Problem


class VariationalMuntheKaas(VariationalLowering):
    """Variational Runge-Kutta-Munthe-Kaas methods."""

    family = "vrkmk"

    def lower(self, problem: Problem, method: Method) -> Program:
        """Return the program of a VRKMK method with cut-off ``method.cutoff``.

        :class:`orderconds.errors.ZeroWeight` where some b_i = 0, :class:`codegen.errors.MethodError` without
        a cut-off: a program has finitely many brackets.
        """
        return _program(problem, method)


def _program(scene: Problem, method: Method) -> Program:
    r = brackets(method)
    stages, tableau, A, b = begin(scene, method)
    q, mu = stages.inputs
    build, s = stages.builder, tableau.s
    v = [build.fresh(f"v{i + 1}", Kind.ALG) for i in range(s)]
    m = [build.fresh(f"m{i + 1}", Kind.DUAL) for i in range(s)]
    transported = build.fresh("Lambda", Kind.DUAL)
    later_only = [all(A[j][i].is_zero for j in range(i + 1)) for i in range(s)]
    shared: dict[str, Var] = {}

    def images() -> list[Var]:
        X = [stages.combination(f"X{i + 1}", Kind.ALG, row, v) for i, row in enumerate(tableau.A)]
        g = [build.exp(f"g{i + 1}", x) for i, x in enumerate(X)]
        now, forces, slopes = list(m), dict[int, Var](), dict[int, Var]()
        lagrange, velocities = dict[int, Var](), dict[int, Var]()
        for i in reversed(range(s)):
            if later_only[i]:
                terms = [(Coefficient(b[i]), transported)]
                terms += [(Coefficient(A[j][i]), lagrange[j]) for j in range(i + 1, s)]
                now[i] = build.lin(f"p{i + 1}", Kind.DUAL, terms)
            weighted = build.lin(f"w{i + 1}", Kind.DUAL, [(Coefficient(ONE.value / b[i]), now[i])])
            M = build.dexpinv(f"M{i + 1}", X[i], weighted, r)
            Q = build.mul(f"Q{i + 1}", g[i], q)
            xi, n = build.hamilton(f"xi{i + 1}", f"n{i + 1}", Q, M, *stages.at(tableau.c[i]))
            velocities[i] = build.dexpinv(f"u{i + 1}", X[i], xi, r)
            forces[i] = n
            slopes[i] = build.add(InverseDexpSlope(r), f"P{i + 1}", X[i], xi, now[i])
            direct = build.dual_dexp(f"d{i + 1}", X[i], n)
            lagrange[i] = build.lin(
                f"lambda{i + 1}",
                Kind.DUAL,
                [(stages.times_h(-b[i]), direct), (stages.times_h(ONE.value), slopes[i])],
            )
        found = [velocities[i] for i in range(s)]
        Y = stages.combination("Y", Kind.ALG, tableau.b, found)
        minus = build.lin("y", Kind.ALG, [(Coefficient(-ONE.value), Y)])
        nu = [build.adjoint(f"nu{j + 1}", g[j], forces[j]) for j in range(s)]
        momentum = build.lin(
            "mubar", Kind.DUAL, [(ONE, mu)] + [(stages.times_h(b[j]), nu[j]) for j in range(s)]
        )
        shared.update(Y=Y, mubar=momentum)

        def written_out(i: int) -> Var:
            terms = [(Coefficient(b[i]), build.dual_dexp("L", minus, mu))]
            for j in range(s):
                terms.append((stages.times_h(b[i] * b[j]), build.dual_dexp("L", minus, nu[j])))
                direct = build.dual_dexp(f"d{j + 1}", X[j], forces[j])
                terms.append((stages.times_h(-(A[j][i] * b[j])), direct))
                terms.append((stages.times_h(A[j][i]), slopes[j]))
            return build.lin(f"p{i + 1}", Kind.DUAL, terms)

        image = build.dual_dexp("Lambda_new", minus, momentum)
        return [*found, *(written_out(i) for i in range(s)), image]

    def starts() -> list[Var]:
        xi, _ = build.hamilton("xi0", "n0", q, mu, *stages.at(None))
        weighted = [build.lin(f"m0_{i + 1}", Kind.DUAL, [(Coefficient(b[i]), mu)]) for i in range(s)]
        return [xi] * s + weighted + [mu]

    def update() -> dict[str, Var]:
        g = build.exp("g", shared["Y"])
        return {"q": build.mul("q1", g, q), "mu": build.adjoint("mu1", g, shared["mubar"], inverse=True)}

    return stages.program([*v, *m, transported], images, starts, update)
