"""Steps of lattices: a sequence of sweeps over all sites, with values stored in arrays between the sweeps.

A sweep is a loop that computes the same formulas at each site. The formulas read numbers of the site and of
its neighbours. The number of sites is known only at run time.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from codegen.ir.expr import Expr
from codegen.ir.number import Number

if TYPE_CHECKING:
    from codegen.ir.kernel import Kernel

STATE, WORK, RESULT = "state", "work", "result"
"""The arrays of a step: the old state, the workspace, and the new state. An array has one row for each
quantity and one column for each site.
"""

EXISTS = "exists"
"""The array whose row k contains 1 for each site with a neighbour k, and 0 for all other sites. These numbers
are computed from the position of the site, and are not stored in memory.
"""

OWN = -1
"""The value of ``neighbour`` that denotes the site itself."""

NO_TIME = Number.rational(0)

BYTES = 8
"""The number of bytes of a double."""


@dataclass(frozen=True)
class Row:
    """Row ``number`` of the array ``array``."""

    array: str
    number: int


@dataclass(frozen=True)
class Load:
    """A number that a sweep reads: ``row`` contains the number, and ``symbol`` denotes it in the formulas.

    If ``neighbour`` is :data:`OWN`, the number belongs to the site itself. Otherwise the number belongs to
    the neighbour whose offset has the index ``neighbour``.
    """

    symbol: str
    row: Row
    neighbour: int = OWN


@dataclass(frozen=True)
class Sweep:
    """One loop over all sites. Output k of ``kernel`` is stored in the row ``stores[k]``.

    - ``about`` names the operations of the program in the sweep.
    - ``outside`` is a kernel for neighbours outside the lattice. If the neighbour of load k in
      ``read_outside`` does not exist, output k of this kernel is used in place of the load.
    - ``axis`` is the direction of the pairs in a sweep over pairs of neighbours. Neighbour 0 is the other
      site of the pair, and the second half of ``stores`` belongs to this other site.
    - ``unknowns`` are the unknowns u of equations u = g(u). The first outputs of the kernel are the values
      g(u), which replace the unknowns.
    - ``measured`` are the rows of the largest change and of the largest absolute value of an unknown.
    - ``sums`` contains the name and the row of each sum over all sites, which later sweeps read.
    """

    about: str
    kernel: Kernel
    loads: tuple[Load, ...]
    stores: tuple[Row, ...]
    outside: Kernel | None = None
    axis: int = OWN
    unknowns: tuple[str, ...] = ()
    measured: tuple[Row, ...] = ()
    sums: tuple[tuple[str, Row], ...] = ()

    @property
    def neighbours(self) -> tuple[int, ...]:
        """The indices of the neighbours whose numbers the sweep reads, sorted."""
        # The site itself is no neighbour.
        return tuple(sorted({load.neighbour for load in self.loads} - {OWN}))

    @property
    def read_outside(self) -> tuple[Load, ...]:
        """The loads of the sweep that read numbers of neighbours."""
        return tuple(load for load in self.loads if load.neighbour != OWN)

    @property
    def rows_read(self) -> tuple[Row, ...]:
        """The rows that the sweep reads, each once."""
        # The rows of ``EXISTS`` are not in memory, so they cause no traffic.
        return tuple(dict.fromkeys(load.row for load in self.loads if load.row.array != EXISTS))

    @property
    def kernels(self) -> tuple[Kernel, ...]:
        """All kernels of the sweep."""
        # A sweep without numbers from outside has a single kernel.
        return (self.kernel,) if self.outside is None else (self.kernel, self.outside)


@dataclass(frozen=True)
class SiteNewton:
    """The matrix of Newton's method for the equations of a chain, to first order in h.

    The matrix is block-tridiagonal. For each site, ``kernel`` computes three blocks of ``size`` rows and
    columns. They are the derivatives with respect to the unknowns of the left neighbour, of the site, and of
    the right neighbour. ``loads`` are the numbers that the kernel reads. The symbol exists[k] is 1 if
    neighbour k exists, and 0 otherwise.

    In the workspace, the blocks of one site begin at the row ``matrix``. The residuals are in ``size`` rows
    that begin at the row ``residual``. A periodic chain also needs ``size`` columns for the last site, which
    begin at the row ``border``.
    """

    kernel: Kernel
    loads: tuple[Load, ...]
    exists: tuple[str, ...]
    size: int
    residual: int
    border: int
    matrix: int

    def moved_once(self, periodic: bool) -> tuple[int, int]:
        """Return how many numbers are read and written for each site when the matrix is factored."""
        n = self.size
        # The kernel writes three blocks of n^2 numbers. The factorisation reads the blocks and writes them
        # again.
        read, written = len({load.row for load in self.loads}) + 3 * n * n, 6 * n * n
        # In a periodic chain, the last site is a neighbour of the first one, so the matrix has entries
        # outside its three block diagonals.
        if periodic:
            # Each of the n columns for the last site is an additional right-hand side.
            solved = self._substituted()
            read, written = read + n * solved[0], written + n * n + n * solved[1]
        return read, written

    def moved_in_a_sweep(self, periodic: bool) -> tuple[int, int]:
        """Return how many numbers are read and written for each site when the unknowns are corrected."""
        n = self.size
        # The residuals of a sweep are the right-hand side of the linear equations.
        read, written = self._substituted()
        # The correction reads the unknowns and their changes, and writes the unknowns.
        read, written = read + 2 * n, written + n
        return (read + n * n + n, written + n) if periodic else (read, written)

    def _substituted(self) -> tuple[int, int]:
        """Return how many numbers forward and back substitution read and write for each site.

        The matrix blocks are read once, and the right-hand side twice.
        """
        n = self.size
        # Both substitutions read and write the n numbers of the right-hand side.
        return 3 * n * n + 2 * n, 2 * n


@dataclass(frozen=True)
class SiteBlock:
    """Equations u = g(u) for unknowns at all sites.

    The sweeps with the indices ``first`` to ``last`` compute the images g(u) and replace the unknowns by the
    images. If ``newton`` is given, these sweeps only store the residuals g(u) - u, and Newton's method
    changes the unknowns. The sweeps are repeated until the unknowns of all sites converge. Sweeps before
    ``first`` store the first values of the unknowns.
    """

    label: str
    unknowns: tuple[str, ...]
    first: int
    last: int
    newton: SiteNewton | None = None


@dataclass(frozen=True)
class SiteFlow:
    """One flow of a splitting step.

    - ``sweep`` is the index of the sweep that computes the flow.
    - ``duration`` is in units of h.
    - ``elapsed``: a flow that depends on time is evaluated at the time t + ``elapsed`` h.
    - ``colour`` is the parity (0 or 1) of the first site of each pair, in a sweep over pairs.
    """

    sweep: int
    colour: int
    duration: Number
    elapsed: Number = NO_TIME


@dataclass(frozen=True)
class SiteStep:
    """One step of a lattice. The ``sweeps`` are executed in order, and use ``rows`` rows of the workspace.

    If there are ``flows``, the step executes the sweep of each flow, in the order of the flows. The first
    sweep reads the old state, and all other sweeps change the new state in place.

    ``blocks`` are the equations of an implicit method, in order.
    """

    dimension: int
    offsets: tuple[tuple[int, ...], ...]
    periodic: bool
    sweeps: tuple[Sweep, ...]
    size: int
    rows: int
    flows: tuple[SiteFlow, ...] = ()
    blocks: tuple[SiteBlock, ...] = ()

    @property
    def workspace(self) -> int:
        """The number of rows of the workspace: the stored rows and a second state."""
        return self.rows + self.size

    @property
    def passes(self) -> tuple[Sweep, ...]:
        """The sweeps of a step in the order of execution. A sweep occurs once for each flow that uses it."""
        # A step without flows executes each sweep once.
        return tuple(self.sweeps[flow.sweep] for flow in self.flows) or self.sweeps

    @property
    def totals(self) -> tuple[str, ...]:
        """The names of all sums over all sites."""
        return tuple(name for sweep in self.sweeps for name, _ in sweep.sums)

    def expressions(self) -> Iterator[Expr]:
        """Yield every expression of the step."""
        for sweep in self.sweeps:
            for kernel in sweep.kernels:
                yield from kernel.expressions()
        for block in self.blocks:
            if block.newton is not None:
                yield from block.newton.kernel.expressions()

    @property
    def unrepeated(self) -> tuple[Sweep, ...]:
        """The sweeps that a step executes only once, in order. The sweeps of iterations are not included."""
        # The sweeps of a block of equations are executed in each iteration.
        repeated = {k for block in self.blocks for k in range(block.first, block.last + 1)}
        if self.flows:
            return self.passes
        return tuple(sweep for k, sweep in enumerate(self.sweeps) if k not in repeated)

    def repeated(self, block: SiteBlock) -> tuple[Sweep, ...]:
        """Return the sweeps of one iteration for the equations of ``block``."""
        return self.sweeps[block.first : block.last + 1]

    @property
    def moved_once(self) -> tuple[int, int]:
        """The numbers of values that a step reads and writes for each site, without the iterations."""
        # The matrices of Newton's method are computed once in each step, before the iterations.
        matrices = [b.newton.moved_once(self.periodic) for b in self.blocks if b.newton is not None]
        return _added([traffic(self.unrepeated), *matrices])

    def moved_in_a_sweep(self, block: SiteBlock) -> tuple[int, int]:
        """Return how many numbers an iteration for ``block`` reads and writes for each site."""
        newton = [] if block.newton is None else [block.newton.moved_in_a_sweep(self.periodic)]
        # Fixed-point iteration needs no matrix, so it moves only the numbers of the sweeps.
        return _added([traffic(self.repeated(block)), *newton])

    def numbers_moved(self, sweeps: Sequence[float]) -> float:
        """Return how many numbers a step moves to or from memory for each site.

        ``sweeps`` contains the number of iterations for each block of equations.
        """
        # ``n`` is the number of iterations for one block of equations.
        repeated = (n * sum(self.moved_in_a_sweep(b)) for n, b in zip(sweeps, self.blocks, strict=True))
        return sum(self.moved_once) + sum(repeated)

    def explanation(self) -> list[str]:
        """Return lines that describe the loops, the stored values and the memory traffic."""
        lines = []
        for number, sweep in enumerate(self.sweeps, 1):
            lines.append(f"loop {number}: {sweep.about}")
            # Each row contains one number for each site.
            lines.append(f"  reads {len(sweep.rows_read)} and stores {_stored(sweep)} numbers for each site")
            if sweep.sums:
                names = ", ".join(name for name, _ in sweep.sums)
                lines.append(f"  then the terms of {names} are added for all sites")
        for block in self.blocks:
            # The indices begin at 0, and the printed numbers at 1.
            loops = f"loops {block.first + 1} to {block.last + 1} are"
            # A block often has a single loop, which needs the singular form of the sentence.
            if block.first == block.last:
                loops = f"loop {block.last + 1} is"
            names = ", ".join(block.unknowns)
            lines.append(f"{loops} repeated until the unknowns {names} converge at all sites")
            if block.newton is not None:
                n = block.newton.size
                lines.append(
                    f"  Newton's method: each site has three blocks of {n} x {n} numbers of the matrix"
                )
        if self.flows:
            lines.append(f"a step: {len(self.flows)} passes through these loops")
        lines.append(
            f"workspace: {self.workspace} numbers for each site, {BYTES * self.workspace} bytes, and padding"
        )
        moved = f"memory traffic: {_moved(self.moved_once)} for each site and step"
        for block in self.blocks:
            moved += f", and {_moved(self.moved_in_a_sweep(block))} in each sweep of {block.label}"
        return [*lines, moved]


def traffic(sweeps: Iterable[Sweep]) -> tuple[int, int]:
    """Return how many numbers the sweeps read and write for each site. Later reads of a number are not
    counted, because they find the number in the cache.
    """
    listed = list(sweeps)
    # After a sweep, another loop over all sites reads the measured rows and the terms of the sums.
    read = sum(len(sweep.rows_read) + len(sweep.measured) + len(sweep.sums) for sweep in listed)
    return read, sum(map(_stored, listed))


def _stored(sweep: Sweep) -> int:
    """Return the number of rows that a sweep changes."""
    # A row that is stored and also measured is written once.
    return len({*sweep.stores, *sweep.measured})


def _added(pairs: Iterable[tuple[int, int]]) -> tuple[int, int]:
    # Each pair contains the numbers read and the numbers written.
    read, written = zip(*pairs, strict=True)
    return sum(read), sum(written)


def _moved(numbers: tuple[int, int]) -> str:
    read, written = numbers
    return f"{BYTES * read} bytes read and {BYTES * written} bytes written"
