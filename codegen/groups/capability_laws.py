"""The laws of the capabilities of a group, for :func:`codegen.groups.laws.check_laws`."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from codegen.groups.capabilities import (
    BodyFrame,
    CayleyMap,
    Coadjoint,
    DependentCoordinates,
    Inverse,
    LeftTranslation,
    MatrixRepresentation,
    PointMotions,
    Projection,
    RightTrivialisation,
    Rotations,
)
from codegen.groups.law import DEXPINV_ORDER, EXACT, Element, Law, Sample
from codegen.groups.linear_algebra import dot, matmul, matvec, units, vector_sum


def laws_of_capabilities(s: Sample) -> Iterator[Law]:
    """Yield the laws of all capabilities that the group of the sample offers."""
    return chain(_coadjoint(s), _defaults_of_coadjoint(s), _translations(s), _maps(s), _matrices(s))


def _dexpt(s: Sample, group: Coadjoint) -> Element:
    """Return dexp*_x mu, the sum of (ad*_x)^k mu/(k+1)! over k >= 0."""
    d, total, term, k = s.d, s.mu, s.mu, 1
    smallest = d.context.mpf(10) ** -(EXACT + 5)
    while k < 200 and max(abs(a.value) for a in term) > smallest:
        k += 1
        term = tuple(d.rational(1, k) * a for a in group.adt(d, s.x, term))
        total = vector_sum(total, term)
    return total


def _coadjoint(s: Sample) -> Iterator[Law]:
    group, d, g, x, mu = s.group.offers(Coadjoint), s.d, s.g, s.x, s.mu
    if group is None:
        return
    moved = group.Ad(d, g, x)
    yield Law("Ad", "exp(Ad_g x) g = g exp(x)", s.mul(s.exp(moved), g), s.mul(g, s.exp(x)))
    pulled = group.Adt(d, g, mu)
    basis: tuple[Element, ...] = units(d, group.dim)
    dual = tuple(dot(mu, group.Ad(d, g, y)) for y in basis)
    yield Law("Adt", "<Ad*_g mu, y> = <mu, Ad_g y>", pulled, dual)
    yield Law("Adtinv", "Ad*_{g^-1} Ad*_g mu = mu", group.Adtinv(d, g, pulled), mu)
    dual = tuple(dot(mu, group.ad(d, x, y)) for y in basis)
    yield Law("adt", "<ad*_x mu, y> = <mu, [x, y]>", group.adt(d, x, mu), dual)
    text = "dexp*_x mu = sum of (ad*_x)^k mu/(k+1)!"
    yield Law("dexpt", text, group.dexpt(d, x, mu), _dexpt(s, group))


def _defaults_of_coadjoint(s: Sample) -> Iterator[Law]:
    """Yield a law for each method of :class:`Coadjoint` with a formula that a subclass may replace."""
    group, d, x, y, mu = s.group.offers(Coadjoint), s.d, s.x, s.y, s.mu
    if group is None:
        return
    order, base = DEXPINV_ORDER, Coadjoint
    text = "{} is the formula of the class Coadjoint"
    if type(group).dexpinvt is not base.dexpinvt:
        right = base.dexpinvt(group, d, x, mu, order)
        yield Law("dexpinvt", text.format("dexpinvt"), group.dexpinvt(d, x, mu, order), right)
    if type(group).P is not base.P:
        yield Law("P", text.format("P"), group.P(d, x, y, mu, order), base.P(group, d, x, y, mu, order))
    if type(group).transport is not base.transport:
        right = base.transport(group, d, x, s.z, mu)
        yield Law("transport", text.format("transport"), group.transport(d, x, s.z, mu), right)
    if type(group).cotangent_expmul is not base.cotangent_expmul:
        left = group.cotangent_expmul(d, x, s.z, s.g, mu)
        right = group.expmul(d, x, s.g) + base.transport(group, d, x, s.z, mu)
        yield Law("cotangent_expmul", text.format("cotangent_expmul"), left, right)


def _translations(s: Sample) -> Iterator[Law]:
    """Yield the laws of inverses, rates and left translations."""
    group, d, g, x = s.group, s.d, s.g, s.x
    if (invertible := group.offers(Inverse)) is not None:
        back = invertible.inverse(d, g)
        yield Law("inverse", "g g^-1 = e", s.mul(g, back), s.e)
    if (right := group.offers(RightTrivialisation)) is not None:
        yield Law("rate", "rate(velocity(x, g), g) = x", right.rate(d, right.velocity(d, x, g), g), x)
    if (left := group.offers(LeftTranslation)) is not None:
        yield Law("Adinv", "Ad_{g^-1} Ad_g x = x", left.Adinv(d, g, left.Ad(d, g, x)), x)
        moved = left.velocity(d, left.Ad(d, g, x), g)
        text = "left_velocity(g, x) = velocity(Ad_g x, g)"
        yield Law("left_velocity", text, left.left_velocity(d, g, x), moved)
    if (body := group.offers(BodyFrame)) is not None:
        yield Law("mulexp", "mulexp(g, x) = g exp(x)", body.mulexp(d, g, x), s.mul(g, s.exp(x)))


def _maps(s: Sample) -> Iterator[Law]:
    """Yield the laws of the Cayley map, of projections and of motions of points."""
    group, d, g, x, y = s.group, s.d, s.g, s.x, s.y
    if (cayley := group.offers(CayleyMap)) is not None:
        at = cayley.cay(d, x)
        yield Law("cay", "cay(0) = e", cayley.cay(d, s.times(0, x)), s.e)
        rate = cayley.dcayinv(d, x, y)
        slope = s.slope(lambda step: cayley.cay(d, vector_sum(x, step)), rate)
        text = "d/deps cay(x + eps dcayinv_x y) = velocity(y, cay(x))"
        yield Law("dcayinv", text, slope, cayley.velocity(d, y, at), slope=True)
        left, right = cayley.sandwich(d, x, y), CayleyMap.sandwich(cayley, d, x, y)
        yield Law("sandwich", "x y x = 4 y - 2 [x, y] - 4 dcayinv_x y", left, right)
    if (projection := group.offers(Projection)) is not None:
        yield Law("project", "project(g) = g for an element g", projection.project(d, g), g)
    if (dependent := group.offers(DependentCoordinates)) is not None:
        for missing in dependent.determined():
            known = tuple(a * d.rational(int(i not in missing)) for i, a in enumerate(g))
            text = f"complete(g, {missing}) = g for an element g"
            yield Law("complete", text, dependent.complete(d, known, missing), g)
    if (motions := group.offers(PointMotions)) is not None:
        z = tuple(d.rational(i + 2, 3) for i in range(motions.point_size))
        left = motions.move(d, s.mul(g, s.k), z)
        yield Law(
            "move", "move(g k, z) = move(g, move(k, z))", left, motions.move(d, g, motions.move(d, s.k, z))
        )
        slope = s.slope(lambda step: motions.move(d, s.exp(step), z), x)
        text = "point_velocity(x, z) = d/deps exp(eps x).z"
        yield Law("point_velocity", text, motions.point_velocity(d, x, z), slope, slope=True)


def _matrices(s: Sample) -> Iterator[Law]:
    group, d, g, x = s.group.offers(MatrixRepresentation), s.d, s.g, s.x
    if group is None:
        return
    left = group.matrix(d, s.mul(g, s.k))
    n = round(len(left) ** 0.5)
    first, second = group.matrix(d, g), group.matrix(d, s.k)
    yield Law("matrix", "matrix(g k) = matrix(g) matrix(k)", left, matmul(first, second, n))
    yield Law("element", "element(matrix(g)) = g", group.element(first), g)
    slope = s.slope(lambda step: group.matrix(d, s.exp(step)), x)
    yield Law("hat", "hat(x) = d/deps matrix(exp(eps x))", group.hat(d, x), slope, slope=True)
    yield Law("vee", "vee(hat(x)) = x", group.vee(d, group.hat(d, x)), x)
    if (rotations := s.group.offers(Rotations)) is not None:
        column = tuple(d.rational(i + 2, 3) for i in range(rotations.order))
        right = matvec(s.exp(x), column)
        yield Law("rotate", "rotate(x, y) = exp(x) y", rotations.rotate(d, x, column), right)
