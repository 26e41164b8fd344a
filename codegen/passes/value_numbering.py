"""Value numbering: if an operation is applied to the same values several times, it is computed once.

The pass is exact. The terms of a sum are sorted by the first appearance of their values, so that equal sums
are recognised.
"""

from __future__ import annotations

from codegen.ir.operations import Operation
from codegen.ir.program import Assign, Program
from codegen.ir.values import Var
from codegen.passes.rewrite import Rewriter, rewrite


def run(program: Program) -> Program:
    """Return the program in which every value is computed only once."""
    known: dict[tuple[Operation, tuple[Var, ...], str], tuple[Var, ...]] = {}
    rank: dict[Var, int] = {}

    def ranked(var: Var) -> int:
        return rank.setdefault(var, len(rank))

    def rule(rewriter: Rewriter, assign: Assign) -> tuple[Var, ...]:
        # Terms are sorted by first appearance and not by name, because passes introduce new names, and these
        # would change the order.
        for arg in assign.args:
            ranked(arg)
        if assign.terms:
            assign = Assign.of_terms(
                assign.targets[0], sorted(assign.terms, key=lambda term: ranked(term[1]))
            )
        # The key contains the kind of the result, because the zeros of the algebra and its dual are
        # different.
        key = (assign.operation, assign.args, assign.targets[0].kind.value)
        if key not in known:
            # The first computation of a value is kept. It precedes all readers of the value.
            known[key] = rewriter.emit(assign)
        return known[key]

    return rewrite(program, rule)
