"""Join exact flows of the same part of the Hamiltonian.

Two flows of one part are joined if all flows between the two commute with this part. The pass tests this with
40 digits at sample points of the scene.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache
from itertools import combinations, product

from codegen.flows.kick import Kick
from codegen.groups.capabilities import Coadjoint
from codegen.ir.operations import Advance
from codegen.ir.program import Assign, Program
from codegen.ir.rounding_domain import Sized
from codegen.ir.scene_operations import FlowOf
from codegen.ir.smoothness import selections
from codegen.ir.values import Coefficient, Kind, Var
from codegen.scene.orbit import orbit_of
from codegen.scene.problem import Problem

TYPICAL_STEPS = 16
"""A number that determines the durations for the test whether two flows commute.

The durations are about T/TYPICAL_STEPS, where T is the length of the time span of the scene. The choice of
the number is not critical: flows that commute over the tested durations commute over all durations
(:func:`commuting`).
"""

SHARES = Fraction(2, 7), Fraction(3, 7)
"""Factors for the durations of two flows in the test whether the flows commute.

The first flow is tested with the durations s and sqrt(2) s, where s = SHARES[0] * T/TYPICAL_STEPS, and T is
the length of the time span. For the second flow, s = SHARES[1] * T/TYPICAL_STEPS.
"""


@dataclass(frozen=True)
class Letter:
    """One flow in the sequence of flows of a splitting method.

    The attributes are the name of the part of the Hamiltonian, the duration, and the time argument, if any.
    """

    part: str
    duration: Coefficient
    time: tuple[Var, ...] = ()


def run(program: Program, scene: Problem) -> Program:
    """Return the program in which flows of the same part of the Hamiltonian are joined, if possible."""
    letters = word(program)
    if letters is None:
        return program
    # Testing whether flows commute takes time, so it is done only for programs that consist of flows.
    commute = commuting(scene)
    kept: list[Letter] = []
    # Each flow is joined with an earlier flow of the same part, if possible.
    for letter in letters:
        at = _before(kept, letter, commute)
        if at is not None:
            # The durations are added, because exp(a X) exp(b X) = exp((a + b) X).
            duration = letter.duration.value + kept.pop(at).duration.value
            letter = replace(letter, duration=Coefficient(duration, letter.duration.power))
        # A flow whose duration is provably zero is the identity, so it is dropped.
        if not letter.duration.is_zero:
            kept.append(letter)
    # If no flow was joined or dropped, the program is returned unchanged.
    return program if len(kept) == len(letters) else with_flows(program, kept)


def _before(kept: Sequence[Letter], letter: Letter, commute: Callable[[str, str], bool]) -> int | None:
    """Return an index k such that the flows ``kept[k]`` and ``letter`` can be joined, or None."""
    for at in reversed(range(len(kept))):
        # Only flows with the same part and the same stage time have the same vector field and can be joined.
        if (kept[at].part, kept[at].time) == (letter.part, letter.time):
            return at
        # The flow ``letter`` can only be moved past flows that commute with ``letter``.
        if not commute(kept[at].part, letter.part):
            return None
    return None


def word(program: Program) -> list[Letter] | None:
    """Return the flows of a program in order, or None if the program is not a composition of flows."""
    letters = []
    state = tuple(v for v in program.inputs if v.kind is not Kind.REAL)
    for statement in program.body:
        # A statement that is not an Assign is a block of implicit equations. A composition of flows has no
        # implicit equations.
        if not isinstance(statement, Assign):
            return None
        operation, args = statement.operation, statement.args
        if isinstance(operation, Advance):
            continue
        # Every flow of a composition starts from the result of the previous flow.
        if not isinstance(operation, FlowOf) or args[: len(state)] != state:
            return None
        letters.append(Letter(operation.part, operation.duration, args[len(state) :]))
        state = statement.targets
    # The outputs of a composition must be the state after the last flow.
    return letters if state == tuple(var for _, var in program.outputs) else None


def with_flows(program: Program, letters: Sequence[Letter]) -> Program:
    """Return ``program`` with its flows replaced by the flows in ``letters``.

    The stage times are those of ``program``.
    """
    # Stage times depend on t alone, so they are computed before all flows.
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
    """Return a function with two arguments: the names of two parts of the Hamiltonian.

    The function returns True if the flows of the two parts commute.

    The test uses two durations of each flow, whose ratio is sqrt(2). One duration is not sufficient: a flow
    that makes a full turn in this duration is then the identity, and commutes with all flows. For a fixed
    duration of one flow, the durations of the other flow for which both commute form a closed subgroup of the
    real numbers. A closed subgroup that contains two numbers with an irrational ratio contains all numbers.
    """
    orbit = orbit_of(scene)
    d, group = orbit.domain, scene.group.require(Coadjoint)
    # To test whether two flows commute, the state after the first flow and then the second flow is compared
    # with the state after the second flow and then the first flow. The durations are proportional to the time
    # span of the scene. If the durations were much shorter, the two states could agree up to rounding errors
    # although the flows do not commute.
    begin, end = scene.span
    unit = abs(end - begin) / TYPICAL_STEPS or Fraction(1)
    shorter = [d.rational(*(unit * share).as_integer_ratio()) for share in SHARES]
    ratio = d.call("sqrt", d.rational(2))
    durations = list(product(*((tau, tau * ratio) for tau in shorter)))

    def moved(point: dict[str, Sized], parts: Sequence[tuple[str, Sized]]) -> list[Sized]:
        q, mu = (tuple(point[s] for s in block.symbols) for block in scene.state)
        for part, tau in parts:
            # The values of the parameters are those of the sample point.
            values = {**point, **dict(zip(scene.symbols, (*q, *mu), strict=True))}
            q, mu = scene.flows[part].advance(d, group, values, tau, q, mu)
        return [*q, *mu]

    def agree(point: dict[str, Sized], one: tuple[str, Sized], two: tuple[str, Sized]) -> bool:
        # The flows are applied in both orders, and ``ends`` contains the two resulting states.
        try:
            ends = moved(point, (one, two)), moved(point, (two, one))
        except (ArithmeticError, ValueError):
            # If a flow cannot be evaluated at a sample point, the flows are treated as not commuting.
            return False
        return all(orbit.sized(x - y, (x, y)) for x, y in zip(*ends, strict=True))

    @cache
    def same(a: str, b: str) -> bool:
        one, two = scene.flows[a], scene.flows[b]
        # Perhaps the sample points do not reach all cases of a formula with selections, so the answer is
        # False. This does not matter for two kicks, because they always commute.
        trivial = isinstance(one, Kick) and isinstance(two, Kick)
        if not trivial and selections((*one.expressions, *two.expressions)):
            return False
        return all(agree(point, (a, s), (b, t)) for (s, t), point in product(durations, orbit.points))

    # The order of a and b does not matter, so (a, b) and (b, a) share one cached comparison.
    return lambda a, b: a == b or same(*sorted((a, b)))


def apart(letters: Sequence[Letter], commute: Callable[[str, str], bool]) -> tuple[str, ...]:
    """Return the parts of the Hamiltonian whose flows commute with the flows of all other parts.

    Each entry of ``letters`` is a flow of one part. Parts without a flow in ``letters`` are ignored. The
    result is in order of first occurrence.
    """
    parts = tuple(dict.fromkeys(letter.part for letter in letters))
    bound = {p for a, b in combinations(parts, 2) if not commute(a, b) for p in (a, b)}
    return tuple(p for p in parts if p not in bound)
