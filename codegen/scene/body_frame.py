"""A Hamiltonian and its field in the body frame.

The Hamiltonian H is a function of q and of the momentum P = Ad*_q mu in the body frame. The velocity
W in the body frame is the gradient of H with respect to P. The force in the body frame is

    N = tau + ad*_W P,   tau_b = -d/deps H(q exp(eps e_b), P) at eps = 0.

Here tau is the torque, e_b are the basis elements of the Lie algebra, and P does not depend on eps. The
velocity xi and the force n in the space frame are

    xi = Ad_q W,   n = Ad*_{q^-1} N.

If the inertia is fixed in the body, the kinetic energy is a quadratic form of P with constant coefficients.
Then W = A P with a constant matrix A, and P = A^-1 W.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import dataclass

from codegen.groups.capabilities import BodyFrame, LeftTranslation
from codegen.groups.linear_algebra import S, Vector, units
from codegen.ir.differentiate import gradient
from codegen.ir.domain import Domain, ExprDomain
from codegen.ir.expr import Expr, evaluate, walk
from codegen.ir.normal_form import NormalForms
from codegen.ir.number import Number
from codegen.ir.rounding_domain import RoundingDomain, Sized
from codegen.ir.smoothness import combinations, on_sides, selections
from codegen.scene.values import Bindings

DIGITS = 40
POINTS = 6
"""A numerical test evaluates two formulas with DIGITS digits at POINTS random points."""


@dataclass(frozen=True)
class BodyField:
    """The field in the body frame, as formulas in q and in the momentum P in the body frame.

    The Hamiltonian of a scene contains symbols for the components of the momentum mu in the space frame. In
    the formulas of this class, the same symbols denote the components of P.

    The equations of motion are q' = q.W and P' = N, where ``velocity`` is W and ``force`` is N. If W = A P
    with a constant invertible matrix A, ``inverse`` contains the rows of A^-1.
    """

    velocity: tuple[Expr, ...]
    force: tuple[Expr, ...]
    inverse: tuple[tuple[Number, ...], ...] | None

    def momentum(self, domain: Domain, W: Vector[S]) -> Vector[S]:
        """Return the momentum P in the body frame, given the velocity W in the body frame.

        The attribute ``inverse`` must not be None.
        """
        assert self.inverse is not None
        result: list[S] = []
        for row in self.inverse:
            pairs = [(c, x) for c, x in zip(row, W, strict=True) if not c.is_zero]
            terms: list[S] = [x if c.is_one else domain.number(c) * x for c, x in pairs]
            total = terms[0]
            for term in terms[1:]:
                total = total + term
            result.append(total)
        return tuple(result)


def body_field(group: BodyFrame, q: Sequence[str], mu: Sequence[str], hamiltonian: Expr) -> BodyField:
    """Return the field of a Hamiltonian H(q, mu) in the body frame.

    ``q`` and ``mu`` are the names of the coordinates in the formula of the Hamiltonian.
    """
    space = hamiltonian.space
    domain = ExprDomain(space)
    element, P = tuple(space.sym(s) for s in q), tuple(space.sym(s) for s in mu)
    normal = NormalForms(space, group.relations(q))
    H = _in_body(group, q, mu, hamiltonian, normal)
    slopes = gradient(H, [*q, *mu])
    W = tuple(slopes[len(q) :])
    force = []
    carried = [normal(x) for x in group.adt(domain, W, P)]
    basis: tuple[tuple[Expr, ...], ...] = units(domain, group.dim)
    for b, unit in enumerate(basis):
        torque = space.zero
        for slope, rate in zip(slopes[: len(q)], group.left_velocity(domain, element, unit), strict=True):
            torque = torque - slope * rate
        force.append(torque + carried[b])
    return BodyField(W, tuple(force), _inverse([_row(normal, w, P) for w in W]))


def field_in_body(
    group: LeftTranslation, q: Sequence[str], mu: Sequence[str], roots: Sequence[Expr]
) -> tuple[tuple[Expr, ...], tuple[Expr, ...]]:
    """Return the velocity W and the force N in the body frame.

    ``roots`` are the velocity xi and the force n in the space frame, as formulas in q and mu. The result is
    W = Ad_{q^-1} xi and N = Ad*_q n, as formulas in q and P = Ad*_q mu. In ``roots``, the name ``mu[k]``
    denotes component k of mu. In the result, the name ``mu[k]`` denotes component k of P.

    A formula for a component of W or N can contain q although the value of the component does not depend on
    q. In this case, the result contains a formula without q.
    """
    space = roots[0].space
    domain = ExprDomain(space)
    normal = NormalForms(space, group.relations(q))
    P = tuple(space.sym(s) for s in mu)

    def at(element: tuple[Expr, ...]) -> tuple[Expr, ...]:
        values: Bindings = {name: space.sym(name) for name in dict.fromkeys(_symbols_of(roots))}
        values |= dict(zip((*q, *mu), (*element, *group.Adtinv(domain, element, P)), strict=True))
        field = tuple(evaluate(roots, domain, values))
        xi, n = field[: group.dim], field[group.dim :]
        return (*group.Adinv(domain, element, xi), *group.Adt(domain, element, n))

    moved = at(tuple(space.sym(s) for s in q))
    still = at(group.identity(domain))
    chosen = tuple(b if _same(group, q, mu, a, b) else normal(a) for a, b in zip(moved, still, strict=True))
    return chosen[: group.dim], chosen[group.dim :]


def _in_body(
    group: BodyFrame, q: Sequence[str], mu: Sequence[str], hamiltonian: Expr, normal: NormalForms
) -> Expr:
    """Return the Hamiltonian as a formula in q and the body momentum P, if possible a sum V(q) + T(P)."""
    space = hamiltonian.space
    domain = ExprDomain(space)
    element, P = tuple(space.sym(s) for s in q), tuple(space.sym(s) for s in mu)

    def at(element: Sequence[Expr], momentum: Sequence[Expr]) -> Expr:
        values: Bindings = {s: space.sym(s) for s in _symbols(hamiltonian)}
        values |= dict(zip((*q, *mu), (*element, *momentum), strict=True))
        value: Expr = evaluate([hamiltonian], domain, values)[0]
        return value

    moved, at_rest = at(element, group.Adtinv(domain, element, P)), (space.zero,) * len(mu)
    try:
        kinetic = at(group.identity(domain), P) - at(group.identity(domain), at_rest)
    except ZeroDivisionError:
        kinetic = space.zero
    split = at(element, at_rest) + kinetic
    return normal(split if _same(group, q, mu, moved, split) else moved)


def _symbols(root: Expr) -> list[str]:
    return _symbols_of([root])


def _symbols_of(roots: Sequence[Expr]) -> list[str]:
    return [n.payload for n in walk(roots) if n.op == "sym"]


def _same(group: LeftTranslation, q: Sequence[str], mu: Sequence[str], a: Expr, b: Expr) -> bool:
    """Return True if two formulas agree at random elements, momenta, times and parameters.

    The difference must be as small as its rounding error, so the result does not depend on units. Formulas
    with selections must agree in all combinations of their cases.
    """
    nodes = selections((a, b))
    cases = combinations(nodes)
    pairs = [on_sides((a, b), nodes, sides)[0] if nodes else [a, b] for sides in cases or ()]
    return cases is not None and all(_agree(group, q, mu, pair) for pair in pairs)


def _agree(group: LeftTranslation, q: Sequence[str], mu: Sequence[str], pair: Sequence[Expr]) -> bool:
    domain, rng = RoundingDomain(0, DIGITS), random.Random("body frame")
    names = dict.fromkeys(_symbols_of(pair))

    def draw() -> Sized:
        return domain.rational(rng.randint(-99, 99), 100)

    for _ in range(POINTS):
        values: Bindings = {name: draw() for name in names}
        g = group.exp(domain, tuple(draw() for _ in range(group.dim)))
        values |= dict(zip(q, g, strict=True)) | {name: draw() for name in mu}
        try:
            x, y = evaluate(pair, domain, values)
            if not abs((x - y).value) <= domain.rounding(x - y):
                return False
        except (ArithmeticError, ValueError, TypeError):  # Comparing complex numbers raises TypeError.
            return False
    return True


def _row(normal: NormalForms, w: Expr, P: Sequence[Expr]) -> list[Number] | None:
    """Return the constants c_k with w = sum c_k P_k, or None if there are no such constants."""
    row = [Number.rational(0)] * len(P)
    place = {p.id: k for k, p in enumerate(P)}
    for monomial, c in normal.polynomial(w).items():
        if len(monomial) != 1 or monomial[0][0] not in place or monomial[0][1] != 1:
            return None
        row[place[monomial[0][0]]] = c
    return row


def _inverse(rows: Sequence[list[Number] | None]) -> tuple[tuple[Number, ...], ...] | None:
    """Return the inverse of a matrix of exact numbers, or None if the matrix is singular or a row is None."""
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
