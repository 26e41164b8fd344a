"""Parts of the field of a lattice. A part acts on single sites, or couples pairs of neighbours.

The generators of a part are formulas for the components of an element f(y) of the Lie algebra. The sum of
f(y).y over all parts is the velocity of a site, where the dot denotes the action. The generators must be
constant along the solutions of y' = f(y).y. The exact flow of the part over a time tau is then
y -> exp(tau f(y)).y.

The pairs along an axis form two sets. In one set, the first site of each pair has an even index along the
axis. In the other set, the first site of each pair has an odd index. Two pairs of one set share no site, so
their flows commute.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from codegen.errors import SceneError
from codegen.ir.differentiate import gradient
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, evaluate, walk
from codegen.ir.rounding_domain import Sized
from codegen.scene.formulas import Reader
from codegen.scene.orbit import Orbit
from codegen.scene.problem import TIME, Problem
from codegen.scene.sites import Offset, SitePart, Sites, neighbour, offset_of

if TYPE_CHECKING:
    import sympy


@dataclass(frozen=True)
class Pair:
    """The interaction of the sites i and i + offset.

    ``first`` contains the generators of site i, and ``second`` contains the generators of site i + offset.
    The generators of a site are the components of an element of the Lie algebra. These components may
    depend on the coordinates of both sites.
    """

    offset: Sequence[int]
    first: Sequence[sympy.Expr]
    second: Sequence[sympy.Expr]


Stated = Mapping[str, "Pair | Sequence[sympy.Expr]"]


def read_parts(
    reader: Reader, y: Sequence[sympy.Symbol], size: int, parts: Stated | None
) -> tuple[SitePart, ...]:
    """Read the argument ``parts`` of a scene. ``size`` is the dimension of the group.

    SceneError is raised for formulas with unknown symbols. SceneError is also raised if the offset of a
    :class:`Pair` is not 1 along one axis and 0 along all other axes.
    """
    return tuple(_read(reader, y, size, name, given) for name, given in (parts or {}).items())


def _read(
    reader: Reader, y: Sequence[sympy.Symbol], size: int, name: str, given: Pair | Sequence[sympy.Expr]
) -> SitePart:
    what = f"part {name}"
    if not isinstance(given, Pair):
        return SitePart(name, reader.column(given, size, what))
    symbols = tuple(str(s.name) for s in neighbour(y, given.offset))
    offset = tuple(given.offset)
    if sorted(offset) != [*[0] * (len(offset) - 1), 1]:
        raise SceneError(
            f"the offset {offset} of the {what}",
            where=reader.name,
            expected="the offset of the next site along an axis, such as (1,) or (0, 1)",
        )
    both = [
        *reader.column(given.first, size, f"{what}, first", more=symbols),
        *reader.column(given.second, size, f"{what}, second", more=symbols),
    ]
    return SitePart(name, tuple(both), offset.index(1), symbols)


def check_parts(scene: Problem, orbit: Orbit) -> None:
    """Raise SceneError if the parts of the field violate one of the following conditions.

    - No part depends on time.
    - Each :class:`Pair` couples neighbours along an axis of the lattice. Its offset has one entry for each
      dimension of the lattice.
    - The generators of each part are constant along the flow of this part.
    - The velocities of all parts add up to the velocity of the field.
    """
    sites = scene.sites
    assert sites is not None
    for part in sites.parts:
        if any(n.op == "sym" and n.payload == TIME for n in walk(part.roots)):
            raise SceneError(
                f"the part {part.name} depends on t", where=scene.name, expected="a formula without t"
            )
        offset = offset_of(part.symbols[0], scene.symbols) if part.symbols else None
        if offset is not None and len(offset) != sites.dimension:
            raise SceneError(
                f"the offset {offset} of the part {part.name}",
                where=scene.name,
                expected=f"one entry for each dimension of the lattice; the dimension is {sites.dimension}",
            )
        _check_constant(scene, orbit, part)
    if sites.parts:
        _check_sum(scene, orbit, sites)


def _velocity(scene: Problem, part: SitePart) -> tuple[tuple[str, ...], list[Expr]]:
    """Return the coordinates of the sites of a part, and their derivatives along the flow of the part."""
    domain, dim = ExprDomain(part.roots[0].space), scene.group.dim
    names = [scene.symbols, *([part.symbols] if part.symbols else [])]
    slopes: list[Expr] = []
    for k, own in enumerate(names):
        point = tuple(map(domain.space.sym, own))
        x = tuple(part.roots[k * dim : (k + 1) * dim])
        slopes += scene.action.velocity(domain, scene.group, x, point)
    return tuple(s for own in names for s in own), slopes


def _check_constant(scene: Problem, orbit: Orbit, part: SitePart) -> None:
    symbols, slopes = _velocity(scene, part)
    for k, root in enumerate(part.roots):
        terms = [a * b for a, b in zip(gradient(root, symbols), slopes, strict=True)]
        for number in range(len(orbit.points)):
            values = orbit.values(terms, _two(scene, orbit, part.symbols, number))
            if values is not None and not orbit.sized(sum(values[1:], values[0]), values):
                raise SceneError(
                    f"in the part {part.name}, generator {k} depends on the state y and is not constant "
                    "along the exact flow",
                    where=scene.name,
                    expected="generators f(y) for which the exact flow over a time tau is exp(tau f(y)).y",
                    hint="split the part, or use constant generators that give the same velocity. For "
                    "example, two spins with S' = J T x S and T' = J S x T have the generators J T and J S, "
                    "which are not constant along the flow. If both spins have the generator J (S + T), the "
                    "velocity is the same, and the generator is constant along the flow",
                )


def _two(scene: Problem, orbit: Orbit, partner: Sequence[str], number: int) -> dict[str, Sized]:
    """Return the values of the symbols of a site and its neighbour.

    The state of the site is point ``number`` of ``orbit``. The state of the neighbour is the next point.
    ``partner`` contains the symbols of the neighbour's coordinates.
    """
    point = dict(orbit.points[number])
    other = orbit.points[(number + 1) % len(orbit.points)]
    return point | {s: other[own] for s, own in zip(partner, scene.symbols, strict=bool(partner))}


def _check_sum(scene: Problem, orbit: Orbit, sites: Sites) -> None:
    """Raise SceneError if the velocities of all parts do not add up to the velocity of the whole field."""
    axes = [part.axis for part in sites.parts if part.symbols]
    offsets = {*sites.offsets}
    for axis in axes:
        offsets |= {_step(sites, axis, 1), _step(sites, axis, -1)}
    listed = sorted(offsets)
    missing: list[frozenset[Offset]] = [frozenset()]
    if not sites.periodic:
        missing += [frozenset({offset}) for offset in listed] + [frozenset(listed)]
    for absent in missing:
        for number, point in enumerate(orbit.points):
            states = {
                offset: {s: orbit.points[(number + k) % len(orbit.points)][s] for s in scene.symbols}
                for k, offset in enumerate(listed, 1)
            }
            given = _with_outside(orbit, sites, point, states, absent)
            expected = orbit.velocity(given)
            total = _summed(scene, orbit, sites, point, {o: x for o, x in states.items() if o not in absent})
            for x, y in zip(total, expected, strict=True):
                if not orbit.sized(x - y, (x, y)):
                    where = f" at a site without neighbours at the offsets {sorted(absent)}" if absent else ""
                    raise SceneError(
                        f"the velocities of all parts do not add up to the velocity of the field f: the sum "
                        f"is {orbit.text(x)}{where}",
                        where=scene.name,
                        expected=f"{orbit.text(y)}, the velocity of the field f",
                        hint='list all terms of f in the argument "parts"; in a Pair, list the terms for '
                        'site i in "first", and the terms for site i + offset in "second"',
                    )


def _step(sites: Sites, axis: int, length: int) -> Offset:
    return tuple(length if e == axis else 0 for e in range(sites.dimension))


def _with_outside(
    orbit: Orbit,
    sites: Sites,
    point: Mapping[str, Sized],
    states: Mapping[Offset, Mapping[str, Sized]],
    absent: frozenset[Offset],
) -> dict[str, Sized]:
    """Return ``point``, extended by the coordinates of the neighbours of a site.

    ``point`` contains the coordinates of the site. ``states`` contains the coordinates of the neighbour at
    each offset. At an offset in ``absent``, the site has no neighbour, and ``sites.outside`` is used instead.
    """
    values = dict(point)
    for k, offset in enumerate(sites.offsets):
        column = list(states[offset].values())
        if offset in absent:
            column = list(evaluate(list(sites.outside[k]), orbit.domain, point))
        values |= dict(zip(sites.symbols[k], column, strict=True))
    return values


def _summed(
    scene: Problem,
    orbit: Orbit,
    sites: Sites,
    point: Mapping[str, Sized],
    states: Mapping[Offset, Mapping[str, Sized]],
) -> list[Sized]:
    """Return the velocity of one site: the sum of f(y).y over all parts of the field.

    ``states`` contains the states of the neighbours inside the lattice.
    """
    total = [orbit.domain.rational(0)] * len(scene.symbols)
    own = tuple(point[s] for s in scene.symbols)
    dim = scene.group.dim
    for part in sites.parts:
        generators = []
        if not part.symbols:
            generators.append(evaluate(list(part.roots), orbit.domain, dict(point)))
        for side, length in enumerate((1, -1) if part.symbols else ()):
            other = states.get(_step(sites, part.axis, length))
            if other is None:
                continue
            first, second = (point, other) if length > 0 else ({**point, **other}, point)
            values = dict(first) | {s: second[x] for s, x in zip(part.symbols, scene.symbols, strict=True)}
            roots = part.roots[side * dim : (side + 1) * dim]
            generators.append(evaluate(list(roots), orbit.domain, values))
        for x in generators:
            slope = scene.action.velocity(orbit.domain, scene.group, tuple(x), own)
            total = [a + b for a, b in zip(total, slope, strict=True)]
    return total
