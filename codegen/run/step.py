"""One step: the kernel on a state, checked, and the composition of substeps.

A step changes the state when it succeeds, and leaves it alone otherwise. The size of a step must be a number;
so must be every number of the new state, and those of the old one that the kernel does not read because they
follow from the others.
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

ADVANCE, SUBSTEP = "advance", "substep"
"""The names of the functions that make a step, and a part of one."""


def core(plan: Plan) -> str:
    """Return the name of the function that holds the kernel."""
    return SUBSTEP if plan.parts else ADVANCE


def kernel_step(plan: Plan) -> Function:
    """Return the function that holds the kernel."""
    state = plan.state()
    read = plan.arrangement.symbols()
    parameters = (state, *plan.moment(), *plan.parameters, *plan.sampled())
    parameters += (*plan.remembering(plan.memory), *plan.counted)
    parameters += (plan.error,) if plan.kernel.estimate is not None else ()
    ends, new = outputs(plan.arrangement, plan.symbols)
    unread = [state[i] for i, s in enumerate(plan.symbols) if s not in read]
    body: list[Statement] = [
        If(negated(is_finite(STEP)), (Return(code(BAD_STEP)),)),
        *sampled(plan),
        *loaded(plan.symbols, state, read),
        *computed(plan, _remembered(plan)),
        *ends,
        If(negated(all_finite(*new, *unread)), (Return(code(NOT_FINITE)),)),
        *_errors(plan),
        *_aged(plan),
        *stored(state, new),
        Return(code(OK)),
    ]
    about = f"Make one {'part of a step' if plan.parts else 'step'}."
    return Function(core(plan), about, parameters, tuple(body), Kind.STATUS, RAISES_STATUS, often=True)


def _remembered(plan: Plan) -> list[Statement]:
    """Return the statements that take up the solutions: the next guess does not wait for the new state."""
    if plan.start is None:
        return []
    solution = real("solution", len(plan.start.unknowns))
    unknowns = tuple(own(u) for u in plan.start.unknowns)
    return [Array(solution, unknowns), Call("remember", (plan.memory, solution))]


def _errors(plan: Plan) -> list[Statement]:
    """Return the statements that write the estimate of the error."""
    if plan.kernel.estimate is None:
        return []
    errors = stored(plan.error, [value(x) for x in plan.arrangement.errors])
    return [If(given(plan.error), tuple(errors))]


def _aged(plan: Plan) -> list[Statement]:
    """Return the statements that count for how many steps an inverse for residuals has served."""
    sequence: list[Statement] = []
    for k, loop in enumerate(plan.kernel.loops, 1):
        if loop.newton is None or not loop.newton.period:
            continue
        served, period = plan.memory.field(f"made_{k}", Kind.COUNT), loop.newton.period
        # 0 asks the next step for a new matrix.
        older = whole(0) if period == 1 else select((served % period) > 0, served + 1, 0)
        sequence.append(Assign(served, older))
    return sequence


def exact_time(start: Term, steps: Term, h: Term) -> Term:
    """Return start + steps h, rounded once: short steps do not vanish in a float's time."""
    return narrow(wide(start) + wide(steps) * wide(h))


def substep_tables(plan: Plan) -> tuple[Table, ...]:
    """Return how long the parts of a step are and when they begin, in units of h."""
    if not plan.parts:
        return ()
    n, rounded = plan.parts, plan.format.round
    fractions = tuple(rounded(step.fraction) for step in plan.kernel.substeps)
    sequence = [Table(real("fraction", n), (fractions,), "The parts of a step, in units of h.")]
    if plan.time:
        offsets = tuple(rounded(step.offset) for step in plan.kernel.substeps)
        sequence.append(
            Table(real("offset", n), (offsets,), "The beginnings of the parts of a step, in units of h.")
        )
    return tuple(sequence)


def part_moment(plan: Plan, part: Term) -> tuple[Term, ...]:
    """Return the arguments for the time and length of a part of a step."""
    begins = exact_time(TIME, real("offset", plan.parts)[part], STEP)
    return plan.moment(begins, real("fraction", plan.parts)[part] * STEP)


def composed_step(plan: Plan) -> Function:
    """Return the function that makes all parts of a step, one after the other."""
    state, following, part = plan.state(), plan.state("next"), count("part_number")
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
        Array(following),
        Assign(following, state),
        Assign(STATUS, code(OK)),
        Assign(part, whole(0)),
        While(both(STATUS.equals(code(OK)), part < plan.parts), inner),
        If(STATUS.equals(code(OK)), (Assign(state, following),)),
        Return(STATUS),
    )
    about = "One step: all its parts, one after the other."
    return Function(ADVANCE, about, parameters, body, Kind.STATUS, often=True)
