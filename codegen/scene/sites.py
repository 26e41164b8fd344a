"""Sites: the points of a chain or lattice, each with a state of its own, and the neighbours of a site.

The offset of a neighbour is the index of the neighbour minus the index of the site.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass

import sympy

from codegen.errors import SceneError
from codegen.ir.expr import Expr
from codegen.ir.number import Number

MOST_DIMENSIONS, MOST_DISTANCE = 4, 8
"""MOST_DIMENSIONS is the largest dimension of a lattice. MOST_DISTANCE is the largest distance of a neighbour
from a site along each axis of the lattice."""

HALF = Number.rational(1, 2)

Offset = tuple[int, ...]


def offset_text(offset: Offset) -> str:
    """Return the suffix for an offset. The symbol of a neighbour's coordinate ends with this suffix.

    >>> offset_text((1,)), offset_text((0, -1))
    ('at_p1', 'at_0_m1')
    """
    return "at_" + "_".join(f"{'p' if x > 0 else 'm' if x < 0 else ''}{abs(x)}" for x in offset)


_NEIGHBOUR = re.compile(r"(.+)_at_((?:0|[pm][1-9])(?:_(?:0|[pm][1-9]))*)")


def offset_of(symbol: str, coordinates: Collection[str]) -> Offset | None:
    """Return the offset of a neighbour if ``symbol`` is one of its coordinates, else None.

    ``coordinates`` contains the names of the coordinates of a site.

    >>> offset_of("S0_at_0_m1", ["S0"]), offset_of("S0", ["S0"])
    ((0, -1), None)
    """
    match = _NEIGHBOUR.fullmatch(symbol)
    if match is None or match[1] not in coordinates:
        return None
    return tuple(int(x.replace("p", "").replace("m", "-")) for x in match[2].split("_"))


def neighbour(y: Iterable[sympy.Symbol], offset: Sequence[int]) -> sympy.Matrix:
    """Return a column of symbols for the state of a neighbour. ``y`` contains the symbols of one site.

    ``offset`` is the position of the neighbour relative to the site: one integer for each dimension of the
    lattice. :class:`SceneError` is raised in four cases:

    - An entry of the offset is not an integer.
    - The absolute value of an entry is greater than MOST_DISTANCE.
    - The offset has more than MOST_DIMENSIONS entries.
    - All entries are zero.

    >>> S = sympy.Matrix(sympy.symbols("S0:3", real=True))
    >>> neighbour(S, (1,)).T
    Matrix([[S0_at_p1, S1_at_p1, S2_at_p1]])
    """
    try:
        values = tuple(int(x) for x in offset)
        exact = values == tuple(offset)
    except (TypeError, ValueError):
        values, exact = (), False
    far = max(map(abs, values), default=0)
    if not exact or not 1 <= far <= MOST_DISTANCE or len(values) > MOST_DIMENSIONS:
        raise SceneError(
            f"a neighbour with the offset {offset!r}",
            expected=f"one to {MOST_DIMENSIONS} integers between -{MOST_DISTANCE} and {MOST_DISTANCE}, "
            "not all zero, such as (1,) or (0, -1)",
        )
    return sympy.Matrix([sympy.Symbol(f"{symbol.name}_{offset_text(values)}", real=True) for symbol in y])


def left(y: Iterable[sympy.Symbol]) -> sympy.Matrix:
    """Return a column vector of symbols for the coordinates of the left neighbour in a chain.

    ``y`` contains the symbols for the coordinates of the site itself.
    """
    return neighbour(y, (-1,))


def right(y: Iterable[sympy.Symbol]) -> sympy.Matrix:
    """Return a column vector of symbols for the coordinates of the right neighbour in a chain.

    ``y`` contains the symbols for the coordinates of the site itself.
    """
    return neighbour(y, (1,))


@dataclass(frozen=True)
class SitePart:
    """A part of the field of a lattice, with a known exact flow.

    The generators of a site are formulas for the components of an element of the Lie algebra. If the part
    acts on single sites, ``roots`` contains the generators of one site. If the part couples two neighbours
    along ``axis``, ``roots`` contains the generators of the first site and then those of the second. In this
    case, ``symbols`` contains the names of the coordinates of the second site.
    """

    name: str
    roots: tuple[Expr, ...]
    axis: int = -1
    symbols: tuple[str, ...] = ()


@dataclass(frozen=True)
class Sites:
    """The lattice of a scene, with the offsets and coordinate symbols of the neighbours that the field reads.

    - ``outside``: for each offset, the state that replaces a missing neighbour at an open boundary. For a
      periodic lattice, ``outside`` is empty.
    - ``parts``: the parts of the field (:mod:`codegen.scene.site_parts`).
    - ``force``: in a Hamiltonian scene, the force of all bonds on a site
      (:mod:`codegen.scene.hamiltonian_sites`).
    - ``energy``: the energy of a site plus the energies of all its bonds.
    - ``bonds``: a pair (k, energy) for each bond between a site and a neighbour. The offset of this neighbour
      is offsets[k].
    """

    dimension: int
    offsets: tuple[Offset, ...]
    symbols: tuple[tuple[str, ...], ...]
    outside: tuple[tuple[Expr, ...], ...] = ()
    parts: tuple[SitePart, ...] = ()
    force: tuple[Expr, ...] = ()
    energy: Expr | None = None
    bonds: tuple[tuple[int, Expr], ...] = ()

    @property
    def periodic(self) -> bool:
        """True if the first and the last site along each axis are neighbours."""
        return not self.outside

    def share(self, exists: Sequence[Expr | bool]) -> Expr:
        """Return the share of a site in the total energy.

        The two sites of a bond share its energy equally. If the neighbour is missing, the site has the whole
        energy of the bond. ``exists`` has one entry for each offset: true or 1 if the neighbour exists, else
        false or 0.
        """
        assert self.energy is not None
        share, space = self.energy, self.energy.space
        for number, bond in self.bonds:
            given = exists[number]
            factor = given if isinstance(given, Expr) else space.one if given else space.zero
            share = share - factor * (space.const(HALF) * bond)
        return share

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the coordinates of all neighbours."""
        return tuple(name for column in self.symbols for name in column)

    def text(self) -> str:
        """Return a text that describes the lattice, for the header of emitted code."""
        kind = "chain" if self.dimension == 1 else f"lattice of dimension {self.dimension}"
        ends = "periodic" if self.periodic else "open, with given states outside"
        listed = ", ".join(str(o[0]) if len(o) == 1 else str(o).replace(" ", "") for o in self.offsets)
        return f"{kind}, {ends}; the field of a site reads the neighbours at the offsets {listed}"
