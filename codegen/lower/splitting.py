"""Splittings and compositions: words of exact flows of a Hamiltonian's parts, on T*G.

A splitting tableau in as many parts as the scene has is read as it stands. One in two parts A, B also serves
a scene in more: written as beta_1, alpha_1, ..., the composition of Phi, the flows of all pieces one after
the other, and its adjoint Phi*, the same backwards, has its order for any basic method (McLachlan, SIAM J.
Sci. Comput. 16 (1995) 151). A symmetric composition takes Strang's step as its base. Time moves with the
flows of one piece that does not depend on it, and stands still in all others.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from codegen.errors import MethodError
from codegen.flows.flow import Kick
from codegen.flows.recognise import Part, Piece, bracket, recognise, vanish
from codegen.ir.number import Number
from codegen.ir.program import Builder, Coefficient, Kind, Program, Var
from codegen.ir.verify import verify
from codegen.method import Method
from codegen.scene.problem import Problem, orbit_of
from orderconds.tableau import AdjointComposition, Composition, Splitting

Word = list[tuple[Piece, Number]]
"""Pieces and how long they flow, as multiples of h, the first acting first."""


@dataclass(frozen=True)
class Reading:
    """A splitting of a scene: its word, the piece that carries time, the family that tells its order."""

    word: tuple[tuple[Piece, Number], ...]
    carrier: Piece | None
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
    if not vanish(orbit_of(scene), [rest]):
        raise MethodError(
            f"the parts {', '.join(scene.parts)} do not add up to H",
            where=where,
            expected="all summands of H",
        )
    parts = recognise(scene)
    for part in parts:
        if not part.pieces:
            raise MethodError(
                f"the part {part.name} has no exact flow: {part.reason}",
                where=where,
                expected="kicks, drifts, tops, turns about fixed axes and linear flows",
                hint="split it into such parts",
            )
    pieces = [piece for part in parts for piece in part.pieces]
    tableau = method.tableau.method
    if isinstance(tableau, Composition) and method.family == "composition":
        word = _strang(_kicks_first(pieces), [method.number(x) for x in tableau.gamma])
        family = "composition"
    elif isinstance(tableau, AdjointComposition):
        both = [
            (method.number(y), method.number(x)) for x, y in zip(tableau.alpha, tableau.beta, strict=True)
        ]
        word, family = _pairs(_kicks_first(pieces), both), "composition"
    elif isinstance(tableau, Splitting) and method.family == "splitting":
        word, family = _splitting(scene, method, tableau, parts, pieces, where)
    else:
        raise MethodError(
            f"{method.family} with the {method.tableau.family} tableau {method.tableau.name}",
            where=where,
            expected="a tableau of family splitting or composition",
        )
    return Reading(tuple(_joined(word)), _carrier(scene, pieces, where), family)


def lower(scene: Problem, method: Method) -> Program:
    """Return the program of a splitting; ``scene`` is the problem that holds the flows of :func:`flows`."""
    reading = read(scene, method)
    q, mu = Var("q", Kind.GROUP), Var("mu", Kind.DUAL)
    time = None if scene.autonomous else Var("t", Kind.REAL)
    inputs = (q, mu) if time is None else (q, mu, time)
    builder = Builder({v.name for v in inputs} | {"t", "h"})
    for piece, duration in reading.word:
        step = Coefficient(duration, 1)
        for name, flow in piece.flows:
            q, mu = builder.flow(name, q, mu, step, *((time,) if time is not None and flow.timed else ()))
        if time is not None and piece is reading.carrier:
            time = builder.advance("t_stage", time, step)
    return verify(Program(method.label, inputs, builder.take(), (("q", q), ("mu", mu))))


def _splitting(
    scene: Problem,
    method: Method,
    tableau: Splitting,
    parts: Sequence[Part],
    pieces: Sequence[Piece],
    where: str,
) -> tuple[Word, str]:
    steps = [(k, method.number(x)) for k, x in tableau.steps]
    chosen: Sequence[Piece] = [part.pieces[0] for part in parts] if all(p.exact for p in parts) else pieces
    if len(chosen) == len(tableau.parts):
        names = [part.name for part in parts]
        if sorted(names) == sorted(tableau.parts):
            chosen = [parts[names.index(name)].pieces[0] for name in tableau.parts]
        elif tableau.rkn is not None:
            chosen = sorted(chosen, key=lambda piece: _is_kick(piece) != (tableau.rkn == 0))
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


def nystroem(scene: Problem, parts: Sequence[Part], piece: Piece) -> bool:
    """Whether [V, [V, [V, T]]] = 0, as Runge-Kutta-Nystroem splittings need, for the part V of a piece."""
    (V,) = [scene.parts[p.name] for p in parts if p.pieces[0] is piece]
    (T,) = [scene.parts[p.name] for p in parts if p.pieces[0] is not piece]
    nested = bracket(scene, bracket(scene, bracket(scene, T, V), V), V)
    return vanish(orbit_of(scene), [nested])


def _is_kick(piece: Piece) -> bool:
    return all(isinstance(flow, Kick) for _, flow in piece.flows)


def _kicks_first(pieces: Sequence[Piece]) -> list[Piece]:
    """Return the pieces with kicks first: at the ends of Strang's step, where they are cheapest to join."""
    return sorted(pieces, key=lambda piece: not _is_kick(piece))


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


def _pairs(pieces: Sequence[Piece], both: Sequence[tuple[Number, Number]]) -> Word:
    """Return Phi*_{beta_1}, Phi_{alpha_1}, ...: Phi goes through the pieces backwards, Phi* forwards."""
    word: Word = []
    for beta, alpha in both:
        word += [(piece, beta) for piece in pieces] + [(piece, alpha) for piece in reversed(pieces)]
    return word


def _strang(pieces: Sequence[Piece], gamma: Sequence[Number]) -> Word:
    half = Number.rational(1, 2)
    return _pairs(pieces, [(g * half, g * half) for g in gamma])


def _joined(word: Word) -> Iterator[tuple[Piece, Number]]:
    """Yield the word with neighbouring flows of one piece joined, and without flows for no time."""
    joined: Word = []
    for piece, x in word:
        if x.is_zero:
            continue
        if joined and joined[-1][0] is piece:
            total = joined.pop()[1] + x
            if total.is_zero:
                continue
            x = total
        joined.append((piece, x))
    assert all(a is not b for (a, _), (b, _) in pairwise(joined))
    yield from joined


def _carrier(scene: Problem, pieces: Sequence[Piece], where: str) -> Piece | None:
    """Return the piece with which time moves, None for a scene without time."""
    if scene.autonomous:
        return None
    for piece in pieces:
        if not piece.timed:
            return piece
    raise MethodError(
        "every part depends on t",
        where=where,
        expected="one part without t, with whose flow the time moves",
        hint="add a part that does not depend on t",
    )


def problem_for(scene: Problem, method: Method) -> Problem:
    """Return the scene with the exact flows that the method composes, by name."""
    flows = {name: flow for piece, _ in read(scene, method).word for name, flow in piece.flows}
    return replace(scene, flows=dict(sorted(flows.items())))
