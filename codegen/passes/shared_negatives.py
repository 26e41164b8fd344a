"""Compute a sum as the negative of an earlier sum, if possible.

The pass is exact. The pass runs last, because the other passes would undo its changes.
"""

from __future__ import annotations

from dataclasses import replace

from codegen.ir.program import Assign, Program, Solve
from codegen.ir.values import MINUS_ONE, Coefficient, Var

Terms = frozenset[tuple[Coefficient, Var]]


def run(program: Program) -> Program:
    """Return the program in which a sum is computed from an earlier sum with opposite coefficients.

    For example, after the assignment s = a - b, the sum b - a is computed as -s.
    """
    outside: dict[Terms, Var] = {}
    body = [
        # Each block has its own table of earlier sums.
        replace(s, body=_signed(s.body, {})) if isinstance(s, Solve) else _signed((s,), outside)[0]
        for s in program.body
    ]
    return replace(program, body=tuple(body))


def _signed(body: tuple[Assign, ...], known: dict[Terms, Var]) -> tuple[Assign, ...]:
    result = []
    for assign in body:
        if assign.terms:
            # The order of terms does not matter, so the terms are compared as a set.
            opposite = frozenset((Coefficient(-c.value, c.power), v) for c, v in assign.terms)
            if opposite in known:
                assign = Assign.of_terms(assign.targets[0], [(MINUS_ONE, known[opposite])])
            else:
                # If several sums are equal, ``known`` keeps the first, which all later sums can read.
                known.setdefault(frozenset(assign.terms), assign.targets[0])
        result.append(assign)
    return tuple(result)
