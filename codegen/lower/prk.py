"""Partitioned Runge-Kutta methods on T*R^n: one tableau for the positions, another for the momenta.

The equations of a step are those of section II.2.1 in E. Hairer, C. Lubich and G. Wanner, *Geometric
Numerical Integration* (HLW):

    Q_i = q0 + h sum_j a_ij xi_j,   P_i = p0 + h sum_j ahat_ij n_j,
    (xi_i, n_i) = f(Q_i, P_i, t0 + c_i h),   c_i = sum_j a_ij,
    q1 = q0 + h sum_i b_i xi_i,     p1 = p0 + h sum_i bhat_i n_i.

The tableau for the positions has the coefficients a_ij and b_i. The tableau for the momenta has the
coefficients ahat_ij and bhat_i. The pair f(q, p, t) consists of the velocity and the force. The unknowns are
the velocities xi_i and the forces n_i.

If the velocity does not depend on q, the program uses q0 in place of Q_i. If the force does not depend on p,
it uses p0 in place of P_i. The compiler can then detect explicit stages, for example in the Stoermer-Verlet
method.
"""

from __future__ import annotations

from codegen.errors import MethodError
from codegen.ir.expr import walk
from codegen.ir.program import Program
from codegen.ir.values import ONE, Kind, Var
from codegen.lower.base import Lowering, Objection
from codegen.lower.stages import Stages
from codegen.method import Method
from codegen.scene.problem import TIME, Problem
from orderconds.families import Family
from orderconds.tableau.method_properties import symplectic_pair
from orderconds.tableau.methods import PartitionedRungeKutta, RungeKutta


class PartitionedLowering(Lowering):
    """Partitioned Runge-Kutta methods for Hamilton's equations on a vector space."""

    family = "prk"
    hamiltonian = True
    repeats_substeps = True

    def objection(self, scene: Problem) -> Objection | None:
        """Return an objection if the scene has no Hamiltonian, or if its group is not abelian.

        For all other scenes return None.
        """
        if not scene.is_hamiltonian:
            return Objection(": the state contains no momentum", "a Hamiltonian scene")
        if scene.group.abelian:
            return None
        hint = "use a variational method for Lie groups: vcg, vcf or vrkmk"
        return Objection(f", whose group is {scene.group.name}", "a Hamiltonian scene on R^n", hint)

    def problem(self, scene: Problem, method: Method) -> Problem:
        """Return the scene itself."""
        return scene

    def symplectic(self, scene: Problem, method: Method) -> bool:
        """Return True if the compiler proves that the steps are symplectic for the scene's Hamiltonian.

        For H = T(p) + V(q, t), the pair of tableaux must be symplectic. For all other H, the
        weights must also satisfy b_i = b_hat_i (HLW Theorem VI.4.6).
        """
        tableau, zero = _pair(method), method.ring.is_zero
        # If the ring cannot decide whether a difference is zero, the two weights count as different.
        same = all(zero(x - y) is True for x, y in zip(tableau.b, tableau.b_hat, strict=True))
        return symplectic_pair(tableau, method.ring) is True and (same or separable(scene))

    def conditions(self, method: Method, scene: Problem | None = None) -> Family:
        """Return the order conditions.

        For a symplectic pair of tableaux and H = T(p) + V(q, t), the result is the family ``sprk_separable``.
        """
        from orderconds import families

        if scene is not None and separable(scene) and symplectic_pair(_pair(method), method.ring) is True:
            return families.get("sprk_separable")
        return super().conditions(method, scene)

    def lower(self, problem: Problem, method: Method) -> Program:
        """Return the program of a step."""
        tableau = _pair(method)
        q, mu = Var("q", Kind.GROUP), Var("mu", Kind.DUAL)
        stages = Stages(problem, method, (q, mu))
        build, s = stages.builder, tableau.s
        xi = [build.fresh(f"xi{i + 1}", Kind.ALG) for i in range(s)]
        n = [build.fresh(f"n{i + 1}", Kind.DUAL) for i in range(s)]
        by_position, by_momentum = reads_position(problem), reads_momentum(problem)

        def images() -> list[Var]:
            velocities, forces = [], []
            for i, number in enumerate(range(1, s + 1)):
                x = stages.combination(f"X{number}", Kind.ALG, tableau.A[i], xi)
                Q = build.mul(f"Q{number}", build.exp(f"g{number}", x), q)
                terms = [
                    (ONE, mu),
                    *((stages.times_h(a), f) for a, f in zip(tableau.A_hat[i], n, strict=True)),
                ]
                P = build.lin(f"P{number}", Kind.DUAL, terms)
                # The sum starts with the first entry of the row, because the integer 0 is not an element of
                # the ring.
                time = stages.at(sum(tableau.A[i][1:], tableau.A[i][0]))
                v, f = build.hamilton(f"v{number}", f"f{number}", Q, P, *time)
                # If the velocity does not depend on positions, the position ``q`` at the start of the step
                # can replace the position ``Q`` of the stage.
                if not by_position:
                    # ``q`` is known, but ``Q`` can depend on unknown velocities. Therefore the velocity is
                    # computed from ``q``.
                    v, _ = build.hamilton(f"v{number}", "unused", q, P, *time)
                # If the force does not depend on momenta, its values at ``mu`` and ``P`` are equal, so ``mu``
                # can replace ``P``.
                if not by_momentum:
                    # ``P`` can depend on unknown forces. Therefore the force is computed from ``mu``.
                    _, f = build.hamilton("unused", f"f{number}", Q, mu, *time)
                velocities.append(v)
                forces.append(f)
            # The order of the results must match the unknowns: first velocities, then forces.
            return velocities + forces

        def starts() -> list[Var]:
            # The initial guesses are the velocity and the force at the beginning of the step.
            v, f = build.hamilton("v0", "f0", q, mu, *stages.at(None))
            return [v] * s + [f] * s

        def update() -> dict[str, Var]:
            # On a vector space, the group product of exp(x) and q is the sum q + x.
            x = stages.combination("X", Kind.ALG, tableau.b, xi)
            terms = [(ONE, mu), *((stages.times_h(b), f) for b, f in zip(tableau.b_hat, n, strict=True))]
            return {"q": build.mul("q1", build.exp("g", x), q), "mu": build.lin("mu1", Kind.DUAL, terms)}

        return stages.program(xi + n, images, starts, update)


