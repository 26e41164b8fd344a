"""Flows of a splitting method that are joined across steps (:class:`codegen.ir.kernel.Deferred`).

If the last flow of a step and the first flow of the next step belong to the same part of the vector field,
these two flows are joined into one. A flow that commutes with all other flows is removed from the steps.
After the last step, one flow of the total duration replaces the removed flows.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from codegen.ir.kernel import ELAPSED, LEAD, Deferred, Kernel
from codegen.ir.number import Number
from codegen.ir.operations import Advance, Operation
from codegen.ir.program import Assign, Program
from codegen.ir.scene_operations import FlowFor, FlowOf
from codegen.ir.values import Kind, Var
from codegen.ir.verify import verify
from codegen.kernel.translate import AS_WRITTEN, to_kernel
from codegen.passes.flows import Letter, apart, commuting, word
from codegen.scene.problem import Problem


@dataclass(frozen=True)
class Parted:
    """The flows of a run, divided into programs for the beginning, the steps and the end of the run.

    A joined flow replaces a flow at the end of a step and a flow at the beginning of the next step. A
    deferred flow is a flow that commutes with all other flows. The steps omit the deferred flows. Instead,
    each deferred flow is applied once after the last step, for the total duration of the run.

    - ``begin`` is executed before the first step. It is None if no flows are joined.
    - ``core`` is executed in each step. The duration of each joined flow is the variable :data:`LEAD`.
    - ``finish`` is executed after the last step. It contains the deferred flows, with the duration
      :data:`ELAPSED`, the sum of the durations of all steps. If no flow is deferred, ``finish`` is None.
    - ``last`` is the quotient LEAD/h in the last step of a run. In the last step, LEAD is the duration of the
      last flow alone, because no step follows.
    - ``later`` is the quotient LEAD/h in all other steps. In these steps, LEAD is the duration of a joined
      flow.
    """

    begin: Program | None
    core: Program
    finish: Program | None
    last: Number
    later: Number


def part(program: Program, scene: Problem) -> Parted | None:
    """Split the program of a splitting method into programs for the start, the steps and the end of a run.

    The result is None in three cases:

    - The program is not a composition of flows.
    - No flow can be joined or deferred (:class:`Parted`).
    - All flows can be deferred. Then no flow would remain in the steps.
    """
    letters = word(program)
    if letters is None:
        return None
    # For the names a and b of two parts of the Hamiltonian, ``commute(a, b)`` is true if the flows of these
    # parts commute. The function applies the two flows to sample points in both possible sequences, and
    # compares the results.
    commute = commuting(scene)
    # If a flow of duration h commutes with all other flows, its n applications in a run of n steps can be
    # replaced by one flow of duration n h. This is not done for a part in ``bound``, because one of its flows
    # has a duration other than h or depends on the time.
    bound = {letter.part for letter in letters if letter.time or not _is_h(letter)}
    free = [name for name in apart(letters, commute) if name not in bound]
    kept = [letter for letter in letters if letter.part not in free]
    spun = [letter for letter in letters if letter.part in free]
    joined = _joined(kept, commute, program)
    if not kept or not (joined or spun):
        return None
    lead, elapsed = Var(LEAD, Kind.REAL), Var(ELAPSED, Kind.REAL)
    # All entries of ``joined`` contain the same two durations: ``last`` is the duration in the last step of a
    # run, and ``later`` is the duration in all other steps.
    last, later = joined[0][2:] if joined else (Number.rational(0), Number.rational(0))
    # The flows ``tails`` at the end of a step are joined with the flows ``heads`` of the next step.
    heads, tails = {i for i, _, _, _ in joined}, {j for _, j, _, _ in joined}
    first: list[Timed] = [(kept[i], None) for i in sorted(heads)]
    # The previous step has already applied the flows with the indices ``heads``.
    inner: list[Timed] = [(x, lead if j in tails else None) for j, x in enumerate(kept) if j not in heads]
    # In a run of n steps, each flow in ``spun`` is applied once, with the duration ``elapsed`` = n h.
    outer: list[Timed] = [(letter, elapsed) for letter in spun]
    return Parted(
        verify(_program(program, first)) if first else None,
        verify(_program(program, inner, *([lead] if joined else []))),
        verify(_program(program, outer, elapsed)) if outer else None,
        last,
        later,
    )


def with_deferred(kernel: Kernel, parted: Parted, scene: Problem, chains: int = AS_WRITTEN) -> Kernel:
    """Return a copy of ``kernel`` that also contains ``parted.begin`` and ``parted.finish``.

    ``kernel`` was compiled from the program ``parted.core``.
    """
    begin, finish = (
        None if program is None else to_kernel(program, scene, chains=chains)
        for program in (parted.begin, parted.finish)
    )
    return replace(kernel, deferred=Deferred(begin, finish, parted.last, parted.later))


def _is_h(letter: Letter) -> bool:
    """Return True if the duration of a flow is h."""
    # The coefficient of h may be a ball (a number with an error bound), which does not compare equal to 1.
    return letter.duration.power == 1 and float(letter.duration.value) == 1.0


Timed = tuple[Letter, Var | None]
"""A pair (flow, variable). The variable replaces the duration of the flow. If the second entry is None, the
flow keeps its duration.
"""

JoinedFlows = tuple[int, int, Number, Number]
"""A leading flow of a step and a final flow of the previous step, which are joined into one.

