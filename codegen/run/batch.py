"""Build the functions for a batch: steps of many independent systems. The systems are called lanes.

Every lane has its own state, parameters, inputs and status. All lanes have the same time and step size.
In an array of the batch, component k of lane i has the index ``k * stride + i``.

An explicit step is computed by one loop over many lanes. The loop calls fast variants of the sine, the
cosine and the Stumpff functions. The variants return NaN for large arguments. If the new state of a lane is
not finite, the step function for one system (the scalar step) is called for this lane. For all other lanes,
the loop and the scalar step give exactly the same state.

If one loop is not possible (:func:`obstacle`), the function ``run`` is called for each lane.
"""

from __future__ import annotations

from collections.abc import Iterable

from codegen.ir.expr import walk
from codegen.kernel.schedule import Simple
from codegen.run.arithmetic import outputs
from codegen.run.language import (
    Array,
    Assign,
    Call,
    For,
    Function,
    If,
    Return,
    Statement,
    assigned,
    reads,
    statements,
    terms,
)
from codegen.run.plan import STEP, STEPS, STRIDE, TIME, Plan
from codegen.run.step import exact_time
from codegen.run.terms import (
    BAD_STEP,
    OK,
    STATUS,
    Kind,
    Term,
    absent,
    both,
    code,
    count,
    holding,
    is_finite,
    negated,
    number,
    own,
    paired,
    real,
    select,
    whole,
)
from codegen.run.trajectory import Rows
from codegen.run.values import simple

BATCH, LANES = "run_batch", "advance_lanes"
"""The names of the public function that runs a batch, and of the function for one step of many lanes."""

BLOCK = 128
"""The number of lanes (systems) in a block.

During all steps, the states of a block stay in the cache.
"""

VECTORISED = frozenset({"sin", "cos", "sqrt", "fabs", "choose"})
"""These functions can be computed without branches. The same is true for all Stumpff functions."""

_TOTAL, _PLACE, _FIRST, _NUMBER = count("lanes"), count("place"), count("first"), count("number")
# In a loop over a block of lanes (systems), ``_FIRST`` is the index of the first lane of the block, and
# ``_LANE`` counts the lanes of the block from 0. Therefore a lane has the index ``_PLACE`` = ``_FIRST`` +
# ``_LANE`` in the batch.
_LANE, _DONE, _ENDED = count("lane"), count("step"), count("ended", 1)
_STATE, _PARAMETERS, _INPUTS = real("state", 0), real("parameters", 0), real("inputs", 0)
_STOPPED, _FAILED, _ALONE, _HELD = "stopped", "failed", "alone", "held"


def _statuses() -> Term:
    return Term("name", (), Kind.STATUS, "statuses", shape=(0,))


def functions(plan: Plan) -> list[Function]:
    """Return the functions of a batch, or an empty list if no batch was requested.

    Each function comes after the functions that it calls.
    """
    if not plan.kernel.batch:
        return []
    if obstacle(plan):
        return [_batch(plan, _one_by_one(plan))]
    return [_advance_lanes(plan), _batch(plan, _blocks(plan))]


def obstacle(plan: Plan) -> str:
    """Return '' if one loop can advance all lanes. Otherwise return the reason why this is not possible."""
    kernel = plan.kernel
    # The loops in ``kernel.loops`` solve equations by iteration.
    if kernel.loops:
        return "the lanes need different numbers of iterations to solve their equations"
    if kernel.deferred is not None or plan.parts or kernel.carried is not None:
        return "a step calls several functions, so one loop over lanes cannot compute the step"
    if not kernel.outputs or kernel.outlined:
        return "the loop over lanes cannot pass arrays to the functions that a step calls"
    # If the loop over lanes called a function with branches, vector instructions would not be possible.
    called = called_by(_statements(plan))
    # The names are sorted, because the message must not vary between runs.
    others = sorted(name for name in called if name not in VECTORISED and not name.startswith("stumpff_"))
    return f"branches in the function {others[0]} prevent vector instructions" if others else ""


