"""Remove adjoint operations that cancel in pairs or have no effect.

The pass is exact. An exponential has no effect on multiples of its exponent: Ad_{exp x} (c x) = c x for each
number c.
"""

from __future__ import annotations

from codegen.ir.operations import Adjoint, Exp
from codegen.ir.program import Assign, Program
from codegen.ir.values import Var
from codegen.passes.rewrite import Rewriter, rewrite


def run(program: Program) -> Program:
    """Remove adjoint operations that cancel in pairs or do not change their argument."""
    return rewrite(program, _rule)


def _rule(rewriter: Rewriter, assign: Assign) -> tuple[Var, ...]:
    operation = assign.operation
    if isinstance(operation, Adjoint):
        g, x = assign.args
        source, element = rewriter.definitions.get(x), rewriter.definitions.get(g)
        # After value numbering, equal group elements are the same variable.
        if source is not None and source.operation == operation.opposite() and source.args[0] == g:
            return (source.args[1],)
        # For a number c, Ad_{exp x}(c x) = c x. For Ad*_{exp x}, no such rule exists.
        own = element is not None and isinstance(element.operation, Exp) and not operation.dual
        if own and element is not None and _line(rewriter, element.args[0]) == _line(rewriter, x):
            return (x,)
    return rewriter.emit(assign)


def _line(rewriter: Rewriter, x: Var) -> Var:
    """Return v if the program defines x as a multiple of a value v, else x."""
    source = rewriter.definitions.get(x)
    return source.args[0] if source is not None and source.is_multiple else x
