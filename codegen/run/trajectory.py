"""The public functions for a single step and for a run of equal steps, which can store a trajectory.

A run ends after the last step or after a failure. After a failure, the state is the state before the failed
step. The rows of the trajectory are the state at the beginning and the state after every stride-th step.

A small explicit kernel is inlined in the loop of the run, so that its state stays in registers.
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
"""Functions that raise an exception in Python for some arguments."""

REGISTERS = 6
"""The kernel is inlined in a run if the state has at most this number of components.

With more components, the state and the intermediate values of a step do not fit into the registers.
"""

DONE = count("step")
"""The number of completed steps."""

COMPLETED = count("completed", 1, optional=True, cell=True)

LOOP = "loop"
"""The name of the emitted function that contains the loop over the steps of a run, with the kernel
inlined."""


def is_looped(plan: Plan) -> bool:
    """Return True if the kernel is inlined in a run.

    A kernel is inlined if the state is small and the kernel needs no function of its own.
    """
    kernel = plan.kernel
    # An inlined kernel keeps a small state in registers. With a function call for each step, the state would
    # be stored in memory.
    alone = kernel.deferred is None and not plan.parts and plan.size <= REGISTERS
    plain = bool(kernel.outputs) and kernel.estimate is None
    return alone and plain and not (plan.counting or plan.time or _may_raise(kernel))


def _may_raise(kernel: Kernel) -> bool:
    """Return True if a target may raise an exception where C computes an infinity or a NaN."""
    # A kernel that may raise an exception is not inlined: its own function catches the exception and returns
    # a status.
    return any(n.op == "div" or (n.op == "call" and n.payload in RAISING) for n in walk(kernel.expressions()))


@dataclass(frozen=True)
class Rows:
    """The optional rows of a trajectory: the initial state, and the state after every stride-th step."""

    plan: Plan

    recording, written = flag("recording"), count("row")

    @property
    def trajectory(self) -> Term:
        """The array in which the rows are stored. The caller may omit it."""
        return real("trajectory", 0, self.plan.size, optional=True)

    def begin(self, state: Term) -> list[Statement]:
        """Return the statements that write the first row."""
        return [
            # The stride and the array are tested once, before the loop, because testing one flag in the loop
            # is cheaper than two tests.
            Assign(self.recording, both(STRIDE > 0, given(self.trajectory))),
            Assign(self.written, whole(0)),
            If(self.recording, (Assign(self.trajectory[0], state),)),
        ]

    def due(self, step: Term = DONE) -> Term:
        """Return the test whether the state after ``step`` steps is a row of the trajectory."""
        # The flag is tested first, because the remainder of a division by a stride of zero is undefined.
        return both(self.recording, (step % STRIDE).equals(0))

    def add(self, state: Term) -> list[Statement]:
        """Return the statements that write another row."""
        return [
            # Rows are counted, because computing the index as step / stride in each step would cost more than
            # writing the row.
            Assign(self.written, self.written + 1),
            Assign(self.trajectory[self.written], state),
        ]


def own_memory(plan: Plan) -> list[Statement]:
    """Return the statement that creates the memory of a run."""
    # The memory is local to a run. A run therefore depends on its arguments only, and threads can make runs
    # at the same time.
    return [Array(plan.memories, zero=True)] if plan.remembers else []


def arguments(plan: Plan, inputs: Term = INPUTS, t: Term = TIME) -> tuple[Term, ...]:
    """Return the arguments of a step that follow the state."""
    return (
        *plan.moment(t),
        *plan.parameters,
        *plan.sampled(inputs),
        *plan.remembering(plan.memories),
        *plan.counted,
    )


def advanced(plan: Plan, state: Term, given_arguments: tuple[Term, ...]) -> list[Statement]:
    """Return the statements that call a step and set the status.

    If the kernel has a warm start and no substeps, the statements also call the continuation after a failure.
    """
    # A run with steps of constant size does not read the error estimate.
    error = (absent(plan.error),) if plan.kernel.estimate is not None else ()
    call = Call(ADVANCE, (state, *given_arguments, *error), (STATUS,))
    return [call, *([] if plan.parts else retried(plan, state, given_arguments))]


def step(plan: Plan) -> Function:
    """Return the public function for one step. Run-time inputs are constant during this step."""
    state = plan.state()
    # The inputs of a single step are values and not functions of time. The caller may change the values
    # between steps.
    held = real("inputs", len(plan.kernel.inputs))
    parameters = (state, *plan.moment(), *plan.parameters, *((held,) if plan.held else ()), *plan.counted)
    body: list[Statement] = []
    if is_looped(plan):
        # If the kernel is inlined in the run, the step calls a run of one step, because a second copy of the
        # kernel would add code.
        nothing = (absent(Rows(plan).trajectory), whole(0), absent(COMPLETED))
        body = [Call("run", (state, STEP, whole(1), *plan.parameters, *nothing), (STATUS,))]
        return Function("step", "", parameters, (*body, Return(STATUS)), STATUS.kind, public=True)
    # If the kernel uses the body momentum, the step converts the state before and after the kernel.
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
    """Return the functions of a run that contains the kernel.

    They are the loop, the function that finds the cause of a failure, and the public run.
    """
    # The loop is a separate function, because the search for the cause of a failure calls it again with a
    # step of size zero.
    loop = replace(run(plan), name=LOOP, about="The loop of a run.", public=False)
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
            # The row is first a copy of the initial state. The function LEAVE updates the row to the current
            # state in the space frame. The run itself continues in the body frame.
            row.append(Call(LEAVE, (moving, before, rows.trajectory[rows.written]), (STATUS,)))
        advance = (Assign(DONE, DONE + 1), If(rows.due(), tuple(row)))
        # Each time is computed from the initial time, so that errors do not accumulate.
        later = exact_time(TIME, DONE, STEP)
        # The counter advances only after a success, so it is the number of completed steps.
        inner = (*advanced(plan, now, arguments(plan, t=later)), If(STATUS.equals(code(OK)), advance))
        body.append(While(both(STATUS.equals(code(OK)), DONE < STEPS), inner))
        body += searched(plan, now, later)
    if carried:
        # A momentum that is finite in the body frame may overflow in the space frame. In this case no step
        # counts as completed.
        ended = Term("name", (), STATUS.kind, "ended")
        failed = (Assign(STATUS, code(NOT_FINITE)), Assign(DONE, whole(0)))
        finite = (Call(LEAVE, (moving, before, state), (ended,)), If(ended.differs(code(OK)), failed))
        body.append(If(DONE > 0, finite))
    body += completed()
    return Function("run", "", run_parameters(plan), (*body, Return(STATUS)), STATUS.kind, public=True)


def completed() -> list[Statement]:
    """Return the statement that reports the number of completed steps."""
    return [If(given(COMPLETED), (Assign(COMPLETED[0], DONE),))]


def _looped(plan: Plan, rows: Rows) -> list[Statement]:
    """Return the loop of a run with the kernel inlined."""
    state, numbers = plan.state(), [own(s) for s in plan.symbols]
    read = plan.arrangement.symbols()
    ends, new = outputs(plan.arrangement, plan.symbols)
    # Entries of the state that the kernel does not read are tested separately. They do not affect the new
    # values, so the test of the new values would miss a NaN in such an entry.
    unread = [x for x in numbers if x.text not in read]
    row = [Assign(rows.written, rows.written + 1)]
    row += [Assign(rows.trajectory[rows.written][k], x) for k, x in enumerate(numbers)]
    # Each new value has a separate name, so the copies may be made in any order.
    taken: list[Statement] = [Assign(x, y) for x, y in zip(numbers, new, strict=True)]
    taken += [Assign(DONE, DONE + 1), If(rows.due(), tuple(row))]
    inner: list[Statement] = [
        *computed(plan),
        *ends,
        If(all_finite(*new, *unread), tuple(taken), (Assign(STATUS, code(NOT_FINITE)),)),
    ]
    bad_step = both(STEPS > 0, negated(is_finite(STEP)))
    return [
        If(bad_step, (Assign(STATUS, code(BAD_STEP)),)),
        # The loop works on local copies, because the compiler cannot prove that rows of the trajectory do not
        # alias the state. Without the copies, compiled code would store the state in each step.
        *(Assign(x, state[k]) for k, x in enumerate(numbers)),
        While(both(STATUS.equals(code(OK)), DONE < STEPS), tuple(inner)),
        *(Assign(state[k], x) for k, x in enumerate(numbers)),
    ]
