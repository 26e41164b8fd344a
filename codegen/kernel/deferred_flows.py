"""Flows deferred across steps: the leading flow of a step, and flows that commute with all other flows.

If a step of a splitting ends with the flow that the next step begins with, these two flows are joined. The
leading flow is then applied once before the first step. A part that commutes with every other part is applied
once for all steps. Both changes are exact; :class:`codegen.ir.kernel.Deferred` states the identities.
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
    """A program split into three; ``begin`` or ``finish`` is None if it would contain no flows.

    ``core`` reads the duration :data:`LEAD`, ``finish`` the duration :data:`ELAPSED`. ``last`` is the
    duration, in units of h, of the flow that ends the last step of a run. ``later`` is the duration of the
    flow that joins two steps.
    """

    begin: Program | None
    core: Program
    finish: Program | None
    last: Number
    later: Number


def part(program: Program, scene: Problem) -> Parted | None:
    """Return a splitting's program split into three, or None if no flow can be deferred."""
    letters = word(program)
    if letters is None:
        return None
    # Whether flows commute is tested at sample points, because the formula of a bracket that is zero need not
    # simplify to zero.
    commute = commuting(scene)
    # A flow with another duration than h, or with a stage time, cannot be moved, because its result depends
    # on its place in the step.
    bound = {letter.part for letter in letters if letter.time or not _is_h(letter)}
    free = [name for name in apart(letters, commute) if name not in bound]
    # A free part commutes with all other parts, so removing the free part does not change the order of the
    # other parts.
    kept = [letter for letter in letters if letter.part not in free]
    spun = [letter for letter in letters if letter.part in free]
    joined = _joined(kept, commute, program)
    # If all flows of a step were free, no flow would remain for the core of the step.
    if not kept or not (joined or spun):
        return None
    lead, elapsed = Var(LEAD, Kind.REAL), Var(ELAPSED, Kind.REAL)
    # All joined flows have the same pair of durations, because ``_joined`` returns only flows with the same
    # durations.
    last, later = joined[0][2:] if joined else (Number.rational(0), Number.rational(0))
    heads, tails = {i for i, _, _, _ in joined}, {j for _, j, _, _ in joined}
    first: list[Timed] = [(kept[i], None) for i in sorted(heads)]
    inner: list[Timed] = [(x, lead if j in tails else None) for j, x in enumerate(kept) if j not in heads]
    # The free flows of all steps are joined: exp(h X)^n = exp(n h X).
    outer: list[Timed] = [(letter, elapsed) for letter in spun]
    # The new programs are verified like the result of a pass.
    return Parted(
        verify(_program(program, first)) if first else None,
        verify(_program(program, inner, *([lead] if joined else []))),
        verify(_program(program, outer, elapsed)) if outer else None,
        last,
        later,
    )


def with_deferred(kernel: Kernel, parted: Parted, scene: Problem, chains: int = AS_WRITTEN) -> Kernel:
    """Return the kernel of a program's core with its deferred flows."""
    begin, finish = (
        None if program is None else to_kernel(program, scene, chains=chains)
        for program in (parted.begin, parted.finish)
    )
    return replace(kernel, deferred=Deferred(begin, finish, parted.last, parted.later))


def _is_h(letter: Letter) -> bool:
    """Return True if a flow has duration h, as each part of a consistent splitting does, proved or not."""
    # The comparison rounds the duration to a double. A ball around one cannot prove that the duration is one,
    # but the ball is rounded to one.
    return letter.duration.power == 1 and float(letter.duration.value) == 1.0


Timed = tuple[Letter, Var | None]
"""A flow, and the variable that replaces its duration; None if the flow keeps its duration in the program."""

JoinedFlows = tuple[int, int, Number, Number]
"""The index of a first flow, the index of a last flow, the duration of the last flow, and the duration of
both flows joined.
"""


def _joined(
    kept: Sequence[Letter], commute: Callable[[str, str], bool], program: Program
) -> list[JoinedFlows]:
    """Return the flows at the end of a step that join a flow of the same part in the next step."""
    # The end of a step is the beginning of the next step: flows at the times t + h and t can be joined.
    last = _last_time(program)
    begin, end = _run(kept, commute), _run(kept[::-1], commute)
    pairs: list[JoinedFlows] = []
    for i, head in enumerate(kept[:begin]):
        for k, tail in enumerate(kept[::-1][:end]):
            # The condition i < j excludes joining a flow with itself.
            j = len(kept) - 1 - k
            timely = not head.time or (head.time[0].name == "t" and tail.time == last)
            if head.part == tail.part and i < j and timely:
                pairs.append((i, j, tail.duration.value, head.duration.value + tail.duration.value))
    # All deferred flows share one leading duration, so only pairs with the same durations are kept.
    return [pair for pair in pairs if pair[2:] == pairs[0][2:]]


def _run(letters: Sequence[Letter], commute: Callable[[str, str], bool]) -> int:
    """Return the largest n such that the first n letters have different parts that commute pairwise."""
    n = 0
    # The first n flows commute, so each of them can be moved to the very beginning of the step.
    while n < len(letters) and all(
        x.part != letters[n].part and commute(x.part, letters[n].part) for x in letters[:n]
    ):
        n += 1
    return n


def _last_time(program: Program) -> tuple[Var, ...]:
    times = [a.targets for a in program.assigns() if isinstance(a.operation, Advance)]
    return times[-1] if times else ()


def _program(old: Program, letters: Sequence[Timed], *more: Var) -> Program:
    """Return the program of some flows; a flow with a variable lasts for the value of the variable."""
    # All stage times are copied; the kernel assigns only those that its outputs read.

    body = [a for a in old.assigns() if isinstance(a.operation, Advance)]
    first = state = tuple(v for v in old.inputs if v.kind is not Kind.REAL)
    for number, (letter, duration) in enumerate(letters):
        targets = tuple(Var(f"{v.name}{number + 1}", v.kind) for v in first)
        operation: Operation = FlowOf(letter.part, letter.duration, bool(letter.time))
        args = (*state, *letter.time)
        if duration is not None:
            operation = FlowFor(letter.part, bool(letter.time))
            args = (*args, duration)
        body.append(Assign(targets, operation, args))
        state = targets
    outputs = tuple((name, var) for (name, _), var in zip(old.outputs, state, strict=True))
    return replace(old, inputs=(*old.inputs, *more), body=tuple(body), outputs=outputs)
