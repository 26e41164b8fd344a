"""Adjoint operations that undo each other, and exponentials that do nothing to their own exponent.

Exact. Ad*_g Ad*_{g^-1} mu = mu and the like; Ad_{exp x} y = y where x and y are multiples of one value.
"""

from __future__ import annotations

from codegen.ir.program import Assign, Program, Var
from codegen.passes.rewrite import Rewriter, rewrite

OPPOSITE = {"Ad": "Adinv", "Adinv": "Ad", "Adt": "Adtinv", "Adtinv": "Adt"}


def run(program: Program) -> Program:
    """Return the program without operations that are undone at once."""
    return rewrite(program, _rule)


def _rule(rewriter: Rewriter, assign: Assign) -> tuple[Var, ...]:
    name = assign.operation.name
    if name in OPPOSITE:
        g, x = assign.args
        made, element = rewriter.definitions.get(x), rewriter.definitions.get(g)
        if made is not None and made.operation.name == OPPOSITE[name] and made.args[0] == g:
            return (made.args[1],)
        own = element is not None and element.operation.name == "exp" and name in ("Ad", "Adinv")
        if own and element is not None and _line(rewriter, element.args[0]) == _line(rewriter, x):
            return (x,)
    return rewriter.emit(assign)


def _line(rewriter: Rewriter, x: Var) -> Var:
    """Return the value that x is a multiple of."""
    made = rewriter.definitions.get(x)
    return made.args[0] if made is not None and made.operation.name == "lin" and len(made.args) == 1 else x
