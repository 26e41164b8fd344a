"""Dead code: what neither the new state nor an equation that it needs depends on.

Exact. A block loses unknowns that nothing reads and, with them, their equations; a block without unknowns
that anything reads vanishes.
"""

from __future__ import annotations

from dataclasses import replace

from codegen.ir.program import Assign, Program, Solve, Statement
from codegen.ir.values import Var


def run(program: Program) -> Program:
    """Return the program without dead assignments, unknowns and blocks."""
    live: set[Var] = {var for _, var in program.outputs}
    kept: list[Statement] = []
    for statement in reversed(program.body):
        if isinstance(statement, Assign):
            if live.intersection(statement.targets):
                live.update(statement.args)
                kept.append(statement)
            continue
        kept += reversed(_trim(statement, live))
    return replace(program, body=tuple(reversed(kept)))


def _trim(block: Solve, live: set[Var]) -> tuple[Statement, ...]:
    """Keep the body assignments that are live, adding what they need to ``live``.

    Where none of them depends on an unknown there is nothing to solve, and they stand alone.
    """
    image = dict(zip(block.unknowns, block.images, strict=True))
    residual = dict(zip(block.unknowns, block.residuals, strict=False))
    maker = {target: assign for assign in block.body for target in assign.targets}
    wanted = [v for v in (*block.unknowns, *maker) if v in live]
    needed: set[Var] = set()
    # A live unknown needs its image, and the image whatever it is computed from.
    while wanted:
        var = wanted.pop()
        if var in needed:
            continue
        needed.add(var)
        live.add(var)
        if var in image:
            wanted.append(image[var])
            wanted.extend([residual[var]] if var in residual else [])
        elif var in maker:
            wanted.extend(maker[var].args)
    pairs = list(zip(block.unknowns, block.starts, block.images, strict=True))
    pairs = [p for p in pairs if p[0] in needed]
    kept = tuple(residual[u] for u in block.unknowns if u in needed and u in residual)
    body = tuple(a for a in block.body if needed.intersection(a.targets))
    if not pairs:
        return body
    unknowns, starts, images = zip(*pairs, strict=True)
    live.update(starts)
    return (replace(block, unknowns=unknowns, starts=starts, images=images, body=body, residuals=kept),)
