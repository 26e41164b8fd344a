"""Exact Jacobians of expressions by elimination of vertices.

The nodes of the expressions are the vertices of a graph. An edge leads from each argument to the node that
uses the argument. The label of the edge is the partial derivative of the node with respect to the argument.

The elimination removes a vertex v and its edges. For each path u -> v -> w, the product of its two labels is
added to the label of the edge u -> w. A missing edge has the label zero. After all eliminations, the labels
of the edges are the entries of the Jacobian.

The vertex with the lowest cost is eliminated next. The cost of a vertex is the number of incoming edges times
the number of outgoing edges (Markowitz's rule; Griewank and Walther, Evaluating Derivatives, ch. 10).
"""

from __future__ import annotations

import heapq
from collections.abc import Sequence

from codegen.ir.differentiate import partials
from codegen.ir.expr import Expr, walk


def jacobian(roots: Sequence[Expr], symbols: Sequence[str]) -> tuple[tuple[Expr, ...], ...]:
    """Return the matrix of the derivatives d ``roots[i]`` / d ``symbols[j]`` as expressions.

    :class:`codegen.ir.differentiate.NotDifferentiable` is raised if a function has no derivative.

    >>> from codegen.ir.expr import Space
    >>> s = Space(); x, y = s.sym("x"), s.sym("y")
    >>> jacobian([x * y, x + 2 * y], ["x", "y"])
    ((y, x), (1, 2))
    """
    # ``columns`` maps the node number of a variable to the column of the variable.
    space = roots[0].space
    columns = {space.sym(name).id: j for j, name in enumerate(symbols)}
    graph = _Graph(roots, columns)
    graph.eliminate()
    matrix = [[space.zero] * len(symbols) for _ in roots]
    for i in range(len(roots)):
        for source, factor in graph.before[-1 - i].items():
            # All inner vertices are now eliminated, so every edge to a result begins at a variable.
            matrix[i][columns[source]] = factor
    return tuple(tuple(row) for row in matrix)


class _Graph:
    """The graph of the expressions. An edge from u to v means that v depends directly on u. Both
    ``before[v][u]`` and ``after[u][v]`` contain the label of this edge: the partial derivative of v with
    respect to u.

    The vertex -1 - i represents ``roots[i]``. Every other vertex u is the expression with ``id`` u.
    """

    def __init__(self, roots: Sequence[Expr], columns: dict[int, int]) -> None:
        self.before: dict[int, dict[int, Expr]] = {}
        self.after: dict[int, dict[int, Expr]] = {u: {} for u in columns}
        self.inner: list[int] = []
        for node in walk(roots):
            # A variable has no incoming edges and is never eliminated.
            if node.id in columns:
                continue
            # A node without variables is skipped, because all its derivatives are zero.
            if any(a.id in self.after for a in node.args):
                self.inner.append(node.id)
                self.before[node.id], self.after[node.id] = {}, {}
                for arg, factor in zip(node.args, partials(node, self.after), strict=True):
                    self._add(arg.id, node.id, factor)
        for i, root in enumerate(roots):
            self.before[-1 - i] = {}
            # Results have the negative vertex numbers -1, -2, ...
            self._add(root.id, -1 - i, root.space.one)

    def _add(self, u: int, v: int, factor: Expr) -> None:
        # If u depends on no variable, it is not a vertex of the graph, and no edge is added.
        if u not in self.after:
            return
        old = self.before[v].get(u)
        # By the chain rule, the contributions of all paths from u to v are added.
        total = factor if old is None else old + factor
        # An edge with the label zero is removed, because it would increase the costs for no benefit.
        if total.is_zero:
            self.before[v].pop(u, None)
            self.after[u].pop(v, None)
        else:
            self.before[v][u] = self.after[u][v] = total

    def _cost(self, v: int) -> int:
        """Return the number of incoming edges of the vertex v times the number of outgoing edges."""
        return len(self.before[v]) * len(self.after[v])

    def eliminate(self) -> None:
        """Eliminate every inner vertex, the cheapest first. Among vertices of equal cost, the vertex with the
        largest node number comes first.
        """
        # For equal costs, the smallest entry (cost, -v) has the largest v.
        queue = [(self._cost(v), -v) for v in self.inner]
        heapq.heapify(queue)
        # A vertex may have several entries in the queue, because its cost changes.
        gone: dict[int, bool] = {}
        while queue:
            cost, negative = heapq.heappop(queue)
            v = -negative
            if v in gone:
                continue
            now = self._cost(v)
            # If the cost of v has grown, v is put back into the queue with the new cost.
            if now > cost:
                heapq.heappush(queue, (now, negative))
                continue
            gone[v] = True
            neighbours = self._take_out(v)
            # The cost of a vertex depends only on how many edges enter it and how many edges leave it
            # (:meth:`_cost`). The elimination of v changes only edges of the neighbours of v, so only the
            # neighbours get new costs.
            for u in neighbours:
                # Only inner vertices are in both tables. Variables and results are never eliminated.
                if u in self.before and u in self.after:
                    heapq.heappush(queue, (self._cost(u), -u))

    def _take_out(self, v: int) -> list[int]:
        # The vertex v and its edges are removed from the graph.
        ins, outs = self.before.pop(v), self.after.pop(v)
        # The following two loops remove the edges of v from the tables of the neighbours.
        for u in ins:
            del self.after[u][v]
        for w in outs:
            del self.before[w][v]
        for w, second in outs.items():
            for u, first in ins.items():
                # By the chain rule, the term dw/dv dv/du is added to dw/du.
                self._add(u, w, second * first)
        return [*ins, *outs]
