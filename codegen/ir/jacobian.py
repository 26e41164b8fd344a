"""Jacobians of expressions by elimination of vertices: exact, and cheaper than one column after another.

The expressions form a graph whose edges carry partial derivatives. Taking a vertex out multiplies each edge
into it with each edge out of it; when only the variables and the results are left, the edges between them are
the Jacobian. In which order vertices go decides how much is multiplied: the one on the fewest paths comes
next (Markowitz's rule; Griewank and Walther, Evaluating Derivatives, ch. 10). Forward and reverse
differentiation are two of these orders, seldom the best.
"""

from __future__ import annotations

import heapq
from collections.abc import Sequence

from codegen.ir.differentiate import partials
from codegen.ir.expr import Expr, walk


def jacobian(roots: Sequence[Expr], symbols: Sequence[str]) -> tuple[tuple[Expr, ...], ...]:
    """Return d roots[i] / d symbols[j], a row for each root, in the roots' space.

    :class:`codegen.ir.differentiate.NotDifferentiable` where a function has no derivative.

    >>> from codegen.ir.expr import Space
    >>> s = Space(); x, y = s.sym("x"), s.sym("y")
    >>> jacobian([x * y, x + 2 * y], ["x", "y"])
    ((y, x), (1, 2))
    """
    # Columns are found by number, since a variable that no root reads has no vertex.
    space = roots[0].space
    columns = {space.sym(name).id: j for j, name in enumerate(symbols)}
    graph = _Graph(roots, columns)
    graph.eliminate()
    matrix = [[space.zero] * len(symbols) for _ in roots]
    for i in range(len(roots)):
        for source, factor in graph.before[-1 - i].items():
            # Only variables are left before a result: all inner vertices are gone.
            matrix[i][columns[source]] = factor
    return tuple(tuple(row) for row in matrix)


class _Graph:
    """The linearised expressions: ``before[v][u]`` and ``after[u][v]`` are the edge from u to v.

    Vertices are the ids of nodes that depend on a variable; results are -1, -2, ... so that a node may be a
    result and an argument of another node.
    """

    def __init__(self, roots: Sequence[Expr], columns: dict[int, int]) -> None:
        self.before: dict[int, dict[int, Expr]] = {}
        self.after: dict[int, dict[int, Expr]] = {u: {} for u in columns}
        self.inner: list[int] = []
        for node in walk(roots):
            # A variable is a source: it keeps its edges and is never taken out.
            if node.id in columns:
                continue
            # Nodes that depend on no variable never enter the graph: their derivatives are zero.
            if any(a.id in self.after for a in node.args):
                self.inner.append(node.id)
                self.before[node.id], self.after[node.id] = {}, {}
                for arg, factor in zip(node.args, partials(node), strict=True):
                    self._add(arg.id, node.id, factor)
        for i, root in enumerate(roots):
            self.before[-1 - i] = {}
            # A result that is a variable or an inner node is joined to it by an edge with the derivative 1.
            self._add(root.id, -1 - i, root.space.one)

    def _add(self, u: int, v: int, factor: Expr) -> None:
        # u depends on no variable.
        if u not in self.after:
            return
        old = self.before[v].get(u)
        # Parallel edges are one: path contributions to a derivative add up.
        total = factor if old is None else old + factor
        # An edge that cancels must go, or the costs below would count paths that carry nothing.
        if total.is_zero:
            self.before[v].pop(u, None)
            self.after[u].pop(v, None)
        else:
            self.before[v][u] = self.after[u][v] = total

    def _cost(self, v: int) -> int:
        """Return how many paths lead through v."""
        return len(self.before[v]) * len(self.after[v])

    def eliminate(self) -> None:
        """Take out every inner vertex, the cheapest first, among equals the one nearest to the results."""
        # Minus the number: among equal costs the youngest
        # vertex is the first, which is nearest to the results.
        queue = [(self._cost(v), -v) for v in self.inner]
        heapq.heapify(queue)
        # A vertex may have several entries in the queue; the first that is valid counts.
        gone: dict[int, bool] = {}
        while queue:
            cost, negative = heapq.heappop(queue)
            v = -negative
            if v in gone:
                continue
            now = self._cost(v)
            # Entries may be out of date. A cost that has grown is entered again; one that has fallen was
            # entered by the elimination that lowered it.
            if now > cost:
                heapq.heappush(queue, (now, negative))
                continue
            gone[v] = True
            neighbours = self._take_out(v)
            for u in neighbours:
                # Variables have no incoming and results no outgoing edges: neither may be taken out.
                if u in self.before and u in self.after:
                    heapq.heappush(queue, (self._cost(u), -u))

    def _take_out(self, v: int) -> list[int]:
        # The vertex leaves both tables first: products below must not find edges to it.
        ins, outs = self.before.pop(v), self.after.pop(v)
        for u in ins:
            del self.after[u][v]
        for w in outs:
            del self.before[w][v]
        for w, second in outs.items():
            for u, first in ins.items():
                # The chain rule: dw/du gains dw/dv dv/du.
                self._add(u, w, second * first)
        return [*ins, *outs]
