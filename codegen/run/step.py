"""Build the emitted functions for one step and for one substep.

A step fails if the step size or the new state is not finite, or if an iteration does not converge. If a step
fails, the state is unchanged.
"""

from __future__ import annotations

from codegen.run.arithmetic import computed, loaded, outputs, sampled, stored
from codegen.run.continuation import retried
from codegen.run.language import (
    RAISES_STATUS,
    Array,
    Assign,
    Call,
    Function,
    If,
    Return,
    Statement,
    Table,
    While,
)
from codegen.run.plan import INPUTS, STEP, TIME, Plan
from codegen.run.terms import (
    BAD_STEP,
    NOT_FINITE,
    OK,
    STATUS,
    Kind,
    Term,
    all_finite,
    both,
    code,
    count,
    given,
    is_finite,
    narrow,
    negated,
    own,
    real,
    record,
    select,
    value,
    whole,
    wide,
)
from codegen.run.whole_arrays import in_state, names_in, whole_result

ADVANCE, SUBSTEP = "advance", "substep"
"""The names of the functions for a step and for a substep."""


def core(plan: Plan) -> str:
    """Return the name of the function that evaluates the kernel: SUBSTEP or, without substeps, ADVANCE."""
    return SUBSTEP if plan.parts else ADVANCE


def kernel_step(plan: Plan) -> Function:
    """Return the emitted function that evaluates the kernel once, that is, makes one step or substep."""
    state = plan.state()
    read = plan.arrangement.symbols()
    parameters = (state, *plan.moment(), *plan.parameters, *plan.sampled())
    parameters += (*plan.remembering(plan.memory), *plan.counted)
    parameters += (plan.error,) if plan.kernel.estimate is not None else ()
    # The new entries depend on the old state. Therefore all new entries are computed before the first old
    # entry is overwritten.
    ends, new = outputs(plan.arrangement, plan.symbols)
    # The results do not depend on unread entries of the state, so a test of the results does not find a NaN
    # in an unread entry. A NaN in an unread entry must be found here.
    unread = [state[i] for i, s in enumerate(plan.symbols) if s not in read]
    inner = [*in_state(computed(plan, _remembered(plan)), plan.symbols, state), *ends]
    array = whole_result(plan.arrangement.outputs)
    finite = all_finite(*new, *unread) if array is None or unread else all_finite(array)
    body: list[Statement] = [
        If(negated(is_finite(STEP)), (Return(code(BAD_STEP)),)),
        *sampled(plan),
        *loaded(plan.symbols, state, names_in([*inner, *_errors(plan)])),
        *inner,
        # The state is overwritten only after this test, so a failed step leaves the state unchanged.
        If(negated(finite), (Return(code(NOT_FINITE)),)),
        *_errors(plan),
        *_aged(plan),
        *(stored(state, new) if array is None else [Assign(state, array)]),
        Return(code(OK)),
    ]
    about = f"One {'substep' if plan.parts else 'step'}."
    return Function(core(plan), about, parameters, tuple(body), Kind.STATUS, RAISES_STATUS, often=True)


def _remembered(plan: Plan) -> list[Statement]:
    """Return the statements that compute the initial guess for the next step (warm start).

    If the kernel has no warm start, the list is empty.
    """
    if plan.start is None:
        return []
    solution = real("solution", len(plan.start.unknowns))
    # One array contains the unknowns of all loops.
    unknowns = tuple(own(u) for u in plan.start.unknowns)
    return [Array(solution, unknowns), Call("remember", (plan.memory, solution))]


def _errors(plan: Plan) -> list[Statement]:
    """Return the statements that store the error estimate, if there is an estimate."""
    if plan.kernel.estimate is None:
        return []
    errors = stored(plan.error, [value(x) for x in plan.arrangement.errors])
    # A run with constant steps passes no array for the estimate, and computes no estimate.
    return [If(given(plan.error), tuple(errors))]


def _aged(plan: Plan) -> list[Statement]:
    """Return the statements that update the age of each stored inverse matrix after a step.

    After ``period`` steps the age becomes 0, and the next step computes a new matrix.
    """
    sequence: list[Statement] = []
    for k, loop in enumerate(plan.kernel.loops, 1):
        if loop.newton is None or not loop.newton.period:
            continue
        age, period = plan.memory.field(f"age_{k}", Kind.COUNT), loop.newton.period
        # The age 0 means that the next step computes a new matrix. If the old matrix were used for more than
        # ``period`` steps, the iteration would converge more slowly.
        older = whole(0) if period == 1 else select((age % period) > 0, age + 1, 0)
        sequence.append(Assign(age, older))
    return sequence


def exact_time(start: Term, steps: Term, h: Term) -> Term:
    """Return the time ``start + steps * h`` in the precision of the emitted code.

    The product and the sum are computed in double precision. Only the sum is rounded to the precision of the
    emitted code.
    """
    # Repeated updates ``t += h`` would accumulate rounding errors.
    return narrow(wide(start) + wide(steps) * wide(h))


def substep_tables(plan: Plan) -> tuple[Table, ...]:
    """Return tables with two quantities of the substeps in units of h: the lengths and the start times."""
    if not plan.parts:
        return ()
    n, rounded = plan.parts, plan.format.round
    # The exact fractions are rounded once, when the code is generated.
    fractions = tuple(rounded(step.fraction) for step in plan.kernel.substeps)
    sequence = [Table(real("fraction", n), (fractions,), "Lengths of the substeps, in units of h.")]
    if plan.time:
        offsets = tuple(rounded(step.offset) for step in plan.kernel.substeps)
        sequence.append(Table(real("offset", n), (offsets,), "Beginnings of the substeps, in units of h."))
    return tuple(sequence)


def part_moment(plan: Plan, part: Term) -> tuple[Term, ...]:
    """Return the start time and the step size of the substep with the index ``part``."""
    # A sum of the lengths of all earlier substeps would accumulate rounding errors.
    begins = exact_time(TIME, real("offset", plan.parts)[part], STEP)
    return plan.moment(begins, real("fraction", plan.parts)[part] * STEP)


def composed_step(plan: Plan) -> Function:
    """Return the emitted function that makes one step as a sequence of substeps."""
    state, following, part = plan.state(), plan.state("next"), count("part_number")
    # Each substep has its own memory for data from earlier steps.
    memories = record("memory", "memory", plan.parts)
    arguments = (*part_moment(plan, part), *plan.parameters, *plan.sampled(INPUTS))
    arguments += (*plan.remembering(memories[part]), *plan.counted)
    parameters = (state, *plan.moment(), *plan.parameters, *plan.sampled())
    parameters += (*plan.remembering(memories), *plan.counted)
    inner: tuple[Statement, ...] = (
        Call(SUBSTEP, (following, *arguments), (STATUS,)),
        *retried(plan, following, arguments),
        Assign(part, part + 1),
    )
    body: tuple[Statement, ...] = (
        # The substeps change a copy, so that a failed substep leaves the caller's state unchanged.
        Array(following),
        Assign(following, state),
        Assign(STATUS, code(OK)),
        Assign(part, whole(0)),
        While(both(STATUS.equals(code(OK)), part < plan.parts), inner),
        If(STATUS.equals(code(OK)), (Assign(state, following),)),
        Return(STATUS),
    )
    about = "One step: the composition of its substeps."
    return Function(ADVANCE, about, parameters, body, Kind.STATUS, often=True)
