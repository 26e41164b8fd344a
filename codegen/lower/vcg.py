"""Variational Crouch-Grossman methods on T*G, equations (3.18) and (3.19) of Marthinsen's thesis.

A step leads from (q0, mu0) to (q1, mu1). The coefficients of the tableau with s stages are a_ij and b_i. Let
(xi_i, n_i) = f(Q_i, M_i) be the velocity and the force of stage i. The group elements e^j and E_i^j are
products of j exponentials. The superscript j is an index, not a power. The empty products are
e^0 = E_i^0 = 1. The product of all s factors of stage i is E_i = E_i^s. The equations are

    e^j = exp(h b_j xi_j) e^{j-1},   E_i^j = exp(h a_ij xi_j) E_i^{j-1},
    Q_i = E_i q0,   nu_j = Ad*_{E_j} n_j,
    M_i = dexp*_{-h b_i xi_i} Ad*_{(e^{i-1})^-1} (mu0 + h sum_j b_j nu_j)
          - h sum_j (b_j a_ji/b_i) dexp*_{-h a_ji xi_i} Ad*_{(E_j^{i-1})^-1} nu_j,
    q1 = e^s q0,   mu1 = Ad*_{(e^s)^-1} (mu0 + h sum_j b_j nu_j).

The equation for M_i follows from (3.19) and the identity dexp*_x Ad*_{exp(-x)} = dexp*_{-x}.
"""

from __future__ import annotations

from codegen.ir.program import Program
from codegen.ir.values import ONE, Coefficient, Kind, Var
from codegen.lower.variational import VariationalLowering, begin
from codegen.method import Method
from codegen.scene.problem import Problem
from orderconds.ring.protocol import Element


class VariationalCrouchGrossman(VariationalLowering):
    """Variational Crouch-Grossman methods."""

    family = "vcg"
    repeats_substeps = True

    def lower(self, problem: Problem, method: Method) -> Program:
        """Return the program of a VCG method.

        :class:`orderconds.errors.ZeroWeight` is raised if a weight b_i is zero, or is an interval that
        contains zero.
        """
        return _program(problem, method)


# The coefficient b_j a_ji/b_i in the equation for M_i is computed as b_j (a_ji/b_i). If a_ji = b_i, the
# quotient a_ji/b_i is exactly 1, even if a_ji and b_i are intervals.
def _program(scene: Problem, method: Method) -> Program:
    stages, tableau, A, b = begin(scene, method)
    q, mu = stages.inputs
    build, s = stages.builder, tableau.s
    xi = [build.fresh(f"xi{i + 1}", Kind.ALG) for i in range(s)]
    n = [build.fresh(f"n{i + 1}", Kind.DUAL) for i in range(s)]
    shared: dict[str, list[Var]] = {}

    def partial_products(row: tuple[Element, ...], name: str) -> list[Var]:
        """Return the products of the first 0, 1, ..., s factors exp(h row_j xi_j)."""
        products = [build.identity(f"{name}0")]
        for j in range(s):
            x = stages.combination(f"x{name}{j + 1}", Kind.ALG, row[j : j + 1], xi[j : j + 1])
            products.append(build.mul(f"{name}{j + 1}", build.exp(f"g{name}{j + 1}", x), products[-1]))
        return products

    def momentum(i: int, e: list[Var], E: list[list[Var]], nu: list[Var]) -> Var:
        """Return the momentum M_i of stage i (see the docstring of this module)."""
        minus = stages.builder.lin(f"y{i + 1}", Kind.ALG, [(stages.times_h(-b[i]), xi[i])])

        def carried(m: Var) -> Var:
            # The stages are 0, ..., s-1. The product e[i] contains the exponentials of stages 0, ..., i-1.
            moved = build.adjoint(f"m{i + 1}", e[i], m, inverse=True)
            return build.dual_dexp(f"p{i + 1}", minus, moved)

        terms = [(ONE, carried(mu))]
        for j in range(s):
            terms.append((stages.times_h(b[j]), carried(nu[j])))
            a = A[j][i]
            if a.is_zero:  # Q_j does not depend on xi_i
                continue
            x = build.lin(f"y{i + 1}", Kind.ALG, [(stages.times_h(-a), xi[i])])
            moved = build.adjoint(f"m{i + 1}", E[j][i], nu[j], inverse=True)
            factor = Coefficient(-(b[j] * (a / b[i])), 1)
            terms.append((factor, build.dual_dexp(f"p{i + 1}", x, moved)))
        return build.lin(f"M{i + 1}", Kind.DUAL, terms)

    def images() -> list[Var]:
        e = partial_products(tableau.b, "e")
        E = [partial_products(row, f"E{i + 1}_") for i, row in enumerate(tableau.A)]
        nu = [build.adjoint(f"nu{j + 1}", E[j][s], n[j]) for j in range(s)]
        evaluations = []
        for i in range(s):
            Q = build.mul(f"Q{i + 1}", E[i][s], q)
            M = momentum(i, e, E, nu)
            evaluations.append(build.hamilton(f"f{i + 1}", f"r{i + 1}", Q, M, *stages.at(tableau.c[i])))
        shared.update(e=e, nu=nu)
        return [x for x, _ in evaluations] + [r for _, r in evaluations]

    def starts() -> list[Var]:
        x, r = build.hamilton("xi0", "n0", q, mu, *stages.at(None))
        return [x] * s + [r] * s

    def update() -> dict[str, Var]:
        e, nu = shared["e"], shared["nu"]
        terms = [(ONE, mu)] + [(stages.times_h(b[j]), nu[j]) for j in range(s)]
        total = build.lin("mubar", Kind.DUAL, terms)
        return {"q": build.mul("q1", e[s], q), "mu": build.adjoint("mu1", e[s], total, inverse=True)}

    return stages.program(xi + n, images, starts, update)
