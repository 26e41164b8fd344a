"""VRKMK with dexp^{-1} replaced by the inverse of dexp cut off: thesis section 3.4.1, alternative approach.

The unknowns v_i satisfy dexp_{(r),X_i} v_i = xi_i, where dexp_{(r),x} = sum_{k<=r} ad_x^k/(k+1)! and X_i =
h sum_j a_ij v_j; so no multipliers are needed. With R*_(r)(x, v) the dual of the derivative of dexp_{(r),x} v
by x, (xi_i, n_i) = f(exp(X_i) q0, M_i), Y = h sum_j b_j v_j and Lambda = dexp*_{-Y}(mu0 + h sum_j b_j
Ad*_{exp X_j} n_j),

    b_i dexp*_{(r),X_i} M_i = b_i Lambda - h sum_j b_j a_ji (R*_(r)(X_j, v_j) M_j + dexp*_{X_j} n_j),
    q1 = exp(Y) q0,   mu1 = Ad*_{exp(-Y)}(mu0 + h sum_j b_j Ad*_{exp X_j} n_j).

These are the Hamilton equations of the discrete Lagrangian h sum_i b_i l(Q_i, dexp_{(r),X_i} v_i). The
unknowns are all v_i and M_i; of each dexp_(r) the identity is solved for, the rest is taken from the sweep
before.
"""

from __future__ import annotations

from fractions import Fraction
from math import factorial

from codegen.ir.number import Number
from codegen.ir.program import Program
from codegen.ir.values import ONE, Coefficient, Kind, Var
from codegen.lower.variational import VariationalLowering, begin, brackets
from codegen.method import Method
from codegen.scene.problem import Problem

Terms = list[tuple[Coefficient, Var]]


class VariationalMuntheKaasPade(VariationalLowering):
    """VRKMK with the inverse of dexp cut off."""

    family = "vrkmk_pade"

    def lower(self, problem: Problem, method: Method) -> Program:
        """Return the program with ``method.cutoff`` brackets in dexp.

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
    M = [build.fresh(f"M{i + 1}", Kind.DUAL) for i in range(s)]
    shared: dict[str, Var] = {}

    def powers(x: Var, first: Var) -> list[Var]:
        """Append ad_x^k first, or its dual, for k = 0..r."""
        found = [first]
        for k in range(r):
            found.append(build.bracket(f"{first.name}_{k + 1}", x, found[-1]))
        return found

    def rest(chain: list[Var]) -> Terms:
        """Return -sum over k >= 1 of ad_x^k/(k+1)!, or of its dual."""
        return [(_over_factorial(-1, k), power) for k, power in enumerate(chain) if k]

    def slope(name: str, brackets: list[Var], momenta: list[Var]) -> Var:
        """Append R*_(r) M, the sum over i < r of ad*_z (ad*_x)^i M, z = -sum_k ad_x^{k-1-i} v/(k+1)!."""
        terms: Terms = []
        for i in range(r):
            inner = [(_over_factorial(-1, k), brackets[k - 1 - i]) for k in range(i + 1, r + 1)]
            subscript = build.lin("z", Kind.ALG, inner)
            terms.append((ONE, build.bracket("R", subscript, momenta[i])))
        return build.lin(name, Kind.DUAL, terms)

    def images() -> list[Var]:
        X = [stages.combination(f"X{i + 1}", Kind.ALG, row, v) for i, row in enumerate(tableau.A)]
        g = [build.exp(f"g{i + 1}", x) for i, x in enumerate(X)]
        velocities, forces, slopes, corrections = [], [], [], []
        for i in range(s):
            Q = build.mul(f"Q{i + 1}", g[i], q)
            xi, n = build.hamilton(f"xi{i + 1}", f"n{i + 1}", Q, M[i], *stages.at(tableau.c[i]))
            brackets, momenta = powers(X[i], v[i]), powers(X[i], M[i])
            velocities.append(build.lin(f"u{i + 1}", Kind.ALG, [(ONE, xi), *rest(brackets)]))
            forces.append(n)
            slopes.append(slope(f"R{i + 1}", brackets, momenta))
            corrections.append(rest(momenta))
        Y = stages.combination("Y", Kind.ALG, tableau.b, velocities)
        minus = build.lin("y", Kind.ALG, [(Coefficient(-ONE.value), Y)])
        nu = [build.adjoint(f"nu{j + 1}", g[j], forces[j]) for j in range(s)]
        total = [(ONE, mu)] + [(stages.times_h(b[j]), nu[j]) for j in range(s)]
        shared.update(Y=Y, mubar=build.lin("mubar", Kind.DUAL, total))
        found = []
        for i in range(s):
            terms: Terms = [(ONE, build.dual_dexp("L", minus, mu)), *corrections[i]]
            for j in range(s):
                factor = stages.times_h(-(b[j] * (A[j][i] / b[i])))
                terms.append((stages.times_h(b[j]), build.dual_dexp("L", minus, nu[j])))
                terms.append((factor, build.dual_dexp(f"d{j + 1}", X[j], forces[j])))
                terms.append((factor, slopes[j]))
            found.append(build.lin(f"p{i + 1}", Kind.DUAL, terms))
        return [*velocities, *found]

    def starts() -> list[Var]:
        xi, _ = build.hamilton("xi0", "n0", q, mu, *stages.at(None))
        return [xi] * s + [mu] * s

    def update() -> dict[str, Var]:
        g = build.exp("g", shared["Y"])
        return {"q": build.mul("q1", g, q), "mu": build.adjoint("mu1", g, shared["mubar"], inverse=True)}

    return stages.program([*v, *M], images, starts, update)


def _over_factorial(sign: int, k: int) -> Coefficient:
    """Return sign/(k + 1)!."""
    return Coefficient(Number.rational(*Fraction(sign, factorial(k + 1)).as_integer_ratio()))
