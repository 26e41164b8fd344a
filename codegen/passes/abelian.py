"""Simplify operations if all Lie brackets vanish, or if a series is truncated at order 0.

The pass is exact. On an abelian group, dexp^{-1}, dexp* and the adjoint operations are the identity, and ad
is zero. On every group, dexp^{-1} truncated at order 0 is the identity. If dexp^{-1}_x is the identity, its
derivative with respect to x is zero.
"""

from __future__ import annotations

from codegen.ir.operations import Adjoint, Bracket, DualDexp, InverseDexp, InverseDexpSlope, Zero
from codegen.ir.program import Assign, Program
from codegen.ir.values import Var
from codegen.passes.rewrite import Rewriter, rewrite

IDENTITIES = (Adjoint, InverseDexp, DualDexp)
"""Operations that return their last argument if all brackets vanish."""

ZEROS = (Bracket, InverseDexpSlope)
"""Operations that return zero if all brackets vanish."""


def run(program: Program, abelian: bool) -> Program:
    """Replace operations in :data:`IDENTITIES` by their last argument, and those in :data:`ZEROS` by zero.

    If the group is not abelian (``abelian`` is False), only two operations are replaced: dexp^{-1} truncated
    at order 0, and its derivative.
    """

    def rule(rewriter: Rewriter, assign: Assign) -> tuple[Var, ...]:
        operation = assign.operation
        # The series dexp^{-1} = 1 - ad/2 + ..., truncated at order 0, is the identity on every group.
        uncut = isinstance(operation, InverseDexp | InverseDexpSlope) and operation.order == 0
        if isinstance(operation, IDENTITIES) and (abelian or uncut):
            # If the group is abelian or the series is truncated at order 0, the result of the operation is
            # the last argument.
            return assign.args[-1:]
        if isinstance(operation, ZEROS) and (abelian or uncut):
            # The pass for zeros recognises the operation Zero, but not a sum without terms.
            return rewriter.emit(Assign(assign.targets, Zero(assign.targets[0].kind), ()))
        return rewriter.emit(assign)

    return rewrite(program, rule)
