"""Splittings: a step on T*G is a sequence of exact flows of the parts of a Hamiltonian.

If the tableau and the scene have the same number of parts, each coefficient x of the tableau gives one flow
of duration x h.

If the scene has more than two parts, a tableau for two parts defines a composition of a basic method Phi and
its adjoint Phi*. Phi applies the flows of all summands of the Hamiltonian one by one, and Phi* applies these
flows in the opposite order. For any basic method Phi, the composition has the order of the tableau
(McLachlan, SIAM J. Sci. Comput. 16 (1995) 151).
"""

from __future__ import annotations

from collections.abc import Sequence

from codegen.errors import MethodError
from codegen.flows.part import Part, Summand
from codegen.ir.differentiate import gradient
from codegen.ir.number import Number
from codegen.lower.flow_words import (
    FlowLowering,
    Parts,
    Word,
    adjoint_word,
    is_kick,
    pairs,
    unread,
)
from codegen.method import Method
from codegen.scene.canonical_equations import poisson_bracket
from codegen.scene.orbit import orbit_of
from codegen.scene.problem import Problem
from codegen.scene.site_scene import with_frozen_neighbours
from orderconds.tableau import AdjointComposition, Splitting


class SplittingLowering(FlowLowering):
    """Splittings, and compositions of a basic method Phi and its adjoint Phi*."""

    family = "splitting"

    def word(self, parts: Parts, method: Method) -> tuple[Word, str]:
        """Return the flows with their durations, and the label of the family whose order conditions apply."""
        tableau = method.tableau.method
        if isinstance(tableau, AdjointComposition):
            return adjoint_word(parts, method, tableau)
        if not isinstance(tableau, Splitting):
            raise unread(parts, method)
        steps = [(k, method.number(x)) for k, x in tableau.steps]
        # ``exact`` is True if the exact flow of each part is known. Otherwise the method composes the exact
        # flows of all summands of the parts.
        exact = all(part.exact for part in parts.parts)
        chosen = [part.summands[0] for part in parts.parts] if exact else parts.summands
        if len(chosen) == len(tableau.parts):
            return _in_order(parts, tableau, steps, chosen)
        # A two-part splitting method corresponds to a composition of a basic method and its adjoint.
        if len(tableau.parts) == 2 and len(chosen) > 2:
            # For any basic method, this composition has the order of the tableau (McLachlan 1995).
            return pairs(parts.arranged, _as_pairs(steps)), self.family
        inexact = [part.name for part in parts.parts if not part.exact]
        raise MethodError(
            f"the tableau has {len(tableau.parts)} parts, but the scene has {len(chosen)} parts",
            where=parts.where,
            expected="a tableau with as many parts as the scene, or a tableau with two parts if the scene "
            "has more than two parts",
            hint="if the exact flow of a part is unknown, the program first replaces the part by its "
            f"summands, and then counts the parts; replaced parts: {', '.join(inexact)}"
            if inexact
            else "",
        )


def _in_order(
    own: Parts, tableau: Splitting, steps: Sequence[tuple[int, Number]], summands: Sequence[Summand]
) -> tuple[Word, str]:
    """Return the flows of a splitting, and the label of the family whose order conditions apply.

    If the parts of the tableau and of the scene have the same names, the parts are matched by name. Otherwise
    the parts are matched by position. There is one exception for Hamiltonian scenes: the potential V of a
    Runge-Kutta-Nystroem tableau is matched with the kick.
    """
    chosen = summands
    names = [part.name for part in own.parts]
    # Parts are matched by name rather than by position, because the order of parts in a scene is arbitrary.
    if sorted(names) == sorted(tableau.parts):
        chosen = [own.parts[names.index(name)].summands[0] for name in tableau.parts]
    elif tableau.rkn is not None and own.scene.paired:
        # ``rkn`` (0 or 1) is the index of the potential V in ``tableau.parts``.
        chosen = sorted(chosen, key=lambda summand: is_kick(summand) != (tableau.rkn == 0))
    word = [(chosen[k], x) for k, x in steps]
    if (
        tableau.rkn is not None
        and own.scene.paired
        and len(own.parts) == 2
        and _nystroem(own.scene, own.parts, chosen[tableau.rkn])
    ):
        # Since [V, [V, [V, T]]] = 0, the order conditions of Runge-Kutta-Nystroem splittings are sufficient.
        return word, "rkn"
    return word, "splitting" if len(chosen) == 2 else f"splitting({len(chosen)})"


def _nystroem(scene: Problem, parts: Sequence[Part], summand: Summand) -> bool:
    """Return True if the nested Poisson bracket [V, [V, [V, T]]] is zero.

    V is the part of the Hamiltonian that contains ``summand``, and T is the other part.
    """
    if scene.sites is not None:
        return is_kick(summand) and _quadratic(scene, [p for p in parts if p.summands[0] is not summand])
    (V,) = [scene.parts[p.name] for p in parts if p.summands[0] is summand]
    (T,) = [scene.parts[p.name] for p in parts if p.summands[0] is not summand]
    qs, mus = (block.symbols for block in scene.state)
    nested = T
    for _ in range(3):
        # The sign convention of the bracket does not matter, because the result is only compared with zero.
        nested = poisson_bracket(scene.group, qs, mus, nested, V)
    return orbit_of(scene).vanish([nested])


def _quadratic(scene: Problem, parts: Sequence[Part]) -> bool:
    # A polynomial has degree two or less if and only if all its third derivatives vanish.
    mus = scene.state[1].symbols
    slopes = [scene.parts[part.name] for part in parts]
    for _ in range(3):
        slopes = [slope for root in slopes for slope in gradient(root, mus)]
    return orbit_of(with_frozen_neighbours(scene)).vanish(slopes)


def _as_pairs(steps: Sequence[tuple[int, Number]]) -> list[tuple[Number, Number]]:
    """Write a splitting in two parts as a composition of Phi and Phi* (see the top of this module).

    Each pair (beta_i, alpha_i) contains the durations of Phi* and Phi in units of the step size.
    """
    zero = Number.rational(0)
    joined: list[tuple[int, Number]] = []
    for k, x in steps:
        # Successive flows of the same part are joined. The flows of A and B then alternate.
        if joined and joined[-1][0] == k:
            joined[-1] = (k, joined[-1][1] + x)
        else:
            joined.append((k, x))
    durations = [x for _, x in joined]
    # The loop below requires an odd number of flows.
    if len(durations) % 2 == 0:
        durations.append(zero)
    composed, carried = [], durations[0]
    for inner, outer in zip(durations[1::2], durations[2::2], strict=True):
        # Here ``carried`` is beta_i, ``inner`` is beta_i + alpha_i, and ``outer`` is alpha_i + beta_{i+1}.
        alpha = inner - carried
        composed.append((carried, alpha))
        carried = outer - alpha
    # The loop above computes the durations ``composed``. Let A be the part of the Hamiltonian whose flow acts
    # first, and let B be the second part. After the loop, the variable ``carried`` is the difference of two
    # sums. The first sum contains the durations of all flows of A. The second sum contains the durations of
    # all flows of B. If the method has order one or higher, each sum is one step size. In this case,
    # ``carried`` is zero and is not needed.
    return composed
