"""Lowerings of splitting methods: a step on T*G is a sequence of exact flows of summands of a Hamiltonian.

The sequence is called a word. If the Hamiltonian depends on time, the flow of one autonomous summand also
advances the time. During all other flows the time is constant.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING

from codegen.errors import MethodError
from codegen.flows.kick import Kick
from codegen.flows.part import Part, Summand
from codegen.flows.recognise import recognise
from codegen.flows.site_flow import site_flows
from codegen.ir.number import Number
from codegen.ir.program import Builder, Program
from codegen.ir.values import Coefficient, Kind, Var
from codegen.ir.verify import verify
from codegen.lower.base import Lowering, Objection
from codegen.method import Method
from codegen.scene.problem import Problem
from orderconds.tableau import AdjointComposition

if TYPE_CHECKING:
    from orderconds.families import Family

Word = list[tuple[Summand, Number]]
"""The flows of a step, in the order in which they act.

Each pair (summand, x) denotes the flow of the summand with the duration x h, where h is the step size.
"""


@dataclass(frozen=True)
class Parts:
    """The parts of a Hamiltonian with their exact flows.

    The text ``where`` names the method and the scene in error messages.
    """

    scene: Problem
    parts: tuple[Part, ...]
    where: str

    @property
    def summands(self) -> list[Summand]:
        """The summands of all parts."""
        return [summand for part in self.parts for summand in part.summands]

    @property
    def arranged(self) -> list[Summand]:
        """The summands of all parts. The first half of Strang's step applies their flows in this order.

        The second half of Strang's step applies the flows in the reverse order. A kick is a flow that changes
        only the momentum. If the scene is not a lattice, kicks come first. The last kick of a step and the
        first kick of the next step can then be joined into one flow. On a lattice, kicks come last. The two
        kicks in the middle of Strang's step can then be joined.
        """
        if self.scene.sites is None:
            return kicks_first(self.summands)
        return sorted(self.summands, key=is_kick)


@dataclass(frozen=True)
class Reading:
    """The flows in one step of a method on a scene.

    ``word`` is the sequence of flows. ``carrier`` is a summand of the Hamiltonian, and its flow advances the
    time. If the scene does not depend on time, ``carrier`` is None. ``conditions`` is the label of the family
    whose order conditions apply.
    """

    word: tuple[tuple[Summand, Number], ...]
    carrier: Summand | None
    conditions: str


class FlowLowering(Lowering):
    """A family of methods that compose exact flows of the parts of a Hamiltonian.

    :meth:`problem` stores the exact flows of a step in a copy of the scene. :meth:`lower` forms the program
    from this copy.
    """

    hamiltonian = True

    def objection(self, scene: Problem) -> Objection | None:
        """Return the reason why the family does not accept a scene, or None if the family accepts it."""
        if scene.sites is not None:
            hint = 'list the parts of the field in the argument "parts" of the scene'
            # A Hamiltonian lattice lists parts of the Hamiltonian. Other lattices list parts of the field.
            listed = scene.parts if scene.paired else scene.sites.parts
            expected = "a field that is a sum of parts whose exact flows are known"
            return None if listed else Objection(", a lattice without parts", expected, hint)
        if not scene.is_hamiltonian:
            return Objection("", "a Hamiltonian scene")
        # Exact flows are unknown for a scene with a wrench (an external force and torque) or with run-time
        # inputs.
        if scene.forced or scene.inputs:
            what = "a wrench" if scene.forced else "run-time inputs"
            return Objection(
                f", which is driven by {what}",
                "a Hamiltonian that is a sum of parts whose exact flows are known",
            )
        if not scene.parts:
            hint = 'write parts={"T": T, "V": V} in the scene'
            return Objection(", whose Hamiltonian has no parts", "a Hamiltonian with named parts", hint)
        return None

    def problem(self, scene: Problem, method: Method) -> Problem:
        """Return a copy of the scene with the exact flows of the step in the dictionary ``flows``.

        The keys of ``flows`` are the names of the flows.
        """
        word = self.read(scene, method).word
        # Only flows of the step are included, because other flows would be emitted as unused functions.
        flows = {name: flow for summand, _ in word for name, flow in summand.flows}
        # The flows are sorted by name, so the order of emitted functions does not depend on the step.
        return replace(scene, flows=dict(sorted(flows.items())))

    def symplectic(self, scene: Problem, method: Method) -> bool:
        """Return True, because flows of Hamiltonians are symplectic maps."""
        return True

    def conditions(self, method: Method, scene: Problem | None = None) -> Family:
        """Return the :class:`Family` whose order conditions apply to the method on a scene.

        If ``scene`` is None, return the family with the label ``method.family_label``.
        """
        from orderconds import families

        if scene is None:
            return super().conditions(method)
        # The scene decides which order conditions apply.
        return families.get(self.read(scene, method).conditions)

    @abstractmethod
    def word(self, parts: Parts, method: Method) -> tuple[Word, str]:
        """Return the sequence of flows of a step, and the label of the family whose order conditions apply.

        :class:`codegen.errors.MethodError` is raised if the tableau of ``method`` cannot be used with
        ``parts``.
        """

    def read(self, scene: Problem, method: Method) -> Reading:
        """Return the flows of one step for a scene whose Hamiltonian is a sum of parts.

        :class:`codegen.errors.MethodError` is raised if a part has no exact flow, or if the tableau does not
        fit the scene. MethodError is also raised if every part depends on time.
        """
        parts = parts_of(scene, f"{method.family}:{method.tableau.name} on {scene.name}")
        word, conditions = self.word(parts, method)
        # The flows phi_a of one summand satisfy phi_a phi_b = phi_{a+b}, so neighbouring flows can be joined.
        return Reading(tuple(_joined(word)), _carrier(parts), conditions)

    def lower(self, problem: Problem, method: Method) -> Program:
        """Return the program: one operation for each flow."""
        reading = self.read(problem, method)
        q, mu = Var("q", Kind.GROUP), Var("mu", Kind.DUAL)
        # If the scene depends on time, ``time`` is the current time within the step.
        time = None if problem.autonomous else Var("t", Kind.REAL)
        inputs = (q, mu) if time is None else (q, mu, time)
        # The names t and h are reserved, because they are arguments of emitted code.
        builder = Builder({v.name for v in inputs} | {"t", "h"})
        for summand, duration in reading.word:
            # ``Coefficient(x, k)`` represents the number x h^k, so ``step`` represents ``duration`` times h.
            step = Coefficient(duration, 1)
            # All flows of one summand commute with each other, so their order does not matter.
            for name, flow in summand.flows:
                # A summand of the Hamiltonian can depend on time. The flow of such a summand is computed for
                # a fixed value of the time. This value is the argument ``time``.
                q, mu = builder.flow(name, q, mu, step, *((time,) if time is not None and flow.timed else ()))
            # Only the flow of the summand ``carrier`` advances the time.
            if time is not None and summand is reading.carrier:
                time = builder.advance("t_stage", time, step)
        return verify(Program(method.label, inputs, builder.take(), (("q", q), ("mu", mu))))


def parts_of(scene: Problem, where: str) -> Parts:
    """Return the parts of a Hamiltonian with their exact flows.

    MethodError is raised if the compiler finds no exact flow for some part.
    """
    parts = recognise(scene) if scene.sites is None else site_flows(scene)
    for part in parts:
        # If the compiler cannot split a part into summands with exact flows, ``summands`` is empty.
        if not part.summands:
            raise MethodError(
                f"the part {part.name} has no exact flow: {part.reason}",
                where=where,
                expected="kicks, drifts, free rigid bodies, rotations about fixed axes, and linear flows",
                hint="split this part into several parts with exact flows",
            )
    return Parts(scene, tuple(parts), where)


def adjoint_word(parts: Parts, method: Method, tableau: AdjointComposition) -> tuple[Word, str]:
    """Return the flows of a composition, and the label of the family whose order conditions apply.

    A step applies Phi* and Phi alternately, and begins with Phi*. Phi is the product of the flows of all
    ``parts``, and Phi* is the adjoint of Phi.
    """
    # In each pair, beta_i comes first, because the flows with the duration beta_i h act first.
    both = [(method.number(y), method.number(x)) for x, y in zip(tableau.alpha, tableau.beta, strict=True)]
    return pairs(parts.arranged, both), "composition"


def unread(parts: Parts, method: Method) -> MethodError:
    """Return the error for a tableau whose format the family cannot use."""
    return MethodError(
        f"the family {method.family} cannot use {method.tableau.name}, a tableau of format "
        f"{method.tableau.family}",
        where=parts.where,
        expected="a tableau of format splitting or composition",
    )


def is_kick(summand: Summand) -> bool:
    """Return True if the flow of a summand changes only the momentum."""
    return all(isinstance(flow, Kick) for _, flow in summand.flows)


def kicks_first(summands: Sequence[Summand]) -> list[Summand]:
    """Return a sorted copy of ``summands``: kicks come first.

    The last kick of a step and the first kick of the next step can then be joined into one flow.
    """
    # The sort is stable, so the summands that are not kicks keep the order of the scene.
    return sorted(summands, key=lambda summand: not is_kick(summand))


def pairs(summands: Sequence[Summand], both: Sequence[tuple[Number, Number]]) -> Word:
    """Return the flows of a composition of a method Phi and its adjoint Phi*.

    For each pair (beta, alpha) in ``both``, Phi* with the duration beta h acts before Phi with the duration
    alpha h. Phi* applies the flows of ``summands`` in the given order, and Phi in the reverse order.
    """
    word: Word = []
    for beta, alpha in both:
        # The last summand occurs twice in succession. Its two flows are merged by ``_joined``.
        word += [(summand, beta) for summand in summands] + [
            (summand, alpha) for summand in reversed(summands)
        ]
    return word


def _joined(word: Word) -> Iterator[tuple[Summand, Number]]:
    joined: Word = []
    for summand, x in word:
        # A flow of duration zero is dropped, so that the flows before and after it can be joined.
        if x.is_zero:
            continue
        # ``word`` contains the same Summand object for all flows of a summand, so ``is`` compares summands.
        if joined and joined[-1][0] is summand:
            total = joined.pop()[1] + x
            # If the sum of the two durations is zero, both flows are dropped.
            if total.is_zero:
                continue
            x = total
        joined.append((summand, x))
    assert all(a is not b for (a, _), (b, _) in pairwise(joined))
    yield from joined


def _carrier(parts: Parts) -> Summand | None:
    """Return the summand whose flow advances the time, or None if the scene does not depend on time."""
    if parts.scene.autonomous:
        return None
    for summand in parts.summands:
        # The first summand that does not depend on time is returned. Another choice would give the same order
        # of accuracy.
        if not summand.timed:
            return summand
    raise MethodError(
        "every part depends on t",
        where=parts.where,
        expected="at least one part that does not depend on t",
        hint="add a part that does not depend on t",
    )
