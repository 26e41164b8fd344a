"""Variational Runge-Kutta-Munthe-Kaas methods with dexp^{-1} replaced by the inverse of a truncated dexp.

The source is section 3.4.1 of Marthinsen's thesis. The truncated series of dexp is
dexp_{(r),x} = sum_{k<=r} ad_x^k/(k+1)!. Let R*_(r)(x, v) be the dual of the derivative of dexp_{(r),x} v with
respect to x.

A step leads from (q0, mu0) to (q1, mu1). The coefficients of the tableau are a_ij and b_i. The unknowns of
stage i are the vector v_i and the momentum M_i. The exponent of stage i is X_i = h sum_j a_ij v_j. The
velocity and the force of stage i are (xi_i, n_i) = f(exp(X_i) q0, M_i). The vector v_i satisfies
dexp_{(r),X_i} v_i = xi_i. The other equations are

    Y = h sum_j b_j v_j,   Lambda = dexp*_{-Y}(mu0 + h sum_j b_j Ad*_{exp X_j} n_j),
    b_i dexp*_{(r),X_i} M_i = b_i Lambda - h sum_j b_j a_ji (R*_(r)(X_j, v_j) M_j + dexp*_{X_j} n_j),
    q1 = exp(Y) q0,   mu1 = Ad*_{exp(-Y)}(mu0 + h sum_j b_j Ad*_{exp X_j} n_j).

The method is the variational integrator with the discrete Lagrangian h sum_i b_i l(Q_i, dexp_{(r),X_i} v_i),
where l is the Lagrangian and Q_i = exp(X_i) q0. The series dexp_{(r),X_i} v_i and dexp*_{(r),X_i} M_i begin
with v_i and M_i. For the fixed-point iteration, all other terms are moved to the right-hand side.
"""

from __future__ import annotations

from fractions import Fraction
from math import factorial

from codegen.ir.number import Number
from codegen.ir.program import Program
from codegen.ir.values import ONE, Coefficient, Kind, Var
from codegen.lower.variational import ExpandedStep, VariationalLowering
from codegen.method import Method
from codegen.scene.problem import Problem

Terms = list[tuple[Coefficient, Var]]


class VariationalMuntheKaasPade(VariationalLowering):
    """Variational Runge-Kutta-Munthe-Kaas methods with the inverse of a truncated dexp."""

    family = "vrkmk_pade"

    def lower(self, problem: Problem, method: Method) -> Program:
        """Return the program of a step, with ``method.cutoff`` brackets in the series of dexp.

        :class:`orderconds.errors.ZeroWeight` is raised if a weight b_i is zero, or is an interval that
        contains zero.
        :class:`codegen.errors.MethodError` is raised if the method has no cut-off.
        """
        return _Step(problem, method).program()


