"""Finds the divisions that need IEEE arithmetic in emitted Python.

In Python, a division by zero raises an exception, and the step fails with the status NOT_FINITE. In C, the
quotient is an infinity or a NaN. The step fails, too, if this value makes the new state infinite or NaN. But
a formula such as exp(-1/x^2) or 1/(1 + 1/x) is finite, although a part of it is infinite.
"""

from __future__ import annotations

from collections.abc import Iterable

from codegen.ir.expr import Expr, walk
from codegen.ir.ieee import UNDEFINED
from codegen.run.language import Assign, Function, Unit, direct, statements
from codegen.run.terms import Term

KEEPING = frozenset((*UNDEFINED, "cosh", "fabs", "sinh"))
"""Functions whose value is infinite or NaN if the argument is infinite or NaN."""


def hidden_divisions(unit: Unit) -> frozenset[Expr]:
    """Return the divisions that can give an infinity or a NaN in a function with finite results.

    For example, if a function returns 1/(1 + 1/x), the division 1/x is infinite for x = 0, but the result is
    0. If another division gives an infinity or a NaN, a result of its function is infinite or NaN, too.
    """
    return frozenset(x for function in unit.functions for x in _hidden(function))


def _hidden(function: Function) -> Iterable[Expr]:
    formulas = list(_formulas(function))
    divisions = [x for x in walk([root for _, root in formulas]) if x.op == "div"]
    if not divisions:
        return ()
    read = {term.text for term in _read(function) if term.op == "name"}
    shown: set[Expr] = set()
    while True:
        # If an expression in ``shown`` is infinite or NaN, a result of the function is infinite or NaN, too.
        # If ``shown`` contains a symbol, the next round calls ``_keep`` for the formula of this symbol.
        for root in reversed([root for target, root in formulas if target is None or target in read]):
            _keep(root, shown)
        more = {str(x.payload) for x in shown if x.op == "sym"} - read
        if not more:
            return [x for x in divisions if x not in shown]
        read |= more


def _formulas(function: Function) -> Iterable[tuple[str | None, Expr]]:
    """Yield each formula of a function with the name of the scalar to which it is assigned.

    The name is None if the formula is not assigned to a scalar.
    """
    for statement in statements(function.body):
        if isinstance(statement, Assign) and statement.value.value is not None:
            yield statement.target.text if statement.target.op == "name" else None, statement.value.value
    for term in _read(function):
        if term.value is not None:
            yield None, term.value


def _read(function: Function) -> Iterable[Term]:
    """Yield all terms in the statements of a function, with two exceptions.

    The exceptions are a scalar on the left-hand side of an assignment, and a formula on the right-hand side.
    """
    for statement in statements(function.body):
        whole = isinstance(statement, Assign) and statement.value.value is not None
        for term in direct(statement):
            if isinstance(statement, Assign) and (
                (term is statement.target and term.op == "name") or (whole and term is statement.value)
            ):
                continue
            yield from _parts(term)


def _parts(term: Term) -> Iterable[Term]:
    waiting = [term]
    while waiting:
        last = waiting.pop()
        yield last
        waiting += last.args


def _keep(root: Expr, shown: set[Expr]) -> None:
    """Add parts of the formula ``root`` to the set ``shown``.

    If one of the added parts is infinite or NaN, ``root`` is infinite or NaN, too.
    """
    waiting = [root]
    while waiting:
        node = waiting.pop()
        if node in shown:
            continue
        shown.add(node)
        if node.op in ("add", "sub", "mul", "neg", "pow"):
            waiting += node.args
        elif node.op == "div":
            # An infinite divisor can give a finite quotient.
            waiting.append(node.args[0])
        elif node.op == "call" and node.payload in KEEPING:
            waiting += node.args
