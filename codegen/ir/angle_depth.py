"""The depth of a step: the length of its longest chain of rotation angles.

In such a chain, each angle is computed from a Stumpff function of the previous angle. Examples of Stumpff
functions of an angle x are cos x and (sin x)/x. A rotation by a large angle amplifies the rounding errors of
the previous rotations. The largest permitted angle therefore depends on the length of the chain
(:func:`codegen.snippets.stumpff.limit`).
"""

from __future__ import annotations

from collections.abc import Mapping

from codegen.ir.expr import Expr, walk
from codegen.ir.kernel import Kernel, Let


def chain(kernel: Kernel) -> int:
    """Return the depth of a step.

    The depth is the largest number of nested Stumpff functions, and at least 1.

    In two cases the expressions are not examined, and the result is 1:

    - The kernel solves implicit equations by iteration.
    - The kernel is a step of a splitting method with deferred flows (:class:`codegen.ir.kernel.Deferred`).

    >>> from codegen.ir.expr import Space
    >>> space = Space()
    >>> x = space.call("stumpff1", space.sym("h"))
    >>> body = (Let("x", x), Let("y", space.call("stumpff1", x * x) + x))
    >>> chain(Kernel("step", (), ("h",), body, (space.sym("y"),)))
    2
    """
    if kernel.loops or kernel.deferred is not None:
        return 1
    # The depth of a value is the largest number of nested Stumpff functions in its formula.
    depths: dict[str, int] = {}
    for statement in kernel.body:
        if isinstance(statement, Let):
            depths[statement.name] = _depth(statement.value, depths)
    # The result must be at least 1, because :func:`codegen.snippets.stumpff.limit` divides by the depth.
    return max([1, *(_depth(x, depths) for x in kernel.outputs)])


def _depth(root: Expr, depths: Mapping[str, int]) -> int:
    """Return the largest number of nested Stumpff functions in ``root``.

    ``root`` can contain the names of earlier results of the step. ``depths`` maps each of these names to the
    number of nested Stumpff functions in the formula of the result.
    """
    by_node: dict[int, int] = {}
    for node in walk([root]):
        # ``walk`` yields the arguments before the node, so their depths are known.
        below = max((by_node[a.id] for a in node.args), default=0)
        # The inputs of the step (for example the old state) depend on no angle of this step, so
        # these inputs have depth 0.
        if node.op == "sym":
            below = depths.get(node.payload, 0)
        # Derivatives of Stumpff functions (``slope2`` etc.) are not counted.
        by_node[node.id] = below + (node.op == "call" and "stumpff" in node.payload)
    return by_node[root.id]