The entries are the indices of the leading and of the final flow, the duration of the final flow, and the sum
of both durations.
"""


def _joined(
    kept: Sequence[Letter], commute: Callable[[str, str], bool], program: Program
) -> list[JoinedFlows]:
    """Find pairs of flows that can be joined: a flow at the end of a step, and a flow of the next step.

    Each entry of the result describes one pair (:data:`JoinedFlows`).
    """
    # The time t + h at the end of a step is the time t of the next step.
    last = _last_time(program)
    begin, end = _run(kept, commute), _run(kept[::-1], commute)
    pairs: list[JoinedFlows] = []
    for i, head in enumerate(kept[:begin]):
        for k, tail in enumerate(kept[::-1][:end]):
            # The index ``k`` counts from the end of ``kept``, and ``j`` counts from the beginning.
            j = len(kept) - 1 - k
            timely = not head.time or (head.time[0].name == "t" and tail.time == last)
            # A pair consists of two flows of the step: the earlier flow ``head`` with the index i, and the
            # later flow ``tail`` with the index j. For i = j, there is only one flow, and nothing is joined.
            if head.part == tail.part and i < j and timely:
                pairs.append((i, j, tail.duration.value, head.duration.value + tail.duration.value))
    # All joined flows read their duration from the variable LEAD, so only pairs with equal durations are
    # joined.
    return [pair for pair in pairs if pair[2:] == pairs[0][2:]]


def _run(letters: Sequence[Letter], commute: Callable[[str, str], bool]) -> int:
    """Return the largest n such that the first n flows in ``letters`` commute pairwise and are flows of
    different terms of the Hamiltonian.

    The attribute ``part`` of a flow is the name of the term.
    """
    n = 0
    # If the first n flows commute pairwise, each of these flows can be moved to the beginning.
    while n < len(letters) and all(
        x.part != letters[n].part and commute(x.part, letters[n].part) for x in letters[:n]
    ):
        n += 1
    return n


def _last_time(program: Program) -> tuple[Var, ...]:
    times = [a.targets for a in program.assigns() if isinstance(a.operation, Advance)]
    return times[-1] if times else ()


def _program(old: Program, letters: Sequence[Timed], *more: Var) -> Program:
    """Return a copy of the program ``old`` with different flows and with additional inputs.

    ``letters`` contains the flows of the copy, and ``more`` contains the additional inputs.
    """
    # ``body`` begins with the assignments of all stage times.

    body = [a for a in old.assigns() if isinstance(a.operation, Advance)]
    # The inputs t and h have the kind REAL. All other inputs form the state.
    first = state = tuple(v for v in old.inputs if v.kind is not Kind.REAL)
    for number, (letter, duration) in enumerate(letters):
        targets = tuple(Var(f"{v.name}{number + 1}", v.kind) for v in first)
        # The duration of ``FlowOf`` is a fixed multiple of h, and the duration of ``FlowFor`` is a variable.
        operation: Operation = FlowOf(letter.part, letter.duration, bool(letter.time))
        args = (*state, *letter.time)
        if duration is not None:
            operation = FlowFor(letter.part, bool(letter.time))
            args = (*args, duration)
        body.append(Assign(targets, operation, args))
        state = targets
    outputs = tuple((name, var) for (name, _), var in zip(old.outputs, state, strict=True))
    return replace(old, inputs=(*old.inputs, *more), body=tuple(body), outputs=outputs)
