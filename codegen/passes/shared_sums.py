"""Compute linear combinations of values L(x_k) with fewer evaluations of the linear map L.

The pass is exact. The combination sum_k a_k L(x_k) with numbers a_k is computed as L(sum_k a_k x_k).
"""

from __future__ import annotations

from codegen.ir.operations import Operation
from codegen.ir.program import Assign, Program, Solve
from codegen.ir.values import Coefficient, Var
from codegen.passes import dead
from codegen.passes.rewrite import Rewriter, rewrite

Key = tuple[Operation, tuple[Var, ...]]
"""An operation and all its arguments except the last. The operation is linear in the last argument."""

Share = tuple[tuple[Var, Coefficient], ...]
"""A linear combination sum_k a_k L(x_k) for one linear map L, as pairs (L(x_k), a_k).

The pairs have a fixed order, and the first a_k is 1.
"""


def run(program: Program) -> Program:
    """Return the program with sum_k a_k L(x_k) replaced by L(sum_k a_k x_k). L is a linear map."""
    while True:
        # The search is repeated, because each replacement may allow further replacements.
        wanted = _worthwhile(program)
        if not wanted:
            return program
        values: dict[Share, Var] = {}

        def rule(
            # The default arguments bind the objects of this iteration.
            rewriter: Rewriter,
            assign: Assign,
            wanted: set[Share] = wanted,
            values: dict[Share, Var] = values,
        ) -> tuple[Var, ...]:
            return _rule(rewriter, assign, wanted, values)

        program = dead.run(rewrite(program, rule))


def _rule(
    rewriter: Rewriter, assign: Assign, wanted: set[Share], values: dict[Share, Var]
) -> tuple[Var, ...]:
    if not assign.terms:
        return rewriter.emit(assign)
    pairs = list(assign.terms)
    for share, factor in _shares(assign, rewriter.definitions).items():
        if share not in wanted:
            continue
        members = dict(share)
        # Each combination is emitted once, and its value is stored in ``values``.
        if share not in values:
            first = rewriter.definitions[share[0][0]]
            inner = [(c, rewriter.definitions[v].args[-1]) for v, c in share]
            total = rewriter.builder.fresh(f"s_{first.targets[0].name}", share[0][0].kind)
            rewriter.emit(Assign.of_terms(total, inner))
            target = rewriter.builder.fresh(first.targets[0].name, share[0][0].kind)
            values[share] = rewriter.emit(Assign((target,), first.operation, (*first.args[:-1], total)))[0]
        pairs = [(c, v) for c, v in pairs if v not in members] + [(factor, values[share])]
    return rewriter.emit(Assign.of_terms(assign.targets[0], pairs))


def _worthwhile(program: Program) -> set[Share]:
    """Return the combinations sum_k a_k L(x_k) that should be computed as L(sum_k a_k x_k).

    A combination is returned only if the new form needs fewer evaluations of L.
    """
    worthwhile: set[Share] = set()
    for statement in program.body:
        # Only blocks of implicit equations (statements of the class Solve) are searched. Iterations evaluate
        # the statements of a block many times in a step. Other statements are not iterated.
        body = statement.body if isinstance(statement, Solve) else ()
        definitions = {target: a for a in body for target in a.targets}
        shares: dict[Key, dict[Share, None]] = {}
        for assign in body:
            for share in _shares(assign, definitions):
                first = definitions[share[0][0]]
                shares.setdefault((first.operation, first.args[:-1]), {})[share] = None
        for combinations in shares.values():
            values = {v for share in combinations for v, _ in share}
            if len(combinations) < len(values):
                worthwhile |= {share for share in combinations if len(share) > 1}
    return worthwhile


def _shares(assign: Assign, definitions: dict[Var, Assign]) -> dict[Share, Coefficient]:
    """Group the terms of the sum ``assign`` by their linear maps.

    Let a_k v_k be the terms with v_k = L(x_k) for one linear map L, and let c be the first of the numbers
    a_k. If all variables v_k are different, the result contains one entry for L, otherwise none. The key of
    the entry is the combination sum_k (a_k/c) v_k in the form of :data:`Share`, and the value is c.
    """
    groups: dict[Key, list[tuple[Var, Coefficient]]] = {}
    for c, arg in assign.terms:
        source = definitions.get(arg)
        if source is not None and source.operation.linear_in_last:
            groups.setdefault((source.operation, source.args[:-1]), []).append((arg, c))
    shares: dict[Share, Coefficient] = {}
    for terms in groups.values():
        # ``shares`` gets no entry for a linear map if two terms of this map contain the same variable v, for
        # example v and h v.
        if len({v for v, _ in terms}) < len(terms):
            continue
        # All coefficients are divided by the first, so proportional combinations become equal.
        _, unit = min(terms, key=lambda term: (term[1].power, term[0].name))
        ordered = sorted(terms, key=lambda term: (term[1].power, term[0].name))
        share = tuple((v, Coefficient(c.value / unit.value, c.power - unit.power)) for v, c in ordered)
        shares[share] = unit
    return shares
