"""A step of a lattice system as a sequence of sweeps over all sites.

A sweep is a loop that computes the same formulas at each site. The formulas read numbers of the site and of
its neighbours.
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
"""The names of the arrays of a step: the old state, the workspace, and the new state. An array has one row
for each quantity and one column for each site.
"""

EXISTS = "exists"
"""The name of an array of flags. The flag in row k is 1 if neighbour k of the site exists, and 0 otherwise.
"""

OWN = -1
"""The value of :attr:`Load.neighbour` that denotes the site itself."""

NO_TIME = Number.rational(0)

BYTES = 8
"""The number of bytes of a double."""


@dataclass(frozen=True)
class Row:
    """A row of an array, with one number for each site.

    ``array`` is the name of the array: :data:`STATE`, :data:`WORK`, :data:`RESULT` or :data:`EXISTS`. The
    index of the row is ``number``.
    """

    array: str
    number: int


@dataclass(frozen=True)
class Load:
    """A number that a sweep reads at each site. ``symbol`` denotes the number in the formulas.

    ``row`` has one entry for each site. If ``neighbour`` is :data:`OWN`, the sweep reads the entry of the
    site itself. Otherwise, it reads the entry of neighbour number ``neighbour`` (:attr:`SiteStep.offsets`).
    """

    symbol: str
    row: Row
    neighbour: int = OWN


@dataclass(frozen=True)
class Sweep:
    """One loop over all sites. Output k of ``kernel`` is stored in the row ``stores[k]``.

    - ``about`` is a text that lists the operations of the sweep.
    - ``loads`` are the numbers that the kernel reads at each site.
    - ``outside`` is a kernel for sites at the boundary of the lattice, or None. If a load refers to a
      neighbour that does not exist, ``outside`` computes the value of the load. Output k of ``outside``
      belongs to the load ``read_outside[k]``.
    - ``axis`` is :data:`OWN` if the sweep visits single sites. If the sweep visits pairs of neighbouring
      sites, ``axis`` is the index of the lattice axis along which the two sites are neighbours. In a sweep
      over single sites, the attribute ``neighbour`` of a load is :data:`OWN` or an index in
      :attr:`SiteStep.offsets`. In a sweep over pairs, ``neighbour`` is :data:`OWN` for the first site of the
      pair, and 0 for the second site. The first half of ``stores`` contains the rows for the first site. The
      second half contains the rows for the second site.
    - ``unknowns`` are the unknowns u of the equations u = g(u). The first outputs of ``kernel`` are the
      values g(u). In Newton's method, the sweep subtracts u from these outputs, and stores the differences
      g(u) - u. In fixed-point iteration, the sweep stores the outputs unchanged.
    - ``measured`` is empty, or contains two rows for the stopping test of fixed-point iteration. For each
      site, the first row contains the largest change of the unknowns of this site. The second row contains
      the largest absolute value of the unknowns of this site.
    - ``sums`` contains a pair (name, row) for each sum over all sites. The row contains the terms of the sum.
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
        """The sorted indices of the neighbours from which the sweep reads numbers."""
        # A site is not its own neighbour.
        return tuple(sorted({load.neighbour for load in self.loads} - {OWN}))

    @property
    def read_outside(self) -> tuple[Load, ...]:
        """The loads that read a number from a neighbour of the site."""
        return tuple(load for load in self.loads if load.neighbour != OWN)

    @property
    def rows_read(self) -> tuple[Row, ...]:
        """The rows that the sweep reads, without duplicates."""
        # The flags ``EXISTS`` are computed at each site. They are not in memory.
        return tuple(dict.fromkeys(load.row for load in self.loads if load.row.array != EXISTS))

    @property
    def kernels(self) -> tuple[Kernel, ...]:
        """The kernels of the sweep: ``kernel``, and ``outside`` if it is not None."""
        return (self.kernel,) if self.outside is None else (self.kernel, self.outside)


