"""Splittings and compositions: words of exact flows of a Hamiltonian's parts, on T*G.

A splitting tableau in as many parts as the scene has is read as it stands. One in two parts A, B also serves
a scene in more: written as beta_1, alpha_1, ..., the composition of Phi, the flows of all summands one after
the other, and its adjoint Phi*, the same backwards, has its order for any basic method (McLachlan, SIAM J.
Sci. Comput. 16 (1995) 151). A symmetric composition takes Strang's step as its base. Time moves with the
flows of one summand that does not depend on it, and stands still in all others.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from codegen.errors import MethodError
from codegen.flows.kick import Kick
from codegen.flows.part import Part, Summand
from codegen.flows.recognise import recognise
from codegen.ir.number import Number
from codegen.ir.program import Builder, Coefficient, Kind, Program, Var
from codegen.ir.verify import verify
from codegen.method import Method
from codegen.scene.canonical_equations import poisson_bracket
from codegen.scene.orbit import orbit_of
from codegen.scene.problem import Problem
from orderconds.tableau import AdjointComposition, Composition, Splitting

Word = list[tuple[Summand, Number]]
"""Summands and how long they flow, as multiples of h, the first acting first."""


@dataclass(frozen=True)
class Reading:
    """A splitting of a scene: its word, the summand that carries time, the family that tells its order."""

    word: tuple[tuple[Summand, Number], ...]
    carrier: Summand | None
    family: str


def read(scene: Problem, method: Method) -> Reading:
    """Return how a splitting or composition is read on a Hamiltonian scene.

    :class:`codegen.errors.MethodError` for a scene without parts, a part without exact flow, a tableau in
    another number of parts, and one for [V,[V,[V,T]]] = 0 where that does not hold.
    """
    where = f"{method.family}:{method.tableau.name} on {scene.name}"
    if not scene.parts:
        raise MethodError(
            "a scene without parts",
            where=where,
            expected="named summands of H",
            hint='write parts={"T": T, "V": V} in the scene',
        )
    assert scene.hamiltonian is not None
    rest = scene.hamiltonian
    for summand in scene.parts.values():
        rest = rest - summand
    if not orbit_of(scene).vanish([rest]):
        raise MethodError(
            f"the parts {', '.join(scene.parts)} do not add up to H",
            where=where,
            expected="all summands of H",
        )
    parts = recognise(scene)
    for part in parts:
        if not part.summands:
            raise MethodError(
                f"the part {part.name} has no exact flow: {part.reason}",
                where=where,
                expected="kicks, drifts, tops, turns about fixed axes and linear flows",
                hint="split it into such parts",
            )
    summands = [summand for part in parts for summand in part.summands]
    tableau = method.tableau.method
    if isinstance(tableau, Composition) and method.family == "composition":
        word = _strang(_kicks_first(summands), [method.number(x) for x in tableau.gamma])
        family = "composition"
    elif isinstance(tableau, AdjointComposition):
        both = [
            (method.number(y), method.number(x)) for x, y in zip(tableau.alpha, tableau.beta, strict=True)
        ]
        word, family = _pairs(_kicks_first(summands), both), "composition"
    elif isinstance(tableau, Splitting) and method.family == "splitting":
        word, family = _splitting(scene, method, tableau, parts, summands, where)
    else:
        raise MethodError(
            f"{method.family} with the {method.tableau.family} tableau {method.tableau.name}",
            where=where,
            expected="a tableau of family splitting or composition",
        )
    return Reading(tuple(_joined(word)), _carrier(scene, summands, where), family)


def lower(scene: Problem, method: Method) -> Program:
    """Return the program of a splitting; ``scene`` is the problem that holds the flows of :func:`flows`."""
    reading = read(scene, method)
    q, mu = Var("q", Kind.GROUP), Var("mu", Kind.DUAL)
    time = None if scene.autonomous else Var("t", Kind.REAL)
    inputs = (q, mu) if time is None else (q, mu, time)
    builder = Builder({v.name for v in inputs} | {"t", "h"})
    for summand, duration in reading.word:
        step = Coefficient(duration, 1)
        for name, flow in summand.flows:
            q, mu = builder.flow(name, q, mu, step, *((time,) if time is not None and flow.timed else ()))
        if time is not None and summand is reading.carrier:
            time = builder.advance("t_stage", time, step)
    return verify(Program(method.label, inputs, builder.take(), (("q", q), ("mu", mu))))


def _splitting(
    scene: Problem,
    method: Method,
    tableau: Splitting,
    parts: Sequence[Part],
    summands: Sequence[Summand],
    where: str,
) -> tuple[Word, str]:
    steps = [(k, method.number(x)) for k, x in tableau.steps]
    chosen: Sequence[Summand] = (
        [part.summands[0] for part in parts] if all(p.exact for p in parts) else summands
    )
    if len(chosen) == len(tableau.parts):
        names = [part.name for part in parts]
        if sorted(names) == sorted(tableau.parts):
            chosen = [parts[names.index(name)].summands[0] for name in tableau.parts]
        elif tableau.rkn is not None:
            chosen = sorted(chosen, key=lambda summand: _is_kick(summand) != (tableau.rkn == 0))
        word = [(chosen[k], x) for k, x in steps]
        if tableau.rkn is not None and len(parts) == 2 and nystroem(scene, parts, chosen[tableau.rkn]):
            return word, "rkn"
        return word, "splitting" if len(chosen) == 2 else f"splitting({len(chosen)})"
    if len(tableau.parts) == 2 and len(chosen) > 2:
        return _pairs(_kicks_first(chosen), _as_pairs(steps)), "splitting"
    inexact = [part.name for part in parts if not part.exact]
    found = f"a tableau in {len(tableau.parts)} parts for a scene in {len(chosen)}"
    hint = f"{', '.join(inexact)} is split into turns that do not commute" if inexact else ""
    raise MethodError(found, where=where, expected=f"{len(chosen)} parts, or two", hint=hint)


def nystroem(scene: Problem, parts: Sequence[Part], summand: Summand) -> bool:
    """Whether [V, [V, [V, T]]] = 0, as Runge-Kutta-Nystroem splittings need, for the part V of a summand."""
    (V,) = [scene.parts[p.name] for p in parts if p.summands[0] is summand]
    (T,) = [scene.parts[p.name] for p in parts if p.summands[0] is not summand]
    qs, mus = (block.symbols for block in scene.state)
    nested = T
    for _ in range(3):
        nested = poisson_bracket(scene.group, qs, mus, nested, V)
    return orbit_of(scene).vanish([nested])


def _is_kick(summand: Summand) -> bool:
    return all(isinstance(flow, Kick) for _, flow in summand.flows)


def _kicks_first(summands: Sequence[Summand]) -> list[Summand]:
    """Return the summands with kicks first: at the ends of Strang's step, where they are cheapest to join."""
    return sorted(summands, key=lambda summand: not _is_kick(summand))


