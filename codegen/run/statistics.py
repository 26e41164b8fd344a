"""Statistics of a run: numbers of sweeps and of Newton matrices, and the block that failed.

The record of statistics belongs to the caller. A run adds its counts to the record. If the caller passes no
record, nothing is counted. Separate functions do the counting, so that a loop contains a single call.
"""

from __future__ import annotations

from codegen.run.language import Assign, Call, Function, If, Record, Statement
from codegen.run.plan import STATISTICS, Plan
from codegen.run.terms import OK, STATUS, Kind, Term, code, count, flag, given, whole

SWEEPS = count("sweep")
"""The number of sweeps of a loop so far."""


def statistics_record(plan: Plan) -> Record:
    """Return the record of a unit's statistics."""
    # Sweeps are counted for each block, because a single slow block would be invisible in a total.
    labels = [loop.label for loop in plan.kernel.loops]
    fields = [
        (count("sweeps", len(labels)), "by block: " + ", ".join(labels)),
        (count("most"), "largest number of sweeps of one block in one step"),
        # Blocks are numbered from one, so that a record of zeros means no failure.
        (count("failed"), "number of the block that failed, counted from 1; 0 if none"),
    ]
    # Simplified Newton computes one matrix in each step, so its matrices are not counted.
    if plan.newton:
        fields.append((count("matrices"), "number of Newton matrices that were computed"))
    about = "Sweeps over the equations, summed over all steps since the caller set all fields to zero."
    return Record(STATISTICS, about, tuple(fields), public=True)


def counters(plan: Plan) -> tuple[Function, ...]:
    """Return the functions that update the statistics."""
    statistics, block, sweeps, failed = plan.statistics, count("block"), count("sweeps"), flag("failed")
    most, last = (statistics.field(name, Kind.COUNT) for name in ("most", "failed"))
    total = statistics.field("sweeps", Kind.COUNT, (len(plan.kernel.loops),))[block]
    adding = (
        Assign(total, total + sweeps),
        # The largest number is stored in addition to the sum, because a single step with many sweeps is the
        # first sign of a step size that is too large.
        If(sweeps > most, (Assign(most, sweeps),)),
        If(failed, (Assign(last, block + 1),)),
    )
    functions = [
        Function(
            "count_sweeps",
            "Record the number of sweeps over one block, and whether the block failed.",
            (statistics, block, sweeps, failed),
            # The caller may pass no statistics. The emitted function tests this, so that the loops need no
            # test.
            (If(given(statistics), adding),),
        )
    ]
    if plan.newton:
        matrices = statistics.field("matrices", Kind.COUNT)
        body = (If(given(statistics), (Assign(matrices, matrices + 1),)),)
        functions.append(Function("count_matrix", "Add one matrix.", (statistics,), body))
    return tuple(functions)


def count_sweeps(plan: Plan, block: int, sweeps: Term = SWEEPS) -> Statement:
    """Return the call that counts the sweeps of a loop. If the status is not OK, the call also records the
    failure.
    """
    return Call("count_sweeps", (plan.statistics, whole(block), sweeps, STATUS.differs(code(OK))))


def count_matrix(plan: Plan) -> Statement:
    """Return the call that counts a matrix. The call follows the computation of the matrix."""
    return Call("count_matrix", (plan.statistics,))


def no_failure(plan: Plan) -> Statement:
    """Return the statement that sets the field ``failed`` to zero, after the continuation has succeeded."""
    return If(given(plan.statistics), (Assign(plan.statistics.field("failed", Kind.COUNT), whole(0)),))
