"""Brackets on an abelian group, and dexp^{-1} cut off at 0.

Exact. Where every bracket vanishes, dexp^{-1}, dexp* and the adjoint operations are the identity and ad is
zero; dexp^{-1}_(0) is the identity on any group.
"""

from __future__ import annotations

from codegen.ir.program import Assign, Operation, Program, Var
from codegen.passes.rewrite import Rewriter, rewrite

TRIVIAL = frozenset({"Ad", "Adt", "Adtinv", "dexpinv", "dexpt"})


def run(program: Program, abelian: bool) -> Program:
    """Return the program without operations that do nothing."""

    def rule(rewriter: Rewriter, assign: Assign) -> tuple[Var, ...]:
        name = assign.operation.name
        if (abelian and name in TRIVIAL) or (name == "dexpinv" and assign.operation.order == 0):
            return assign.args[-1:]
        if abelian and name in ("ad", "adt"):
            return rewriter.emit(Assign(assign.targets, Operation("zero"), ()))
        return rewriter.emit(assign)

    return rewrite(program, rule)
