"""A Hamiltonian seen from the body: H as a function of q and P = Ad*_q mu, and what follows from it.

With W = D_P H and tau_b = -d/deps H(q exp(eps e_b), P) at fixed P, the field in the body frame is

    xi = Ad_q W,   n = Ad*_{q^-1} N,   N = tau + ad*_W P.

A kinetic energy that the body carries becomes a constant quadratic form, whose inverse gives P from W.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from codegen.ir.differentiate import gradient
from codegen.ir.domain import ExprDomain, PreciseDomain
from codegen.ir.expr import Expr, evaluate, walk
from codegen.ir.normal_form import NormalForms, Relation
from codegen.ir.number import Number

DIGITS, TOLERANCE = 40, Fraction(1, 10**30)
POINTS = 6
"""Where a splitting of H is tried, with how many digits, and what rounding may leave of them."""


@dataclass(frozen=True)
class BodyFrame:
    """Formulas in the coordinates of q and, under the names of mu's components, of P.

    ``velocity`` is W, ``force`` is N; ``inverse`` gives P, its entries rows of rational numbers, from W where
    W is a constant invertible matrix times P, and is None elsewhere.
    """

    velocity: tuple[Expr, ...]
    force: tuple[Expr, ...]
    inverse: tuple[tuple[Number, ...], ...] | None


def body_frame(
    group: Any, q: Sequence[str], mu: Sequence[str], hamiltonian: Expr, relations: Sequence[Relation]
) -> BodyFrame:
    """Return the field of a Hamiltonian in the body frame; symbols of q and mu are named."""
    space = hamiltonian.space
    domain = ExprDomain(space)
    element, P = tuple(space.sym(s) for s in q), tuple(space.sym(s) for s in mu)
    normal = NormalForms(space, relations)

    def at(element: Sequence[Expr], momentum: Sequence[Expr]) -> Expr:
        values: dict[str, Any] = {s: space.sym(s) for s in _symbols(hamiltonian)}
        values |= dict(zip((*q, *mu), (*element, *momentum), strict=True))
        found: Expr = evaluate([hamiltonian], domain, values)[0]
        return found

    moved, still = at(element, group.Adtinv(domain, element, P)), (space.zero,) * len(mu)
    try:
        kinetic = at(group.identity(domain), P) - at(group.identity(domain), still)
    except ZeroDivisionError:
        kinetic = space.zero  # a potential without a value at the neutral element
    split = at(element, still) + kinetic
    H = normal(split if _same(group, q, mu, moved, split) else moved)
    slopes = gradient(H, [*q, *mu])
    W = tuple(slopes[len(q) :])
    force = []
    carried = [normal(x) for x in group.adt(domain, W, P)]
    for b in range(group.dim):
        unit = tuple(domain.rational(int(a == b)) for a in range(group.dim))
        turned = group.spin(domain, element, unit)
        torque = space.zero
        for slope, rate in zip(slopes[: len(q)], turned, strict=True):
            torque = torque - slope * rate
        force.append(torque + carried[b])
    return BodyFrame(W, tuple(force), _inverse([_row(normal, w, P) for w in W]))


def _symbols(root: Expr) -> list[str]:
    return [n.payload for n in walk([root]) if n.op == "sym"]


def _same(group: Any, q: Sequence[str], mu: Sequence[str], a: Expr, b: Expr) -> bool:
    """Whether two formulas agree to 40 digits at random elements, momenta, times and parameters."""
    domain, rng = PreciseDomain(0, DIGITS), random.Random("body frame")
    names = dict.fromkeys([*_symbols(a), *_symbols(b)])

    def some() -> Any:
        return domain.rational(rng.randint(-99, 99), 100)

    for _ in range(POINTS):
        values = {name: some() for name in names}
        g = group.exp(domain, tuple(some() for _ in range(group.dim)))
        values |= dict(zip(q, g, strict=True)) | {name: some() for name in mu}
        try:
            x, y = evaluate([a, b], domain, values)
            if abs(x - y) > TOLERANCE * max(1, abs(x)):
                return False
        except (ArithmeticError, ValueError, TypeError):  # the last: comparing complex numbers
            return False
    return True


def _row(normal: NormalForms, w: Expr, P: Sequence[Expr]) -> list[Number] | None:
    """Return the coefficients of P in w where w is linear in P with rational coefficients."""
    row = [Number.rational(0)] * len(P)
    place = {p.id: k for k, p in enumerate(P)}
    for monomial, c in normal.polynomial(w).items():
        if len(monomial) != 1 or monomial[0][0] not in place or monomial[0][1] != 1:
            return None
        row[place[monomial[0][0]]] = c
    return row


def _inverse(rows: Sequence[list[Number] | None]) -> tuple[tuple[Number, ...], ...] | None:
    """Return the inverse of a rational matrix, None where there is none."""
    n = len(rows)
    zero, one = Number.rational(0), Number.rational(1)
    work: list[list[Number]] = []
    for i, row in enumerate(rows):
        if row is None:
            return None
        work.append([*row, *(one if i == j else zero for j in range(n))])
    for k in range(n):
        pivot = next((i for i in range(k, n) if not work[i][k].is_zero), None)
        if pivot is None:
            return None
        work[k], work[pivot] = work[pivot], work[k]
        head = work[k][k]
        work[k] = [x / head for x in work[k]]
        for i in range(n):
            if i != k:
                factor = work[i][k]
                work[i] = [x - factor * y for x, y in zip(work[i], work[k], strict=True)]
    return tuple(tuple(row[n:]) for row in work)


def applied(
    frame: BodyFrame, name: str, domain: Any, values: dict[str, Any], W: Sequence[Any] = ()
) -> tuple[Any, ...]:
    """Return W and N at the values of symbols, or P of W, for the operations velocity, force and legendre."""
    if not name.startswith("legendre"):
        return tuple(evaluate(frame.velocity if name.startswith("velocity") else frame.force, domain, values))
    assert frame.inverse is not None
    result = []
    for row in frame.inverse:
        pairs = [(c, x) for c, x in zip(row, W, strict=True) if not c.is_zero]
        terms = [x if c.is_one else domain.number(c) * x for c, x in pairs]
        total = terms[0]
        for term in terms[1:]:
            total = total + term
        result.append(total)
    return tuple(result)
