"""Take linear maps out of sums: c1 L(x1) + c2 L(x2) becomes L(c1 x1 + c2 x2).

The pass is exact. A term L(x) is included only if no other operation reads L(x).
"""

from __future__ import annotations

from codegen.ir.program import Assign, Program
from codegen.ir.values import ONE, Coefficient, Var
from codegen.passes import dead
from codegen.passes.rewrite import Rewriter, rewrite


def run(program: Program) -> Program:
    """Return the program with linear maps factored out of sums."""
    # The number of rounds is finite, because each replacement reduces the number of linear maps.
    while True:
        # Each round counts how often a value is read. Reads by unused operations must not count, so unused
        # operations are removed.
        new = dead.run(rewrite(program, _rule))
        if new == program:
            return program
        program = new


def _rule(rewriter: Rewriter, assign: Assign) -> tuple[Var, ...]:
    if not assign.terms:
        return rewriter.emit(assign)
    # A dict keeps the order of insertion, so the emitted sum is the same in every run.
    groups: dict[object, list[tuple[Coefficient, Var]]] = {}
    for k, (c, arg) in enumerate(assign.terms):
        source = rewriter.definitions.get(arg)
        # If ``arg`` is used a second time, its computation cannot be removed.
        single = source is not None and rewriter.uses.get(arg) == 1 and source.operation.linear_in_last
        # Terms with the same linear map form a group.
        key = (source.operation, source.args[:-1]) if source is not None and single else k
        groups.setdefault(key, []).append((c, arg))
    if all(len(terms) == 1 for terms in groups.values()):
        return rewriter.emit(assign)
    result: list[tuple[Coefficient, Var]] = []
    for terms in groups.values():
        if len(terms) == 1:
            result += terms
            continue
        source = rewriter.definitions[terms[0][1]]
        # The coefficients move inside: sum c_k L(x_k) = L(sum c_k x_k).
        inner = [(c, rewriter.definitions[v].args[-1]) for c, v in terms]
        total = _lin(rewriter, inner)
        # The new name is derived from the name of the first value L(x_1).
        target = rewriter.builder.fresh(terms[0][1].name, terms[0][1].kind)
        moved = Assign((target,), source.operation, (*source.args[:-1], total))
        result.append((ONE, rewriter.emit(moved)[0]))
    return rewriter.emit(Assign.of_terms(assign.targets[0], result))


def _lin(rewriter: Rewriter, terms: list[tuple[Coefficient, Var]]) -> Var:
    target = rewriter.builder.fresh(f"s_{terms[0][1].name}", terms[0][1].kind)
    return rewriter.emit(Assign.of_terms(target, terms))[0]
