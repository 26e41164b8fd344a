"""The field of a Hamiltonian put together from the fields of its parts, where that takes fewer operations.

Exact on the group. What differentiation finds is written in the entries of q; a part that was recognised has
a shorter field, which holds because q is an element of the group: the symmetric top's is mu/I_1 + s (mu.d) d,
and reads of a rotation nothing but its axis d.
"""

from __future__ import annotations

from dataclasses import replace

from codegen.flows.recognise import recognise, vanish
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, walk
from codegen.scene.problem import TIME, Problem, orbit_of


def simplified(scene: Problem) -> Problem:
    """Return a Hamiltonian scene with a field of no more operations, equal at all points of the group."""
    if scene.hamiltonian is None or not scene.parts or scene.stated or scene.inputs or scene.forced:
        return scene
    parts = recognise(scene)
    if not all(part.pieces for part in parts):
        return scene
    space = scene.hamiltonian.space
    domain = ExprDomain(space)
    q, mu = (tuple(space.sym(s) for s in block.symbols) for block in scene.state)
    names = (*scene.symbols, *scene.parameters, TIME)
    values = {name: space.sym(name) for name in names}
    roots: tuple[Expr, ...] = (space.zero,) * len(scene.roots)
    for part in parts:
        for piece in part.pieces:
            for _, flow in piece.flows:
                xi, n = flow.field(domain, scene.group, values, q, mu)
                roots = tuple(a + b for a, b in zip(roots, (*xi, *n), strict=True))
    if _operations(roots) >= _operations(scene.roots):
        return scene
    rests = [a - b for a, b in zip(roots, scene.roots, strict=True)]
    return replace(scene, roots=roots) if vanish(orbit_of(scene), rests) else scene


def _operations(roots: tuple[Expr, ...]) -> int:
    return sum(node.op not in ("const", "sym", "neg") for node in walk(roots))
