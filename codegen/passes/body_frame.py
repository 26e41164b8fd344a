"""Transformation of a program to the body frame at the start of the step.

The pass is exact. Let q be the position at the start of the step. Every value except a position is
transformed:

- a group element E becomes E~ = q^{-1} E q,
- an element x of the algebra becomes Ad_{q^-1} x,
- a momentum mu becomes Ad*_q mu.

A position Q = E q is not transformed. The new program computes Q as the product q E~, because
q E~ = q q^{-1} E q = E q = Q.

The operations in :data:`EQUIVARIANT` commute with this transformation. The pass applies each of these
operations to the transformed arguments.

The pass replaces one operation: the evaluation of the derivatives of the Hamiltonian. The evaluation gives
the velocity and the force of a stage at a position Q = q E~. Let M be the transformed momentum of the stage.
The body momentum at the position Q is P = Ad*_E~ M. The module :mod:`codegen.scene.body_frame` defines the
velocity W(Q, P) and the force N(Q, P). The transformed velocity is Ad_E~ W(Q, P), and the transformed force
is Ad*_{E~^-1} N(Q, P).

The new program reads and returns the momentum in the body frame (:data:`codegen.ir.program.BODY`).
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from codegen.ir.operations import (
    Adjoint,
    Advance,
    Bracket,
    DualDexp,
    Exp,
    Identity,
    InverseDexp,
    InverseDexpSlope,
    Linear,
    Multiply,
    Zero,
)
from codegen.ir.program import BODY, Assign, Builder, Program, Solve, Statement
from codegen.ir.scene_operations import BodyForce, BodyVelocity, HamiltonianDerivatives
from codegen.ir.values import Kind, Var
from codegen.passes.rewrite import defined
from codegen.scene.problem import Problem

EQUIVARIANT = (
    Exp,
    Linear,
    Zero,
    Bracket,
    InverseDexp,
    InverseDexpSlope,
    DualDexp,
    Adjoint,
    Multiply,
    Identity,
)
"""Operations that commute with the transformation to the body frame."""


class NotFramed(Exception):
    """Raised if this pass cannot rewrite a program. The function ``run`` catches this exception."""


def run(program: Program, scene: Problem) -> Program:
    """Return the program in the body frame, or the unchanged program if it cannot be rewritten."""
    kinds = {v.name: v.kind for v in program.inputs}
    # The state must consist of a group element q and a momentum mu.
    if scene.body is None or (kinds.get("q"), kinds.get("mu")) != (Kind.GROUP, Kind.DUAL):
        return program
    try:
        return _Framing(program).run()
    except NotFramed:
        return program


@dataclass
class _Framing:
    program: Program
    names: dict[Var, Var] = field(default_factory=dict)
    relative: dict[Var, Var | None] = field(default_factory=dict)
    """Maps each position Q to the variable that contains q^{-1} Q in the new program, or to None if Q = q.

    Here q is the position at the start of the step.
    """

    def run(self) -> Program:
        program = self.program
        self.build = Builder({v.name for v in defined(program)})
        inputs = {v.name: v for v in program.inputs}
        self.q = inputs["q"]
        # Each position Q has the form E q, where q is the position at the start of the step. For Q = q, the
        # factor E is the identity. The entry None represents the identity.
        self.relative[self.q] = None
        body: list[Statement] = []
        for statement in program.body:
            if isinstance(statement, Assign):
                self._visit(statement)
                body += self.build.take()
                continue
            # This pass rewrites a block only if all unknowns are elements of the algebra or of its dual.
            if any(u.kind not in (Kind.ALG, Kind.DUAL) for u in statement.unknowns):
                raise NotFramed
            # The new block begins with the transformed start values.
            starts = self._now(statement.starts)
            for assign in statement.body:
                self._visit(assign)
            body.append(
                Solve(
                    *(statement.label, statement.unknowns, starts),
                    *(self.build.take(), self._now(statement.images)),
                )
            )
        outputs = dict(program.outputs)
        # A program with an embedded solution is not rewritten, because it returns two positions with
        # different body frames.
        if set(outputs) != {"q", "mu"} or outputs["q"] not in self.relative:
            raise NotFramed
        element, (momentum,) = outputs["q"], self._now((outputs["mu"],))
        E = self.relative[element]
        # ``E`` is the group element with q E = q', where q is the initial and q' the final position.
        m = momentum if E is None else self.build.adjoint("m", E, momentum)
        ends = {"q": self.names.get(element, element), "mu": m}
        body += self.build.take()
        named = tuple((name, ends[name]) for name, _ in program.outputs)
        return replace(program, body=tuple(body), outputs=named, frame=BODY)

    def _now(self, variables: tuple[Var, ...]) -> tuple[Var, ...]:
        # Only two operations may have a position as an argument: the evaluation of the field, and the product
        # with a group element.
        if any(v in self.relative for v in variables):
            raise NotFramed
        return tuple(self.names.get(v, v) for v in variables)

    def _visit(self, assign: Assign) -> None:
        operation, args = assign.operation, assign.args
        if isinstance(operation, HamiltonianDerivatives) and args[0] in self.relative:
            self._field(assign)
        elif isinstance(operation, Multiply) and args[1] in self.relative:
            left, right = args[0], self.relative[args[1]]
            # The pass cannot rewrite a product if both factors are positions.
            if left in self.relative:
                raise NotFramed
            # The product of L = ``left`` and the position R q, with R = ``right``, is E q with E = L R.
            E = left if right is None else self.build.mul(f"r{assign.targets[0].name}", left, right)
            self.relative[assign.targets[0]] = E
            # The new program computes the position E q as q E~, where E~ = q^{-1} E q.
            self._emit(replace(assign, args=(self.q, E)))
        elif isinstance(operation, EQUIVARIANT):
            # The operation stays the same. Its arguments are replaced by the transformed values.
            self._emit(replace(assign, args=self._now(args)))
        # A stage time does not depend on the frame.
        elif isinstance(operation, Advance):
            self._emit(assign)
        else:
            raise NotFramed

    def _emit(self, assign: Assign) -> None:
        self.build.body.append(assign)

    def _field(self, assign: Assign) -> None:
        build, (xi, n), element = self.build, assign.targets, assign.args[0]
        E, time = self.relative[element], assign.args[2:]
        (M,) = self._now(assign.args[1:2])
        # Let q be the position at the start of the step, and let Q = q E be the position of the stage. Let mu
        # be the momentum of the stage in the space frame. In the body frame at q, the momentum is M = Ad*_q
        # mu. In the body frame at Q, the momentum is P = Ad*_Q mu = Ad*_E M.
        P = M if E is None else build.adjoint(f"P{xi.name}", E, M)
        W = build.add(BodyVelocity(bool(time)), f"W{xi.name}", element, P, *time)
        N = build.add(BodyForce(bool(time)), f"N{n.name}", element, P, *time)
        # W is the velocity and N is the force in the body frame at Q = q E. In the body frame at q, the
        # velocity is Ad_E W, and the force is Ad*_{E^-1} N.
        self.names[xi] = W if E is None else build.adjoint(f"b{xi.name}", E, W)
        self.names[n] = N if E is None else build.adjoint(f"b{n.name}", E, N, inverse=True)
