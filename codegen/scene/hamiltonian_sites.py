"""Hamiltonian chains and lattices: each site has a Hamiltonian, and bonds between neighbours have energies.

The site i has the Hamiltonian h(q_i, mu_i). A bond with the offset d has the energy V(q_i, q_{i+d}). The
total energy E is the sum of h over all sites and of V over all bonds.

The equations are q_i' = xi_i.q_i and mu_i' = n_i - ad*_{xi_i} mu_i. Here xi_i is the derivative of h with
respect to mu_i. Let e_a be the basis elements of the Lie algebra. Let E_a(eps) be the energy E after
q_i is replaced by exp(eps e_a) q_i. Component a of the force n_i is -E_a'(0)
(:mod:`codegen.scene.canonical_equations`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from codegen.errors import SceneError
from codegen.groups.actions import LeftMultiplication
from codegen.groups.base import LieGroup
from codegen.ir.differentiate import gradient
from codegen.ir.expr import Expr
from codegen.ir.values import Kind
from codegen.scene.arguments import read_span
from codegen.scene.bonds import Bond, energies_of_bonds, sum_of_energies
from codegen.scene.canonical_equations import force, velocity
from codegen.scene.consistency import check_equal, check_problem
from codegen.scene.formulas import Reader
from codegen.scene.hamiltonian_scene import phase_space_reader
from codegen.scene.orbit import orbit_of
from codegen.scene.problem import Problem, StateField
from codegen.scene.site_scene import PERIODIC, outside_states, with_frozen_neighbours
from codegen.scene.sites import Offset, Sites, neighbour

if TYPE_CHECKING:
    import sympy

    Column = Sequence[sympy.Expr]


def HamiltonianSiteScene(
    *,
    group: LieGroup,
    q: Column,
    mu: Column,
    H: sympy.Expr,
    bonds: Sequence[Bond],
    q0: Column,
    mu0: Column,
    span: tuple[sympy.Expr, sympy.Expr],
    boundary: str = PERIODIC,
    outside: Column | Mapping[Sequence[int], Column] | None = None,
    parts: Mapping[str, sympy.Expr] | None = None,
    name: str = "scene",
    title: str = "",
) -> Problem:
    """Return the scene of a Hamiltonian chain or lattice. Emitted code accepts any number of sites.

    - ``q``, ``mu``: the coordinates of a site (``group.point``, ``group.dual``).
    - ``H``: the Hamiltonian of one site, without bonds, as a formula in q, mu, t and parameters.
    - ``bonds``: the energies of bonds (:class:`Bond`). Each energy gives the forces on both sites.
    - ``q0``, ``mu0``: one initial state for all sites.
    - ``boundary``: "periodic" or "open".
    - ``outside``: the group element that replaces q of a missing neighbour at an open boundary. Give a column
      of ``group.size`` formulas in q, t and parameters, or a mapping from offsets to columns. A free end
      needs an element that exerts no force on the site, often the coordinates ``q`` of the site itself.
    - ``parts``: named summands of ``H``.

    :class:`SceneError` is raised for the errors that :func:`codegen.scene.HamiltonianScene` and
    :func:`codegen.scene.SiteScene` list, and for bonds that contain the momentum.
    """
    reader = phase_space_reader(name, group, q, mu)
    qs, mus = tuple(reader.coordinates[: len(q)]), tuple(reader.coordinates[len(q) :])
    hamiltonian = reader.scalar(H, "H")
    summands = {key: reader.scalar(part, f"part {key}") for key, part in (parts or {}).items()}
    energies = energies_of_bonds(reader, q, bonds, offsets := _offsets(name, bonds))
    pull = _of_bonds(reader, group, qs, energies)
    slopes = gradient(hamiltonian, (*qs, *mus))
    own = force(reader.space, group, qs, slopes[: len(qs)])
    total = tuple(a + b for a, b in zip(own, pull, strict=True))
    symbols = tuple(tuple(str(s.name) for s in neighbour([*q, *mu], offset)) for offset in offsets)
    ends = outside_states(reader, boundary, _with_momenta(outside, mu), offsets)
    state = (
        StateField("q", Kind.GROUP, qs, reader.column(q0, len(qs), "q0", constant=True)),
        StateField("mu", Kind.DUAL, mus, reader.column(mu0, len(mus), "mu0", constant=True)),
    )
    if reader.signals:
        raise SceneError("a signal in the energy of a site", where=name, expected="formulas in t")
    energy = sum_of_energies(hamiltonian, energies)
    problem = Problem(
        *(name, title or name, group, LeftMultiplication(), state, (*slopes[len(qs) :], *total)),
        *(None, {}, read_span(name, span), reader.parameters()),
        paired=True,
        parts=summands,
        sites=Sites(len(offsets[0]), offsets, symbols, ends, (), pull, energy, energies),
    )
    _check(problem, hamiltonian)
    return problem


def _check(problem: Problem, hamiltonian: Expr) -> None:
    """Raise SceneError if the initial state is not on T*G, or if the sum of ``problem.parts`` is not H."""
    check_problem(with_frozen_neighbours(problem), {})
    _check_parts(problem, hamiltonian)


def check_parts_of_site(problem: Problem) -> None:
    """Raise SceneError if the fields of the parts and the forces of bonds do not add up to the field."""
    sites, group = problem.sites, problem.group
    if sites is None or not problem.parts:
        return
    qs, mus = (block.symbols for block in problem.state)
    total = (sites.force[0].space.zero,) * group.dim + sites.force
    for part in problem.parts.values():
        total = tuple(a + b for a, b in zip(total, velocity(group, qs, mus, part), strict=True))
    orbit = orbit_of(with_frozen_neighbours(problem))
    check_equal(orbit, total, "the sum of the fields of all parts", problem.roots)


def _offsets(name: str, bonds: Sequence[Bond]) -> tuple[Offset, ...]:
    """Return the offsets of all bonds and the negatives of these offsets, sorted."""
    given = [tuple(int(x) for x in bond.offset) for bond in bonds]
    if not given:
        raise SceneError(
            "a lattice without bonds",
            where=name,
            expected="a list of one Bond or more",
            hint='use HamiltonianScene; for many independent systems, use the command "emit" with --batch',
        )
    if len({len(offset) for offset in given}) > 1:
        raise SceneError(
            f"bond offsets with different numbers of entries: {', '.join(map(str, given))}",
            where=name,
            expected="offsets with one entry for each dimension of the lattice",
        )
    return tuple(sorted({*given, *(tuple(-x for x in offset) for offset in given)}))


def _of_bonds(
    reader: Reader, group: LieGroup, q: Sequence[str], energies: Sequence[tuple[int, Expr]]
) -> tuple[Expr, ...]:
    """Return the components of the total force of all bonds on one site."""
    total = (reader.space.zero,) * group.dim
    for _, V in energies:
        pairs = zip(total, force(reader.space, group, q, gradient(V, q)), strict=True)
        total = tuple(a + b for a, b in pairs)
    return total


def _with_momenta(
    outside: Column | Mapping[Sequence[int], Column] | None, mu: Column
) -> Column | dict[Sequence[int], Column] | None:
    """Return ``outside`` with ``mu`` appended to each column. Each column is then a state (q, mu)."""
    if outside is None:
        return None
    if isinstance(outside, Mapping):
        return {offset: [*column, *mu] for offset, column in outside.items()}
    return [*outside, *mu]


def _check_parts(problem: Problem, hamiltonian: Expr) -> None:
    """Raise SceneError if the listed summands of H (``parts``) do not add up to the Hamiltonian H."""
    orbit = orbit_of(with_frozen_neighbours(problem))
    parts = tuple(problem.parts.values())
    for point in orbit.points if parts else ():
        values = orbit.values((hamiltonian, *parts), point)
        if values is None:
            continue
        total = sum(values[1:], orbit.domain.rational(0))
        if not orbit.sized(values[0] - total, values):
            raise SceneError(
                f"the parts {', '.join(problem.parts)} add up to {orbit.text(total)}",
                where=problem.name,
                expected=f"{orbit.text(values[0])}, the value of H",
                hint="H is the Hamiltonian of one site without bonds; list all summands of H in the argument "
                '"parts", and the energies of bonds in the argument "bonds"',
            )
