"""Symplectic Lie group integrators on T*G, the family of thesis section 2.5; one stage is the theta-method.

With X_i = h sum_j a_ij xi_j, Y = h sum_j b_j xi_j, Q_i = exp(X_i) q0, (xi_i, n_i) = f(Q_i, M_i) and nu_j =
Ad*_{exp X_j} n_j,

    M_i = dexp*_{-Y}(mu0 + h sum_j b_j nu_j) - h sum_j (b_j a_ji/b_i) dexp*_{X_j} n_j,
    q1 = exp(Y) q0,   mu1 = Ad*_{exp(-Y)}(mu0 + h sum_j b_j nu_j).

It has no brackets, is VRKMK(0) and has order two at most (in section 2.5 f carries h). With one stage, a_11 =
theta and b_1 = 1, all factors are exponentials of xi, and the terms in n merge:

    M = dexp*_{-h xi} mu0 + h (1 - theta) dexp*_{-(1 - theta) h xi} n,
    mu1 = Ad*_{exp(-h xi)} mu0 + h Ad*_{exp(-(1 - theta) h xi)} n.

The unknowns are the xi_i and n_i.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from codegen.ir.program import ONE, Coefficient, Kind, Program, Var
from codegen.lower.variational import VariationalLowering, begin
from codegen.method import Method
from codegen.scene.problem import Problem

if TYPE_CHECKING:
    from orderconds.families import Family


class SymplecticIntegrator(VariationalLowering):
    """Symplectic Lie group integrators of section 2.5 of Marthinsen's thesis."""

    family = "slgi"

    def lower(self, problem: Problem, method: Method) -> Program:
        """Return the program of an SLGI method; :class:`orderconds.errors.ZeroWeight` where some b_i = 0."""
        return _program(problem, method)

    def conditions(self, method: Method, scene: Problem | None = None) -> Family:
        """Return the conditions of VRKMK without brackets, which the method is."""
        from orderconds import families

        return families.get("vrkmk(0)")


def _program(scene: Problem, method: Method) -> Program:
    stages, tableau, A, b = begin(scene, method)
    q, mu = stages.inputs
    do, s = stages.builder, tableau.s
    xi = [do.fresh(f"xi{i + 1}", Kind.ALG) for i in range(s)]
    n = [do.fresh(f"n{i + 1}", Kind.DUAL) for i in range(s)]
    shared: dict[str, Var] = {}

    def several() -> list[Var]:
        """Append the momenta of the stages, one or more."""
        X = [stages.combination(f"X{i + 1}", Kind.ALG, row, xi) for i, row in enumerate(tableau.A)]
        Y = stages.combination("Y", Kind.ALG, tableau.b, xi)
        minus = do.lin("y", Kind.ALG, [(Coefficient(-ONE.value), Y)])
        nu = [do.do("Adt", f"nu{j + 1}", do.do("exp", f"g{j + 1}", X[j]), n[j]) for j in range(s)]
        terms = [(ONE, mu)] + [(stages.times_h(b[j]), nu[j]) for j in range(s)]
        total = do.lin("mubar", Kind.DUAL, terms)
        moved = do.do("dexpt", "Lambda", minus, total)
        direct = [do.do("dexpt", f"d{j + 1}", X[j], n[j]) for j in range(s)]
        shared.update(g=do.do("exp", "g", Y), mubar=total)
        found = []
        for i in range(s):
            own = [(stages.times_h(-(b[j] * (A[j][i] / b[i]))), direct[j]) for j in range(s)]
            found.append(do.lin(f"M{i + 1}", Kind.DUAL, [(ONE, moved), *own]))
        return found

    def one() -> list[Var]:
        """Append the momentum of the theta-method, for any b_1."""
        rest = b[0] - A[0][0]
        minus = do.lin("y", Kind.ALG, [(stages.times_h(-b[0]), xi[0])])
        after = do.lin("z", Kind.ALG, [(stages.times_h(-rest), xi[0])])
        free = do.do("dexpt", "L", minus, mu)
        forced = do.do("dexpt", "F", after, n[0])
        shared.update(after=after)
        return [do.lin("M1", Kind.DUAL, [(ONE, free), (stages.times_h(rest), forced)])]

    def images() -> list[Var]:
        pairs = []
        for i, M in enumerate(one() if s == 1 else several()):
            x = stages.combination(f"X{i + 1}", Kind.ALG, tableau.A[i], xi)
            Q = do.do("mul", f"Q{i + 1}", do.do("exp", f"g{i + 1}", x), q)
            pairs.append(do.hamilton(f"f{i + 1}", f"r{i + 1}", Q, M, *stages.at(tableau.c[i])))
        return [f for f, _ in pairs] + [r for _, r in pairs]

    def starts() -> list[Var]:
        x, r = do.hamilton("xi0", "n0", q, mu, *stages.at(None))
        return [x] * s + [r] * s

    def update() -> dict[str, Var]:
        if s > 1:
            g = shared["g"]
            return {"q": do.do("mul", "q1", g, q), "mu": do.do("Adtinv", "mu1", g, shared["mubar"])}
        g = do.do("exp", "g", stages.combination("Y", Kind.ALG, tableau.b, xi))
        free = do.do("Adtinv", "mu_free", g, mu)
        forced = do.do("Adt", "mu_forced", do.do("exp", "g_after", shared["after"]), n[0])
        terms = [(ONE, free), (stages.times_h(b[0]), forced)]
        return {"q": do.do("mul", "q1", g, q), "mu": do.lin("mu1", Kind.DUAL, terms)}

    return stages.program(xi + n, images, starts, update)
