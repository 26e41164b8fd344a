"""Closed forms of a group: exp followed by the action becomes one operation where exp(x) is used once.

Exact. exp(x).y needs no group element: Rodrigues' formula applied to a vector costs two cross products.
"""

from __future__ import annotations

from codegen.ir.program import Assign, Operation, Program, Var
from codegen.passes.rewrite import Rewriter, rewrite


def run(program: Program) -> Program:
    """Return the program with act(exp(x), y) fused into actexp(x, y); exp is left for dead code."""

    def rule(rewriter: Rewriter, assign: Assign) -> tuple[Var, ...]:
        if assign.operation.name == "act":
            made = rewriter.definitions.get(assign.args[0])
            if made is not None and made.operation.name == "exp" and rewriter.uses[assign.args[0]] == 1:
                fused = Assign(assign.targets, Operation("actexp"), (made.args[0], assign.args[1]))
                return rewriter.emit(fused)
        return rewriter.emit(assign)

    return rewrite(program, rule)