def _pair(method: Method) -> PartitionedRungeKutta:
    """Return the pair of tableaux for positions and momenta.

    MethodError is raised if the tableau of the method has a format that defines no such pair.
    """
    tableau = method.tableau.read_as(("prk", "rk"))
    if isinstance(tableau, RungeKutta):
        # A Runge-Kutta method uses one tableau for both positions and momenta.
        return PartitionedRungeKutta(tableau.A, tableau.b, tableau.A, tableau.b)
    if not isinstance(tableau, PartitionedRungeKutta):
        raise MethodError(
            f"the family {method.family} cannot use {method.name}, a tableau of format "
            f"{method.tableau.family}",
            expected="a tableau of format prk, rk or composition",
        )
    return tableau


def separable(scene: Problem) -> bool:
    """Return True if H = T(p) + V(q, t).

    In this case the velocity depends only on p, and the force only on q and t.
    """
    # For H = T(p) + V(q, t), only the force may depend on the time.
    return not reads_position(scene) and not reads_momentum(scene) and TIME not in _read(scene, False)


def reads_position(scene: Problem) -> bool:
    """Return True if the velocity xi depends on positions."""
    # On a lattice, the velocity may also depend on the positions of neighbours.
    around = () if scene.sites is None else scene.sites.names
    return bool(_read(scene, False) & {*scene.state[0].symbols, *around})


def reads_momentum(scene: Problem) -> bool:
    """Return True if the force in Hamilton's equations depends on the momentum."""
    return bool(_read(scene, True) & set(scene.state[1].symbols))


def _read(scene: Problem, force: bool) -> set[str]:
    """Return the symbols in the formulas of the velocity xi or of the force n."""
    dim = scene.group.dim
    # In ``roots``, the formulas of the velocity come first, and the formulas of the force follow.
    roots = scene.roots[dim:] if force else scene.roots[:dim]
    return {str(x.payload) for x in walk(roots) if x.op == "sym"}
