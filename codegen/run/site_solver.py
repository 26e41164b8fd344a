"""The solution of implicit equations on a lattice, by fixed-point iteration or by Newton's method.

The equations are u = g(u), with unknowns u at each site. One iteration consists of one or more sweeps over
all sites.

In fixed-point iteration, the last sweep of each iteration replaces u by g(u). The stopping rule
(:mod:`codegen.run.stopping`) uses the largest change and the largest absolute value of an unknown over
all sites.

In Newton's method for chains (:mod:`codegen.run.site_newton`), the last sweep stores the residuals g(u) - u.
"""

from __future__ import annotations

from collections.abc import Sequence

from codegen.ir.expr import Space
from codegen.ir.kernel import LOST, Loop, Newton
from codegen.ir.site_step import STATE, WORK, SiteBlock, SiteStep
from codegen.kernel.schedule import METHODS
from codegen.run.language import Array, Assign, Call, For, Function, If, Note, Return, Statement, While
from codegen.run.plan import STEP, Plan
from codegen.run.site_newton import ChainSolver
from codegen.run.site_terms import ARRAYS, MEASURED, SITES, distributed, row_of
from codegen.run.statistics import SWEEPS
from codegen.run.stopping import CHANGE, SCALE, Stopping
from codegen.run.terms import (
    NOT_CONVERGED,
    OK,
    STATUS,
    Kind,
    Term,
    both,
    code,
    count,
    greatest,
    is_finite,
    number,
    real,
    size,
    whole,
)

MEASURE, REACH = "measured", "largest_state"
"""The names of two functions that compute maxima over all sites. MEASURE computes the largest absolute value
of the unknowns and of their changes. REACH computes the largest absolute value of the state variables."""

_REACH, _PLACE = real("reach"), count("place")


class _Stopping(Stopping):
    """The stopping rule for the unknowns of all sites."""

    def converged(self) -> list[Statement]:
        """Return the statements that test whether the unknowns have converged."""
        # To save time, ``REACH`` is called only if the changes no longer decrease.
        still = both(self.previous > 0.0, CHANGE >= self.previous)
        measured = If(still, (Call(REACH, (SITES, ARRAYS[STATE]), (_REACH,)),))
        # Compilers require that ``_REACH`` has an initial value. The initial value 0 has no effect on the
        # result of the stopping rule.
        return [Assign(_REACH, number(0.0)), measured, *super().converged()]

    def lost(self) -> Term:
        """Return the test *lost* of the stopping rule (:mod:`codegen.run.stopping`).

        Let h be the step size, and let CHANGE be the largest change of an unknown in the last iteration.
        The test is true if h times CHANGE is not larger than the rounding errors of the states.
        """
        return CHANGE * size(STEP) <= self.plan.format.scaled(LOST) * _REACH


def loop_of(block: SiteBlock) -> Loop:
    """Return the data that the stopping rule needs about a block of equations."""
    newton = None if block.newton is None else Newton((), (), leading=True)
    # The third argument is a nonempty tuple, because an empty tuple would mean a warm start.
    return Loop(block.label, block.unknowns, (Space().zero,), (), (), newton=newton)


