"""Variational Runge-Kutta-Munthe-Kaas methods on T*G, equation (3.16) of Marthinsen's thesis.

A step leads from (q0, mu0) to (q1, mu1). The coefficients of the tableau are a_ij and b_i. Let
dexp^{-1}_{(r),x} be the series of dexp^{-1}_x up to the terms with r brackets. The derivative of the vector
dexp^{-1}_{(r),x} xi with respect to x is a linear map. Let P*_(r)(x, xi) be the dual of this linear map. Let
xi_i and n_i be the velocity and the force of stage i, (xi_i, n_i) = f(exp(X_i) q0, M_i). The equations are

    m_i = b_i Lambda + sum_j a_ji lambda_j,   M_i = (dexp^{-1}_{(r),X_i})* m_i / b_i,
    lambda_i = -h b_i dexp*_{X_i} n_i + h P*_(r)(X_i, xi_i) m_i,
    v_i = dexp^{-1}_{(r),X_i} xi_i,   X_i = h sum_j a_ij v_j,   Y = h sum_j b_j v_j,
    Lambda = dexp*_{-Y}(mu0 + h sum_j b_j Ad*_{exp X_j} n_j),
    q1 = exp(Y) q0,   mu1 = Ad*_{exp(-Y)}(mu0 + h sum_j b_j Ad*_{exp X_j} n_j).

The vectors v_i and the covector Lambda are unknowns. Lambda is an unknown, because the forces n_j in the
equation for Lambda depend on Lambda. The covector m_i is an unknown if a_ji is not zero for some j <= i.
Otherwise the sum over j in the equation for m_i contains only later stages j > i, and the program computes
m_i from Lambda and from the lambda_j of these later stages.
"""

from __future__ import annotations

from codegen.ir.operations import InverseDexpSlope
from codegen.ir.program import Program
from codegen.ir.values import ONE, Coefficient, Kind, Var
from codegen.lower.variational import ExpandedStep, VariationalLowering
from codegen.method import Method
from codegen.scene.problem import Problem


class VariationalMuntheKaas(VariationalLowering):
    """Variational Runge-Kutta-Munthe-Kaas methods."""

    family = "vrkmk"

    def lower(self, problem: Problem, method: Method) -> Program:
        """Return the program of a VRKMK method with cut-off ``method.cutoff``.

        :class:`orderconds.errors.ZeroWeight` is raised if a weight b_i is zero, or is an interval that
        contains zero.
        :class:`codegen.errors.MethodError` is raised if the method has no cut-off.
        """
        return _Step(problem, method).program()


