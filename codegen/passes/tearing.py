"""Tearing: remove unknowns that can be computed directly from the other unknowns.

The pass is exact. The image of an unknown is the right-hand side of its fixed-point equation. If the image
does not depend on the unknown, the pass replaces the unknown by its image and removes the equation.
"""

from __future__ import annotations

from dataclasses import replace

from codegen.ir.program import Assign, Program, Solve, Statement
from codegen.ir.values import Kind, Var


def run(program: Program) -> Program:
    """Return the program without the unknowns that can be computed from other unknowns."""
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
        # Velocities (unknowns with values in the Lie algebra, ``Kind.ALG``) come last in this order, so the
        # loop removes other unknowns first. Velocities should remain unknowns, because their extrapolated
        # start values are the most accurate.
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
    """Return the block without ``unknown``, or None if the unknown cannot be removed.

    The unknown is replaced by its image, the right-hand side of its equation.
    """
    image = dict(zip(block.unknowns, block.images, strict=True))[unknown]
    # ``unknown`` is not removed in two cases:
    # - ``unknown`` is the only unknown of the block. A block needs at least one unknown.
    # - ``image`` is itself an unknown. A later call could remove ``image``, but the program would still read
    #   ``image`` in place of ``unknown``.
    if len(block.unknowns) == 1 or image in block.unknowns:
        return None

    def now(variables: tuple[Var, ...]) -> tuple[Var, ...]:
        return tuple(image if v == unknown else v for v in variables)

    body = ordered(tuple(replace(a, args=now(a.args)) for a in block.body))
    # ``body`` is None if ``image`` depends on ``unknown``.
    if body is None:
        return None
    kept = [
        (u, s, i) for u, s, i in zip(block.unknowns, block.starts, block.images, strict=True) if u != unknown
    ]
    unknowns, starts, images = zip(*kept, strict=True)
    # ``images`` may also contain ``unknown``, so ``unknown`` is replaced there, too.
    return replace(block, unknowns=unknowns, starts=starts, body=body, images=now(images))


def ordered(body: tuple[Assign, ...]) -> tuple[Assign, ...] | None:
    """Return the assignments in an order in which each value is defined before it is read.

    The result is None if the assignments depend on each other in a cycle.
    """
    maker = {target: k for k, assign in enumerate(body) for target in assign.targets}
    result: list[Assign] = []
    # ``state[k]`` is False while ``place(k)`` runs, and True after ``body[k]`` is placed. If ``body[k]``
    # depends on its own result, ``place(k)`` is called a second time while the first call runs. The second
    # call then returns ``state[k]``, which is False.
    state: dict[int, bool] = {}

    def place(k: int) -> bool:
        if k in state:
            return state[k]
        state[k] = False
        # The assignments that compute the arguments of ``body[k]`` are placed before ``body[k]``.
        if not all(place(maker[a]) for a in body[k].args if a in maker):
            return False
        state[k] = True
        result.append(body[k])
        return True

    return tuple(result) if all(place(k) for k in range(len(body))) else None
