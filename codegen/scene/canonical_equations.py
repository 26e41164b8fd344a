"""Hamilton's equations on T*G in right trivialisation, from the partial derivatives of a Hamiltonian.

xi = D_2 H and n = -(D_1 H).q^-1, that is n_a = -d/deps H(exp(eps e_a) q, mu) (thesis eq. 3.4); q' = xi.q and
mu' = n - ad*_xi mu (2.27).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from codegen.groups.cotangent import Cotangent
from codegen.ir.differentiate import gradient
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, Space


def force(space: Space, group: Any, qs: Sequence[str], slope: Sequence[Expr]) -> tuple[Expr, ...]:
    """Return n_a = -<dH, e_a.q> from the partial derivatives of H by the coordinates of q."""
    domain = ExprDomain(space)
    q = tuple(space.sym(s) for s in qs)
    result = []
    for a in range(group.dim):
        unit = tuple(domain.rational(int(a == b)) for b in range(group.dim))
        velocity = group.velocity(domain, unit, q)
        total = space.zero
        for d, v in zip(slope, velocity, strict=True):
            total = total - d * v
        result.append(total)
    return tuple(result)


def velocity(group: Any, qs: Sequence[str], mus: Sequence[str], H: Expr) -> tuple[Expr, ...]:
    """Return the time derivatives of the coordinates of (q, mu), named ``qs`` and ``mus``, along H."""
    space, names = H.space, (*qs, *mus)
    slopes = gradient(H, names)
    field = (*slopes[len(qs) :], *force(space, group, qs, slopes[: len(qs)]))
    state = tuple(space.sym(name) for name in names)
    return Cotangent(group).velocity(ExprDomain(space), field, state)
