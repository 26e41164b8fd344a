"""Splittings: a step on T*G is a sequence of exact flows of the parts of a Hamiltonian.

If the tableau and the scene have the same number of parts, a step applies one flow for each coefficient. The
duration of this flow is h times the coefficient.

A tableau for two parts A, B also applies to a scene with more parts. Its coefficients then define a
composition of a basic method Phi and its adjoint Phi*. Phi applies the flows of all summands of the
Hamiltonian one by one, and Phi* applies them in the opposite order. The composition has the order of the
splitting for any basic method Phi (McLachlan, SIAM J. Sci. Comput. 16 (1995) 151).
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
        """Return the flows with their durations, and the label of the family with the order conditions."""
        tableau = method.tableau.method
        if isinstance(tableau, AdjointComposition):
            return adjoint_word(parts, method, tableau)
        if not isinstance(tableau, Splitting):
            raise unread(parts, method)
        steps = [(k, method.number(x)) for k, x in tableau.steps]
        # ``exact`` is True if each part has a single summand. Otherwise each summand counts as a separate
        # part.
        exact = all(part.exact for part in parts.parts)
        chosen = [part.summands[0] for part in parts.parts] if exact else parts.summands
        if len(chosen) == len(tableau.parts):
            return _in_order(parts, tableau, steps, chosen)
        # By McLachlan's theorem, the coefficients for two parts A, B also define a composition of Phi and
        # Phi*.
        if len(tableau.parts) == 2 and len(chosen) > 2:
            return pairs(parts.arranged, _as_pairs(steps)), self.family
        inexact = [part.name for part in parts.parts if not part.exact]
        raise MethodError(
            f"the tableau is for {len(tableau.parts)} parts, but the scene has {len(chosen)}",
            where=parts.where,
            expected=f"a tableau for {len(chosen)} parts, or a tableau for two parts",
            hint=f"each summand of {', '.join(inexact)} counts as a separate part" if inexact else "",
        )


def _in_order(
    own: Parts, tableau: Splitting, steps: Sequence[tuple[int, Number]], summands: Sequence[Summand]
) -> tuple[Word, str]:
    """Return the flows of a splitting, and the label of the family with the order conditions.

    If the parts of the tableau and of the scene have the same names, the parts are matched by name. Otherwise
    the parts are matched by position. In a Runge-Kutta-Nystroem splitting of a Hamiltonian, however, the part
    V of the tableau is matched with the kick. A kick is a flow that changes only the momentum.
    """
    chosen = summands
    names = [part.name for part in own.parts]
    # Parts are matched by name rather than by position, because the order of parts in a scene is arbitrary.
    if sorted(names) == sorted(tableau.parts):
        chosen = [own.parts[names.index(name)].summands[0] for name in tableau.parts]
    elif tableau.rkn is not None and own.scene.paired:
        # ``rkn`` is the index of the part V in the tableau. The sort moves the kick to this index. There are
        # two parts, so the index is 0 or 1.
        chosen = sorted(chosen, key=lambda summand: is_kick(summand) != (tableau.rkn == 0))
    word = [(chosen[k], x) for k, x in steps]
    if (
        tableau.rkn is not None
        and own.scene.paired
        and len(own.parts) == 2
        and _nystroem(own.scene, own.parts, chosen[tableau.rkn])
    ):
        # Since [V, [V, [V, T]]] = 0, the order conditions of Runge-Kutta-Nystroem splittings are sufficient.
        # General splittings have more order conditions.
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
    # For example, the result is zero if V depends on q alone and T is quadratic in mu, because each bracket
    # with V lowers the degree in mu by one.
    for _ in range(3):
        # The sign convention of the bracket does not matter, because the result is only compared with zero.
        nested = poisson_bracket(scene.group, qs, mus, nested, V)
    return orbit_of(scene).vanish([nested])


def _quadratic(scene: Problem, parts: Sequence[Part]) -> bool:
    """Return True if each part is a polynomial of degree two or less in the momentum of a lattice site."""
    # The degree is at most two if all third derivatives vanish.
    mus = scene.state[1].symbols
    slopes = [scene.parts[part.name] for part in parts]
    for _ in range(3):
        slopes = [slope for root in slopes for slope in gradient(root, mus)]
    return orbit_of(with_frozen_neighbours(scene)).vanish(slopes)


def _as_pairs(steps: Sequence[tuple[int, Number]]) -> list[tuple[Number, Number]]:
    """Return a splitting in two parts as a composition of Phi and Phi*.

    The result contains pairs (beta_i, alpha_i): the coefficients of Phi* and Phi in the composition.
    """
    # Let A be the part whose flow acts first, and B the other part. The splitting applies the flows A_{x1},
    # B_{x2}, A_{x3}, ... in this order. Phi* applies first A and then B. Phi applies first B and then A. The
    # composition of Phi*_{beta_1}, Phi_{alpha_1}, Phi*_{beta_2}, ... is the splitting if x1 = beta_1,
    # x2 = beta_1 + alpha_1, x3 = alpha_1 + beta_2, and so on. The first equation gives beta_1, the second
    # gives alpha_1, the third gives beta_2, and so on.
    zero = Number.rational(0)
    joined: list[tuple[int, Number]] = []
    for k, x in steps:
        # Two consecutive flows of one part are joined, because the recursion requires that the two parts
        # alternate.
        if joined and joined[-1][0] == k:
            joined[-1] = (k, joined[-1][1] + x)
        else:
            joined.append((k, x))
    # The equations above contain only the durations of the flows.
    durations = [x for _, x in joined]
    # The loop below requires an odd number of flows. If the number is even, a flow of duration zero is
    # appended.
    if len(durations) % 2 == 0:
        durations.append(zero)
    composed, carried = [], durations[0]
    for inner, outer in zip(durations[1::2], durations[2::2], strict=True):
        # ``carried`` is beta_i, ``inner`` is beta_i + alpha_i, and ``outer`` is alpha_i + beta_{i+1}.
        alpha = inner - carried
        composed.append((carried, alpha))
        carried = outer - alpha
    # The last value of ``carried`` is not used. It is zero, because both parts have the same total duration.
    return composed
