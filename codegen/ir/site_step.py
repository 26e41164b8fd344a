"""Steps of lattices: a sequence of sweeps over all sites, between which values are stored in arrays.

A sweep computes the same formulas at each site. Its formulas read numbers of the site itself, and numbers of
neighbours that earlier sweeps have stored for all sites. The number of sites is known at run time only.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from codegen.ir.expr import Expr
from codegen.ir.number import Number

if TYPE_CHECKING:
    from codegen.ir.kernel import Kernel

STATE, WORK, RESULT = "state", "work", "result"
"""The arrays of a step: the old state, the workspace, and the new state. Row k of an array contains number k
of every site."""

OWN = -1
"""The neighbour number of the site itself."""

BYTES = 8
"""The number of bytes of a double."""


@dataclass(frozen=True)
class Row:
    """A row of an array."""

    array: str
    number: int


@dataclass(frozen=True)
class Load:
    """A number that a sweep reads: ``symbol`` is its symbol, and ``row`` the row that contains it. It is read
    at the site itself, or at the neighbour whose offset has the index ``neighbour``."""

    symbol: str
    row: Row
    neighbour: int = OWN


@dataclass(frozen=True)
class Sweep:
    """One loop over all sites: output k of ``kernel`` is stored in row k of ``stores``.

    ``about`` describes the sweep by operations of the program. A site at the boundary has no neighbours
    outside the lattice: there output k of ``outside`` is used in place of the number that load k of
    ``read_outside`` would read. ``outside`` is None if nothing has to be replaced, as in a periodic lattice.
    A sweep over pairs of neighbours has an ``axis``. Its neighbour 0 is the other site of the pair, and the
    second half of its stores is at this neighbour.
    """

    about: str
    kernel: Kernel
    loads: tuple[Load, ...]
    stores: tuple[Row, ...]
    outside: Kernel | None = None
    axis: int = OWN

    @property
    def neighbours(self) -> tuple[int, ...]:
        """The indices of the offsets at which the sweep reads, sorted."""
        return tuple(sorted({load.neighbour for load in self.loads} - {OWN}))

    @property
    def read_outside(self) -> tuple[Load, ...]:
        """The loads from neighbours."""
        return tuple(load for load in self.loads if load.neighbour != OWN)

    @property
    def rows_read(self) -> tuple[Row, ...]:
        """The rows that the sweep reads, each once."""
        return tuple(dict.fromkeys(load.row for load in self.loads))

    @property
    def kernels(self) -> tuple[Kernel, ...]:
        """All kernels of the sweep."""
        return (self.kernel,) if self.outside is None else (self.kernel, self.outside)


@dataclass(frozen=True)
class SiteFlow:
    """One flow of a step that composes flows. ``sweep`` is the index of the sweep, and ``duration`` is in
    units of h. ``colour`` (0 or 1) is the set of pairs: the parity of the index of the first site of each
    pair."""

    sweep: int
    colour: int
    duration: Number


@dataclass(frozen=True)
class SiteStep:
    """One step of a lattice: sweeps in order, and the number of ``rows`` in which they store values.

    If there are ``flows``, the step is this sequence of sweeps. The first and the last flow sweep over all
    sites. The first flow reads the old state; all others change the new state in place.
    """

    dimension: int
    offsets: tuple[tuple[int, ...], ...]
    periodic: bool
    sweeps: tuple[Sweep, ...]
    size: int
    rows: int
    flows: tuple[SiteFlow, ...] = ()

    @property
    def workspace(self) -> int:
        """The number of doubles in the workspace for each site: the stored rows and a second state."""
        return self.rows + self.size

    @property
    def passes(self) -> tuple[Sweep, ...]:
        """The sweeps of a step, in the order in which they are executed."""
        return tuple(self.sweeps[flow.sweep] for flow in self.flows) or self.sweeps

    def expressions(self) -> Iterator[Expr]:
        """Yield every expression of the step."""
        for sweep in self.sweeps:
            for kernel in sweep.kernels:
                yield from kernel.expressions()

    def traffic(self) -> tuple[int, int]:
        """Return the numbers of doubles that a step reads and writes for each site. A number that a sweep
        reads at several sites is counted once, because the other reads find it in the cache."""
        # The pairs of one set contain each site once.
        read = sum(len(sweep.rows_read) for sweep in self.passes)
        return read, sum(len(set(sweep.stores)) for sweep in self.passes)

    def explanation(self) -> list[str]:
        """Return lines that describe the loops, the stored values and the memory traffic."""
        lines = []
        for number, sweep in enumerate(self.sweeps, 1):
            lines.append(f"loop {number}: {sweep.about}")
            lines.append(
                f"  reads {len(sweep.rows_read)} and stores {len(set(sweep.stores))} numbers for each site"
            )
        if self.flows:
            lines.append(f"a step: {len(self.flows)} passes through these loops")
        read, written = self.traffic()
        lines.append(f"workspace: {self.workspace} numbers for each site, {BYTES * self.workspace} bytes")
        moved = f"{BYTES * read} bytes read and {BYTES * written} bytes written"
        lines.append(f"memory traffic: {moved} for each site and step")
        return lines
