"""Bonds: energies of pairs of neighbours on a lattice.

The offset of a bond is the lattice index of its second site minus the lattice index of its first site.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from codegen.errors import SceneError
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, evaluate, walk
from codegen.scene.formulas import Reader
from codegen.scene.sites import Offset, neighbour

if TYPE_CHECKING:
    import sympy


@dataclass(frozen=True)
class Bond:
    """The energy of the sites with the lattice indices i and i + offset.

    ``energy`` is a formula in the coordinates of both sites: y for the site i, and ``neighbour(y, offset)``
    for the site i + offset. In a Hamiltonian scene, y contains only the coordinates of q.
    """

    offset: Sequence[int]
    energy: sympy.Expr


def energies_of_bonds(
    reader: Reader, y: Sequence[sympy.Symbol], bonds: Sequence[Bond], offsets: Sequence[Offset]
) -> tuple[tuple[int, Expr], ...]:
    """Return a pair (k, V) for each bond of a site i.

    V is the energy of the bond, and ``offsets[k]`` is the offset from the site to its neighbour. V can depend
    on the coordinates ``y`` of the site. Each element of ``bonds`` describes two bonds of the site i: a bond
    to the site i + offset with the energy V(y_i, y_{i+offset}), and a bond to the site i - offset with the
    energy V(y_{i-offset}, y_i).

    SceneError is raised if an energy does not contain coordinates of both sites. SceneError is also raised if
    an energy contains the momentum of the site.
    """
    space, own = reader.space, tuple(reader.coordinates[: len(y)])
    energies: list[tuple[int, Expr]] = []
    for number, bond in enumerate(bonds):
        offset = tuple(int(x) for x in bond.offset)
        opposite = tuple(-x for x in offset)
        there, back = (tuple(str(s.name) for s in neighbour(y, o)) for o in (bond.offset, opposite))
        what = f"the energy of bond {number}"
        V = reader.scalar(bond.energy, what, more=there)
        read = {str(n.payload) for n in walk([V]) if n.op == "sym"}
        others = read & set(reader.coordinates[len(y) :])
        if others or not read & set(own) or not read & set(there):
            missing = "coordinates of fewer than two sites"
            raise SceneError(
                f"{what} contains {', '.join(sorted(others)) if others else missing}",
                where=reader.name,
                expected=f"a formula in {', '.join(own)} and in the coordinates of neighbour(y, offset)",
            )
        moved = {s: space.sym(s) for s in sorted(read)}
        moved |= {s: space.sym(b) for s, b in zip(own, back, strict=True)}
        moved |= {s: space.sym(a) for s, a in zip(there, own, strict=True)}
        (last,) = evaluate([V], ExprDomain(space), moved)
        energies += [(offsets.index(offset), V), (offsets.index(opposite), last)]
    return tuple(energies)


def sum_of_energies(own: Expr, energies: Sequence[tuple[int, Expr]]) -> Expr:
    """Return the sum of the energy of a site and of the energies of its bonds."""
    return sum((V for _, V in energies), own)
