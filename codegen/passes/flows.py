"""Join exact flows of one part into one flow if they commute with all flows between them.

The pass is exact. Two flows commute if their order does not matter. Whether two flows commute is tested with
40 digits at points of the scene, for two different durations. Example: gravity does not depend on the spin of
a symmetric top about its axis, so a step needs the flow of this spin only once.
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
    """One flow of a composition: its part of the splitting, its duration, and its time argument, if any."""

    part: str
    duration: Coefficient
    time: tuple[Var, ...] = ()


def run(program: Program, scene: Problem) -> Program:
    """Return the program with flows of one part joined across flows that commute with them."""
    letters = word(program)
    if letters is None:
        return program
    # The predicate is formed only if the program is a composition of flows, because sampling the scene takes
    # time.
    commute = commuting(scene)
    kept: list[Letter] = []
    # Each flow is joined to an earlier flow of the same part if it commutes with all flows between them.
    for letter in letters:
        at = _before(kept, letter, commute)
        if at is not None:
            # Flows of one part form a one-parameter group: exp(a X) exp(b X) = exp((a + b) X).
            duration = letter.duration.value + kept.pop(at).duration.value
            letter = replace(letter, duration=Coefficient(duration, letter.duration.power))
        # The flow of duration zero is the identity; a duration counts as zero only if that is proven.
        if not letter.duration.is_zero:
            kept.append(letter)
    # If no flows were joined, the old program is returned, because the optimiser then skips the comparison of
    # programs.
    return program if len(kept) == len(letters) else with_flows(program, kept)


def _before(kept: Sequence[Letter], letter: Letter, commute: Callable[[str, str], bool]) -> int | None:
    """Return the index of the last flow of the same part and time, if all flows after it commute with the new
    flow."""
    for at in reversed(range(len(kept))):
        # The flow of a part that depends on time uses the part at its stage time, so two stage times give two
        # different flows.
        if (kept[at].part, kept[at].time) == (letter.part, letter.time):
            return at
        # The new flow cannot be moved before this flow, because the two flows do not commute.
        if not commute(kept[at].part, letter.part):
            return None
    return None


def word(program: Program) -> list[Letter] | None:
    """Return the flows of a program in order, or None for a program with other operations."""
    letters = []
    state = tuple(v for v in program.inputs if v.kind is not Kind.REAL)
    for statement in program.body:
        # A block means implicit stages, so the program is not a composition of flows.
        if not isinstance(statement, Assign):
            return None
        operation, args = statement.operation, statement.args
        if isinstance(operation, Advance):
            continue
        # Each flow must start from the state that the previous flow returned.
        if not isinstance(operation, FlowOf) or args[: len(state)] != state:
            return None
        letters.append(Letter(operation.part, operation.duration, args[len(state) :]))
        state = statement.targets
    # The outputs must be the state after the last flow; otherwise the program is not a composition of flows
    # only.
    return letters if state == tuple(var for _, var in program.outputs) else None


def with_flows(program: Program, letters: Sequence[Letter]) -> Program:
    """Return the program that applies these flows, with the stage times of the old program."""
    # All stage times come first, which is possible because each stage time depends on t alone. The pass for
    # unused values removes stage times that no flow reads.
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
    """Return a function of the names of two parts that returns whether the flows of these parts commute."""
    orbit = orbit_of(scene)
    d = orbit.domain

    def moved(point: dict[str, Value], parts: Sequence[tuple[str, Value]]) -> tuple[Value, ...]:
        state = tuple(tuple(point[s] for s in block.symbols) for block in scene.state)
        # The points are on the manifold, because flows that use the equations of the group may commute only
        # there.
        for part, tau in parts:
            state = scene.flow(d, part, tau, (*state, point["t"]))
        return tuple(x for block in state for x in block)

    @cache
    def same(pair: tuple[str, str]) -> bool:
        # The durations differ, because with equal durations a symmetry of the two parts could hide a
        # difference.
        first, second = ((part, d.rational(k + 2, 7)) for k, part in enumerate(pair))
        for point in orbit.points:
            try:
                ends = moved(point, (first, second)), moved(point, (second, first))
            except (ArithmeticError, ValueError):
                # If a flow cannot be evaluated at a sample point, the flows are treated as not commuting.
                return False
            if not all(orbit.sized(x - y, (x, y)) for x, y in zip(*ends, strict=True)):
                return False
        return True

    # The relation is symmetric, so sorting the pair halves the number of comparisons. A flow commutes with
    # itself.
    return lambda a, b: a == b or same((a, b) if a < b else (b, a))


def apart(letters: Sequence[Letter], commute: Callable[[str, str], bool]) -> tuple[str, ...]:
    """Return the parts whose flows commute with all other flows of a composition, by first appearance."""
    parts = tuple(dict.fromkeys(letter.part for letter in letters))
    bound = {p for a, b in combinations(parts, 2) if not commute(a, b) for p in (a, b)}
    return tuple(p for p in parts if p not in bound)
