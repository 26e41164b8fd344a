"""Quadratic functions of the momentum, split into terms whose flows are rotations.

P is the momentum: P = Ad*_q mu in the body frame, P = mu in the space frame. Let B be a constant symmetric
matrix. The function P.(B P)/2 is written as the sum of c P.P/2 and terms d_k (e_k.P)^2/2 with numbers c and
d_k and fixed vectors e_k.

- The flow of d_k (e_k.P)^2/2 is a rotation about the axis e_k. This rotation is called a turn.
- If the adjoint action preserves the dot product, the flow of c P.P/2 is a rotation about the momentum. The
  rotation about the momentum commutes with all turns.
- If the adjoint action does not preserve the dot product, c is 0.

If there is only one turn, the composition of the turn and the rotation about the momentum is the exact flow
of the function. The turns of an asymmetric top do not commute with each other.
"""

from __future__ import annotations

from fractions import Fraction

from codegen.flows.isotropic import Isotropic
from codegen.flows.part import CONSTANTS, Formula, Matrix, Part, Summand
from codegen.flows.quadratic_form import isotropic_part, shifted, squares
from codegen.flows.turn import Turn
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import Coadjoint
from codegen.groups.linear_algebra import Vector, units
from codegen.ir.smoothness import selections
from codegen.scene.flow import Flow
from orderconds.ring.protocol import Element


def recognise(formula: Formula) -> Part | None:
    """Split a quadratic function of the momentum into terms whose flows are rotations.

    If the group is abelian, the result is None. If ``formula`` is not a quadratic function of the momentum
    with rational coefficients, the result is a :class:`Part` without summands.
    """
    if formula.problem.group.abelian:
        return None
    identity: Vector[Element] = formula.problem.group.identity(CONSTANTS)
    B = formula.matrix(formula.by_mu, formula.mus, identity)
    w = formula.constants(formula.by_mu, identity)
    if B is None or w is None:
        return formula.refused("its coefficients are not rational numbers")
    for body in (True, False):
        if _is_form(formula, B, w, body):
            return Part(formula.name, tuple(_summands(formula, B, w, body)))
    return formula.refused("it is not a quadratic function of the momentum in the body or space frame")


def _is_form(formula: Formula, B: Matrix, w: list[Fraction], body: bool) -> bool:
    """Return True if ``formula`` and P.(B P)/2 + w.P differ only by a constant.

    The momentum P is Ad*_q mu if ``body`` is true, and mu otherwise.
    """
    # Perhaps the sample points do not reach all cases of a formula with selections.
    if selections([formula.root]):
        return False
    orbit, group = formula.orbit, formula.problem.group.require(Coadjoint)
    d = orbit.domain
    base = None
    for point in orbit.points:
        q, mu = (tuple(point[s] for s in names) for names in (formula.qs, formula.mus))
        P = group.Adt(d, q, mu) if body else mu
        terms = [d.rational(*x.as_integer_ratio()) * y for x, y in zip(w, P, strict=True)]
        for row, x in zip(B, P, strict=True):
            terms += [d.rational(*(b / 2).as_integer_ratio()) * x * y for b, y in zip(row, P, strict=True)]
        values = orbit.values([formula.root], point)
        if values is None:
            return False
        rest = values[0] - sum(terms, d.rational(0))
        base = rest if base is None else base
        if not orbit.sized(rest - base, (*terms, base)):
            return False
    return True


def _summands(formula: Formula, B: Matrix, w: list[Fraction], body: bool) -> list[Summand]:
    mean = isotropic_part(B) if _invariant(formula.problem.group) else Fraction(0)
    turns = [
        Turn(tuple(e), rate, Fraction(0), body)
        for rate, e in sorted(squares(shifted(B, mean)), key=lambda s: -abs(s[0]))
    ]
    if any(w):
        turns = _with_offset(turns, w, body)
    flows: list[list[tuple[str, Flow]]] = []
    several = len(turns) + bool(mean) > 1
    for k, turn in enumerate(turns):
        number = str(k + 1) if len(turns) > 1 else ""
        flows.append([(f"{formula.name}.turn{number}" if several else formula.name, turn)])
    if mean:
        # The flow of ``Isotropic`` commutes with all turns, so its place in the composition is free.
        flow = (f"{formula.name}.mean" if several else formula.name, Isotropic(mean))
        flows = [[flow, *(flows[0] if flows else [])], *flows[1:]]
    return [Summand(tuple(f)) for f in flows]


def _invariant(group: LieGroup) -> bool:
    """Return True if the adjoint action preserves the dot product on the Lie algebra."""
    basis: tuple[Vector[Element], ...] = units(CONSTANTS, group.dim)
    brackets = [[group.ad(CONSTANTS, x, y) for y in basis] for x in basis]
    n, is_zero = range(group.dim), CONSTANTS.ring.is_zero
    return all(is_zero(brackets[i][j][k] + brackets[i][k][j]) for i in n for j in n for k in n)


def _with_offset(turns: list[Turn], w: list[Fraction], body: bool) -> list[Turn]:
    """Return a list of turns whose Hamiltonians have the sum H + w.P.

    H is the sum of the Hamiltonians of ``turns``, and P is the momentum (:class:`Turn`).
    """
    for k, turn in enumerate(turns):
        i = next(i for i, x in enumerate(turn.axis) if x)
        ratio = w[i] / turn.axis[i]
        if all(x == ratio * e for x, e in zip(w, turn.axis, strict=True)):
            return [*turns[:k], Turn(turn.axis, turn.rate, ratio, body), *turns[k + 1 :]]
    return [*turns, Turn(tuple(w), Fraction(0), Fraction(1), body)]
