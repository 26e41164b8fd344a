"""The depth of angles: the length of the longest chain of angles, each computed from the one before.

The depth bounds how far a step may turn before no correct digit is left
(:func:`codegen.snippets.stumpff.limit`).
"""

from __future__ import annotations

from collections.abc import Mapping

from codegen.ir.expr import Expr, walk
from codegen.ir.kernel import Kernel, Let


def chain(kernel: Kernel) -> int:
    """Return the largest number of nested Stumpff functions, at least 1.

    A kernel with equations has depth 1: their solution is as accurate as the equations. A kernel with
    deferred
    flows also has depth 1: the next flow does not multiply the error that one flow adds to an angle.

    >>> from codegen.ir.expr import Space
    >>> space = Space()
    >>> x = space.call("stumpff1", space.sym("h"))
    >>> body = (Let("x", x), Let("y", space.call("stumpff1", x * x) + x))
    >>> chain(Kernel("step", (), ("h",), body, (space.sym("y"),)))
    2
    """
    # A loop repeats until its equations hold to rounding, so it does not multiply earlier rounding errors.
    if kernel.loops or kernel.deferred is not None:
        return 1
    # A kernel is single assignment and ordered, so the depth of a name is known before the name is read.
    depths: dict[str, int] = {}
    for statement in kernel.body:
        if isinstance(statement, Let):
            depths[statement.name] = _depth(statement.value, depths)
    # Only outputs count: lost digits do not reach the state if no output reads the value. The bound is
    # divided by the depth, so the depth is at least 1.
    return max([1, *(_depth(x, depths) for x in kernel.outputs)])


def _depth(root: Expr, depths: Mapping[str, int]) -> int:
    """Return the depth of an expression; ``depths`` holds the depths of its symbols."""
    by_node: dict[int, int] = {}
    for node in walk([root]):
        # walk yields the arguments of a node before the node.
        below = max((by_node[a.id] for a in node.args), default=0)
        # Inputs have depth 0: the state is taken to be exact.
        if node.op == "sym":
            below = depths.get(node.payload, 0)
        # The signed functions count too. Slopes do not: they occur in derivatives only, next to functions of
        # the same angle.
        by_node[node.id] = below + (node.op == "call" and "stumpff" in node.payload)
    return by_node[root.id]