def called_by(body: Iterable[Statement]) -> set[str]:
    """Return the names of all functions that the statements call."""
    listed = list(statements(body))
    values = [term.value for term in terms(listed) if term.value is not None]
    return {str(n.payload) for n in walk(values) if n.op == "call"} | {
        s.function for s in listed if isinstance(s, Call)
    }


def _statements(plan: Plan) -> list[Statement]:
    """Return the statements that evaluate an explicit kernel and compute its outputs."""
    ends, _ = outputs(plan.arrangement, plan.symbols)
    inner = [s for s in plan.arrangement.statements if isinstance(s, Simple)]
    return [*(single for s in inner for single in simple(s)), *ends]


def near(name: str) -> str:
    """Return the name of the branch-free variant of the function ``name``.

    If there is no such variant, return ``name``.

    >>> near("sin"), near("stumpff_12"), near("sqrt")
    ('sin_near', 'stumpff_12_near', 'sqrt')
    """
    return f"{name}_near" if name in ("sin", "cos") or name.startswith("stumpff_") else name


def complete(name: str) -> str:
    """Return the name of the complete variant of the function ``name``.

    The complete variant is valid for small and large arguments. For the sine and the cosine, the complete
    variant is a separate function. All other functions are valid for small and large arguments, so the result
    is ``name``.

    >>> complete("sin"), complete("stumpff_12")
    ('sin_complete', 'stumpff_12')
    """
    return f"{name}_complete" if name in ("sin", "cos") else name


def _entry(array: Term, row: int, place: Term) -> Term:
    """Return the entry of ``array`` with the index ``row * stride + place``."""
    return array[row * STRIDE + place] if row else array[place]


def _advance_lanes(plan: Plan) -> Function:
    """Return the emitted function that advances all lanes of a block by one step."""
    stopped, failed = real(_STOPPED, 0), real(_FAILED, 0)
    # The list ``before`` contains the statements with the same result for all lanes (systems).
    before, inside = _split(plan)
    loaded = [Assign(own(s), _entry(_STATE, k, _PLACE)) for k, s in enumerate(plan.symbols)]
    loaded += [Assign(p, _entry(_PARAMETERS, k, _PLACE)) for k, p in enumerate(plan.parameters)]
    read = plan.arrangement.symbols()
    # A sample contains the run-time inputs at one time. The inputs of a lane (a system) are constant in time,
    # so all samples contain the same values.
    for sample in plan.kernel.samples:
        loaded += [
            Assign(own(s), _entry(_INPUTS, k, _PLACE)) for k, s in enumerate(sample.symbols) if s in read
        ]
    ends, new = outputs(plan.arrangement, plan.symbols)
    # Components that the kernel does not read can be NaN, too, so they are tested.
    unread = [own(s) for s in plan.symbols if s not in read]
    check = real("check")
    passed = check.equals(number(0.0))
    body: list[Statement] = [
        Assign(_PLACE, _FIRST + _LANE),
        *loaded,
        *inside,
        *ends,
        # x - x is 0 for a finite x, and otherwise a NaN. Therefore ``check`` is 0 only if all components are
        # finite and the lane has not stopped. Otherwise the lane does not advance.
        Assign(check, paired([x - x for x in (*new, *unread)]) + stopped[_LANE]),
        *(
            # A selection between the new and the old value is used, because a branch would prevent vector
            # instructions.
            Assign(_entry(_STATE, k, _PLACE), select(passed, x, own(s)))
            for k, (x, s) in enumerate(zip(new, plan.symbols, strict=True))
        ),
        Assign(failed[_LANE], select(passed, number(0.0), number(1.0))),
    ]
    # Each iteration of the loop changes only the entries of its own lane, so the iterations are independent.
    loop = For(_LANE, _NUMBER, tuple(body), independent=True)
    about = (
        "Advance several systems (lanes) by one step. The index of the first lane is 'first', and the number "
        "of lanes is 'number'. The loop over lanes has no branches, so compilers can use vector "
        "instructions. A lane keeps its state if it has stopped, or if its new state is not finite. The "
        "array 'failed' is 1 for lanes that keep their state, otherwise 0."
    )
    parameters = _lane_parameters(plan, stopped, failed)
    return Function(LANES, about, parameters, (*before, loop), often=True, near=True)


