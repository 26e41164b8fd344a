"""The names of arguments and arrays in the functions of a lattice, and the positions of numbers in arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TypeVar

from codegen.ir.kernel import Kernel
from codegen.ir.site_step import RESULT, STATE, WORK, Row, SiteStep
from codegen.kernel.schedule import Simple, arrange
from codegen.run.language import Assign, For, Function, Statement, assigned, reads, terms
from codegen.run.terms import Term, count, flag, real, select, value, whole
from codegen.run.values import simple

Count = TypeVar("Count", int, Term)

SITES, COLUMNS, COLUMN, ROW = count("sites"), count("columns"), count("column"), count("row")
"""SITES is the number of all sites, and COLUMNS is the number of sites in one row of the lattice.

COLUMN is the index of a site in its row. ROW is the index of the first site of this row among all sites."""

STRIDE = count("stride")
"""The distance of two rows of the workspace."""

SITE, NUMBER, PLACE, INDEX = count("site"), count("number"), count("place"), count("i")
BAD, WHOLE = count("bad"), flag("whole")
"""BAD is the number of sites whose new state is not finite, and WHOLE is a flag.

If WHOLE is true, sines, cosines and Stumpff functions are computed by variants that accept all arguments."""

# The size 0 denotes a size that only the caller knows. It depends on the number of sites.
_STATE, _WORK, _RESULT = real(STATE, 0), real(WORK, 0), real(RESULT, 0)
CHUNK, MANY_SITES = 1024, 2048
"""A loop over adjacent sites is divided into chunks of CHUNK sites, which several processors can execute.

For fewer than MANY_SITES sites one processor executes all loops. On 1024 spins, a step of cf4 takes the same
time with one thread and with two threads. On 4096 spins, two threads need 0.55 times the time of one thread
(`benchmarks/lattice.py --threads 2` without this limit)."""

_PASS, FIRST, SIZE = count("chunk"), count("first"), count("size")
"""The index of a chunk, its first site, and its number of sites."""

ARRAYS = {STATE: _STATE, WORK: _WORK, RESULT: _RESULT}


def chunks(number: Term, body: Sequence[Statement], reductions: tuple[tuple[str, Term], ...] = ()) -> For:
    """Return a parallel loop over chunks of ``number`` adjacent sites.

    ``body`` computes the SIZE sites from the site FIRST on.
    """
    rest = number - FIRST
    # The last chunk may have fewer sites.
    limits = (Assign(FIRST, _PASS * CHUNK), Assign(SIZE, select(rest < CHUNK, rest, whole(CHUNK))))
    many = number >= MANY_SITES
    # The quotient is rounded up.
    count_of_chunks = (number + (CHUNK - 1)) // CHUNK
    return For(_PASS, count_of_chunks, (*limits, *body), parallel=True, reductions=reductions, when=many)


def distributed(loop: For, reductions: tuple[tuple[str, Term], ...] = ()) -> For:
    """Return a loop over all sites or rows that is parallel if the lattice has many sites."""
    return replace(loop, parallel=True, reductions=reductions, when=SITES >= MANY_SITES)


def shape_of(step: SiteStep) -> Term:
    """Return the argument for the numbers of sites in all dimensions."""
    return count("shape", step.dimension)


MEASURED = real("measures", 3)
"""Three values for all sites together: the largest change of an unknown, the largest unknown, and the sum of
all changes."""


def padded(sites: Count) -> Count:
    """Return the distance of two rows of the workspace: an odd multiple of 8 that is at least ``sites``.

    With a distance of 512 doubles, the entries of all rows at one site would compete for the same few lines
    of a cache. A step of cf4 then takes 1.7 times as long on 1024 x 1024 spins, and 2.3 times as long on a
    rod of 512 sections (`benchmarks/lattice.py --side 1024`, `benchmarks/rod.py`).

    >>> [padded(n) for n in (1, 8, 9, 500, 512)]
    [8, 8, 24, 504, 520]
    """
    # A multiple of 16 plus 8 is an odd multiple of 8.
    return (sites + 7) // 16 * 16 + 8


def entry_of(step: SiteStep, row: Row, place: Term) -> Term:
    """Return the entry of a row at the site with the index ``place``."""
    array = ARRAYS[row.array]
    # Only the workspace has padded rows. The rows of a state have exactly ``sites`` entries.
    if row.array == WORK:
        return array[row_of(step, row.number) + place]
    return array[(row.number * SITES if row.number > 1 else SITES) + place] if row.number else array[place]


def row_of(step: SiteStep, number: int | Term) -> Term:
    """Return the index at which a row of the workspace begins. The first ``step.size`` rows contain a
    state."""
    first = number + step.size
    return STRIDE if isinstance(first, int) and first == 1 else first * STRIDE


def with_stride(function: Function) -> Function:
    """Return a function with a new first statement that computes the stride, if the function uses the
    stride."""
    # An unused variable would cause a warning of C compilers.
    used = any(term.text == STRIDE.text for term in terms(function.body))
    return replace(function, body=(Assign(STRIDE, padded(SITES)), *function.body)) if used else function


def moved(index: Term, offset: int, size: Term, periodic: bool) -> tuple[Term | None, Term]:
    """Return a test and the index of a neighbour.

    The test is true if the neighbour lies in the range 0, ..., ``size`` - 1. It is None if the offset is
    zero. For a neighbour outside this range, the index of the site itself is returned. In a periodic lattice,
    the index wraps around instead. One addition or subtraction of ``size`` is enough, because ``size`` is
    larger than every offset.
    """
    if not offset:
        return None, index
    far = abs(offset)
    # Counts must not become negative, but ``size - far`` may be negative. Therefore the first test adds
    # ``far`` to the index.
    there = index + far < size if offset > 0 else index >= far
    moved = index + far if offset > 0 else index - far
    wrapped = (index + far - size if offset > 0 else index + size - far) if periodic else index
    return there, select(there, moved, wrapped)


def split(kernel: Kernel, shared: set[str]) -> tuple[list[Statement], list[Statement], list[Term]]:
    """Split the statements of a kernel. Return two lists of statements, and the list of outputs.

    The first list contains the statements whose results depend only on the scalars ``shared``. The second
    list contains all other statements.
    """
    before: list[Statement] = []
    inside: list[Statement] = []
    known = set(shared)
    arranged = arrange(kernel)
    for statement in arranged.statements:
        # Equations on a lattice are solved by repeated sweeps, so the kernel of a site contains no loops.
        assert isinstance(statement, Simple)
        for single in simple(statement):
            # The statement has the same result at all sites, so it can be executed once before the loop.
            if all(term.text in known for term in reads(single)):
                before.append(single)
                # Later statements may read these results and still be independent of the site.
                known |= {term.text for term in assigned(single)}
            else:
                inside.append(single)
    return before, inside, [value(x) for x in arranged.outputs]
