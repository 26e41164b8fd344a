"""What a run of many steps puts off: the last flow of a step, and flows that commute with all others.

Where a step of a splitting ends with the flow that the next one begins with, the two are one; only after the
last step is the end made alone. A part that commutes with every other is not made in the steps at all but
once for all of them. Both are exact: :class:`codegen.ir.kernel.PutOff` says what equals what.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from codegen.ir.kernel import ELAPSED, LEAD, Kernel, PutOff
from codegen.ir.number import Number
from codegen.ir.program import Assign, Kind, Operation, Program, Var
from codegen.ir.verify import verify
from codegen.lower.kernel import to_kernel
from codegen.passes.flows import Letter, apart, commuting, word
from codegen.scene import Setting


@dataclass(frozen=True)
class Parted:
    """A program in two: ``core`` reads :data:`LEAD`, ``finish`` reads :data:`ELAPSED`."""

    core: Program
    finish: Program
    first: Number
    later: Number


def part(program: Program, scene: Setting) -> Parted | None:
    """Return a splitting's program in two, or None where nothing can be put off."""
    letters = word(program)
    if letters is None:
        return None
    commute = commuting(scene)
    whole = {letter.part for letter in letters if not _is_h(letter)}
    free = [name for name in apart(letters, commute) if name not in whole]
    kept = [letter for letter in letters if letter.part not in free]
    spun = [letter for letter in letters if letter.part in free]
    leading = _leading(kept, commute, program)
    if not kept or not (leading or spun):
        return None
    lead, elapsed = Var(LEAD, Kind.REAL), Var(ELAPSED, Kind.REAL)
    first, later = leading[0][2:] if leading else (Number.rational(0), Number.rational(0))
    heads, tails = {i for i, _, _, _ in leading}, {j for _, j, _, _ in leading}
    inner = [(x, lead if i in heads else None) for i, x in enumerate(kept) if i not in tails]
    outer: list[tuple[Letter, Var | None]] = [(kept[j], None) for j in sorted(tails)]
    outer += [(letter, elapsed) for letter in spun]
    core = _program(program, inner, (lead,) if leading else ())
    finish = _program(program, outer, (elapsed,))
    return Parted(verify(core), verify(finish), first, later)


def with_put_off(kernel: Kernel, program: Program, scene: Setting) -> Kernel:
    """Return the kernel of a program's core with what it puts off; ``kernel`` where that is nothing."""
    parted = None if scene.inputs else part(program, scene)  # inputs are sampled step by step
    if parted is None:
        return kernel
    finish = to_kernel(parted.finish, scene)
    put_off = PutOff(finish, parted.first, parted.later)
    return replace(to_kernel(parted.core, scene), put_off=put_off)


def _is_h(letter: Letter) -> bool:
    """Whether a flow lasts h: each part of a consistent splitting does, also where balls cannot prove it."""
    return letter.duration.power == 1 and float(letter.duration.value) == 1.0


Lead = tuple[int, int, Number, Number]
"""Places of a flow at the beginning and of one at the end, and the factors of h that it leads with."""


def _leading(kept: Sequence[Letter], commute: Callable[[str, str], bool], program: Program) -> list[Lead]:
    """Return which flows at the beginning take those of the same part at the end with them."""
    last = _last_time(program)
    begin, end = _run(kept, commute), _run(kept[::-1], commute)
    found: list[Lead] = []
    for i, head in enumerate(kept[:begin]):
        for k, tail in enumerate(kept[::-1][:end]):
            j = len(kept) - 1 - k
            timely = not head.time or (head.time[0].name == "t" and tail.time == last)
            if head.part == tail.part and i < j and timely:
                found.append((i, j, head.duration.value, head.duration.value + tail.duration.value))
    return [lead for lead in found if lead[2:] == found[0][2:]]


def _run(letters: Sequence[Letter], commute: Callable[[str, str], bool]) -> int:
    """Return how many letters at the beginning are of different parts and commute with one another."""
    n = 0
    while n < len(letters) and all(
        x.part != letters[n].part and commute(x.part, letters[n].part) for x in letters[:n]
    ):
        n += 1
    return n


def _last_time(program: Program) -> tuple[Var, ...]:
    times = [a.targets for a in program.assigns() if a.operation.name == "advance"]
    return times[-1] if times else ()


def _program(old: Program, letters: Sequence[tuple[Letter, Var | None]], more: tuple[Var, ...]) -> Program:
    """Return the program of some flows, those with a variable for the time that it holds."""
    body = [a for a in old.assigns() if a.operation.name == "advance"]
    first = state = tuple(v for v in old.inputs if v.kind is not Kind.REAL)
    for number, (letter, duration) in enumerate(letters):
        targets = tuple(Var(f"{v.name}{number + 1}", v.kind) for v in first)
        timed = "t" if letter.time else ""
        if duration is None:
            operation = Operation(f"flow{timed}", (letter.duration,), part=letter.part)
            args = (*state, *letter.time)
        else:
            operation = Operation(f"flow{timed}for", part=letter.part)
            args = (*state, *letter.time, duration)
        body.append(Assign(targets, operation, args))
        state = targets
    outputs = tuple((name, var) for (name, _), var in zip(old.outputs, state, strict=True))
    return replace(old, inputs=(*old.inputs, *more), body=tuple(body), outputs=outputs)
