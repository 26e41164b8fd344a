"""Variational commutator-free methods on T*G.

Each exponent is a linear combination of the velocities xi_j of the stages. In exponent J of stage i, xi_j has
the coefficient alpha_iJ^j. The superscript j is an index, not a power. In exponent J of the update, xi_j has
the coefficient beta_J^j. Exponent J is X_iJ in stage i, and Y_J in the update:

    X_iJ = h sum_j alpha_iJ^j xi_j,   Y_J = h sum_j beta_J^j xi_j.

The group elements E_i^J and e^J are products of J exponentials:

    E_i^J = exp(X_iJ) E_i^{J-1},   E_i^0 = 1,
    e^J = exp(Y_J) e^{J-1},        e^0 = 1.

E_i and e are the products of all factors. The position of stage i is Q_i = E_i q0. With the Lagrangian l, the
discrete Lagrangian is h sum_i b_i l(Q_i, xi_i), where b_i = sum_J beta_J^i. The momentum of stage j is M_j.
The velocity and the force of stage j are (xi_j, n_j) = f(Q_j, M_j). With nu_j = Ad*_{E_j} n_j and
mubar = mu0 + h sum_j b_j nu_j, Hamilton's equations for the discrete Lagrangian are

    b_i M_i = sum_J beta_J^i dexp*_{-Y_J} Ad*_{(e^{J-1})^-1} mubar
              - h sum_j sum_J b_j alpha_jJ^i dexp*_{-X_jJ} Ad*_{(E_j^{J-1})^-1} nu_j,
    q1 = e q0,   mu1 = Ad*_{e^-1} mubar.

The first equation uses the identity dexp*_x Ad*_{exp(-x)} = dexp*_{-x} for x in the Lie algebra.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from codegen.ir.number import Number
from codegen.ir.program import Builder, Program
from codegen.ir.values import ONE, Coefficient, Kind, Var
from codegen.lower.stages import Stages
from codegen.lower.variational import VariationalLowering, nonzero
from codegen.method import Method
from codegen.scene.problem import Problem

Rows = tuple[tuple[Number, ...], ...]
"""The coefficients in a product of exponentials: one row for each exponent.