@dataclass(frozen=True)
class SiteNewton:
    """The matrix of Newton's method for implicit equations u = g(u) on a chain of sites.

    The matrix is the Jacobian matrix of u - g(u), expanded to first order in the step size h. Each site has
    ``size`` unknowns. For each site, ``kernel`` computes three square blocks: the derivatives with respect to
    the unknowns of the left neighbour, of the site, and of the right neighbour.

    The position of neighbour k relative to a site is entry k of :attr:`SiteStep.offsets`. In an open chain,
    the first site and the last site lack one neighbour each. The symbol with the name ``exists[k]`` is 1 for
    a site with neighbour k, and 0 for a site without neighbour k.

    ``matrix``, ``residual`` and ``border`` are indices of rows in the workspace. A row of the workspace
    contains one number for each site.

    - The matrix occupies 3 ``size``^2 rows from row ``matrix`` on. The blocks of one site are contiguous.
    - The residuals occupy ``size`` rows from row ``residual`` on.
    - In a periodic chain, the border occupies ``size``^2 rows from row ``border`` on. The border consists of
      the ``size`` columns of the matrix that belong to the unknowns of the last site. Each column contains
      ``size`` numbers for each site.
    """

    kernel: Kernel
    loads: tuple[Load, ...]
    exists: tuple[str, ...]
    size: int
    residual: int
    border: int
    matrix: int

    def moved_once(self, periodic: bool) -> tuple[int, int]:
        """Return the memory traffic for the computation and factorisation of Newton's matrix.

        The result is the pair (numbers read, numbers written) for each site.
        """
        n = self.size
        # For each site, ``kernel`` writes 3 n^2 matrix entries, and the factorisation reads and overwrites
        # these entries.
        read, written = len({load.row for load in self.loads}) + 3 * n * n, 6 * n * n
        # The matrix of a periodic chain is not block-tridiagonal, because the last site is a neighbour of the
        # first site.
        if periodic:
            # Block elimination separates the n unknowns of the last site from all other unknowns, and solves
            # one additional linear system for each of these n unknowns.
            solved = self._substituted()
            read, written = read + n * solved[0], written + n * n + n * solved[1]
        return read, written

    def moved_in_a_sweep(self, periodic: bool) -> tuple[int, int]:
        """Return the memory traffic of one correction of the unknowns by Newton's method.

        The result is the pair (numbers read, numbers written) for each site.
        """
        n = self.size
        # The linear equations of Newton's method have the residuals as right-hand side.
        read, written = self._substituted()
        # The update reads the old values and the corrections of the n unknowns, and writes the new values.
        read, written = read + 2 * n, written + n
        return (read + n * n + n, written + n) if periodic else (read, written)

    def _substituted(self) -> tuple[int, int]:
        """Return the pair (numbers read per site, numbers written per site).

        Both counts are totals for a forward and a back substitution with one right-hand side.
        """
        n = self.size
        # The forward and the back substitution each read and write the n numbers of the right-hand side.
        return 3 * n * n + 2 * n, 2 * n


@dataclass(frozen=True)
class SiteBlock:
    """Implicit equations u = g(u) for the unknowns u of all sites, solved by iteration.

    In each iteration, the sweeps with the indices ``first`` to ``last`` compute g(u). If ``newton`` is None,
    g(u) replaces u. If ``newton`` is given, the sweeps store the residuals g(u) - u.

    The sweeps before ``first`` store the initial guess for u.
    """

    label: str
    unknowns: tuple[str, ...]
    first: int
    last: int
    newton: SiteNewton | None = None


@dataclass(frozen=True)
class SiteFlow:
    """One exact flow in a step of a splitting method.

    - ``sweep`` is the index of the sweep that computes the flow.
    - ``duration`` is the duration of the flow, divided by h.
    - A flow that depends on time is evaluated at the time t + ``elapsed`` * h.
    - In a sweep over pairs of sites, ``colour`` is 0 if the first site of each pair has an even index, and 1
      if this index is odd.
    """

    sweep: int
    colour: int
    duration: Number
    elapsed: Number = NO_TIME


