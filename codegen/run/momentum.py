"""Conversion of the momentum between the space frame and the body frame.

The caller's state contains the space momentum p, but the steps of a run use the body momentum. At the
beginning of a run, p is converted to the body frame, and the result is converted back to a space momentum
p_0. At the end of the run, the new body momentum is converted to a space momentum p_1. The new momentum of
the caller is p + (p_1 - p_0).

Rounding makes the group element q slightly non-orthogonal, so each conversion to the space frame has an
error. The errors of p_0 and p_1 are nearly equal, so they nearly cancel in p_1 - p_0.
"""

from __future__ import annotations

from codegen.ir.kernel import Carried
from codegen.run.arithmetic import filling
from codegen.run.language import Array, Assign, Call, For, Function, If, Return
from codegen.run.plan import Plan
from codegen.run.terms import NOT_FINITE, OK, Kind, Term, all_finite, code, count, negated, real, whole

ENTER, LEAVE = "enter_body", "leave_body"

MOVING = "moving"
"""The name of the array for the current state of a run. The momentum in this array is the body momentum."""


def momentum_before(plan: Plan) -> Term:
    """Return the array for the momentum at the beginning of a run."""
    assert plan.kernel.carried is not None
    # The momentum occupies the last entries of the state.
    return real("before", plan.size - plan.kernel.carried.first)


def turning(plan: Plan) -> tuple[Function, ...]:
    """Return the emitted functions for a run whose steps use the body momentum.

    The tuple is empty if the steps of ``plan`` do not use the body momentum.
    """
    carried = plan.kernel.carried
    if carried is None:
        return ()
    n = plan.size - carried.first
    # The conversions compute only the momentum, because the group element is the same in both frames.
    momentum = real("momentum", n)
    to_body = filling(
        # The conversion has its own kernel ``carried.inward``, and each kernel needs a plan.
        Plan(carried.inward, plan.format),
        "to_body",
        "Convert space momentum to body momentum.",
        momentum,
    )
    to_space = filling(
        Plan(carried.outward, plan.format), "to_space", "Convert body momentum to space momentum.", momentum
    )
    return to_body, to_space, _enter(plan, carried), _leave(plan, carried, n)


def _enter(plan: Plan, carried: Carried) -> Function:
    state, moving, before = plan.state(), plan.state(MOVING), momentum_before(plan)
    first, n = carried.first, plan.size - carried.first
    body = (
        Call("to_body", (state, before)),
        # The group element q is the same in both frames, so it is copied.
        Assign(moving.part(0, first), state.part(0, first)),
        Assign(moving.part(first, n), before),
        # The rounding errors of the two converted momenta nearly cancel in their difference.
        Call("to_space", (moving, before)),
    )
    about = (
        "Copy the state to 'moving', and convert the momentum to the body frame. Then convert this momentum "
        "back to the space frame, and write the result into 'before'."
    )
    return Function(ENTER, about, (state, moving, before), body)


def _leave(plan: Plan, carried: Carried, n: int) -> Function:
    state, moving, before = plan.state(), plan.state(MOVING), momentum_before(plan)
    momentum, i = real("momentum", n), count("i")
    # The parentheses keep the rounding error small: the increase ``momentum[i] - before[i]`` is usually much
    # smaller than the momentum.
    gained = state[i + carried.first] + (momentum[i] - before[i])
    body = (
        Array(momentum),
        Call("to_space", (moving, momentum)),
        For(i, whole(n), (Assign(momentum[i], gained),)),
        # A failure must not change the caller's state.
        If(negated(all_finite(momentum)), (Return(code(NOT_FINITE)),)),
        Assign(state.part(0, carried.first), moving.part(0, carried.first)),
        Assign(state.part(carried.first, n), momentum),
        Return(code(OK)),
    )
    about = (
        "Update the state at the end of a run. The group element is copied from 'moving'. The momentum in "
        "'moving' is converted to the space frame. The converted momentum minus 'before' is the increase of "
        "the momentum during the run. This increase is added to the momentum of the state."
    )
    return Function(LEAVE, about, (moving, before, state), body, Kind.STATUS)