class _Step(ExpandedStep):
    """The equations of one step. The method uses the inverse of the truncated series of dexp."""

    def __init__(self, problem: Problem, method: Method) -> None:
        super().__init__(problem, method)
        self.v = [self.build.fresh(f"v{i + 1}", Kind.ALG) for i in range(self.s)]
        self.M = [self.build.fresh(f"M{i + 1}", Kind.DUAL) for i in range(self.s)]
        self.unknowns = [*self.v, *self.M]
        # These lists contain terms of the equations for the momenta, with one entry for each stage.
        self.forces: list[Var] = []
        self.slopes: list[Var] = []
        self.corrections: list[Terms] = []

    def images(self) -> list[Var]:
        """Return new values of v_i and M_i, computed from their values in the previous iteration."""
        self.exponentiate(self.v)
        velocities = [self._evaluated(i) for i in range(self.s)]
        self.end(velocities, self.forces)
        return [*velocities, *(self._momentum(i) for i in range(self.s))]

    def _evaluated(self, i: int) -> Var:
        """Append the velocity xi_i and the force n_i of stage i to the program.

        Return a variable for the value of the unknown v_i in the next iteration.
        """
        build, X = self.build, self.X[i]
        Q = build.mul(f"Q{i + 1}", self.g[i], self.q)
        xi, n = build.hamilton(f"xi{i + 1}", f"n{i + 1}", Q, self.M[i], *self.time(i))
        # With X = X_i, ``brackets`` contains ad_X^k v_i, and ``momenta`` contains (ad*_X)^k M_i.
        brackets, momenta = self._powers(X, self.v[i]), self._powers(X, self.M[i])
        # The new v_i is xi_i - sum_{1<=k<=r} ad_X^k v_i/(k+1)!. In the sum, v_i is the value from the
        # previous iteration.
        velocity = build.lin(f"u{i + 1}", Kind.ALG, [(ONE, xi), *_rest(brackets)])
        self.forces.append(n)
        self.slopes.append(self._slope(f"R{i + 1}", brackets, momenta))
        self.corrections.append(_rest(momenta))
        return velocity

    def _powers(self, x: Var, first: Var) -> list[Var]:
        """Return ad_x^k v for k = 0, ..., ``self.r`` and v = ``first``. For a covector v, ad* replaces ad."""
        powers = [first]
        for k in range(self.r):
            powers.append(self.build.bracket(f"{first.name}_{k + 1}", x, powers[-1]))
        return powers

    def _slope(self, name: str, brackets: list[Var], momenta: list[Var]) -> Var:
        """Return a new variable for the vector R*_(r)(x, v) M (see the docstring of this module).

        ``brackets`` are the vectors ad_x^k v, and ``momenta`` are the vectors (ad*_x)^k M.
        """
        terms: Terms = []
        # The result is the sum over i = 0, ..., r-1 of the covectors ad*_z (ad*_x)^i M. Here r is ``self.r``,
        # and z is a vector that depends on i.
        for i in range(self.r):
            # z = -v/(i+2)! - ad_x v/(i+3)! - ... - ad_x^{r-1-i} v/(r+1)!
            inner = [(_over_factorial(-1, k), brackets[k - 1 - i]) for k in range(i + 1, self.r + 1)]
            subscript = self.build.lin("z", Kind.ALG, inner)
            terms.append((ONE, self.build.bracket("R", subscript, momenta[i])))
        return self.build.lin(name, Kind.DUAL, terms)

    def _momentum(self, i: int) -> Var:
        """Append the assignments that compute the new M_i to the program, and return the new variable."""
        build, times_h = self.build, self.stages.times_h
        # The equation for M_i in the module docstring is divided by b_i. The left-hand side is then the sum
        # M_i + ad*_x M_i/2! + ... + (ad*_x)^r M_i/(r+1)! with x = X_i and r = ``self.r``. All terms after M_i
        # are moved to the right-hand side, which changes the signs of the moved terms. The list
        # corrections[i] contains the moved terms with the changed signs.
        terms: Terms = [(ONE, build.dual_dexp("L", self.minus, self.mu)), *self.corrections[i]]
        for j in range(self.s):
            # ``factor`` is -h b_j a_ji/b_i, the coefficient of two terms in the equation for momentum M_i.
            factor = times_h(-(self.b[j] * (self.A[j][i] / self.b[i])))
            terms.append((times_h(self.b[j]), build.dual_dexp("L", self.minus, self.nu[j])))
            terms.append((factor, build.dual_dexp(f"d{j + 1}", self.X[j], self.forces[j])))
            terms.append((factor, self.slopes[j]))
        return build.lin(f"p{i + 1}", Kind.DUAL, terms)

    def starts(self) -> list[Var]:
        """Return the initial guesses of v_i and M_i: the velocity and the momentum before the step."""
        xi, _ = self.build.hamilton("xi0", "n0", self.q, self.mu, *self.stages.at(None))
        # The exact v_i and M_i differ from the initial guesses by O(h).
        return [xi] * self.s + [self.mu] * self.s


def _rest(powers: list[Var]) -> Terms:
    """Return the terms -p_k/(k+1)! for k >= 1, where p_k is ``powers[k]``."""
    # The caller writes the equation p_0 + p_1/2! + p_2/3! + ... = c for the unknown p_0 in the form
    # p_0 = c - p_1/2! - p_2/3! - .... The function returns the terms -p_1/2!, -p_2/3!, and so on.
    return [(_over_factorial(-1, k), power) for k, power in enumerate(powers) if k]


def _over_factorial(sign: int, k: int) -> Coefficient:
    """Return sign/(k + 1)!."""
    return Coefficient(Number.rational(*Fraction(sign, factorial(k + 1)).as_integer_ratio()))
