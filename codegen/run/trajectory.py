"""The public functions for a single step and for a run of equal steps. A run can store a trajectory.

If a step fails, the run ends, and the caller gets the state before the failed step. The first row of the
trajectory is the initial state. After every ``stride`` steps, the run adds one row.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from codegen.ir.elementary import ELEMENTARY
from codegen.ir.expr import walk
from codegen.ir.kernel import Kernel
from codegen.run.arithmetic import computed, outputs
from codegen.run.cause import cause, searched
from codegen.run.continuation import retried
from codegen.run.language import Array, Assign, Call, Function, If, Return, Statement, While
from codegen.run.momentum import ENTER, LEAVE, MOVING, momentum_before
from codegen.run.plan import INPUTS, STEP, STEPS, STRIDE, TIME, Plan
from codegen.run.step import ADVANCE, exact_time
from codegen.run.terms import (
    BAD_STEP,
    NOT_FINITE,
    OK,
    STATUS,
    Kind,
    Term,
    absent,
    all_finite,
    both,
    code,
    count,
    flag,
    given,
    holding,
    is_finite,
    negated,
    own,
    real,
    whole,
)

RAISING = frozenset({"sqrt", "log", "exp", *(f.name for f in ELEMENTARY.values() if f.raising)})
"""The functions that raise an exception in Python for some arguments."""

REGISTERS = 6
"""The largest size of a state for which the kernel is inlined in the loop of a run.

