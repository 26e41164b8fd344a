"""Hamilton's equations on T*G in right trivialisation, from the partial derivatives of a Hamiltonian.

Let D_1 H and D_2 H be the derivatives of the Hamiltonian H with respect to q and mu. The velocity is
xi = D_2 H, and the force is n = -(D_1 H).q^-1. Let e_a be the basis elements of the Lie algebra. The
components of the force are n_a = -d/deps H(exp(eps e_a) q, mu) at eps = 0 (eq. 3.4 of H. Marthinsen's
thesis). The equations of motion are q' = xi.q and mu' = n - ad*_xi mu (eq. 2.27).
"""

from __future__ import annotations

from collections.abc import Sequence

from codegen.groups.base import LieGroup
from codegen.groups.cotangent import Cotangent
from codegen.groups.linear_algebra import units
from codegen.ir.differentiate import gradient
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, Space
from codegen.ir.formulas import Formulas


def force(space: Space, group: LieGroup, qs: Sequence[str], slope: Sequence[Expr]) -> tuple[Expr, ...]:
    """Return the components of the force.

    The components are n_a = -phi'(0) with phi(eps) = H(exp(eps e_a) q, mu). Here the e_a are the basis
    elements of the Lie algebra.
    ``slope`` contains the partial derivatives of the Hamiltonian H with respect to the coordinates
    ``qs`` of q.
    """
    domain = ExprDomain(space)
    q = tuple(space.sym(s) for s in qs)
    basis: tuple[tuple[Expr, ...], ...] = units(domain, group.dim)
    result = []
    for unit in basis:
        total = space.zero
        for d, v in zip(slope, group.velocity(domain, unit, q), strict=True):
            total = total - d * v
        result.append(total)
    return tuple(result)


def velocity(group: LieGroup, qs: Sequence[str], mus: Sequence[str], H: Expr) -> tuple[Expr, ...]:
    """Return q' and mu' along the flow of H. The names of the coordinates are ``qs`` and ``mus``."""
    space, names = H.space, (*qs, *mus)
    slopes = gradient(H, names)
    field = (*slopes[len(qs) :], *force(space, group, qs, slopes[: len(qs)]))
    state = tuple(space.sym(name) for name in names)
    return Cotangent(group).velocity(Formulas(ExprDomain(space)), field, state)


def poisson_bracket(group: LieGroup, qs: Sequence[str], mus: Sequence[str], F: Expr, H: Expr) -> Expr:
    """Return {F, H}: the derivative of F along the flow of H on T*G."""
    total = F.space.zero
    for slope, rate in zip(gradient(F, (*qs, *mus)), velocity(group, qs, mus, H), strict=True):
        total = total + slope * rate
    return total
