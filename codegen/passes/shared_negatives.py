"""Sums that are the negative of an earlier sum become its negative, which costs nothing.

Exact. Commutator-free and Crouch-Grossman methods take exp(x) and dexp*_{-x}: x is summed once. This pass
is the last of all, because others multiply a number into the coefficients of a sum.
"""

from __future__ import annotations

from dataclasses import replace

from codegen.ir.program import Assign, Program, Solve
from codegen.ir.values import MINUS_ONE, Coefficient, Var

Terms = frozenset[tuple[Coefficient, Var]]


def run(program: Program) -> Program:
    """Return the program with negatives of sums taken from sums of the same block, or outside all."""
    outside: dict[Terms, Var] = {}
    body = [
        # A new table for each block: sums of two blocks stay independent of each other.
        replace(s, body=_signed(s.body, {})) if isinstance(s, Solve) else _signed((s,), outside)[0]
        for s in program.body
    ]
    return replace(program, body=tuple(body))


def _signed(body: tuple[Assign, ...], known: dict[Terms, Var]) -> tuple[Assign, ...]:
    result = []
    for assign in body:
        if assign.terms:
            # A set: the sum is the negative in whatever order its terms stand.
            opposite = frozenset((Coefficient(-c.value, c.power), v) for c, v in assign.terms)
            if opposite in known:
                assign = Assign.of_terms(assign.targets[0], [(MINUS_ONE, known[opposite])])
            else:
                # The first of equal sums, so that definitions stay before uses.
                known.setdefault(frozenset(assign.terms), assign.targets[0])
        result.append(assign)
    return tuple(result)
