"""Remove dead code: values that neither the new state nor the equations of a block need.

The pass is exact. An unknown that nothing reads is removed from its block together with its equation. If
nothing reads any unknown of a block, the block is replaced by those of its assignments that are still needed.
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
            # If one result of an operation is live, all its results are kept. The operation computes them
            # together, as the Hamiltonian field computes a velocity and a force.
            if live.intersection(statement.targets):
                live.update(statement.args)
                kept.append(statement)
            continue
        # The remaining statements of a block are appended in reverse order, because the list ``kept`` is
        # reversed at the end.
        kept += reversed(_trim(statement, live))
    return replace(program, body=tuple(reversed(kept)))


def _trim(block: Solve, live: set[Var]) -> tuple[Statement, ...]:
    """Return a block with its live assignments only, and add the values that they read to ``live``.

    If no unknown is live, there is nothing to solve, and the live assignments replace the block.
    """
    image = dict(zip(block.unknowns, block.images, strict=True))
    # zip is not strict, because a block has one residual for each unknown, or no residuals.
    residual = dict(zip(block.unknowns, block.residuals, strict=False))
    maker = {target: assign for assign in block.body for target in assign.targets}
    # The values are in a list in the order of the program and not in a set, because the order of a set could
    # differ from run to run.
    wanted = [v for v in (*block.unknowns, *maker) if v in live]
    needed: set[Var] = set()
    # The image of a live unknown is live, and so is every value from which the image is computed.
    while wanted:
        var = wanted.pop()
        # Values of a block may depend on each other in cycles, so the search may reach a value a second time.
        # The value is then skipped.
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
    # The start values are computed before the block, so they are added to ``live``. The start values of
    # removed unknowns are not needed.
    live.update(starts)
    return (replace(block, unknowns=unknowns, starts=starts, images=images, body=body, residuals=kept),)