def iterated(
    plan: Plan, step: SiteStep, block_number: int, block: SiteBlock, iteration: Sequence[Statement]
) -> list[Statement]:
    """Return the statements that repeat ``iteration`` until the unknowns converge.

    If the unknowns do not converge, the statements return the status NOT_CONVERGED or NOT_FINITE. If Newton's
    matrix has no inverse, the statements return the status SINGULAR or NOT_FINITE.
    """
    rule = _Stopping(plan, loop_of(block), block_number, ())
    chain = None if block.newton is None else ChainSolver(plan, step, block, block_number)
    measured = Call(MEASURE, (SITES, ARRAYS[WORK], MEASURED)) if chain is None else chain.corrected()
    body: list[Statement] = [
        Assign(SWEEPS, SWEEPS + 1),
        *iteration,
        measured,
        Assign(CHANGE, MEASURED[0]),
        Assign(SCALE, MEASURED[1]),
        *rule.converged(),
        # ``MEASURED[2]`` is finite only if all changes are finite.
        rule.decided(is_finite(MEASURED[2])),
        Assign(rule.previous, CHANGE),
    ]
    # Newton's matrix is computed once in each step, before the first iteration.
    prepared = [] if chain is None else [*chain.prepared(), If(STATUS.differs(code(OK)), (Return(STATUS),))]
    return [
        Note(f"{block.label}: {METHODS[rule.loop.solver]}"),
        *prepared,
        # All blocks of equations use the array MEASURED, so only the first block declares the array.
        *([Array(MEASURED)] if block_number == 1 else []),
        *rule.before(),
        Assign(SWEEPS, whole(0)),
        Assign(STATUS, code(NOT_CONVERGED)),
        While(rule.going_on(), tuple(body), at_least_once=True),
        If(STATUS.differs(code(OK)), (Return(STATUS),)),
        *rule.after(),
    ]


def solvers(plan: Plan, step: SiteStep) -> list[Function]:
    """Return the functions that solve the equations of a step. An explicit method has none.

    Each function comes after the functions that it calls.
    """
    listed = [_reach(step)] if step.blocks else []
    for number_of_block, block in enumerate(step.blocks, 1):
        # With fixed-point iteration, all blocks share one function.
        if block.newton is not None:
            listed += ChainSolver(plan, step, block, number_of_block).functions()
        elif number_of_block == 1:
            listed.append(_measure(step))
    return listed


def _measure(step: SiteStep) -> Function:
    """Return the function MEASURE for fixed-point iteration.

    The function MEASURE computes the three numbers that the stopping rule needs.
    """
    work = ARRAYS[WORK]
    # The row ``change_row`` contains the largest change of the unknowns of each site. The row ``size_row``
    # contains their largest absolute value. All blocks of equations use the rows of the first block.
    change_row, size_row = (row_of(step, row.number) for row in step.sweeps[step.blocks[0].last].measured)
    start = [count("changes"), count("sizes")]
    most, all_changes, largest = real("most"), real("sum"), real("largest_unknown")
    change = real("change")
    # If several processors execute the loop, their maxima and sums must be combined.
    reductions = (("max", most), ("max", largest), ("+", all_changes))
    body = (
        Assign(change, work[start[0] + _PLACE]),
        Assign(most, greatest([most, change])),
        # A maximum may ignore a NaN, but this sum is NaN if a change is not finite. If all changes are
        # finite, this sum is 0.
        Assign(all_changes, all_changes + (change - change)),
        Assign(largest, greatest([largest, work[start[1] + _PLACE]])),
    )
    about = (
        "Compute three numbers: the largest change of an unknown, the largest absolute value of an unknown, "
        "and a number that is 0 if all changes are finite, and NaN otherwise."
    )
    return Function(
        MEASURE,
        about,
        (SITES, work, MEASURED),
        (
            Assign(start[0], change_row),
            Assign(start[1], size_row),
            *(Assign(x, number(0.0)) for x in (most, all_changes, largest)),
            distributed(For(_PLACE, SITES, body), reductions),
            *(Assign(MEASURED[k], x) for k, x in enumerate((most, largest, all_changes))),
        ),
    )


def _reach(step: SiteStep) -> Function:
    """Return the function that computes the largest absolute value of the state variables."""
    state, most = ARRAYS[STATE], real("most")
    # There are no gaps between the rows of a state, so one loop reads all entries.
    entry = Assign(most, greatest([most, size(state[_PLACE])]))
    loop = distributed(For(_PLACE, step.size * SITES, (entry,)), (("max", most),))
    return Function(
        REACH,
        "The largest absolute value of the state variables of all sites.",
        (SITES, state),
        (Assign(most, number(0.0)), loop, Return(most)),
        Kind.REAL,
    )
