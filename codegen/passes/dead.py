"""Remove dead code: values on which neither the new state nor the equations for the new state depend.

The pass is exact. An unknown that nothing reads is removed from its block together with its equation. A block
is removed if nothing reads its unknowns.
"""

from __future__ import annotations

from dataclasses import replace

from codegen.ir.program import Assign, Program, Solve, Statement
from codegen.ir.values import Var


def run(program: Program) -> Program:
    """Return the program without dead assignments, unknowns and blocks."""
    live: set[Var] = {var for _, var in program.outputs}
    kept: list[Statement] = []
    # The loop runs from the last statement to the first, so that all readers of a value are visited before
    # its definition.
    for statement in reversed(program.body):
        if isinstance(statement, Assign):
            # If one result of an operation is live, all its results are kept, because an operation such as
            # the field computes all of them together.
            if live.intersection(statement.targets):
                live.update(statement.args)
                kept.append(statement)
            continue
        # The statements of a block are appended in reverse order, because the whole list is reversed at the
        # end.
        kept += reversed(_trim(statement, live))
    return replace(program, body=tuple(reversed(kept)))


def _trim(block: Solve, live: set[Var]) -> tuple[Statement, ...]:
    """Return a block with its live assignments only, and add the values that they read to ``live``.

    If no live assignment depends on an unknown, there is nothing to solve, and the assignments replace the
    block.
    """
    image = dict(zip(block.unknowns, block.images, strict=True))
    # zip is not strict, because a block has one residual for each unknown, or no residuals.
    residual = dict(zip(block.unknowns, block.residuals, strict=False))
    maker = {target: assign for assign in block.body for target in assign.targets}
    # A list in program order is used, because the order of a set could change from run to run.
    wanted = [v for v in (*block.unknowns, *maker) if v in live]
    needed: set[Var] = set()
    # The image of a live unknown is live, and so is every value from which the image is computed.
    while wanted:
        var = wanted.pop()
        # Values of a block may depend on each other in cycles, so the search may reach a value that it has
        # already visited.
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
    # An unknown that no live value reads is removed together with its equation, so the block has as many
    # equations as unknowns.
    pairs = [p for p in pairs if p[0] in needed]
    kept = tuple(residual[u] for u in block.unknowns if u in needed and u in residual)
    body = tuple(a for a in block.body if needed.intersection(a.targets))
    if not pairs:
        return body
    unknowns, starts, images = zip(*pairs, strict=True)
    # Starts are read outside the block; only the starts of remaining unknowns are live.
    live.update(starts)
    return (replace(block, unknowns=unknowns, starts=starts, images=images, body=body, residuals=kept),)
