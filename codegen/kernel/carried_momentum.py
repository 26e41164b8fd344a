"""Conversion of the momentum between the space frame and the body frame.

The emitted code may use a different frame than the program from which the code is compiled. The momentum is
converted in the following cases:

- The program uses the space frame, and the emitted code uses the body frame. In this case, each step converts
  the momentum to the space frame and back.
- The program uses the body frame, the emitted code uses the space frame, and the option ``whole`` is true.
  In this case, each step converts the momentum to the body frame and back.
- The program uses the body frame, the emitted code uses the space frame, and the option ``whole`` is false.
  In this case, the momentum is converted to the body frame before the first step, and to the space frame
  after the last step (:class:`codegen.ir.kernel.Carried`).
"""

from __future__ import annotations

from dataclasses import dataclass

from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr
from codegen.ir.interpret import inward, outward
from codegen.ir.kernel import Carried, Field, Kernel
from codegen.ir.program import BODY, Program
from codegen.ir.values import Kind
from codegen.scene.problem import Problem

State = tuple[Expr, ...]


@dataclass(frozen=True)
class Frames:
    """The frames of the momentum in a program and in emitted code.

    Suppose that the program uses the body frame, and the emitted code uses the space frame. If ``whole`` is
    true, each step converts the momentum to the body frame and back. If ``whole`` is false, the momentum
    is converted only before the first step and after the last step.
    """

    scene: Problem
    program: Program
    whole: bool = False

    @property
    def _alike(self) -> bool:
        """True if ``program`` and the emitted code use the same frame for momenta."""
        # The emitted code uses the body frame if ``body_group`` is not None, otherwise the space frame.
        return (self.program.frame == BODY) == (self.scene.body_group is not None)

    @property
    def _size(self) -> int:
        """The number of coordinates of the group element q."""
        group = self.scene.body_group or self.scene.group
        return int(group.size)

    def begin(self, domain: ExprDomain, state: State) -> State:
        """Return ``state`` with the momentum in the frame that the program uses (space or body frame)."""
        if self._alike:
            return state
        q, mu = state[: self._size], state[self._size :]
        if self.scene.body_group is not None:
            # The body momentum mu is converted to the space momentum Ad*_{q^-1} mu.
            return (*q, *self.scene.body_group.Adtinv(domain, q, mu))
        # If ``whole`` is false, the momentum in ``state`` is already in the body frame.
        return (*q, *inward(self.scene, domain, {"q": q, "mu": mu})) if self.whole else state

    def end(self, domain: ExprDomain, state: State, start: State, new: State) -> State:
        """Return ``new`` with the momentum in the frame that ``state`` uses (space or body frame).

        ``state`` is the state before the step. ``start`` is the result of :meth:`begin` for this state.
        ``new`` is the state after the step, with the momentum in the frame of the program.
        """
        # An empty ``new`` represents a missing embedded solution.
        if self._alike or not new:
            return new
        # The group element q does not depend on the frame, so only the momentum is converted.
        q = new[: self._size]
        if self.scene.body_group is not None:
            return (*q, *self.scene.body_group.Adt(domain, q, new[self._size :]))
        if not self.whole:
            return new
        # ``outward`` converts the momenta of ``start`` and ``new`` to the space frame.
        named = ({"q": x[: self._size], "mu": x[self._size :]} for x in (state, start, new))
        return (*q, *outward(self.scene, domain, *named))

    def fields(self) -> tuple[Field, ...]:
        """Return the fields of the state in emitted code, with descriptions."""
        group, symbols = self.scene.body_group, self.scene.symbols
        if group is None:
            return tuple(Field(b.name, b.symbols, _meaning(b.kind, self.scene)) for b in self.scene.state)
        meaning = f"left-trivialised momentum (body frame) in the dual of the Lie algebra of {group.name}"
        return (
            Field("q", symbols[: group.size], f"element of {group.name}{group.layout}"),
            Field("mu", symbols[group.size :], meaning),
        )

    def carried(self, domain: ExprDomain) -> Carried | None:
        """Return the kernels that convert the momentum to the body frame at the beginning of a run, and back
        at the end.

        If the two kernels are not needed, the result is None.
        """
        # No kernels are needed in three cases:
        # - ``_alike`` is true. Then the momentum is never converted.
        # - ``whole`` is true. Then each step converts the momentum.
        # - ``body_group`` is not None. Then each step converts the momentum, too.
        if self._alike or self.whole or self.scene.body_group is not None:
            return None
        # Here a step computes with the momentum in the body frame, but the user of the emitted code supplies
        # the momentum in the space frame.
        state = tuple(domain.space.sym(s) for s in self.scene.symbols)
        q, mu = state[: self._size], state[self._size :]
        fields = self.fields()
        # ``Adt`` maps the momentum mu in the space frame to the momentum Ad*_q mu in the body frame.
        turned = (self.scene.apply(domain, name, None, (q, mu))[0] for name in ("Adt", "Adtinv"))
        first, second = (Kernel(self.program.name, fields, (), (), tuple(new)) for new in turned)
        return Carried(first, second, self._size)


def _meaning(kind: Kind, scene: Problem) -> str:
    group, action = scene.group, scene.action
    if kind is Kind.DUAL:
        return f"right-trivialised momentum in the dual of the Lie algebra of {group.name}"
    # If a group acts on itself, a point is an element of the group.
    if kind is Kind.POINT and not action.on_itself:
        return f"point on which {group.name} acts by {action.name}"
    return f"element of {group.name}{group.layout}"
