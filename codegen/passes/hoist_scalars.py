"""Take numbers out of linear maps, and expand sums that are nested in sums.

If c is a number and L is a linear map, L(c x) is replaced by c L(x).
"""

from __future__ import annotations

from dataclasses import replace

from codegen.ir.program import Assign, Builder, Program, Solve
from codegen.ir.values import Coefficient, Var
from codegen.passes import dead
from codegen.passes.rewrite import Rewriter, defined, rewrite
from codegen.passes.tearing import ordered

Pattern = tuple[tuple[int, Coefficient], ...]
"""The sums that contain one value v, with the coefficients of v up to a common factor.

Each sum has an index. If the sum with index k contains the term c_k v, the pattern contains the pair
(k, c_k / c_m). Here m is the index of the first sum that contains v.
"""


def run(program: Program) -> Program:
    """Move numbers out of linear maps, expand nested sums, and return the new program.

    If several sums of an implicit block contain multiples of one linear combination, this combination is
    computed once.
    """
    while True:
        # Dead code is removed, because :func:`_flat` would count the reads in dead code.
        new = dead.run(rewrite(program, _rule))
        if new == program:
            return _added(program)
        program = new


def _rule(rewriter: Rewriter, assign: Assign) -> tuple[Var, ...]:
    operation = assign.operation
    if assign.terms:
        return _flat(rewriter, assign)
    source = rewriter.definitions.get(assign.args[-1]) if assign.args else None
    if not operation.linear_in_last or source is None or not source.is_multiple:
        return rewriter.emit(assign)
    (target,) = assign.targets
    # For a linear map L, L(c x) is replaced by c L(x).
    mapped = rewriter.builder.fresh(target.name, target.kind)
    rewriter.emit(replace(assign, targets=(mapped,), args=(*assign.args[:-1], source.args[0])))
    return rewriter.emit(Assign((target,), source.operation, (mapped,)))


def _flat(rewriter: Rewriter, assign: Assign) -> tuple[Var, ...]:
    """Expand the nested sums in the sum ``assign``, and return a tuple with the variable of the result."""
    total: dict[tuple[Var, int], Coefficient] = {}
    for c, arg in assign.terms:
        source = rewriter.definitions.get(arg)
        # A nested sum of several terms is expanded only if it is read once.
        terms = [(c, arg)]
        if source is not None and source.terms and (source.is_multiple or rewriter.uses.get(arg) == 1):
            terms = [(Coefficient(c.value * k.value, c.power + k.power), v) for k, v in source.terms]
        for k, v in terms:
            old = total.get((v, k.power))
            total[v, k.power] = k if old is None else Coefficient(old.value + k.value, k.power)
    kept = [(c, v) for (v, _), c in total.items() if not c.is_zero]
    # The pass ``fold_zeros`` replaces a sum without terms by zero.
    if not kept:
        return rewriter.emit(assign)
    if len(kept) == 1 and kept[0][0].is_one:
        return (kept[0][1],)
    return rewriter.emit(Assign.of_terms(assign.targets[0], kept))


def _added(program: Program) -> Program:
    """In each implicit block, compute the common parts of sums only once."""
    builder = Builder({v.name for v in defined(program)})
    # Only implicit blocks are changed: iterations evaluate them several times in a step.
    body = [replace(s, body=_together(s.body, builder)) if isinstance(s, Solve) else s for s in program.body]
    return replace(program, body=tuple(body))


def _together(body: tuple[Assign, ...], builder: Builder) -> tuple[Assign, ...]:
    sums = {k: a for k, a in enumerate(body) if len(a.terms) > 1}
    # Two values u and v belong to one group only if two conditions hold. First, every sum contains both u and
    # v, or neither of them. Second, the quotient (coefficient of u)/(coefficient of v) is equal in all sums
    # that contain u and v.
    groups: dict[tuple[str, Pattern], list[tuple[Var, Coefficient]]] = {}
    for v in dict.fromkeys(v for a in sums.values() for v in a.args):
        places = [(k, c) for k, a in sums.items() for c, x in a.terms if x == v]
        # The coefficient of v in each sum is divided by the coefficient of v in the first of these sums. For
        # example, the terms 3 v and 6 v in two sums give the quotients 1 and 2.
        unit = places[0][1]
        relative = tuple((k, Coefficient(c.value / unit.value, c.power - unit.power)) for k, c in places)
        # ``distinct`` is False if a sum contains v twice, with different powers of h.
        distinct = len({k for k, _ in places}) == len(places)
        # The value v is skipped if a quotient of its coefficients is a negative power of h, such as h/h^2.
        if len(places) > 1 and distinct and all(c.power >= 0 for _, c in relative):
            groups.setdefault((v.kind.value, relative), []).append((v, unit))
    totals: list[Assign] = []
    for (_, relative), members in groups.items():
        _, unit = members[0]
        # A new sum needs at least two values, and their coefficients must contain the same power of h.
        if len(members) < 2 or any(c.power != unit.power for _, c in members):
            continue
        terms = [(Coefficient(c.value / unit.value), v) for c, v in ((c, v) for v, c in members)]
        total = builder.lin(f"sum_{members[0][0].name}", members[0][0].kind, terms)
        totals += builder.take()
        gone = {v for v, _ in members}
        for k, share in relative:
            kept = [(c, v) for c, v in sums[k].terms if v not in gone]
            kept.append((Coefficient(share.value * unit.value, share.power + unit.power), total))
            sums[k] = Assign.of_terms(sums[k].targets[0], kept)
    # The assignments ``totals`` compute common parts of the assignments ``sums``. The function ``ordered``
    # puts each common part before the assignments that read this part.
    result = ordered((*(sums.get(k, a) for k, a in enumerate(body)), *totals))
    # The new sums create no cyclic dependencies, so ``ordered`` does not return None.
    assert result is not None
    return result
