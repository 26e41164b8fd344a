"""Statistics of a run: counters for sweeps and for Newton matrices.

The caller of a run may pass a record. The run then adds its counts to this record.
"""

from __future__ import annotations

from codegen.run.language import Assign, Call, Function, If, Record, Statement
from codegen.run.plan import STATISTICS, Plan
from codegen.run.terms import OK, STATUS, Kind, Term, code, count, flag, given, whole

SWEEPS = count("sweep")
"""The emitted variable that counts the sweeps of one loop."""


def statistics_record(plan: Plan) -> Record:
    """Return the type of the record with the statistics."""
    # Each block of equations has its own number of sweeps, because a total would hide a slow block.
    labels = [loop.label for loop in plan.kernel.loops]
    fields = [
        (count("sweeps", len(labels)), "by block: " + ", ".join(labels)),
        (count("most"), "largest number of sweeps of one block in one step or substep"),
        # Blocks are numbered from 1, because 0 means that no block failed.
        (count("failed"), "number of the block that failed, counted from 1; 0 if none"),
    ]
    # Only the matrices of Newton's method are counted. Simplified Newton needs no counter, because its number
    # of matrices is known in advance.
    if plan.newton:
        fields.append((count("matrices"), "number of Newton matrices that were computed"))
    about = "Statistics of the iterations (sweeps) since the caller set all fields to zero."
    return Record(STATISTICS, about, tuple(fields), public=True)


def counters(plan: Plan) -> tuple[Function, ...]:
    """Return the emitted functions that add counts to the caller's record."""
    statistics, block, sweeps, failed = plan.statistics, count("block"), count("sweeps"), flag("failed")
    most, last = (statistics.field(name, Kind.COUNT) for name in ("most", "failed"))
    total = statistics.field("sweeps", Kind.COUNT, (len(plan.kernel.loops),))[block]
    adding = (
        Assign(total, total + sweeps),
        # A single step with many sweeps is the first sign that the step size is too large.
        If(sweeps > most, (Assign(most, sweeps),)),
        If(failed, (Assign(last, block + 1),)),
    )
    functions = [
        Function(
            "count_sweeps",
            "Record the number of sweeps over one block, and whether the block failed.",
            (statistics, block, sweeps, failed),
            # The caller's record is optional.
            (If(given(statistics), adding),),
        )
    ]
    if plan.newton:
        matrices = statistics.field("matrices", Kind.COUNT)
        body = (If(given(statistics), (Assign(matrices, matrices + 1),)),)
        functions.append(Function("count_matrix", "Add one matrix.", (statistics,), body))
    return tuple(functions)


def count_sweeps(plan: Plan, block: int, sweeps: Term = SWEEPS) -> Statement:
    """Return the call that counts the sweeps over one block in the statistics.

    ``block`` is the index of the block. If the status is not OK when the code is executed, the call also
    records that this block failed.
    """
    return Call("count_sweeps", (plan.statistics, whole(block), sweeps, STATUS.differs(code(OK))))


def count_matrix(plan: Plan) -> Statement:
    """Return the call that counts one more Newton matrix in the statistics."""
    return Call("count_matrix", (plan.statistics,))


def no_failure(plan: Plan) -> Statement:
    """Return the statement that sets the field ``failed`` of the statistics to zero.

    The emitted code executes this statement if a failed step is repeated and succeeds.
    """
    return If(given(plan.statistics), (Assign(plan.statistics.field("failed", Kind.COUNT), whole(0)),))
