"""Statistics: sweeps by block, the most in one step, the block that failed, and matrices of Newton's method.

They are the caller's: a run adds to what it is given, or counts nothing. All counting stands in functions of
its own, so that a loop holds one call.
"""

from __future__ import annotations

from codegen.run.language import Assign, Call, Function, If, Record, Statement
from codegen.run.plan import STATISTICS, Plan
from codegen.run.terms import OK, STATUS, Kind, Term, code, count, flag, given, whole

SWEEPS = count("sweep")
"""How many sweeps a loop has made."""


def statistics_record(plan: Plan) -> Record:
    """Return the record of a unit's statistics."""
    labels = [loop.label for loop in plan.kernel.loops]
    fields = [
        (count("sweeps", len(labels)), "by block: " + ", ".join(labels)),
        (count("most"), "the most that one block took in one step"),
        (count("failed"), "1 + the block that failed, 0 if none has"),
    ]
    if plan.newton:
        fields.append((count("matrices"), "how often a matrix of Newton's method was computed"))
    about = "Sweeps over the equations, added up over all steps since the caller set everything to zero."
    return Record(STATISTICS, about, tuple(fields), public=True)


def counters(plan: Plan) -> tuple[Function, ...]:
    """Return the functions that count."""
    statistics, block, sweeps, failed = plan.statistics, count("block"), count("sweeps"), flag("failed")
    most, last = (statistics.field(name, Kind.COUNT) for name in ("most", "failed"))
    total = statistics.field("sweeps", Kind.COUNT, (len(plan.kernel.loops),))[block]
    adding = (
        Assign(total, total + sweeps),
        If(sweeps > most, (Assign(most, sweeps),)),
        If(failed, (Assign(last, block + 1),)),
    )
    functions = [
        Function(
            "count_sweeps",
            "Add the sweeps over one block in one step.",
            (statistics, block, sweeps, failed),
            (If(given(statistics), adding),),
        )
    ]
    if plan.newton:
        matrices = statistics.field("matrices", Kind.COUNT)
        body = (If(given(statistics), (Assign(matrices, matrices + 1),)),)
        functions.append(Function("count_matrix", "Add one matrix.", (statistics,), body))
    return tuple(functions)


def count_sweeps(plan: Plan, block: int, sweeps: Term = SWEEPS) -> Statement:
    """Return the call after a loop: a status that is not OK is a failure of the block."""
    return Call("count_sweeps", (plan.statistics, whole(block), sweeps, STATUS.differs(code(OK))))


def count_matrix(plan: Plan) -> Statement:
    """Return the call after a matrix was computed."""
    return Call("count_matrix", (plan.statistics,))


def no_failure(plan: Plan) -> Statement:
    """Return the statement that forgets a failure which was mended."""
    return If(given(plan.statistics), (Assign(plan.statistics.field("failed", Kind.COUNT), whole(0)),))
