"""Exact flows of the parts of a lattice scene.

The flow of a part acts on the whole lattice.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NoReturn

from codegen.flows.kick import Kick
from codegen.flows.part import Part, Summand
from codegen.flows.recognise import recognise
from codegen.groups.capabilities import Coadjoint
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain
from codegen.ir.expr import walk
from codegen.scene.flow import Flow
from codegen.scene.problem import TIME, Problem
from codegen.scene.site_scene import with_frozen_neighbours

COLOURS = ("even", "odd")
"""The names of the two sets of pairs of neighbouring sites along an axis.

A pair is "even" if the index of its first site is even.
"""


POTENTIAL = "potential"
"""The name of the potential energy of a lattice. This energy includes the interaction of neighbouring
sites.
"""


@dataclass(frozen=True)
class SiteFlow(Flow):
    """The flow of one part of the field of a lattice. ``part`` is the index of the part in the scene.

    ``colour`` is an index in :data:`COLOURS`. If the part couples the neighbouring sites i and i + 1 along an
    axis, the flow acts only on half of these pairs of sites: on the pairs with even i if ``colour`` is 0, and
    on the pairs with odd i if ``colour`` is 1. If the part couples no sites, ``colour`` is 0.
    """

    part: int
    colour: int

    def advance(
        self, d: Domain, group: Coadjoint, values: Mapping[str, S], tau: S, q: Vector[S], mu: Vector[S]
    ) -> NoReturn:
        """Raise ArithmeticError, because the flow of a lattice cannot be computed for a single site."""
        raise ArithmeticError("the flow of a lattice cannot be computed for a single site")

    def field(
        self, d: Domain, group: Coadjoint, values: Mapping[str, S], q: Vector[S], mu: Vector[S]
    ) -> NoReturn:
        """Raise ArithmeticError, because the field of a lattice cannot be computed for a single site."""
        raise ArithmeticError("the field of a lattice cannot be computed for a single site")

    def text(self) -> str:
        """Return a short description of the flow."""
        return "the action of exp(tau x) for a constant element x of the Lie algebra"


def site_flows(scene: Problem) -> list[Part]:
    """Return the parts of a lattice scene and their exact flows.

    For a Hamiltonian lattice, each part is a term of the Hamiltonian, and the potential energy is the last
    part. If the lattice is not Hamiltonian, the list contains the parts of the vector field:

    - The parts that couple no sites are first in the list.
    - Each part that couples neighbours along an axis is split into two parts, one for the even pairs and one
      for the odd pairs (:data:`COLOURS`), because the flows of pairs with a common site do not commute.
    """
    assert scene.sites is not None
    if scene.paired:
        return _hamiltonian_flows(scene)
    listed = []
    for number, part in sorted(enumerate(scene.sites.parts), key=lambda x: bool(x[1].symbols)):
        for colour in range(2 if part.symbols else 1):
            name = f"{part.name}_{COLOURS[colour]}" if part.symbols else part.name
            listed.append(Part(name, (Summand(((name, SiteFlow(number, colour)),)),)))
    return listed


def _hamiltonian_flows(scene: Problem) -> list[Part]:
    """Return the parts of a lattice Hamiltonian and their exact flows.

    The last part in the list is the potential energy.
    """
    assert scene.sites is not None
    listed, total = [], scene.sites.force
    for part in recognise(with_frozen_neighbours(scene)):
        kicks = [flow for summand in part.summands for _, flow in summand.flows if isinstance(flow, Kick)]
        if not kicks:
            listed.append(part)
        for kick in kicks:
            total = tuple(a + b for a, b in zip(total, kick.force, strict=True))
    # If the force or a prescribed state outside the lattice depends on time, the kick depends on time.
    ends = [x for column in scene.sites.outside for x in column]
    timed = any(n.op == "sym" and n.payload == TIME for n in walk([*total, *ends]))
    taken = {part.name for part in listed}
    name = POTENTIAL if POTENTIAL not in taken else f"{POTENTIAL}_of_bonds"
    return [*listed, Part(name, (Summand(((name, Kick(total, timed)),)),))]
