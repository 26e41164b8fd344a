"""Linear flows: exact flows of quadratic Hamiltonians on T*R^n."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from codegen.flows.part import CONSTANTS, Formula, Part
from codegen.groups.capabilities import Coadjoint
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain
from codegen.ir.expr import Expr
from codegen.ir.number import Number
from codegen.scene.flow import Flow


@dataclass(frozen=True)
class Linear(Flow):
    """The flow of a quadratic Hamiltonian on T*R^n. The flow solves z' = L z + c, where z = (q, mu).

    The attributes ``matrix`` and ``constant`` are L and c. The attribute ``squares`` is the vector w
    with L^2 = -diag(w). The entries of w are not negative. In the time tau, the flow maps z to

        (C_0 + tau C_1 L) z + (tau C_1 + tau^2 C_2 L) c.

    Here C_k is the diagonal matrix with the entries c_k(w_i tau^2). The function c_k is the Stumpff function
    c_k(x) = sum_j (-x)^j/(2j+k)!.
    """

    matrix: tuple[tuple[Fraction, ...], ...]
    constant: tuple[Fraction, ...]
    squares: tuple[Fraction, ...]

    def advance(
        self, d: Domain, group: Coadjoint, values: Mapping[str, S], tau: S, q: Vector[S], mu: Vector[S]
    ) -> tuple[Vector[S], Vector[S]]:
        """Return (q, mu) after the time tau."""
        z = (*q, *mu)
        new: list[S] = []
        for i, square in enumerate(self.squares):
            argument: S | None = (
                d.rational(square.numerator, square.denominator) * (tau * tau) if square else None
            )
            first = _times_stumpff(d, tau, 1, argument)
            rate = _applied(d, self.matrix[i], z, self.constant[i])
            total: S = z[i] if argument is None else d.call("stumpff0", argument) * z[i]
            if rate is not None:
                total = total + first * rate
            constant: Vector[S] = tuple(d.rational(c.numerator, c.denominator) for c in self.constant)
            push = _applied(d, self.matrix[i], constant, Fraction(0))
            if push is not None and any(self.constant):
                total = total + _times_stumpff(d, tau * tau, 2, argument) * push
            new.append(total)
        return tuple(new[: len(q)]), tuple(new[len(q) :])

    def field(
        self, d: Domain, group: Coadjoint, values: Mapping[str, S], q: Vector[S], mu: Vector[S]
    ) -> tuple[Vector[S], Vector[S]]:
        """Return the two halves q' and mu' of the derivative z' = L z + c."""
        z = (*q, *mu)
        rows = [_applied(d, row, z, c) for row, c in zip(self.matrix, self.constant, strict=True)]
        rates: Vector[S] = tuple(d.rational(0) if rate is None else rate for rate in rows)
        return rates[: len(q)], rates[len(q) :]

    def text(self) -> str:
        """Return a short description of the flow."""
        return "linear flow"


def recognise(formula: Formula) -> Part | None:
    """Return the part of the Hamiltonian with this formula, together with a linear flow if there is one.

    A linear flow solves z' = L z + c, where z = (q, mu). The matrix L is J times the Hessian matrix of the
    formula. J is the block matrix with the rows (0, I) and (-I, 0).

    If the group is not abelian, the result is None. For an abelian group, two conditions are tested: the
    formula is quadratic in z, and L^2 is a diagonal matrix whose entries are at most zero. If a condition is
    violated, the part is returned without a flow, and its ``reason`` names the violated condition.
    """
    if not formula.problem.group.abelian:
        return None
    origin = (CONSTANTS.rational(0),) * len(formula.qs)
    slopes = [*formula.by_mu, *(-x for x in formula.by_q)]
    names = (*formula.qs, *formula.mus)
    L, c = formula.matrix(slopes, names, origin), formula.constants(slopes, origin)
    if (
        L is None
        or c is None
        or not formula.orbit.vanish(
            [s - _affine(s, r, b, names) for s, r, b in zip(slopes, L, c, strict=True)]
        )
    ):
        return formula.refused("it is not a quadratic function of q and mu with constant coefficients")
    n = range(len(L))
    square = [[sum((L[i][k] * L[k][j] for k in n), Fraction(0)) for j in n] for i in n]
    if any(square[i][j] for i in n for j in n if i != j) or any(square[i][i] > 0 for i in n):
        return formula.refused(
            "its flow solves z' = M z + c, but a formula is known only if M^2 is diagonal with entries <= 0"
        )
    squares = tuple(-square[i][i] for i in n)
    return formula.whole(Linear(tuple(map(tuple, L)), tuple(c), squares))


def _affine(s: Expr, row: Sequence[Fraction], constant: Fraction, names: Sequence[str]) -> Expr:
    """Return the expression row.z + constant. ``names`` are the symbols of z."""
    space = s.space
    total = space.const(Number.rational(*constant.as_integer_ratio()))
    for x, name in zip(row, names, strict=True):
        total = total + space.const(Number.rational(*x.as_integer_ratio())) * space.sym(name)
    return total


def _times_stumpff(d: Domain, factor: S, k: int, argument: S | None) -> S:
    """Return factor times c_k(argument), where c_k is a Stumpff function and k is at most 2.

    If ``argument`` is None, the value at zero is used: c_k(0) = 1/k!.
    """
    value: S = d.rational(1, max(k, 1)) if argument is None else d.call(f"stumpff{k}", argument)
    return factor * value


def _applied(d: Domain, row: Sequence[Fraction], z: Vector[S], constant: Fraction) -> S | None:
    """Return the dot product row.z plus the constant. If the row and the constant are zero, return None."""
    total: S | None = d.rational(constant.numerator, constant.denominator) if constant else None
    for c, x in zip(row, z, strict=True):
        if c:
            term: S = x if c == 1 else d.rational(c.numerator, c.denominator) * x
            total = term if total is None else total + term
    return total
