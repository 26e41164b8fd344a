"""The depth of a kernel: the length of its longest chain of rotation angles.

In such a chain each angle is computed from the previous angle. Each link of the chain multiplies the rounding
errors. The largest angle that a step accepts therefore depends on the depth
(:func:`codegen.snippets.stumpff.limit`).
"""

from __future__ import annotations

from collections.abc import Mapping

from codegen.ir.expr import Expr, walk
from codegen.ir.kernel import Kernel, Let


def chain(kernel: Kernel) -> int:
    """Return the depth of a kernel: the largest number of nested Stumpff functions, but at least 1.

    A kernel with implicit equations has depth 1, because the solution of the equations does not multiply
    earlier rounding errors. The depth is also 1 if a run joins the last flow of each step with the first flow
    of the next step.

    >>> from codegen.ir.expr import Space
    >>> space = Space()
    >>> x = space.call("stumpff1", space.sym("h"))
    >>> body = (Let("x", x), Let("y", space.call("stumpff1", x * x) + x))
    >>> chain(Kernel("step", (), ("h",), body, (space.sym("y"),)))
    2
    """
    if kernel.loops or kernel.deferred is not None:
        return 1
    # In a kernel each name is assigned before it is read, so its depth is known when it is read.
    depths: dict[str, int] = {}
    for statement in kernel.body:
        if isinstance(statement, Let):
            depths[statement.name] = _depth(statement.value, depths)
    # Only the depths of the outputs are used, because other values do not affect the new state. The depth is
    # at least 1, because the bound of the angle is divided by the depth.
    return max([1, *(_depth(x, depths) for x in kernel.outputs)])


def _depth(root: Expr, depths: Mapping[str, int]) -> int:
    """Return the depth of an expression. ``depths`` contains the depths of its symbols."""
    by_node: dict[int, int] = {}
    for node in walk([root]):
        # walk yields the arguments of a node before the node.
        below = max((by_node[a.id] for a in node.args), default=0)
        # Inputs have depth 0, because the state is assumed to be exact.
        if node.op == "sym":
            below = depths.get(node.payload, 0)
        # Derivatives of Stumpff functions (slopes) add nothing, because formulas with a slope also contain a
        # Stumpff function of the same angle.
        by_node[node.id] = below + (node.op == "call" and "stumpff" in node.payload)
    return by_node[root.id]