def _lane_parameters(plan: Plan, stopped: Term, failed: Term) -> tuple[Term, ...]:
    shared = ((_PARAMETERS,) if plan.parameters else ()) + ((_INPUTS,) if plan.kernel.inputs else ())
    return (_FIRST, _NUMBER, STRIDE, _STATE, *plan.moment(), *shared, stopped, failed)


def _split(plan: Plan) -> tuple[list[Statement], list[Statement]]:
    """Return the statements that depend only on the time and the step size, and the other statements."""
    shared, before, inside = {TIME.text, STEP.text}, [], []
    for statement in plan.arrangement.statements:
        assert isinstance(statement, Simple)
        for single in simple(statement):
            if all(term.text in shared for term in reads(single) if term.own or term.text not in shared):
                before.append(single)
                # ``shared`` contains the names of values that are the same in all lanes.
                shared |= {term.text for term in assigned(single)}
            else:
                inside.append(single)
    return before, inside


def _batch(plan: Plan, work: list[Statement]) -> Function:
    """Return the public function of the batch. ``work`` contains the statements that advance all systems."""
    statuses, ended = _statuses(), count("completed", 0)
    bad = count("bad")
    flag = Term("name", (), Kind.FLAG, bad.text)
    first = select(flag, code(BAD_STEP), code(OK))
    body: list[Statement] = [
        # Without steps, the step size has no effect, so it is not tested.
        Assign(flag, both(STEPS > 0, negated(is_finite(STEP)))),
        # Every lane gets a status, even if the batch makes no step.
        For(_LANE, _TOTAL, (Assign(statuses[_LANE], first), Assign(ended[_LANE], whole(0)))),
        If(flag, (Return(code(BAD_STEP)),)),
        *work,
        Assign(STATUS, code(OK)),
        # The result is the status of the failed lane with the smallest index, because the loop runs
        # backwards, and each failed lane overwrites STATUS.
        For(
            _LANE,
            _TOTAL,
            (If(statuses[_LANE].differs(code(OK)), (Assign(STATUS, statuses[_LANE]),)),),
            reverse=True,
        ),
        Return(STATUS),
    ]
    time = (TIME,) if plan.time else ()
    own_data = ((_PARAMETERS,) if plan.parameters else ()) + ((_INPUTS,) if plan.kernel.inputs else ())
    parameters = (_TOTAL, STRIDE, _STATE, *time, STEP, STEPS, *own_data, statuses, ended)
    return Function(BATCH, "", parameters, tuple(body), Kind.STATUS, public=True)


def _gathered(plan: Plan) -> list[Statement]:
    """Return the statements that copy the state and the inputs of one lane to contiguous arrays."""
    # The scalar step reads the components of a state from adjacent places of an array.
    alone, held = real(_ALONE, plan.size), real(_HELD, len(plan.kernel.inputs))
    rows = [Assign(alone[k], _entry(_STATE, k, _PLACE)) for k in range(plan.size)]
    if plan.kernel.inputs:
        rows += [Assign(held[k], _entry(_INPUTS, k, _PLACE)) for k in range(len(plan.kernel.inputs))]
    return list(rows)


def _arrays(plan: Plan) -> list[Statement]:
    listed = [Array(real(_ALONE, plan.size))]
    return [*listed, *([Array(real(_HELD, len(plan.kernel.inputs)))] if plan.kernel.inputs else [])]


def _scattered(plan: Plan) -> list[Statement]:
    alone = real(_ALONE, plan.size)
    return [Assign(_entry(_STATE, k, _PLACE), alone[k]) for k in range(plan.size)]


def _values(plan: Plan) -> tuple[Term, ...]:
    return tuple(_entry(_PARAMETERS, k, _PLACE) for k in range(len(plan.parameters)))


