"""Apply a linear map L only once, if several sums contain the same linear combination of values L(x_k).

The pass is exact. Suppose that several sums contain multiples of sum_k a_k L(x_k) with fixed numbers a_k.
This combination is computed once, as L(sum_k a_k x_k). The pass :mod:`codegen.passes.factor_linear` does not
change these terms. It requires that only one sum reads L(x_k).
"""

from __future__ import annotations

from codegen.ir.operations import Operation
from codegen.ir.program import Assign, Program, Solve
from codegen.ir.values import Coefficient, Var
from codegen.passes import dead
from codegen.passes.rewrite import Rewriter, rewrite

Key = tuple[Operation, tuple[Var, ...]]
"""A linear map, given by an operation and all its arguments except the last."""

Share = tuple[tuple[Var, Coefficient], ...]
"""A linear combination of values L(x_k) of one linear map L, as pairs (value, coefficient).

The pairs are sorted by the power of h in the coefficient, and then by the name of the value. The combination
is scaled such that the first coefficient is one.
"""


def run(program: Program) -> Program:
    """Return the program in which common combinations sum_k a_k L(x_k) are computed as L(sum_k a_k x_k)."""
    while True:
        # A value formed in one round may be a term of a combination in the next round, so the search is
        # repeated.
        wanted = _worthwhile(program)
        if not wanted:
            return program
        values: dict[Share, Var] = {}

        def rule(
            # Each round of the loop creates new objects ``wanted`` and ``values``. The default arguments
            # store the objects of this round.
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
        # L(sum_k a_k x_k) is emitted before the first sum that contains it.
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

    Let n different values L(x_k) occur in m different combinations. The pass replaces n applications of L by
    m applications. The combinations are returned only if m < n. Combinations of a single value are omitted.
    """
    worthwhile: set[Share] = set()
    for statement in program.body:
        # Only blocks are searched, because the body of a block is evaluated many times in a step.
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
    """Return the parts of a sum that consist of values L(x_k), one part for each linear map L.

    Each part is a factor times a linear combination (:data:`Share`). The result maps the linear combination
    to the factor.
    """
    groups: dict[Key, list[tuple[Var, Coefficient]]] = {}
    for c, arg in assign.terms:
        source = definitions.get(arg)
        if source is not None and source.operation.linear_in_last:
            groups.setdefault((source.operation, source.args[:-1]), []).append((arg, c))
    shares: dict[Share, Coefficient] = {}
    for terms in groups.values():
        # A value may occur in two terms with different powers of h. A combination contains each value only
        # once, so these terms and all others with the same linear map are skipped.
        if len({v for v, _ in terms}) < len(terms):
            continue
        # The coefficient of the first term is divided out, so that proportional combinations become equal.
        _, unit = min(terms, key=lambda term: (term[1].power, term[0].name))
        ordered = sorted(terms, key=lambda term: (term[1].power, term[0].name))
        share = tuple((v, Coefficient(c.value / unit.value, c.power - unit.power)) for v, c in ordered)
        shares[share] = unit
    return shares
