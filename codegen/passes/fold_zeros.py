"""Zero and equal coefficients, terms that cancel, identities.

Exact. A sum loses zero coefficients, terms in the same value are added (and vanish where they cancel), a
single term with coefficient one is that value; the exponential of zero is the identity, a product or action
of the identity its other factor, a linear operation on zero is zero, dexp at zero does nothing.
"""

from __future__ import annotations

from codegen.ir.program import LINEAR_LAST, Assign, Coefficient, Operation, Program, Var
from codegen.passes.rewrite import Rewriter, rewrite

AT_ZERO = frozenset({"dexpinv", "dexpinvt", "dexpt"})
AT_IDENTITY = frozenset({"act", "Ad", "Adt", "Adtinv"})


def run(program: Program) -> Program:
    """Return the program without zeros, identities and cancelling terms."""
    return rewrite(program, _rule)


def _rule(rewriter: Rewriter, assign: Assign) -> tuple[Var, ...]:
    name = assign.operation.name
    if name == "lin":
        return _sum(rewriter, assign)
    made = [rewriter.definitions.get(a) for a in assign.args]
    made_by = [m.operation.name if m else "" for m in made]
    if name == "exp" and made_by[0] == "zero":
        return rewriter.emit(Assign(assign.targets, Operation("identity"), ()))
    if name == "mul" and "identity" in made_by:
        return (assign.args[1 - made_by.index("identity")],)
    if name in AT_IDENTITY and made_by[0] == "identity":
        return (assign.args[1],)
    if name in AT_ZERO and made_by[0] == "zero":
        return (assign.args[1],)
    if name in LINEAR_LAST and (made_by[-1] == "zero" or (name in ("ad", "adt") and made_by[0] == "zero")):
        return rewriter.emit(Assign(assign.targets, Operation("zero"), ()))
    if name == "advance" and assign.operation.coefficients[0].is_zero:
        return assign.args
    return rewriter.emit(assign)


def _sum(rewriter: Rewriter, assign: Assign) -> tuple[Var, ...]:
    """Simplify one linear combination."""
    total: dict[tuple[Var, int], Coefficient] = {}
    for c, arg in zip(assign.operation.coefficients, assign.args, strict=True):
        made = rewriter.definitions.get(arg)
        if made is not None and made.operation.name == "zero":
            continue
        old = total.get((arg, c.power))
        total[arg, c.power] = c if old is None else Coefficient(old.value + c.value, c.power)
    terms = [(c, arg) for (arg, _), c in total.items() if not c.is_zero]
    if not terms:
        return rewriter.emit(Assign(assign.targets, Operation("zero"), ()))
    if len(terms) == 1 and terms[0][0].is_one:
        return (terms[0][1],)
    operation = Operation("lin", tuple(c for c, _ in terms))
    return rewriter.emit(Assign(assign.targets, operation, tuple(a for _, a in terms)))
