"""Shared values: exponentials shared between stages and update, products of exponentials sharing a prefix.

Exact. Value numbering: an operation on the same values is computed once. The terms of a sum are taken in the
order of their values' first appearance, so that equal sums are seen as equal.
"""

from __future__ import annotations

from codegen.ir.operations import Operation
from codegen.ir.program import Assign, Program
from codegen.ir.values import Var
from codegen.passes.rewrite import Rewriter, rewrite


def run(program: Program) -> Program:
    """Return the program with every value computed once."""
    known: dict[tuple[Operation, tuple[Var, ...], str], tuple[Var, ...]] = {}
    rank: dict[Var, int] = {}

    def ranked(var: Var) -> int:
        return rank.setdefault(var, len(rank))

    def rule(rewriter: Rewriter, assign: Assign) -> tuple[Var, ...]:
        # Ranked by first appearance, not by name: fresh names would change the order of the terms.
        for arg in assign.args:
            ranked(arg)
        if assign.terms:
            assign = Assign.of_terms(
                assign.targets[0], sorted(assign.terms, key=lambda term: ranked(term[1]))
            )
        # The kind belongs to the key: zero in the algebra and zero in its dual are one operation.
        key = (assign.operation, assign.args, assign.targets[0].kind.value)
        if key not in known:
            # The first computation stays where it is, before all of its readers.
            known[key] = rewriter.emit(assign)
        return known[key]

    return rewrite(program, rule)