For a larger state, the values of a step do not fit into the registers of the processor.
"""

DONE = count("step")
"""The number of completed steps."""

COMPLETED = count("completed", 1, optional=True, cell=True)

LOOP = "loop"
"""The name of the emitted function for the loop over the steps. The loop contains the inlined kernel."""


def is_looped(plan: Plan) -> bool:
    """Return True if the kernel is inlined in the loop over the steps of a run.

    The kernel is inlined only if the state is small and the step is explicit.
    """
    kernel = plan.kernel
    # In an inlined kernel, a small state remains in registers. A function call would store it in memory.
    alone = kernel.deferred is None and not plan.parts and plan.size <= REGISTERS
    plain = bool(kernel.outputs) and kernel.estimate is None
    return alone and plain and not (plan.counting or plan.time or _may_raise(kernel))


def _may_raise(kernel: Kernel) -> bool:
    """Return True if a kernel contains a division or calls a function in :data:`RAISING`.

    In Python, such an operation may raise an exception although its arguments are finite.
    """
    # If the result is True, the kernel is not inlined in the loop over the steps. A separate function
    # computes one step and catches the exceptions. If the result is False, only extreme arguments raise an
    # exception, for example the sine of an infinity, and the loop catches this exception.
    return any(n.op == "div" or (n.op == "call" and n.payload in RAISING) for n in walk(kernel.expressions()))


def _calls_library(kernel: Kernel) -> bool:
    """Return True if a kernel calls other functions than the Stumpff functions.

    In emitted Python, other functions may raise an exception, for example sin(x) for infinite x. The loop
    over the steps must then catch exceptions. A Stumpff function c_k(z) raises no exception: if abs(z) is too
    large, the value is an infinity or a NaN.
    """
    arithmetic = ("const", "sym", "neg", "add", "sub", "mul", "pow")
    return bool(kernel.outlined) or any(
        n.op not in arithmetic and "stumpff" not in str(n.payload) for n in walk(kernel.expressions())
    )


@dataclass(frozen=True)
class Rows:
    """Builds the statements that store a trajectory. The trajectory is optional in the emitted code."""

    plan: Plan

    recording, written = flag("recording"), count("row")

    @property
    def trajectory(self) -> Term:
        """The array for the trajectory, with one state in each row. The array is optional."""
        return real("trajectory", 0, self.plan.size, optional=True)

    def begin(self, state: Term) -> list[Statement]:
        """Return the statements that write the first row."""
        return [
            # States are recorded if the caller passes a positive stride and an array. The flag ``recording``
            # contains the result of these tests, so the loop tests only the flag.
            Assign(self.recording, both(STRIDE > 0, given(self.trajectory))),
            Assign(self.written, whole(0)),
            If(self.recording, (Assign(self.trajectory[0], state),)),
        ]

    def due(self, step: Term = DONE) -> Term:
        """Return the condition for recording the state with the step number ``step``."""
        # ``recording`` is tested first. If it is true, the stride is positive, and the remainder is defined.
        return both(self.recording, (step % STRIDE).equals(0))

    def add(self, state: Term) -> list[Statement]:
        """Return the statements that write the next row."""
        return [
            # Counting the rows is cheaper than dividing the step number by the stride.
            Assign(self.written, self.written + 1),
            Assign(self.trajectory[self.written], state),
        ]


def own_memory(plan: Plan) -> list[Statement]:
    """Return a list with the statement that creates the memory of a step or a run.

    If steps store no data for later steps, the list is empty.
    """
    # The data for later steps are in a local variable of the emitted function. Therefore several threads can
    # call the emitted function at the same time.
    return [Array(plan.memories, zero=True)] if plan.remembers else []


def arguments(plan: Plan, inputs: Term = INPUTS, t: Term = TIME) -> tuple[Term, ...]:
    """Return the arguments that follow the state in a call of the function that makes a step."""
    return (
        *plan.moment(t),
        *plan.parameters,
        *plan.sampled(inputs),
        *plan.remembering(plan.memories),
        *plan.counted,
    )


def advanced(plan: Plan, state: Term, given_arguments: tuple[Term, ...]) -> list[Statement]:
    """Return the statements that make one step from ``state`` and set the status.

    If steps have a warm start and no substeps, a failed step is repeated by continuation in h.
    """
    # Steps of constant size need no error estimate, so no array is passed for the estimate.
    error = (absent(plan.error),) if plan.kernel.estimate is not None else ()
    call = Call(ADVANCE, (state, *given_arguments, *error), (STATUS,))
    return [call, *([] if plan.parts else retried(plan, state, given_arguments))]


def step(plan: Plan) -> Function:
    """Return the public function for one step. Run-time inputs are constant during this step."""
    state = plan.state()
    # The inputs of a single step are numbers and not functions of time. The caller can change these numbers
    # between two steps.
    held = real("inputs", len(plan.kernel.inputs))
    parameters = (state, *plan.moment(), *plan.parameters, *((held,) if plan.held else ()), *plan.counted)
    body: list[Statement] = []
    if is_looped(plan):
        # The kernel is inlined in ``run``. ``step`` calls ``run`` for one step, because a second copy of the
        # kernel would make the emitted code longer.
        nothing = (absent(Rows(plan).trajectory), whole(0), absent(COMPLETED))
        body = [Call("run", (state, STEP, whole(1), *plan.parameters, *nothing), (STATUS,))]
        return Function("step", "", parameters, (*body, Return(STATUS)), STATUS.kind, public=True)
    # If the kernel uses the body momentum, ENTER converts the state to the body frame before the step. After
    # the step, LEAVE converts the state to the space frame.
    carried = plan.kernel.carried is not None
    moving, before = plan.state(MOVING), momentum_before(plan) if carried else STATUS
    if carried:
        body += [Array(moving), Array(before), Call(ENTER, (state, moving, before))]
    body += own_memory(plan)
    for copy in plan.held:
        body += [Array(copy), Assign(copy, held)]
    inputs = holding(*plan.held) if plan.held else INPUTS
    begun = moving if carried else state
    body += advanced(plan, begun, arguments(plan, inputs))
    body += searched(plan, begun)
    if carried:
        body.append(If(STATUS.equals(code(OK)), (Call(LEAVE, (moving, before, state), (STATUS,)),)))
    return Function("step", "", parameters, (*body, Return(STATUS)), STATUS.kind, public=True)


def run_parameters(plan: Plan) -> tuple[Term, ...]:
    """Return the parameters of a run."""
    rows = (Rows(plan).trajectory, STRIDE)
    time = (TIME,) if plan.time else ()
    counted = (*plan.counted, COMPLETED)
    return (plan.state(), *time, STEP, STEPS, *plan.parameters, *plan.sampled(), *rows, *counted)


def looped_runs(plan: Plan) -> tuple[Function, ...]:
    """Return the three functions of a run with an inlined kernel.

    The functions are the loop over the steps, the search for the cause of a failure, and the public function.
    """
    # The loop is a separate function, because both ``run`` and ``cause`` call it.
    loop = replace(run(plan), name=LOOP, about="The loop over the steps of a run.", public=False)
    alone = (whole(1), *plan.parameters, absent(Rows(plan).trajectory), whole(0), absent(COMPLETED))
    parameters = run_parameters(plan)
    body = (Call(LOOP, parameters, (STATUS,)), *searched(plan, plan.state()), Return(STATUS))
    public = Function("run", "", parameters, body, Kind.STATUS, public=True)
    return loop, cause(plan, LOOP, alone), public


def run(plan: Plan) -> Function:
    """Return the public function for a run."""
    state, rows = plan.state(), Rows(plan)
    carried = plan.kernel.carried is not None
    moving, before = plan.state(MOVING), momentum_before(plan) if carried else STATUS
    body: list[Statement] = [Assign(STATUS, code(OK)), Assign(DONE, whole(0))]
    body += [*own_memory(plan), *rows.begin(state)]
    if carried:
        body += [Array(moving), Array(before), Call(ENTER, (state, moving, before))]
    if is_looped(plan):
        body += _looped(plan, rows)
    else:
        now = moving if carried else state
        row = rows.add(state)
        if carried:
            # ``rows.add`` copies the initial state to the new row of the trajectory. Then LEAVE overwrites
            # this row with the current state.
            row.append(Call(LEAVE, (moving, before, rows.trajectory[rows.written]), (STATUS,)))
        advance = (Assign(DONE, DONE + 1), If(rows.due(), tuple(row)))
        # The time of each step is computed from the initial time, so that rounding errors do not accumulate.
        later = exact_time(TIME, DONE, STEP)
        # A failed step does not increase DONE, the number of completed steps.
        inner = (*advanced(plan, now, arguments(plan, t=later)), If(STATUS.equals(code(OK)), advance))
        body.append(While(both(STATUS.equals(code(OK)), DONE < STEPS), inner))
        body += searched(plan, now, later)
    if carried:
        # Only LEAVE changes ``state``, and only if it succeeds. After a failure, ``state`` is the initial
        # state, so the number of completed steps is set to zero.
        ended = Term("name", (), STATUS.kind, "ended")
        failed = (Assign(STATUS, code(NOT_FINITE)), Assign(DONE, whole(0)))
        finite = (Call(LEAVE, (moving, before, state), (ended,)), If(ended.differs(code(OK)), failed))
        body.append(If(DONE > 0, finite))
    body += completed()
    return Function("run", "", run_parameters(plan), (*body, Return(STATUS)), STATUS.kind, public=True)


def completed() -> list[Statement]:
    """Return the statement that stores the number of completed steps for the caller."""
    return [If(given(COMPLETED), (Assign(COMPLETED[0], DONE),))]


def _looped(plan: Plan, rows: Rows) -> list[Statement]:
    """Return the loop over the steps of a run. The loop contains the inlined kernel."""
    state, numbers = plan.state(), [own(s) for s in plan.symbols]
    read = plan.arrangement.symbols()
    ends, new = outputs(plan.arrangement, plan.symbols)
    # A NaN in an entry that the kernel does not read would not appear in the new state. Therefore the
    # ``unread`` entries are tested, too.
    unread = [x for x in numbers if x.text not in read]
    row = [Assign(rows.written, rows.written + 1)]
    row += [Assign(rows.trajectory[rows.written][k], x) for k, x in enumerate(numbers)]
    # The new state is in separate variables, so the order of the assignments does not matter.
    taken: list[Statement] = [Assign(x, y) for x, y in zip(numbers, new, strict=True)]
    taken += [Assign(DONE, DONE + 1), If(rows.due(), tuple(row))]
    inner: list[Statement] = [
        *computed(plan),
        *ends,
        If(all_finite(*new, *unread), tuple(taken), (Assign(STATUS, code(NOT_FINITE)),)),
    ]
    bad_step = both(STEPS > 0, negated(is_finite(STEP)))
    guard = STATUS if _calls_library(plan.kernel) else None
    return [
        If(bad_step, (Assign(STATUS, code(BAD_STEP)),)),
        # The C compiler must assume that the arrays ``trajectory`` and ``state`` overlap. Without local
        # copies, the C compiler would therefore store ``state`` to memory in each step.
        *(Assign(x, state[k]) for k, x in enumerate(numbers)),
        # The new state is assigned after all computations. So after an arithmetic error, the variables
        # contain the last good state and the number of completed steps.
        While(both(STATUS.equals(code(OK)), DONE < STEPS), tuple(inner), guard=guard),
        *(Assign(state[k], x) for k, x in enumerate(numbers)),
    ]
