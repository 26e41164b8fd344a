"""Exact flows that commute: those of one part are gathered into one where nothing between them minds.

Exact. Two flows commute when they can trade places; that is tried with 40 digits at points of the scene, for
two different times. A flow is joined with the next one of its part when it commutes with all that act
between: the spin of a symmetric top about its axis, which gravity does not see, is made once a step.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import combinations

from codegen.ir.domain import Value
from codegen.ir.operations import Advance
from codegen.ir.program import Assign, Program
from codegen.ir.scene_operations import FlowOf
from codegen.ir.values import Coefficient, Kind, Var
from codegen.scene.orbit import orbit_of
from codegen.scene.problem import Problem


@dataclass(frozen=True)
class Letter:
    """One flow of a word: its part, how long, and the time that it sees, if any."""

    part: str
    duration: Coefficient
    time: tuple[Var, ...] = ()


def run(program: Program, scene: Problem) -> Program:
    """Return the program with flows of one part joined across what commutes with them."""
    letters = word(program)
    if letters is None:
        return program
    commute = commuting(scene)
    kept: list[Letter] = []
    # Each flow moves back as far as it commutes with the flows that it passes.
    for letter in letters:
        at = _before(kept, letter, commute)
        if at is not None:
            duration = letter.duration.value + kept.pop(at).duration.value
            letter = replace(letter, duration=Coefficient(duration, letter.duration.power))
        if not letter.duration.is_zero:
            kept.append(letter)
    return program if len(kept) == len(letters) else with_flows(program, kept)


def _before(kept: Sequence[Letter], letter: Letter, commute: Callable[[str, str], bool]) -> int | None:
    """Return the place of the last flow of the same part and time that can be moved behind the others."""
    for at in reversed(range(len(kept))):
        if (kept[at].part, kept[at].time) == (letter.part, letter.time):
            return at
        if not commute(kept[at].part, letter.part):
            return None
    return None


def word(program: Program) -> list[Letter] | None:
    """Return the flows of a program in order, or None where it does something else as well."""
    letters = []
    state = tuple(v for v in program.inputs if v.kind is not Kind.REAL)
    for statement in program.body:
        if not isinstance(statement, Assign):
            return None
        operation, args = statement.operation, statement.args
        if isinstance(operation, Advance):
            continue
        if not isinstance(operation, FlowOf) or args[: len(state)] != state:
            return None
        letters.append(Letter(operation.part, operation.duration, args[len(state) :]))
        state = statement.targets
    return letters if state == tuple(var for _, var in program.outputs) else None


def with_flows(program: Program, letters: Sequence[Letter]) -> Program:
    """Return the program that makes these flows, with the times of the old one."""
    body = [a for a in program.assigns() if isinstance(a.operation, Advance)]
    first = state = tuple(v for v in program.inputs if v.kind is not Kind.REAL)
    for number, letter in enumerate(letters):
        targets = tuple(Var(f"{v.name}{number + 1}", v.kind) for v in first)
        operation = FlowOf(letter.part, letter.duration, bool(letter.time))
        body.append(Assign(targets, operation, (*state, *letter.time)))
        state = targets
    outputs = tuple((name, var) for (name, _), var in zip(program.outputs, state, strict=True))
    return replace(program, body=tuple(body), outputs=outputs)


def commuting(scene: Problem) -> Callable[[str, str], bool]:
    """Return whether the flows of two parts trade places on the scene."""
    orbit = orbit_of(scene)
    d = orbit.domain

    def moved(point: dict[str, Value], parts: Sequence[tuple[str, Value]]) -> tuple[Value, ...]:
        state = tuple(tuple(point[s] for s in block.symbols) for block in scene.state)
        for part, tau in parts:
            state = scene.flow(d, part, tau, (*state, point["t"]))
        return tuple(x for block in state for x in block)

    @cache
    def same(pair: tuple[str, str]) -> bool:
        first, second = ((part, d.rational(k + 2, 7)) for k, part in enumerate(pair))
        for point in orbit.points:
            try:
                ends = moved(point, (first, second)), moved(point, (second, first))
            except (ArithmeticError, ValueError):
                return False
            if not all(orbit.sized(x - y, (x, y)) for x, y in zip(*ends, strict=True)):
                return False
        return True

    return lambda a, b: a == b or same((a, b) if a < b else (b, a))


def apart(letters: Sequence[Letter], commute: Callable[[str, str], bool]) -> tuple[str, ...]:
    """Return the parts that commute with all others of a word, in order of appearance."""
    parts = tuple(dict.fromkeys(letter.part for letter in letters))
    bound = {p for a, b in combinations(parts, 2) if not commute(a, b) for p in (a, b)}
    return tuple(p for p in parts if p not in bound)