def _as_pairs(steps: Sequence[tuple[int, Number]]) -> list[tuple[Number, Number]]:
    """Return (beta_i, alpha_i) of a splitting in two parts, zero steps put where parts do not alternate."""
    zero = Number.rational(0)
    joined: list[tuple[int, Number]] = []
    for k, x in steps:
        if joined and joined[-1][0] == k:
            joined[-1] = (k, joined[-1][1] + x)
        else:
            joined.append((k, x))
    durations = [x for _, x in joined]
    if len(durations) % 2 == 0:
        durations.append(zero)
    pairs, carried = [], durations[0]
    for inner, outer in zip(durations[1::2], durations[2::2], strict=True):
        alpha = inner - carried
        pairs.append((carried, alpha))
        carried = outer - alpha
    return pairs


def _pairs(summands: Sequence[Summand], both: Sequence[tuple[Number, Number]]) -> Word:
    """Return Phi*_{beta_1}, Phi_{alpha_1}, ...: Phi goes through the summands backwards, Phi* forwards."""
    word: Word = []
    for beta, alpha in both:
        word += [(summand, beta) for summand in summands] + [
            (summand, alpha) for summand in reversed(summands)
        ]
    return word


def _strang(summands: Sequence[Summand], gamma: Sequence[Number]) -> Word:
    half = Number.rational(1, 2)
    return _pairs(summands, [(g * half, g * half) for g in gamma])


def _joined(word: Word) -> Iterator[tuple[Summand, Number]]:
    """Yield the word with neighbouring flows of one summand joined, and without flows for no time."""
    joined: Word = []
    for summand, x in word:
        if x.is_zero:
            continue
        if joined and joined[-1][0] is summand:
            total = joined.pop()[1] + x
            if total.is_zero:
                continue
            x = total
        joined.append((summand, x))
    assert all(a is not b for (a, _), (b, _) in pairwise(joined))
    yield from joined


def _carrier(scene: Problem, summands: Sequence[Summand], where: str) -> Summand | None:
    """Return the summand with which time moves, None for a scene without time."""
    if scene.autonomous:
        return None
    for summand in summands:
        if not summand.timed:
            return summand
    raise MethodError(
        "every part depends on t",
        where=where,
        expected="one part without t, with whose flow the time moves",
        hint="add a part that does not depend on t",
    )


def problem_for(scene: Problem, method: Method) -> Problem:
    """Return the scene with the exact flows that the method composes, by name."""
    flows = {name: flow for summand, _ in read(scene, method).word for name, flow in summand.flows}
    return replace(scene, flows=dict(sorted(flows.items())))
