"""Unknowns with the same image (right-hand side of the fixed-point equation) are merged into one unknown.

The pass is exact, because unknowns with the same image are equal at a solution.
"""

from __future__ import annotations

from dataclasses import replace

from codegen.ir.program import Program, Solve, Statement
from codegen.ir.values import Var


def run(program: Program) -> Program:
    """Merge two unknowns of a block if their equations have the same right-hand side."""
    same: dict[Var, Var] = {}

    def now(variables: tuple[Var, ...]) -> tuple[Var, ...]:
        return tuple(same.get(v, v) for v in variables)

    body: list[Statement] = []
    for statement in program.body:
        if isinstance(statement, Solve):
            pairs, twins = _distinct(statement)
            # ``same`` maps each removed unknown to the unknown that replaces it. The entries of earlier
            # blocks are kept, because later statements may read the removed unknowns.
            same |= twins
            unknowns, starts, images = zip(*pairs, strict=True)
            # Some assignments may now be equal. A later pass, value numbering, merges them.
            inner = tuple(replace(a, args=now(a.args)) for a in statement.body)
            statement = replace(
                statement, unknowns=unknowns, starts=now(starts), images=now(images), body=inner
            )
        else:
            statement = replace(statement, args=now(statement.args))
        body.append(statement)
    outputs = tuple((name, same.get(var, var)) for name, var in program.outputs)
    return replace(program, body=tuple(body), outputs=outputs)


def _distinct(block: Solve) -> tuple[list[tuple[Var, Var, Var]], dict[Var, Var]]:
    """Return the kept unknowns, and the replacements of the other unknowns.

    The kept unknowns are triples (unknown, start value, right-hand side of the equation).
    """
    # ``first[x]`` is the unknown v with the equation v = x. If several unknowns have this equation, v is the
    # first of these unknowns in ``block.unknowns``.
    first: dict[Var, Var] = {}
    pairs: list[tuple[Var, Var, Var]] = []
    twins: dict[Var, Var] = {}
    for unknown, start, image in zip(block.unknowns, block.starts, block.images, strict=True):
        # An equation v = w between two unknowns is kept. :mod:`codegen.passes.blocks` solves it.
        if image in block.unknowns or first.setdefault(image, unknown) == unknown:
            pairs.append((unknown, start, image))
        else:
            twins[unknown] = first[image]
    return pairs, twins
