"""Site scenes: chains and lattices of sites. The equation of site i is y_i' = f_i.y_i.

The element f_i of the Lie algebra depends on y_i and on the states of the neighbours of site i. All sites
have the same formula for f_i.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING

from codegen.errors import SceneError
from codegen.groups.actions import Action
from codegen.groups.base import LieGroup
from codegen.ir.domain import FloatDomain
from codegen.ir.expr import Expr
from codegen.ir.number import Number
from codegen.ir.values import Kind
from codegen.scene.arguments import check_group, check_points, read_span
from codegen.scene.bonds import Bond, energies_of_bonds, sum_of_energies
from codegen.scene.consistency import check_action, check_problem
from codegen.scene.energy import differential
from codegen.scene.formulas import Reader
from codegen.scene.orbit import orbit_of, variants
from codegen.scene.problem import Problem, StateField
from codegen.scene.site_parts import Pair, check_parts, read_parts
from codegen.scene.sites import Offset, Sites, neighbour, offset_of
from codegen.scene.unrolled import small

if TYPE_CHECKING:
    import sympy

PERIODIC, OPEN = "periodic", "open"
"""The possible values of the argument ``boundary`` of a lattice."""

Outside = Mapping[Sequence[int], Sequence["sympy.Expr"]]


def SiteScene(
    *,
    group: LieGroup,
    action: Action,
    y: Sequence[sympy.Symbol],
    f: Sequence[sympy.Expr],
    y0: Sequence[sympy.Expr],
    span: tuple[sympy.Expr, sympy.Expr],
    boundary: str = PERIODIC,
    outside: Sequence[sympy.Expr] | Outside | None = None,
    parts: Mapping[str, Pair | Sequence[sympy.Expr]] | None = None,
    energy: sympy.Expr | None = None,
    bonds: Sequence[Bond] = (),
    invariants: Mapping[str, sympy.Expr] | None = None,
    name: str = "scene",
    title: str = "",
) -> Problem:
    """Return the scene of a chain or lattice whose sites have the same equation.

    - ``y``: the coordinates of a site, on which ``group`` acts.
    - ``f``: a column of ``group.dim`` formulas in ``y``, t, parameters, and the coordinates of neighbours
      (:func:`codegen.scene.sites.neighbour`). Each site has the equation y' = f.y, the action of f on y.
    - ``y0``: the initial state of every site.
    - ``boundary``: "periodic" or "open".
    - ``outside``: the state in place of a missing neighbour at an open boundary. The state is a column of
      formulas in ``y``, t and parameters. ``outside`` can map offsets of neighbours to such columns. At a
      free end, the state must exert no force on the site. If the force is proportional to the neighbour's
      state, use zeros. If the force is proportional to the neighbour's state minus ``y``, use ``y``.
    - ``parts``: the summands of the field. A part is a column of formulas in ``y``, or a
      :class:`codegen.scene.site_parts.Pair` for two neighbours.
    - ``energy``, ``bonds``: the energy of a site, and the energies of pairs of neighbours (:class:`Bond`).
    - ``invariants``: functions of the state of one site. In the equation y' = f.y, let the states of the
      neighbours be arbitrary constants. Each function must be constant along all solutions of this equation.

    :class:`SceneError` is raised for each error that :func:`codegen.scene.FieldScene` lists, and for these
    errors: offsets of neighbours differ in length, ``outside`` has no state for a neighbour, the parts do not
    add up to the field, a part has no exact flow, the total energy of an autonomous scene is not constant.
    """
    check_group(name, group)
    reader = Reader(name, list(y))
    check_points(reader, group, action)
    offsets = _offsets(name, f, reader.coordinates)
    symbols = tuple(tuple(str(s.name) for s in neighbour(y, offset)) for offset in offsets)
    known = tuple(s for column in symbols for s in column)
    roots = reader.column(f, group.dim, "f", more=known)
    start = reader.column(y0, len(y), "y0", constant=True)
    ends = outside_states(reader, boundary, outside, offsets)
    sites = Sites(len(offsets[0]), offsets, symbols, ends, read_parts(reader, y, group.dim, parts))
    sites = _with_energy(reader, sites, y, energy, bonds)
    if reader.signals:
        raise SceneError("the argument f contains a signal", where=name, expected="formulas in t")
    laws = {key: reader.scalar(value, f"invariant {key}") for key, value in (invariants or {}).items()}
    state = (StateField("y", Kind.POINT, tuple(reader.coordinates), start),)
    problem = Problem(
        *(name, title or name, group, action, state, roots, None, laws, read_span(name, span)),
        reader.parameters(),
        sites=sites,
    )
    _check(problem)
    return problem


def _check(problem: Problem) -> None:
    """Raise SceneError if a condition of :func:`check_action`, :func:`check_problem` or :func:`check_sites`
    is violated.
    """
    frozen = with_frozen_neighbours(problem)
    check_action(orbit_of(frozen))
    check_problem(frozen, {})
    check_sites(problem)


def check_sites(problem: Problem) -> None:
    """Raise SceneError if the parts of the field (:func:`check_parts`) or the energy contradict the field."""
    check_parts(problem, orbit_of(with_frozen_neighbours(problem)))
    for one in (replace(problem, runtime=()), *variants(problem)):
        _check_energy(one)


def _with_energy(
    reader: Reader, sites: Sites, y: Sequence[sympy.Symbol], energy: sympy.Expr | None, bonds: Sequence[Bond]
) -> Sites:
    """Add the energies of a site and of its bonds to ``sites``, and return the result.

    For a bond with the offset d, ``sites.offsets`` must contain d and -d, else SceneError is raised.
    """
    if energy is None and not bonds:
        return sites
    for bond in bonds:
        both = {tuple(bond.offset), tuple(-x for x in bond.offset)}
        if not both <= set(sites.offsets):
            raise SceneError(
                f"a bond with the offset {tuple(bond.offset)}",
                where=reader.name,
                expected=f"an offset d such that f reads the neighbours at d and -d; the offsets in f are "
                f"{', '.join(map(str, sites.offsets))}",
            )
    own = reader.space.zero if energy is None else reader.scalar(energy, "energy")
    shared = energies_of_bonds(reader, y, bonds, sites.offsets)
    return replace(sites, energy=sum_of_energies(own, shared), bonds=shared)


def _check_energy(problem: Problem) -> None:
    """Raise SceneError if the total energy of an autonomous problem changes on a small lattice."""
    if problem.sites is None or problem.sites.energy is None:
        return
    whole = small(problem)
    orbit = orbit_of(whole)
    for point in orbit.points if problem.autonomous else ():
        y = tuple(point[s] for s in orbit.symbols)
        gamma = differential(whole, orbit.domain, y)
        f = whole.apply(orbit.domain, "field", None, (y,))[0]
        terms = [a * b for a, b in zip(gamma, f, strict=True)]
        if not orbit.sized(sum(terms), terms):
            raise SceneError(
                f"the total energy of {len(whole.state[0].symbols) // len(problem.symbols)} sites is not "
                f"constant: the time derivative is {orbit.text(sum(terms))}",
                where=problem.name,
                expected="an energy that is constant along the solutions",
                hint='at an open boundary, each state in the argument "outside" must be constant or must '
                "exert no force on the site",
            )


def with_frozen_neighbours(scene: Problem) -> Problem:
    """Return the problem of one site, with the coordinates of the neighbours as parameters."""
    sites = scene.sites
    assert sites is not None
    start = [Fraction(float(x)).limit_denominator(1000) for x in scene.initial(FloatDomain(0.0))]
    values = dict(scene.parameters)
    for number, column in enumerate(sites.symbols, 1):
        # A formula may be singular if two neighbours have equal states. Therefore different neighbours have
        # different states here.
        shifted = [x + Fraction((7 * k + 3 * number) % 11 - 5, 97) for k, x in enumerate(start)]
        values |= {
            s: Number.rational(x.numerator, x.denominator) for s, x in zip(column, shifted, strict=True)
        }
    runtime = (*scene.runtime, *sites.names)
    return replace(scene, parameters=values, runtime=runtime)


def _offsets(name: str, f: Sequence[sympy.Expr], coordinates: Sequence[str]) -> tuple[Offset, ...]:
    """Return the sorted offsets of the neighbours whose coordinates occur in the formulas ``f``."""
    try:
        entries = list(f)
    except TypeError:
        raise SceneError(f"f is {f}", where=name, expected="a column of formulas") from None
    symbols = {str(s) for entry in entries for s in getattr(entry, "free_symbols", ())}
    offsets = {offset for s in symbols if (offset := offset_of(s, coordinates)) is not None}
    if not offsets:
        raise SceneError(
            "a field that reads no neighbour",
            where=name,
            expected="formulas that contain neighbour(y, offset)",
            hint='use FieldScene; for many independent systems, use the command "emit" with --batch',
        )
    lengths = {len(offset) for offset in offsets}
    if len(lengths) > 1:
        raise SceneError(
            f"offsets with different numbers of entries: {', '.join(map(str, sorted(lengths)))}",
            where=name,
            expected="offsets with one entry for each dimension of the lattice",
        )
    return tuple(sorted(offsets))


def outside_states(
    reader: Reader,
    boundary: str,
    outside: Sequence[sympy.Expr] | Outside | None,
    offsets: tuple[Offset, ...],
) -> tuple[tuple[Expr, ...], ...]:
    """For each offset, return the formulas of the state that replaces a missing neighbour.

    For a periodic lattice, return (), or raise SceneError if ``outside`` is given. For an open lattice,
    SceneError is raised if ``outside`` is None, or is a mapping whose keys differ from ``offsets``.
    """
    if boundary not in (PERIODIC, OPEN):
        raise SceneError(f"the boundary {boundary!r}", where=reader.name, expected=f"{PERIODIC} or {OPEN}")
    if boundary == PERIODIC:
        if outside is not None:
            raise SceneError(
                'the argument "outside" is not allowed for a periodic lattice',
                where=reader.name,
                expected=f'boundary="{OPEN}", or a scene without the argument "outside"',
            )
        return ()
    columns = outside if isinstance(outside, Mapping) else dict.fromkeys(offsets, outside)
    given = {tuple(offset): column for offset, column in columns.items() if column is not None}
    size, listed = len(reader.coordinates), []
    for offset in offsets:
        if offset not in given:
            raise SceneError(
                f"the boundary is open, but there is no state for the neighbour {offset}",
                where=reader.name,
                expected='a column of formulas in the argument "outside"',
                hint="the column can contain numbers such as 0, formulas in t, or the coordinates y of the "
                "site",
            )
        listed.append(reader.column(given.pop(offset), size, f"outside {offset}"))
    if given:
        raise SceneError(
            f'the argument "outside" has a state for the neighbour {next(iter(given))}, but the field '
            "does not read this neighbour",
            where=reader.name,
            expected=f"the offsets {', '.join(map(str, offsets))}",
        )
    return tuple(listed)
