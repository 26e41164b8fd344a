"""Sums over all sites of a lattice.

Each chunk of consecutive sites has its own sum. These sums are added in a fixed order. Therefore the result
does not depend on the number of threads.
"""

from __future__ import annotations

from codegen.ir.site_step import WORK, SiteStep, Sweep
from codegen.run.language import Assign, Call, For, Function, Return, Statement
from codegen.run.site_terms import ARRAYS, CHUNK, FIRST, SITES, SIZE, chunks, row_of
from codegen.run.terms import Kind, count, number, own, real

SUM = "sum_of_terms"
"""The name of the function that adds the numbers in one row of the workspace."""

_START, _PLACE, _CHUNK, _SUM, _PART = count("start"), count("place"), count("k"), real("sum"), real("part")


def summed(step: SiteStep, sweep: Sweep) -> list[Statement]:
    """Return a function call for each entry of ``sweep.sums``. Each call computes a sum over all sites."""
    return [
        Call(SUM, (SITES, ARRAYS[WORK], row_of(step, row.number)), (own(name),)) for name, row in sweep.sums
    ]


def sum_of_terms() -> Function:
    """Return the function that computes the sum of all numbers in a row of the workspace.

    The function overwrites some numbers of the row with partial sums.
    """
    work = ARRAYS[WORK]
    added = (
        Assign(_PART, number(0.0)),
        For(_PLACE, SIZE, (Assign(_PART, _PART + work[_START + FIRST + _PLACE]),)),
        # The first number of a chunk is no longer needed, so the sum of the chunk overwrites this number.
        Assign(work[_START + FIRST], _PART),
    )
    # One processor adds the sums of the chunks in a fixed order.
    whole = For(_CHUNK, (SITES + (CHUNK - 1)) // CHUNK, (Assign(_SUM, _SUM + work[_START + _CHUNK * CHUNK]),))
    return Function(
        SUM,
        "The sum of the numbers in one row of the workspace. The function overwrites some of the numbers.",
        (SITES, work, _START),
        (chunks(SITES, added), Assign(_SUM, number(0.0)), whole, Return(_SUM)),
        Kind.REAL,
    )
