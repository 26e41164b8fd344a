"""Exact flows of the parts of a lattice. A flow moves all sites, so a single site has no formula for the
flow.
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
"""The pairs of neighbours along an axis form two sets. The first site of a pair has an even index in the set
"even", and an odd index in the set "odd".
"""


POTENTIAL = "potential"
"""The name of the part that contains all energies without momenta."""


@dataclass(frozen=True)
class SiteFlow(Flow):
    """The flow of the part of a lattice with the index ``part``. If the part couples sites, the flow moves
    the pairs of one of the sets in :data:`COLOURS`, and ``colour`` is the index of this set. If the part
    couples no sites, ``colour`` is 0.
    """

    part: int
    colour: int

    def advance(
        self, d: Domain, group: Coadjoint, values: Mapping[str, S], tau: S, q: Vector[S], mu: Vector[S]
    ) -> NoReturn:
        """Raise ArithmeticError, because the flow moves all sites."""
        raise ArithmeticError("a flow of a lattice moves all sites")

    def field(
        self, d: Domain, group: Coadjoint, values: Mapping[str, S], q: Vector[S], mu: Vector[S]
    ) -> NoReturn:
        """Raise ArithmeticError, because the flow moves all sites."""
        raise ArithmeticError("a flow of a lattice moves all sites")

    def text(self) -> str:
        """Return a description of the motion."""
        return "exp(tau x) for a constant element x of the Lie algebra"


def site_flows(scene: Problem) -> list[Part]:
    """Return the parts of a lattice with their exact flows. Parts that couple no sites come first. The flows
    of the two sets of pairs along an axis do not commute, so each set is listed as a separate part."""
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
    """Return the parts of a Hamiltonian lattice with their exact flows. The last part is the kick by all
    energies that do not depend on momenta."""
    assert scene.sites is not None
    listed, total = [], scene.sites.force
    for part in recognise(with_frozen_neighbours(scene)):
        kicks = [flow for summand in part.summands for _, flow in summand.flows if isinstance(flow, Kick)]
        if not kicks:
            listed.append(part)
        for kick in kicks:
            total = tuple(a + b for a, b in zip(total, kick.force, strict=True))
    # The kick depends on time if the forces or the states outside the ends of the lattice depend on time.
    ends = [x for column in scene.sites.outside for x in column]
    timed = any(n.op == "sym" and n.payload == TIME for n in walk([*total, *ends]))
    taken = {part.name for part in listed}
    name = POTENTIAL if POTENTIAL not in taken else f"{POTENTIAL}_of_bonds"
    return [*listed, Part(name, (Summand(((name, Kick(total, timed)),)),))]
