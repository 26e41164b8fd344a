"""Value numbering: compute an operation once if it is applied to the same values several times.

In exact arithmetic, the pass changes no value. Sums with the same terms in another order count as equal.
"""

from __future__ import annotations

from codegen.ir.operations import Operation
from codegen.ir.program import Assign, Program
from codegen.ir.values import Var
from codegen.passes.rewrite import Rewriter, rewrite


def run(program: Program) -> Program:
    """Return the program without repeated operations on the same values."""
    known: dict[tuple[Operation, tuple[Var, ...], str], tuple[Var, ...]] = {}
    rank: dict[Var, int] = {}

    def ranked(var: Var) -> int:
        return rank.setdefault(var, len(rank))

    def rule(rewriter: Rewriter, assign: Assign) -> tuple[Var, ...]:
        # The terms are sorted, so that sums of the same terms get the same key.
        for arg in assign.args:
            ranked(arg)
        if assign.terms:
            assign = Assign.of_terms(
                assign.targets[0], sorted(assign.terms, key=lambda term: ranked(term[1]))
            )
        # Zero in the algebra and zero in the dual are different values, so the key contains the kind.
        key = (assign.operation, assign.args, assign.targets[0].kind.value)
        if key not in known:
            # The first of several equal assignments is kept, so the value is defined before every statement
            # that reads the value.
            known[key] = rewriter.emit(assign)
        return known[key]

    return rewrite(program, rule)
