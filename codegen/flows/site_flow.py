"""Exact flows of the parts of the field or Hamiltonian of a lattice.

A flow changes the states of all sites together, so there is no formula for the flow of a single site.
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

In the set "even", the first site of each pair has an even index. In the set "odd", the first site of each
pair has an odd index.
"""


POTENTIAL = "potential"
"""The name of the part that contains all energies that do not depend on momenta."""


@dataclass(frozen=True)
class SiteFlow(Flow):
    """The flow of one part of the field of a lattice. ``part`` is the index of this part in the scene.

    If the part couples neighbouring sites, only the pairs of one set in :data:`COLOURS` are coupled by this
    flow. ``colour`` is the index of this set. If the part couples no sites, ``colour`` is 0.
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
        return "exp(tau x) for a constant element x of the Lie algebra"


def site_flows(scene: Problem) -> list[Part]:
    """Return the parts of the field or Hamiltonian of a lattice with their exact flows.

    If a part of the field couples neighbouring sites along an axis, it is split into two parts: one for each
    set of pairs of sites in :data:`COLOURS`. These two parts have flows that do not commute. Parts of the
    field that couple no sites are returned before the parts that couple sites.
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
    """Return the parts of the Hamiltonian of a lattice with their exact flows.

    The last part of the list contains all energies that do not depend on momenta. The flow of this part is a
    kick.
    """
    assert scene.sites is not None
    listed, total = [], scene.sites.force
    for part in recognise(with_frozen_neighbours(scene)):
        kicks = [flow for summand in part.summands for _, flow in summand.flows if isinstance(flow, Kick)]
        if not kicks:
            listed.append(part)
        for kick in kicks:
            total = tuple(a + b for a, b in zip(total, kick.force, strict=True))
    # The kick depends on the time if a force depends on the time. It also depends on the time if a state that
    # the scene prescribes outside the lattice depends on the time.
    ends = [x for column in scene.sites.outside for x in column]
    timed = any(n.op == "sym" and n.payload == TIME for n in walk([*total, *ends]))
    taken = {part.name for part in listed}
    name = POTENTIAL if POTENTIAL not in taken else f"{POTENTIAL}_of_bonds"
    return [*listed, Part(name, (Summand(((name, Kick(total, timed)),)),))]
