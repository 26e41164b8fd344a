"""Remove dead code: values on which no output of the program depends.

The outputs of the program do not change. A value is live if an output depends on it. An unknown that is not
live is removed together with its equation.
"""

from __future__ import annotations

from dataclasses import replace

from codegen.ir.program import Assign, Program, Solve, Statement
from codegen.ir.values import Var


def run(program: Program) -> Program:
    """Return the program without dead code."""
    live: set[Var] = {var for _, var in program.outputs}
    kept: list[Statement] = []
    # The loop runs backwards: when it reaches an assignment, it knows which later statements read the result.
    for statement in reversed(program.body):
        if isinstance(statement, Assign):
            # If one result of an operation is live, all its results are kept, because they are computed
            # together.
            if live.intersection(statement.targets):
                live.update(statement.args)
                kept.append(statement)
            continue
        # The statements in ``kept`` are in reverse order.
        kept += reversed(_trim(statement, live))
    return replace(program, body=tuple(reversed(kept)))


def _trim(block: Solve, live: set[Var]) -> tuple[Statement, ...]:
    """Return ``block`` without dead code, and add all needed variables to ``live``."""
    image = dict(zip(block.unknowns, block.images, strict=True))
    # The tuple ``residuals`` is either empty or as long as ``unknowns``.
    residual = dict(zip(block.unknowns, block.residuals, strict=False))
    maker = {target: assign for assign in block.body for target in assign.targets}
    wanted = [v for v in (*block.unknowns, *maker) if v in live]
    needed: set[Var] = set()
    # If an unknown is live, the right-hand side of its equation (``image``) is live, too.
    while wanted:
        var = wanted.pop()
        # In implicit equations a value can depend on itself.
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
    # Each unknown is removed together with its equation.
    pairs = [p for p in pairs if p[0] in needed]
    kept = tuple(residual[u] for u in block.unknowns if u in needed and u in residual)
    body = tuple(a for a in block.body if needed.intersection(a.targets))
    if not pairs:
        return body
    unknowns, starts, images = zip(*pairs, strict=True)
    # The returned block reads these start values.
    live.update(starts)
    return (replace(block, unknowns=unknowns, starts=starts, images=images, body=body, residuals=kept),)
