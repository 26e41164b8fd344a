"""Names and helper functions for the emitted functions of a lattice.

The names denote arguments and arrays. The helper functions build parallel loops over sites, and find the
array entry that contains a given quantity at a given site.
"""

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

All sites of the lattice have indices from 0 to SITES - 1. ROW is the index of the first site in a row. COLUMN
is the position of a site in this row, so the index of this site is ROW + COLUMN.
"""

STRIDE = count("stride")
"""The distance between the beginnings of two consecutive rows of the workspace, in array entries."""

SITE, NUMBER, PLACE, INDEX = count("site"), count("number"), count("place"), count("i")
BAD, WHOLE = count("bad"), flag("whole")
"""BAD is the number of sites whose new state is not finite.

If the flag WHOLE is true, the emitted code uses sines, cosines and Stumpff functions that are valid for all
arguments. If WHOLE is false, the code may use faster functions that are valid only near zero.
"""

# The size 0 means that the length of an array is known only at run time.
_STATE, _WORK, _RESULT = real(STATE, 0), real(WORK, 0), real(RESULT, 0)
CHUNK, MANY_SITES = 1024, 2048
"""A loop over consecutive sites is divided into chunks of CHUNK sites.

For fewer than MANY_SITES sites, one processor executes all loops, because threads save no time on small
lattices. Without this limit, a step of the method ``cf4`` on 1024 spins takes the same time with one and with
two threads. On 4096 spins, two threads need 0.55 times as long as one thread. The program
``benchmarks/lattice.py`` measures such times with the option ``--threads 2``.
"""

_PASS, FIRST, SIZE = count("chunk"), count("first"), count("size")
"""The index of a chunk, its first site, and its number of sites."""

ARRAYS = {STATE: _STATE, WORK: _WORK, RESULT: _RESULT}


def chunks(number: Term, body: Sequence[Statement], reductions: tuple[tuple[str, Term], ...] = ()) -> For:
    """Return a parallel loop over ``number`` consecutive sites, divided into chunks of CHUNK sites.

    ``body`` computes the sites of one chunk. FIRST is the index of its first site, and SIZE is the number of
    its sites.
    """
    rest = number - FIRST
    # The last chunk may have fewer sites than the other chunks.
    limits = (Assign(FIRST, _PASS * CHUNK), Assign(SIZE, select(rest < CHUNK, rest, whole(CHUNK))))
    many = number >= MANY_SITES
    # The number of chunks is rounded up, because the last chunk may have fewer sites.
    count_of_chunks = (number + (CHUNK - 1)) // CHUNK
    return For(_PASS, count_of_chunks, (*limits, *body), parallel=True, reductions=reductions, when=many)


def distributed(loop: For, reductions: tuple[tuple[str, Term], ...] = ()) -> For:
    """Return a copy of ``loop`` that is executed in parallel if the lattice has at least MANY_SITES sites."""
    return replace(loop, parallel=True, reductions=reductions, when=SITES >= MANY_SITES)


def shape_of(step: SiteStep) -> Term:
    """Return the argument ``shape``, an array with the number of sites in each dimension."""
    return count("shape", step.dimension)


MEASURED = real("measures", 3)
"""The array for three numbers of the stopping rule.

The first two numbers are maxima over all sites: the largest change of an unknown, and the largest absolute
value of an unknown. The third number is finite only if all changes are finite."""


def padded(sites: Count) -> Count:
    """Return the distance between two rows of the workspace: an odd multiple of 8, at least ``sites``.

    If the distance were a large power of two, such as 512, the rows would cause cache conflicts. A step of
    the method ``cf4`` would then take 1.7 times as long on 1024 x 1024 spins
    (``benchmarks/lattice.py --side 1024``).

    >>> [padded(n) for n in (1, 8, 9, 500, 512)]
    [8, 8, 24, 504, 520]
    """
    # The result is 8 times an odd number.
    return (sites + 7) // 16 * 16 + 8


def entry_of(step: SiteStep, row: Row, place: Term) -> Term:
    """Return the entry with the index ``place`` in ``row``."""
    array = ARRAYS[row.array]
    # The distance between rows is STRIDE in the workspace, and SITES in all other arrays.
    if row.array == WORK:
        return array[row_of(step, row.number) + place]
    return array[(row.number * SITES if row.number > 1 else SITES) + place] if row.number else array[place]


def row_of(step: SiteStep, number: int | Term) -> Term:
    """Return the index at which row ``number`` of the workspace begins.

    The workspace begins with space for a second state. Row 0 comes after this space.
    """
    first = number + step.size
    return STRIDE if isinstance(first, int) and first == 1 else first * STRIDE


def with_stride(function: Function) -> Function:
    """Return the function with a new first statement that computes the stride.

    A function that does not read the stride is returned unchanged.
    """
    # C compilers warn about a variable that is assigned but not read. Therefore STRIDE is assigned only in
    # functions that read STRIDE.
    used = any(term.text == STRIDE.text for term in terms(function.body))
    return replace(function, body=(Assign(STRIDE, padded(SITES)), *function.body)) if used else function


def moved(index: Term, offset: int, size: Term, periodic: bool) -> tuple[Term | None, Term]:
    """Return a test and an index for the neighbour at ``index + offset`` in a dimension with ``size`` sites.

    The test is true if ``index + offset`` is in the range 0, ..., ``size`` - 1. Then the returned index is
    ``index + offset``. Otherwise, the returned index is ``index`` in an open lattice, and ``index + offset``
    modulo ``size`` in a periodic lattice. If the offset is zero, the test is None.
    """
    if not offset:
        return None, index
    far = abs(offset)
    # The variables are unsigned. If ``size`` < ``far``, the difference ``size - far`` would wrap around, so
    # the test uses the sum ``index + far``.
    there = index + far < size if offset > 0 else index >= far
    moved = index + far if offset > 0 else index - far
    wrapped = (index + far - size if offset > 0 else index + size - far) if periodic else index
    return there, select(there, moved, wrapped)


def split(kernel: Kernel, shared: set[str]) -> tuple[list[Statement], list[Statement], list[Term]]:
    """Split the statements of a kernel into two lists, and also return the outputs of the kernel.

    The first list contains the statements whose results depend only on the scalars ``shared``, such as h.
    """
    before: list[Statement] = []
    inside: list[Statement] = []
    known = set(shared)
    arranged = arrange(kernel)
    for statement in arranged.statements:
        # The kernel of a sweep contains no loops.
        assert isinstance(statement, Simple)
        for single in simple(statement):
            if all(term.text in known for term in reads(single)):
                # The statement has the same result at all sites, so it is executed once before the loop.
                before.append(single)
                known |= {term.text for term in assigned(single)}
            else:
                inside.append(single)
    return before, inside, [value(x) for x in arranged.outputs]
