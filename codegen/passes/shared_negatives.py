"""Sums that are the negative of an earlier sum become its negative, which costs nothing.

Exact. Commutator-free and Crouch-Grossman methods take exp(x) and dexp*_{-x}: x is summed once. This pass is
the last of all, for others join a number to the coefficients of a sum.
"""

from __future__ import annotations

from dataclasses import replace

from codegen.ir.number import Number
from codegen.ir.program import Assign, Coefficient, Operation, Program, Solve, Var

MINUS = Coefficient(Number.rational(-1))

Terms = frozenset[tuple[Coefficient, Var]]


def run(program: Program) -> Program:
    """Return the program with negatives of sums taken from sums of the same block, or outside all."""
    outside: dict[Terms, Var] = {}
    body = [
        replace(s, body=_signed(s.body, {})) if isinstance(s, Solve) else _signed((s,), outside)[0]
        for s in program.body
    ]
    return replace(program, body=tuple(body))


def _signed(body: tuple[Assign, ...], known: dict[Terms, Var]) -> tuple[Assign, ...]:
    found = []
    for assign in body:
        operation = assign.operation
        if operation.name == "lin":
            pairs = list(zip(operation.coefficients, assign.args, strict=True))
            opposite = frozenset((Coefficient(-c.value, c.power), v) for c, v in pairs)
            if opposite in known:
                assign = replace(assign, operation=Operation("lin", (MINUS,)), args=(known[opposite],))
            else:
                known.setdefault(frozenset(pairs), assign.targets[0])
        found.append(assign)
    return tuple(found)
