"""Splittings: words of exact flows of a Hamiltonian's parts, on T*G.

A tableau in as many parts as the scene has is read as it is. One in two parts A, B also serves a scene in
more: written as beta_1, alpha_1, ..., the composition of Phi, the flows of all summands one after the other,
and its adjoint Phi*, the same backwards, has its order for any basic method (McLachlan, SIAM J. Sci. Comput.
16 (1995) 151).
"""

from __future__ import annotations

from collections.abc import Sequence

from codegen.errors import MethodError
from codegen.flows.part import Part, Summand
from codegen.ir.number import Number
from codegen.lower.flow_words import (
    FlowLowering,
    Parts,
    Word,
    adjoint_word,
    is_kick,
    kicks_first,
    pairs,
    unread,
)
from codegen.method import Method
from codegen.scene.canonical_equations import poisson_bracket
from codegen.scene.orbit import orbit_of
from codegen.scene.problem import Problem
from orderconds.tableau import AdjointComposition, Splitting


class SplittingLowering(FlowLowering):
    """Splittings, and compositions of Phi and Phi*."""

    family = "splitting"

    def word(self, parts: Parts, method: Method) -> tuple[Word, str]:
        """Return the word and the label of its conditions."""
        tableau = method.tableau.method
        if isinstance(tableau, AdjointComposition):
            return adjoint_word(parts, method, tableau)
        if not isinstance(tableau, Splitting):
            raise unread(parts, method)
        steps = [(k, method.number(x)) for k, x in tableau.steps]
        exact = all(part.exact for part in parts.parts)
        chosen = [part.summands[0] for part in parts.parts] if exact else parts.summands
        if len(chosen) == len(tableau.parts):
            return _in_order(parts, tableau, steps, chosen)
        if len(tableau.parts) == 2 and len(chosen) > 2:
            return pairs(kicks_first(chosen), _as_pairs(steps)), self.family
        inexact = [part.name for part in parts.parts if not part.exact]
        raise MethodError(
            f"a tableau in {len(tableau.parts)} parts for a scene in {len(chosen)}",
            where=parts.where,
            expected=f"{len(chosen)} parts, or two",
            hint=f"{', '.join(inexact)} is split into turns that do not commute" if inexact else "",
        )


def _in_order(
    own: Parts, tableau: Splitting, steps: Sequence[tuple[int, Number]], summands: Sequence[Summand]
) -> tuple[Word, str]:
    """Return the word of a tableau in as many parts as there are summands, and the label of its conditions.

    Parts are matched by their names where tableau and scene have the same, else by their order; V of a
    Runge-Kutta-Nystroem tableau is the kick.
    """
    chosen = summands
    names = [part.name for part in own.parts]
    if sorted(names) == sorted(tableau.parts):
        chosen = [own.parts[names.index(name)].summands[0] for name in tableau.parts]
    elif tableau.rkn is not None:
        chosen = sorted(chosen, key=lambda summand: is_kick(summand) != (tableau.rkn == 0))
    word = [(chosen[k], x) for k, x in steps]
    if (
        tableau.rkn is not None
        and len(own.parts) == 2
        and _nystroem(own.scene, own.parts, chosen[tableau.rkn])
    ):
        return word, "rkn"
    return word, "splitting" if len(chosen) == 2 else f"splitting({len(chosen)})"


def _nystroem(scene: Problem, parts: Sequence[Part], summand: Summand) -> bool:
    """Whether [V, [V, [V, T]]] = 0, as Runge-Kutta-Nystroem splittings need, for the part V of a summand."""
    (V,) = [scene.parts[p.name] for p in parts if p.summands[0] is summand]
    (T,) = [scene.parts[p.name] for p in parts if p.summands[0] is not summand]
    qs, mus = (block.symbols for block in scene.state)
    nested = T
    for _ in range(3):
        nested = poisson_bracket(scene.group, qs, mus, nested, V)
    return orbit_of(scene).vanish([nested])


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
    composed, carried = [], durations[0]
    for inner, outer in zip(durations[1::2], durations[2::2], strict=True):
        alpha = inner - carried
        composed.append((carried, alpha))
        carried = outer - alpha
    return composed
