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
"""The arrays of a step: the old state, the workspace, and the new state. Row k of an array contains one
number of each site."""

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
    """The symbol of a number that a sweep reads from a row, at the site or at a ``neighbour``, which is the
    index of its offset."""

    symbol: str
    row: Row
    neighbour: int = OWN


@dataclass(frozen=True)
class Sweep:
    """One loop over all sites: output k of ``kernel`` is stored in row k of ``stores``.

    ``about`` describes the sweep by operations of the program. At sites without some neighbours, output k of
    ``outside`` replaces number k of ``read_outside``, the loads from neighbours; both are empty in a periodic
    lattice. A sweep over pairs of neighbours has an ``axis``, and neighbour 0 is the other site of the pair.
    The second half of its stores is at the neighbour.
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
    """A flow in a step that composes flows: the index of the sweep, the set of pairs (0 or 1, the parity of
    the index of the first site), and the duration in units of h."""

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
        """The numbers of workspace for each site: the stored rows and a second state."""
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