The first row gives the rightmost factor.
"""


@dataclass(frozen=True)
class _Product:
    """A product of exponentials in a program.

    - ``rows`` contains the coefficients of the exponents.
    - ``minus`` contains the exponents, multiplied by -1.
    - ``partial`` contains the products of the first 0, 1, ... factors.
    """

    rows: Rows
    minus: tuple[Var, ...]
    partial: tuple[Var, ...]

    @classmethod
    def of(cls, stages: Stages, name: str, rows: Rows, xi: Sequence[Var]) -> _Product:
        """Append a product to the program. Each row gives one factor exp(h sum_j row_j xi_j)."""
        build = stages.builder

        def exponent(name: str, row: tuple[Number, ...], sign: int) -> Var:
            scaled = (stages.times_h(x if sign > 0 else -x) for x in row)
            return build.lin(name, Kind.ALG, list(zip(scaled, xi, strict=True)))

        # All partial products are stored, because the momenta of the stages depend on them.
        partial, minus = [build.identity(f"{name}0")], []
        for J, row in enumerate(rows, start=1):
            g = build.exp(f"g{name}{J}", exponent(f"x{name}{J}", row, 1))
            # The first exponential acts first, so it is the rightmost factor of the product.
            partial.append(build.mul(f"{name}{J}", g, partial[-1]))
            # The momenta contain dexp*_{-x} for each exponent x, so -x needs a variable of its own.
            minus.append(exponent(f"y{name}{J}", row, -1))
        return cls(rows, tuple(minus), tuple(partial))

    def carried(self, build: Builder, i: int, J: int, m: Var) -> Var:
        """Return a new variable for the covector dexp*_y Ad*_{p^-1} m.

        Here y is ``minus[J]``, and p is ``partial[J]``. The assignments that compute the covector are
        appended to the program. The index i occurs only in names of variables.
        """
        moved = build.adjoint(f"m{i + 1}", self.partial[J], m, inverse=True)
        return build.dual_dexp(f"p{i + 1}", self.minus[J], moved)


class VariationalCommutatorFree(VariationalLowering):
    """Variational commutator-free methods."""

    family = "vcf"
    repeats_substeps = True

    def lower(self, problem: Problem, method: Method) -> Program:
        """Return the program of a VCF method.

        :class:`orderconds.errors.ZeroWeight` is raised if a weight b_i is zero, or is an interval that
        contains zero.
        """
        return _program(problem, method)


def _program(scene: Problem, method: Method) -> Program:
    rows, update = _coefficients(method)
    s = len(rows)
    b = _weights(method, update, s)
    q, mu = Var("q", Kind.GROUP), Var("mu", Kind.DUAL)
    stages = Stages(scene, method, (q, mu))
    build = stages.builder
    xi = [build.fresh(f"xi{i + 1}", Kind.ALG) for i in range(s)]
    n = [build.fresh(f"n{i + 1}", Kind.DUAL) for i in range(s)]
    shared: dict[str, Var] = {}

    def momentum(i: int, e: _Product, E: list[_Product], nu: list[Var]) -> Var:
        """Append the momentum M_i of stage i (see the docstring of this module)."""
        terms = []
        for J, row in enumerate(e.rows):
            if not row[i].is_zero:
                # In the module docstring, row[i] is denoted by beta_J^i.
                share = row[i] / b[i]
                terms.append((Coefficient(share), e.carried(build, i, J, mu)))
                # These terms are not summed up here, because some of them may cancel terms of the next loop.
                terms += [(stages.times_h(b[j] * share), e.carried(build, i, J, nu[j])) for j in range(s)]
        # This loop appends the sum over j and J in the equation for M_i (see the module docstring).
        for j, stage in enumerate(E):
            for J, row in enumerate(stage.rows):
                if not row[i].is_zero:
                    # If row[i] == b[i], the class Number returns the exact quotient 1, even for intervals.
                    factor = stages.times_h(-(b[j] * (row[i] / b[i])))
                    terms.append((factor, stage.carried(build, i, J, nu[j])))
        return build.lin(f"M{i + 1}", Kind.DUAL, terms)

    def images() -> list[Var]:
        e = _Product.of(stages, "e", update, xi)
        # A later pass merges equal factors at the beginning of the products E_i.
        E = [_Product.of(stages, f"E{i + 1}_", r, xi) for i, r in enumerate(rows)]
        nu = [build.adjoint(f"nu{j + 1}", E[j].partial[-1], n[j]) for j in range(s)]
        evaluations = []
        c = method.abscissae()
        for i in range(s):
            Q = build.mul(f"Q{i + 1}", E[i].partial[-1], q)
            # M_i is not an unknown, because it is a function of the velocities and forces of the stages.
            evaluations.append(
                build.hamilton(f"f{i + 1}", f"r{i + 1}", Q, momentum(i, e, E, nu), *stages.at(c[i]))
            )
        terms = [(ONE, mu)] + [(stages.times_h(b[j]), nu[j]) for j in range(s)]
        shared.update(e=e.partial[-1], mubar=build.lin("mubar", Kind.DUAL, terms))
        return [x for x, _ in evaluations] + [r for _, r in evaluations]

    def starts() -> list[Var]:
        x, r = build.hamilton("xi0", "n0", q, mu, *stages.at(None))
        return [x] * s + [r] * s

    def result() -> dict[str, Var]:
        e = shared["e"]
        return {"q": build.mul("q1", e, q), "mu": build.adjoint("mu1", e, shared["mubar"], inverse=True)}

    return stages.program(xi + n, images, starts, result)


def _coefficients(method: Method) -> tuple[list[Rows], Rows]:
    """Return the rows of coefficients for each stage, and the rows for the update."""
    tableau = method.commutator_free()
    # The update has the same format as a stage.
    *stages, update = (
        tuple(tuple(method.number(x) for x in row) for row in tableau.from_start(stage))
        for stage in (*tableau.stages, tableau.update)
    )
    return stages, update


def _weights(method: Method, update: Rows, s: int) -> list[Number]:
    """Return the weights b_i, the sums of the coefficients of xi_i in the update.

    If a weight may be zero, ZeroWeight is raised.
    """
    b = []
    for i in range(s):
        # The weight b_i is the sum of the coefficients of xi_i in all exponents.
        weight = Number.rational(0)
        for row in update:
            weight = weight + row[i]
        b.append(weight)
    return nonzero(method, b)
