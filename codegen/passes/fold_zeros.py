"""Remove zeros, identities and terms that cancel, and combine like terms of sums.

The pass is exact. A linear operation on zero gives zero. For x = 0, exp(x) is the identity, and dexp_x is the
identity map.
"""

from __future__ import annotations

from codegen.ir.operations import (
    Act,
    Adjoint,
    Advance,
    Bracket,
    DualDexp,
    ElementAt,
    Exp,
    Identity,
    InverseDexp,
    InverseDifferential,
    Multiply,
    Zero,
)
from codegen.ir.program import Assign, Program
from codegen.ir.values import Coefficient, Var
from codegen.passes.rewrite import Rewriter, rewrite

AT_ZERO = (InverseDexp, DualDexp, InverseDifferential)
"""Operations that return their last argument if the first argument is zero."""

AT_IDENTITY = (Act, Adjoint)
"""Operations that return their last argument if the first argument is the identity."""


def run(program: Program) -> Program:
    """Simplify operations with zeros and identity elements, and remove terms that cancel."""
    return rewrite(program, _rule)


def _rule(rewriter: Rewriter, assign: Assign) -> tuple[Var, ...]:
    operation = assign.operation
    if assign.terms:
        return _sum(rewriter, assign)
    # The time t + 0 h of a stage at the start of the step is replaced by t.
    if isinstance(operation, Advance) and operation.coefficient.is_zero:
        return assign.args
    # An argument counts as zero only if the operation Zero computes it, and as the identity only if the
    # operation Identity computes it.
    sources = [rewriter.definitions[a].operation if a in rewriter.definitions else None for a in assign.args]
    zero = [isinstance(source, Zero) for source in sources]
    identity = [isinstance(source, Identity) for source in sources]
    if isinstance(operation, Exp | ElementAt) and zero[0]:
        return rewriter.emit(Assign(assign.targets, Identity(), ()))
    if isinstance(operation, Multiply) and any(identity):
        # A product of the identity and another factor is the other factor.
        return (assign.args[1 - identity.index(True)],)
    if (isinstance(operation, AT_IDENTITY) and identity[0]) or (isinstance(operation, AT_ZERO) and zero[0]):
        return (assign.args[1],)
    # A Lie bracket is linear in both arguments.
    if operation.linear_in_last and (zero[-1] or (isinstance(operation, Bracket) and zero[0])):
        return rewriter.emit(Assign(assign.targets, Zero(assign.targets[0].kind), ()))
    return rewriter.emit(assign)


def _sum(rewriter: Rewriter, assign: Assign) -> tuple[Var, ...]:
    """Simplify the linear combination ``assign``, and return the variable of the result."""
    # The terms a h^p x and b h^q x are added only if p = q.
    total: dict[tuple[Var, int], Coefficient] = {}
    for c, arg in assign.terms:
        source = rewriter.definitions.get(arg)
        if source is not None and isinstance(source.operation, Zero):
            continue
        old = total.get((arg, c.power))
        total[arg, c.power] = c if old is None else Coefficient(old.value + c.value, c.power)
    # A coefficient that is a ball (a number with an error bound) is not provably zero, even if the ball
    # contains zero.
    terms = [(c, arg) for (arg, _), c in total.items() if not c.is_zero]
    if not terms:
        return rewriter.emit(Assign(assign.targets, Zero(assign.targets[0].kind), ()))
    # If x is the only term and has the coefficient 1, the sum is x.
    if len(terms) == 1 and terms[0][0].is_one:
        return (terms[0][1],)
    return rewriter.emit(Assign.of_terms(assign.targets[0], terms))
