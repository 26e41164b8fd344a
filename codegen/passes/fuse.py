"""Fuse exponentials and actions: exp(x) and its action become one operation if nothing else reads exp(x).

The pass is exact. On SO(3), the new operation uses two cross products (Rodrigues' formula).
"""

from __future__ import annotations

from codegen.ir.operations import Act, ActExp, Exp
from codegen.ir.program import Assign, Program
from codegen.ir.values import Var
from codegen.passes.rewrite import Rewriter, rewrite


def run(program: Program) -> Program:
    """Return the program with act(exp(x), y) replaced by the operation actexp(x, y)."""

    def rule(rewriter: Rewriter, assign: Assign) -> tuple[Var, ...]:
        if isinstance(assign.operation, Act):
            # The pass replaces act(g, y) by actexp(x, y) if the program computes g as exp(x).
            source = rewriter.definitions.get(assign.args[0])
            if (
                source is not None
                and isinstance(source.operation, Exp)
                # Fusing saves nothing if another operation needs exp(x), too.
                and rewriter.uses[assign.args[0]] == 1
            ):
                fused = Assign(assign.targets, ActExp(), (source.args[0], assign.args[1]))
                return rewriter.emit(fused)
        return rewriter.emit(assign)

    return rewrite(program, rule)
