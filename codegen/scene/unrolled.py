"""A chain or lattice of few sites as one system on the product of the groups of all sites."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import product
from math import prod

from codegen.errors import SceneError
from codegen.groups.actions import FactorwiseAction
from codegen.groups.product import Product
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, Space, evaluate
from codegen.scene.energy import ENERGY
from codegen.scene.problem import TIME, Problem, StateField
from codegen.scene.sites import Offset, Sites

MOST_SITES = 64
"""The largest number of sites of an unrolled lattice, which has separate formulas for each site."""


def unrolled(scene: Problem, shape: Sequence[int]) -> Problem:
    """Return a lattice of the given shape as one system on the product of the groups of all sites.

    The last index of a site changes fastest. Every site has the initial state of the scene. If the scene is
    Hamiltonian, each site has the group T*G, and the Hamiltonian of the result is the total energy of the
    lattice. If it is not Hamiltonian but defines an energy, the total energy is an invariant of the result.

    :class:`SceneError` is raised for a scene without sites, for a shape of the wrong length, and for too few
    or too many sites.
    """
    sites = scene.sites
    if sites is None:
        raise SceneError("a scene without sites", where=scene.name, expected="a SiteScene")
    far = [max(abs(o[e]) for o in sites.offsets) if sites.periodic else 0 for e in range(sites.dimension)]
    if len(shape) != sites.dimension or any(n <= d for n, d in zip(shape, far, strict=True)):
        least = ", ".join(str(d + 1) for d in far)
        raise SceneError(f"the shape {tuple(shape)}", where=scene.name, expected=f"at least ({least}) sites")
    number = prod(shape)
    if number > MOST_SITES:
        raise SceneError(f"{number} sites", where=scene.name, expected=f"at most {MOST_SITES} sites")
    scene = scene.as_field()
    space = Space()
    domain = ExprDomain(space)
    symbols = [tuple(f"{s}_s{i}" for s in scene.symbols) for i in range(number)]
    coordinates = [tuple(map(space.sym, names)) for names in symbols]
    shared = {name: space.sym(name) for name in (TIME, *scene.parameters)}
    roots: list[Expr] = []
    energy: Expr | None = None
    for place, index in enumerate(product(*map(range, shape))):
        values = shared | dict(zip(scene.symbols, coordinates[place], strict=True))
        exists: list[bool] = []
        for k, offset in enumerate(sites.offsets):
            there = neighbour_place(sites, index, offset, shape)
            exists.append(there is not None)
            state = (
                tuple(evaluate(list(sites.outside[k]), domain, values))
                if there is None
                else coordinates[there]
            )
            values |= dict(zip(sites.symbols[k], state, strict=True))
        roots += evaluate(list(scene.roots), domain, values)
        if sites.energy is not None:
            (own,) = evaluate([sites.share(exists)], domain, values)
            energy = own if energy is None else energy + own
    first = tuple(e for block in scene.state for e in block.initial)
    flat = tuple(s for names in symbols for s in names)
    state = (replace(scene.state[0], symbols=flat, initial=first * number),)
    assert isinstance(state[0], StateField)
    return replace(
        scene,
        group=Product(*[scene.group] * number),
        action=FactorwiseAction(*[scene.action] * number),
        state=state,
        roots=tuple(roots),
        hamiltonian=energy if sites.force else None,
        invariants={} if energy is None or sites.force else {ENERGY: energy},
        parts={},
        sites=None,
    )


def small(scene: Problem) -> Problem:
    """Return one problem with the equations of all sites of a small lattice.

    The size of the lattice is chosen such that no site is its own neighbour. :class:`SceneError` is raised if
    the lattice has more than :data:`MOST_SITES` sites.
    """
    assert scene.sites is not None
    offsets, dimension = scene.sites.offsets, scene.sites.dimension
    far = [max(abs(offset[e]) for offset in offsets) for e in range(dimension)]
    shape = [(d if scene.sites.periodic else 2 * d) + 1 for d in far]
    return unrolled(scene, shape if prod(shape) <= MOST_SITES else [d + 1 for d in far])


def neighbour_place(sites: Sites, index: Sequence[int], offset: Offset, shape: Sequence[int]) -> int | None:
    """Return the position of a neighbour in the sequence of all sites, counted from 0.

    If the neighbour would lie beyond an open boundary, return None.
    """
    place = 0
    for i, d, n in zip(index, offset, shape, strict=True):
        if not sites.periodic and not 0 <= i + d < n:
            return None
        place = place * n + (i + d) % n
    return place