class _Step(ExpandedStep):
    """The equations of one step of a VRKMK method."""

    def __init__(self, problem: Problem, method: Method) -> None:
        super().__init__(problem, method)
        self.v = [self.build.fresh(f"v{i + 1}", Kind.ALG) for i in range(self.s)]
        self.m = [self.build.fresh(f"m{i + 1}", Kind.DUAL) for i in range(self.s)]
        self.transported = self.build.fresh("Lambda", Kind.DUAL)
        self.unknowns = [*self.v, *self.m, self.transported]
        self.forces: dict[int, Var] = {}
        self.slopes: dict[int, Var] = {}

    def images(self) -> list[Var]:
        """Return new values of v_i, m_i and Lambda, computed from their values in the previous iteration."""
        # The exponents X_i use the v_j of the previous iteration. The exponent Y uses the new v_j.
        self.exponentiate(self.v)
        velocities = self._evaluated()
        self.end(velocities, self.forces)
        image = self.build.dual_dexp("Lambda_new", self.minus, self.mubar)
        return [*velocities, *(self._multiplier(i) for i in range(self.s)), image]

    def _evaluated(self) -> list[Var]:
        """Append the assignments for the velocities and forces of all stages to the program.

        Let xi_i be the velocity of stage i at the position exp(X_i) q0. Return variables for the vectors
        dexp^{-1}_{X_i} xi_i. The program uses only the terms of the series of dexp^{-1} with at most
        ``self.r`` brackets. The stages are computed from the last to the first.
        """
        build, A, b = self.build, self.A, self.b
        lagrange, velocities = dict[int, Var](), dict[int, Var]()
        for i in reversed(range(self.s)):
            own = self.m[i]
            # If a_ji = 0 for all j <= i, m_i depends only on Lambda and on the covectors lambda_j with j > i.
            # These lambda_j are already computed.
            if all(A[j][i].is_zero for j in range(i + 1)):
                terms = [(Coefficient(b[i]), self.transported)]
                terms += [(Coefficient(A[j][i]), lagrange[j]) for j in range(i + 1, self.s)]
                own = build.lin(f"p{i + 1}", Kind.DUAL, terms)
            # M_i is computed from m_i / b_i (see the docstring of this module).
            weighted = build.lin(f"w{i + 1}", Kind.DUAL, [(Coefficient(ONE.value / b[i]), own)])
            # The argument ``weighted`` is a covector, so ``dexpinv`` applies the dual of dexp^{-1}.
            M = build.dexpinv(f"M{i + 1}", self.X[i], weighted, self.r)
            Q = build.mul(f"Q{i + 1}", self.g[i], self.q)
            xi, n = build.hamilton(f"xi{i + 1}", f"n{i + 1}", Q, M, *self.time(i))
            # The step is symplectic only if v_i and M_i have the same cut-off ``r``.
            velocities[i] = build.dexpinv(f"u{i + 1}", self.X[i], xi, self.r)
            # The vector ``slope`` depends on the derivative of dexp^{-1}_x with respect to x.
            slope = build.add(InverseDexpSlope(self.r), f"P{i + 1}", self.X[i], xi, own)
            self.forces[i], self.slopes[i] = n, slope
            # A small change d of X_i moves Q_i = exp(X_i) q0 by dexp_{X_i} d. The work of the force n_i is
            # then <n_i, dexp_{X_i} d> = <dexp*_{X_i} n_i, d>.
            direct = build.dual_dexp(f"d{i + 1}", self.X[i], n)
            terms = [(self.stages.times_h(-b[i]), direct), (self.stages.times_h(ONE.value), slope)]
            lagrange[i] = build.lin(f"lambda{i + 1}", Kind.DUAL, terms)
        # The loop begins with the last stage, but the list must begin with the first stage.
        return [velocities[i] for i in range(self.s)]

    def _multiplier(self, i: int) -> Var:
        """Return a variable for the right-hand side of the equation m_i = b_i Lambda + sum_j a_ji lambda_j.

        The assignments that compute this variable are appended to the program.
        """
        build, A, b, times_h = self.build, self.A, self.b, self.stages.times_h
        terms = [(Coefficient(b[i]), build.dual_dexp("L", self.minus, self.mu))]
        for j in range(self.s):
            # Let n_j be the force of stage j. On an abelian group, the next two terms are h b_i b_j n_j and
            # -h a_ji b_j n_j. Their sum is h b_i ahat_ij n_j, where ahat_ij = b_j - b_j a_ji/b_i is the
            # coefficient of a symplectic partitioned Runge-Kutta method.
            terms.append((times_h(b[i] * b[j]), build.dual_dexp("L", self.minus, self.nu[j])))
            direct = build.dual_dexp(f"d{j + 1}", self.X[j], self.forces[j])
            terms.append((times_h(-(A[j][i] * b[j])), direct))
            terms.append((times_h(A[j][i]), self.slopes[j]))
        return build.lin(f"p{i + 1}", Kind.DUAL, terms)

    def starts(self) -> list[Var]:
        """Return the initial guesses of the unknowns.

        The guesses are v_i = xi, m_i = b_i mu0 and Lambda = mu0. Here xi is the velocity at (q0, mu0).
        """
        build = self.build
        xi, _ = build.hamilton("xi0", "n0", self.q, self.mu, *self.stages.at(None))
        # m_i is b_i times a momentum, so the initial guess of m_i is b_i mu0.
        weighted = [
            build.lin(f"m0_{i + 1}", Kind.DUAL, [(Coefficient(self.b[i]), self.mu)]) for i in range(self.s)
        ]
        return [xi] * self.s + weighted + [self.mu]
