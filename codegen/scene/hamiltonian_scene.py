"""Hamiltonian scenes: a right-trivialised Hamiltonian H(q, mu) on T*G."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NoReturn

from codegen.errors import SceneError
from codegen.groups.actions import LeftMultiplication
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import Coadjoint
from codegen.groups.coordinate_maps import EXPONENTIAL
from codegen.ir.differentiate import gradient
from codegen.ir.expr import Expr, walk
from codegen.ir.values import Kind
from codegen.scene.arguments import check_group, read_span
from codegen.scene.canonical_equations import force, velocity
from codegen.scene.consistency import check_flow, check_problem
from codegen.scene.formulas import Reader
from codegen.scene.orbit import orbit_of
from codegen.scene.problem import TIME, Problem, StateField

if TYPE_CHECKING:
    import sympy

    Column = Sequence[sympy.Expr]

TAU = "tau"
"""The symbol of the elapsed time in the formulas that a scene gives for a flow."""


def HamiltonianScene(
    *,
    group: LieGroup,
    q: Column,
    mu: Column,
    H: sympy.Expr,
    q0: Column,
    mu0: Column,
    span: tuple[sympy.Expr, sympy.Expr],
    parts: Mapping[str, sympy.Expr] | None = None,
    flows: Mapping[str, tuple[Column, Column]] | None = None,
    xi: Column | None = None,
    n: Column | None = None,
    wrench: Column | None = None,
    invariants: Mapping[str, sympy.Expr] | None = None,
    coordinates: str = EXPONENTIAL,
    name: str = "scene",
    title: str = "",
) -> Problem:
    """Return the scene of a right-trivialised Hamiltonian H(q, mu) on T*G.

    The equations are q' = xi.q and mu' = n + wrench - ad*_xi mu with xi = dH/dmu and n = -(dH/dq).q^-1. If H
    does not depend on t and there is no wrench, the energy is an invariant.

    - ``q``, ``mu``: matrices of symbols (``group.point``, ``group.dual``); ``q0``, ``mu0``: initial values.
    - ``xi``, ``n``: optional formulas that are compared with dH/dmu and -(dH/dq).q^-1.
    - ``parts``: summands of H with names. The sum of all parts must be H.
    - ``flows``: exact flows of parts, as pairs (q, mu) of formulas in the elapsed time ``Symbol("tau")``.
    - ``wrench``: a force that has no potential, in the space frame. A scene with a wrench has no ``parts``.
    - ``coordinates``: only "exp" is permitted.

    SceneError is raised for a formula that contradicts H, and for the errors that ``FieldScene`` lists.
    """
    _check_coordinates(name, coordinates)
    reader = phase_space_reader(name, group, q, mu)
    if wrench is not None and parts:
        _refuse_parts(name, parts)
    system = _CanonicalSystem.read(reader, group, q, mu, H, parts or {}, wrench)
    state = system.state(q0, mu0)
    (energy,) = reader.closed((system.hamiltonian,))
    known = system.invariants(energy, invariants or {})
    stated = {
        key: system.derived(key, column) for key, column in (("xi", xi), ("n", n)) if column is not None
    }
    roots = reader.closed(system.open_roots)
    problem = Problem(
        *(name, title or name, group, LeftMultiplication(), state, roots),
        *(None if system.loads else energy, known, read_span(name, span), reader.parameters()),
        paired=True,
        parts={key: reader.closed((x,))[0] for key, x in system.summands.items()},
        signals=reader.signals,
        open_roots=system.open_roots,
        forced=bool(system.loads),
        stated=system.flows(flows or {}),
    )
    check_problem(problem, stated)
    check_flows(problem)
    return problem


def check_flows(problem: Problem) -> None:
    """Raise SceneError if a formula that the scene gives for an exact flow is wrong."""
    for key, formulas in problem.stated.items():
        qs, mus = (block.symbols for block in problem.state)
        rates = velocity(problem.group, qs, mus, problem.parts[key])
        check_flow(orbit_of(problem), key, formulas, rates, TAU)


def _check_coordinates(name: str, coordinates: str) -> None:
    """Raise SceneError if the coordinate map is not the exponential map."""
    if coordinates != EXPONENTIAL:
        raise SceneError(
            f"coordinates={coordinates!r} on T*G",
            where=name,
            expected=f'coordinates="{EXPONENTIAL}", because the other coordinate maps are defined on G '
            "only, and because variational methods are derived for the exponential map",
            hint='remove the argument "coordinates", or write the equations as a FieldScene',
        )


def _refuse_parts(name: str, parts: Mapping[str, sympy.Expr]) -> NoReturn:
    raise SceneError(
        f'both arguments "wrench" and "parts" are given; the parts are {", ".join(parts)}',
        where=name,
        expected="parts without a wrench, or a wrench without parts",
        hint='remove the argument "parts", because splitting methods do not permit a wrench',
    )


def phase_space_reader(name: str, group: LieGroup, q: Column, mu: Column) -> Reader:
    """Return the :class:`Reader` for the formulas of a Hamiltonian scene with the coordinates q and mu.

    SceneError is raised if ``group`` is not a group with a coadjoint action, or if the number of coordinates
    is wrong.
    """
    check_group(name, group)
    group.require(Coadjoint, where=name)
    reader = Reader(name, [*q, *mu])
    if (len(q), len(mu)) != (group.size, group.dim):
        raise SceneError(
            f"{len(q)} coordinates of q and {len(mu)} of mu",
            where=name,
            expected=f"{group.size} and {group.dim} coordinates for {group.name}",
            hint='use group.point("q") and group.dual("mu")',
        )
    return reader


@dataclass(frozen=True)
class _CanonicalSystem:
    """The formulas of a Hamiltonian scene q' = xi.q, mu' = n + wrench - ad*_xi mu.

    The velocity is xi, and the force is n.

    - ``summands``: the parts of H.
    - ``roots``: the components of xi and n.
    - ``loads``: the components of the wrench, or an empty tuple.
    """

    reader: Reader
    group: LieGroup
    qs: tuple[str, ...]
    mus: tuple[str, ...]
    hamiltonian: Expr
    summands: Mapping[str, Expr]
    roots: tuple[Expr, ...]
    loads: tuple[Expr, ...]
    open_roots: tuple[Expr, ...]

    @classmethod
    def read(
        cls,
        reader: Reader,
        group: LieGroup,
        q: Column,
        mu: Column,
        H: sympy.Expr,
        parts: Mapping[str, sympy.Expr],
        wrench: Column | None,
    ) -> _CanonicalSystem:
        """Read H, its parts and the wrench. Compute the velocity and the force from the gradient of H."""
        hamiltonian = reader.scalar(H, "H")
        summands = {key: reader.scalar(part, f"part {key}") for key, part in parts.items()}
        qs, mus = tuple(s.name for s in q), tuple(s.name for s in mu)
        slopes = gradient(hamiltonian, qs + mus)
        roots = (*slopes[len(qs) :], *force(reader.space, group, qs, slopes[: len(qs)]))
        loads = () if wrench is None else reader.column(wrench, group.dim, "wrench")
        open_roots = roots
        if loads:
            pairs = zip(roots[group.dim :], loads, strict=True)
            open_roots = roots[: group.dim] + tuple(x + y for x, y in pairs)
        return cls(reader, group, qs, mus, hamiltonian, summands, roots, loads, open_roots)

    def state(self, q0: Column, mu0: Column) -> tuple[StateField, StateField]:
        """Return the two blocks of the state, q and mu, with initial values."""
        initial = self.reader.column
        return (
            StateField("q", Kind.GROUP, self.qs, initial(q0, len(self.qs), "q0", constant=True)),
            StateField("mu", Kind.DUAL, self.mus, initial(mu0, len(self.mus), "mu0", constant=True)),
        )

    def invariants(self, energy: Expr, declared: Mapping[str, sympy.Expr]) -> dict[str, Expr]:
        """Return all invariants of the scene.

        If H does not depend on time and there is no wrench, the energy is the first invariant.
        """
        timeless = not any(node.op == "sym" and node.payload == TIME for node in walk([energy]))
        known = {"energy": energy} if timeless and not self.loads else {}
        return known | {key: self.reader.scalar(x, f"invariant {key}") for key, x in declared.items()}

    def derived(self, key: str, column: Column) -> tuple[tuple[Expr, ...], tuple[Expr, ...]]:
        """Return two tuples of formulas for the velocity or the force.

        The first tuple contains the formulas that the user gives in ``column``, and the second tuple contains
        the formulas derived from H. ``key`` is "xi" for the velocity, or "n" for the force.
        """
        dim = self.group.dim
        own = self.roots[:dim] if key == "xi" else self.roots[dim:]
        return self.reader.closed(self.reader.column(column, dim, key)), self.reader.closed(own)

    def flows(self, flows: Mapping[str, tuple[Column, Column]]) -> dict[str, tuple[Expr, ...]]:
        """Return the formulas that the scene gives for the exact flows of parts of H.

        The keys of the result are the names of the parts.
        """
        formulas: dict[str, tuple[Expr, ...]] = {}
        for key, (q, mu) in flows.items():
            if key not in self.summands:
                known = ", ".join(self.summands)
                raise SceneError(
                    f"a flow of {key!r}",
                    where=self.reader.name,
                    expected=f"a flow for one of the parts {known}"
                    if known
                    else "a scene with parts, because flows belong to parts",
                )
            element = self.reader.column(q, len(self.qs), f"q of the flow of {key}", more=(TAU,))
            momentum = self.reader.column(mu, len(self.mus), f"mu of the flow of {key}", more=(TAU,))
            formulas[key] = (*element, *momentum)
        return formulas
