"""Tearing: unknowns that can be computed directly from the other unknowns are removed with their equations.

The pass is exact. An unknown is replaced by its image (the right-hand side of its fixed-point equation) if
the body then has no cycle. Momenta and forces are replaced first, so that velocities remain unknowns.
"""

from __future__ import annotations

from dataclasses import replace

from codegen.ir.program import Assign, Program, Solve, Statement
from codegen.ir.values import Kind, Var


def run(program: Program) -> Program:
    """Return the program in which an unknown is replaced by its image if this creates no cycle."""
    body: list[Statement] = []
    names: dict[Var, Var] = {}

    def now(variables: tuple[Var, ...]) -> tuple[Var, ...]:
        return tuple(names.get(v, v) for v in variables)

    for statement in program.body:
        if isinstance(statement, Assign):
            body.append(replace(statement, args=now(statement.args)))
            continue
        inner = tuple(replace(a, args=now(a.args)) for a in statement.body)
        block = replace(statement, starts=now(statement.starts), body=inner, images=now(statement.images))
        # Velocities are tried last, so that they remain unknowns. The start values of unknowns are
        # extrapolated from earlier steps, and this is most accurate for velocities.
        for unknown in sorted(block.unknowns, key=lambda u: u.kind is Kind.ALG):
            # The search is greedy, because finding the smallest set of unknowns (a minimum feedback vertex
            # set) is NP-hard.
            smaller = _without(block, unknown)
            if smaller is not None:
                names[unknown] = dict(zip(block.unknowns, block.images, strict=True))[unknown]
                block = smaller
        body.append(block)
    outputs = tuple((name, names.get(var, var)) for name, var in program.outputs)
    return replace(program, body=tuple(body), outputs=outputs)


def _without(block: Solve, unknown: Var) -> Solve | None:
    """Return the block with an unknown replaced by its image (the right-hand side of its equation).

    The result is None if the unknown cannot be replaced.
    """
    image = dict(zip(block.unknowns, block.images, strict=True))[unknown]
    # The only unknown of a block cannot be replaced, because its image depends on the unknown itself. An
    # unknown whose image is an unknown is not replaced either.
    if len(block.unknowns) == 1 or image in block.unknowns:
        return None

    def now(variables: tuple[Var, ...]) -> tuple[Var, ...]:
        return tuple(image if v == unknown else v for v in variables)

    body = ordered(tuple(replace(a, args=now(a.args)) for a in block.body))
    # ``body`` is None if the new assignments have a cycle. Then the image depends on the unknown itself, and
    # the unknown is needed.
    if body is None:
        return None
    kept = [
        (u, s, i) for u, s, i in zip(block.unknowns, block.starts, block.images, strict=True) if u != unknown
    ]
    unknowns, starts, images = zip(*kept, strict=True)
    # If another unknown has the removed unknown as its image, this image becomes ``image``.
    return replace(block, unknowns=unknowns, starts=starts, body=body, images=now(images))


def ordered(body: tuple[Assign, ...]) -> tuple[Assign, ...] | None:
    """Return the assignments in an order in which each value is defined before it is read.

    The result is None if the assignments have a cycle.
    """
    maker = {target: k for k, assign in enumerate(body) for target in assign.targets}
    result: list[Assign] = []
    # ``state[k]`` is False while the arguments of assignment k are visited, and True after that. If the visit
    # returns to an assignment whose state is False, there is a cycle.
    state: dict[int, bool] = {}

    def place(k: int) -> bool:
        if k in state:
            return state[k]
        state[k] = False
        # The assignments are visited in their order, so a body that is already sorted does not change.
        if not all(place(maker[a]) for a in body[k].args if a in maker):
            return False
        state[k] = True
        result.append(body[k])
        return True

    return tuple(result) if all(place(k) for k in range(len(body))) else None