def _one_by_one(plan: Plan) -> list[Statement]:
    """Return the loop over lanes that calls the function ``run`` for each lane."""
    held = real(_HELD, len(plan.kernel.inputs))
    time = (TIME,) if plan.time else ()
    signals = (holding(held),) if plan.kernel.inputs else ()
    # A batch records no trajectory and no statistics.
    none = (absent(Rows(plan).trajectory), whole(0), *(absent(x) for x in plan.counted))
    alone = real(_ALONE, plan.size)
    arguments = (alone, *time, STEP, STEPS, *_values(plan), *signals, *none, _ENDED)
    body: list[Statement] = [
        Assign(_PLACE, _LANE),
        # Each iteration of the parallel loop has its own arrays.
        *_arrays(plan),
        # The function ``run`` stores the number of completed steps in an array with one entry.
        Array(_ENDED),
        *_gathered(plan),
        Call("run", arguments, (STATUS,)),
        Assign(_statuses()[_PLACE], STATUS),
        Assign(count("completed", 0)[_PLACE], _ENDED[0]),
        *_scattered(plan),
    ]
    return [For(_LANE, _TOTAL, tuple(body), parallel=True)]


def _blocks(plan: Plan) -> list[Statement]:
    """Return the loop over blocks of lanes."""
    stopped, failed = real(_STOPPED, BLOCK), real(_FAILED, BLOCK)
    statuses, ended = _statuses(), count("completed", 0)
    block = count("block")
    rest = _TOTAL - _FIRST
    # A sum of step sizes would accumulate rounding errors.
    later = exact_time(TIME, _DONE, STEP)
    shared = ((_PARAMETERS,) if plan.parameters else ()) + ((_INPUTS,) if plan.kernel.inputs else ())
    vector = (_FIRST, _NUMBER, STRIDE, _STATE, *plan.moment(later), *shared, stopped, failed)
    held = (real(_HELD, len(plan.kernel.inputs)),) if plan.kernel.inputs else ()
    alone = real(_ALONE, plan.size)
    scalar = (alone, *plan.moment(later), *_values(plan), *held)
    # If a step fails, ``_DONE`` is the number of steps that this system (lane) has completed.
    stop: tuple[Statement, ...] = (
        Assign(statuses[_PLACE], STATUS),
        Assign(ended[_PLACE], _DONE),
        Assign(stopped[_LANE], number(1.0)),
    )
    again: tuple[Statement, ...] = (
        Assign(_PLACE, _FIRST + _LANE),
        *_gathered(plan),
        Call("step", scalar, (STATUS,)),
        # If the scalar step succeeds, the lane continues with the next step.
        If(STATUS.equals(code(OK)), tuple(_scattered(plan)), stop),
    )
    # ``failed`` is 1 for lanes that failed in this step and for lanes that stopped in an earlier step. Only
    # the lanes that failed in this step are computed again.
    running = both(failed[_LANE] > 0.0, stopped[_LANE].equals(number(0.0)))
    steps: tuple[Statement, ...] = (
        Call(LANES, vector),
        For(_LANE, _NUMBER, (If(running, again),)),
    )
    inner: tuple[Statement, ...] = (
        Assign(_FIRST, block * BLOCK),
        # The last block may have fewer lanes than the others.
        Assign(_NUMBER, select(rest < BLOCK, rest, whole(BLOCK))),
        Array(stopped, zero=True),
        Array(failed),
        *_arrays(plan),
        For(_DONE, STEPS, steps),
        For(
            _LANE,
            _NUMBER,
            (
                Assign(_PLACE, _FIRST + _LANE),
                # A lane whose status is still OK has completed all steps.
                If(statuses[_PLACE].equals(code(OK)), (Assign(ended[_PLACE], STEPS),)),
            ),
        ),
    )
    # The number of blocks is rounded up, because the last block may be incomplete.
    return [For(block, (_TOTAL + (BLOCK - 1)) // BLOCK, inner, parallel=True)]
