"""Brackets on an abelian group, and dexp^{-1} cut off at 0.

Exact. Where every bracket vanishes, dexp^{-1}, dexp* and the adjoint operations are the identity, ad and P
are zero; dexp^{-1}_(0) is the identity, and P_(0) zero, on any group.
"""

from __future__ import annotations

from codegen.ir.program import Assign, Operation, Program, Var
from codegen.passes.rewrite import Rewriter, rewrite

TRIVIAL = frozenset({"Ad", "Adt", "Adtinv", "dexpinv", "dexpinvt", "dexpt"})


def run(program: Program, abelian: bool) -> Program:
    """Return the program without operations that do nothing."""

    def rule(rewriter: Rewriter, assign: Assign) -> tuple[Var, ...]:
        name = assign.operation.name
        if (abelian and name in TRIVIAL) or (name in ("dexpinv", "dexpinvt") and assign.operation.order == 0):
            return assign.args[-1:]
        if (abelian and name in ("ad", "adt", "P")) or (name == "P" and assign.operation.order == 0):
            return rewriter.emit(Assign(assign.targets, Operation("zero"), ()))
        return rewriter.emit(assign)

    return rewrite(program, rule)