@dataclass(frozen=True)
class SiteStep:
    """One step of a lattice system.

    - ``dimension`` is the dimension of the lattice. ``offsets[k]`` is the position of neighbour k relative to
      a site.
    - ``sweeps`` are the loops over all sites. If ``flows`` is empty, the step executes the sweeps in the
      order of the tuple. Otherwise, for each ``flow`` in ``flows``, the step executes ``sweeps[flow.sweep]``.
      A sweep may belong to several flows.
    - ``size`` is the number of rows of the state.
    - ``rows`` is the number of rows of the workspace for intermediate results.
    - ``flows`` are the exact flows of a splitting method, in the order of execution. The first flow reads the
      old state, and all other flows change the new state in place.
    - ``blocks`` are the implicit equations of the step, in the order in which they are solved.
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
        """The number of rows of the workspace: the sum of ``rows`` and ``size``.

        The intermediate results occupy ``rows`` rows, and one state occupies ``size`` rows.
        """
        # A step must not overwrite the old state, so the emitted code uses two states.
        return self.rows + self.size

    @property
    def passes(self) -> tuple[Sweep, ...]:
        """The sweeps of a step in the order of execution. A sweep that n flows use is listed n times."""
        # A step without flows executes each sweep once.
        return tuple(self.sweeps[flow.sweep] for flow in self.flows) or self.sweeps

    @property
    def totals(self) -> tuple[str, ...]:
        """The names of all sums over all sites."""
        return tuple(name for sweep in self.sweeps for name, _ in sweep.sums)

    def expressions(self) -> Iterator[Expr]:
        """Yield the expressions in the kernels of the step."""
        for sweep in self.sweeps:
            for kernel in sweep.kernels:
                yield from kernel.expressions()
        for block in self.blocks:
            if block.newton is not None:
                yield from block.newton.kernel.expressions()

    @property
    def unrepeated(self) -> tuple[Sweep, ...]:
        """The sweeps that do not belong to an iteration for implicit equations, in the order of execution."""
        repeated = {k for block in self.blocks for k in range(block.first, block.last + 1)}
        if self.flows:
            return self.passes
        return tuple(sweep for k, sweep in enumerate(self.sweeps) if k not in repeated)

    def repeated(self, block: SiteBlock) -> tuple[Sweep, ...]:
        """Return the sweeps (loops over all sites) that each iteration for ``block`` executes."""
        return self.sweeps[block.first : block.last + 1]

    @property
    def moved_once(self) -> tuple[int, int]:
        """The memory traffic of a step, without the iterations for implicit equations.

        The result is the pair (numbers read, numbers written) for each site.
        """
        # Newton's matrices are computed before the iterations, once in each step.
        matrices = [b.newton.moved_once(self.periodic) for b in self.blocks if b.newton is not None]
        return _added([traffic(self.unrepeated), *matrices])

    def moved_in_a_sweep(self, block: SiteBlock) -> tuple[int, int]:
        """Return the memory traffic of one iteration of ``block``.

        The result is the pair (numbers read, numbers written) for each site.
        """
        newton = [] if block.newton is None else [block.newton.moved_in_a_sweep(self.periodic)]
        return _added([traffic(self.repeated(block)), *newton])

    def numbers_moved(self, sweeps: Sequence[float]) -> float:
        """Return how many numbers a step reads and writes in memory for each site.

        ``sweeps[k]`` is the number of iterations for the equations of ``blocks[k]``.
        """
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
                lines.append(f"  computes the sums over all sites: {names}")
        for block in self.blocks:
            # In the text, the first loop has the number 1.
            loops = f"loops {block.first + 1} to {block.last + 1} are"
            if block.first == block.last:
                loops = f"loop {block.last + 1} is"
            names = ", ".join(block.unknowns)
            lines.append(f"{loops} repeated until the unknowns {names} converge at all sites")
            if block.newton is not None:
                n = block.newton.size
                lines.append(
                    f"  Newton's method: the matrix has three blocks of {n} x {n} numbers for each site"
                )
        if self.flows:
            lines.append(
                f"a step executes {len(self.flows)} loops; a loop that is executed twice counts twice"
            )
        lines.append(
            f"workspace: {self.workspace} numbers ({BYTES * self.workspace} bytes) for each site, "
            "plus padding"
        )
        moved = f"memory traffic: {_moved(self.moved_once)} for each site and step"
        for block in self.blocks:
            moved += f", plus {_moved(self.moved_in_a_sweep(block))} in each iteration for {block.label}"
        return [*lines, moved]


def traffic(sweeps: Iterable[Sweep]) -> tuple[int, int]:
    """Return the memory traffic of the sweeps: the pair (numbers read, numbers written) for each site.

    If a sweep reads a number several times, the number counts once, because it remains in the cache.
    """
    listed = list(sweeps)
    # The stopping test reads the rows ``measured``. Each sum in ``sums`` reads one row.
    read = sum(len(sweep.rows_read) + len(sweep.measured) + len(sweep.sums) for sweep in listed)
    return read, sum(map(_stored, listed))


def _stored(sweep: Sweep) -> int:
    """Return the number of rows to which a sweep writes."""
    # The set counts a row only once, even if the row is in ``stores`` and in ``measured``.
    return len({*sweep.stores, *sweep.measured})


def _added(pairs: Iterable[tuple[int, int]]) -> tuple[int, int]:
    # Each pair contains the number of memory reads and the number of memory writes.
    read, written = zip(*pairs, strict=True)
    return sum(read), sum(written)


def _moved(numbers: tuple[int, int]) -> str:
    read, written = numbers
    return f"{BYTES * read} bytes read and {BYTES * written} bytes written"
