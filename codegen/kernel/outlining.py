"""Outlining: if a step repeats a computation, the computation becomes a function.

Outlining shortens the code but can add operations, so only long steps are outlined.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from codegen.errors import MethodError
from codegen.ir.domain import ExprDomain, FloatDomain, PreciseDomain
from codegen.ir.expr import Expr, evaluate, walk
from codegen.ir.kernel import Function
from codegen.ir.program import Program
from codegen.ir.verify import IllFormed
from codegen.kernel.outlined_functions import WithFunctions, function, rewritten
from codegen.kernel.repeated_trees import Key, Tree, Trees
from codegen.scene.problem import Problem

LONG, LONG_EXPLICIT = 700, 500
"""Outlining is applied to implicit steps with more than LONG assignments, and to explicit steps with more
than LONG_EXPLICIT assignments.

Outlining shortens a step of cg:cg5 on dipole from 2345 to 545 lines, and the step then takes a third less
time.

To choose new limits, run ``orderconds bench dipole`` with the old limits and with both limits 0.
"""

WORTH = 0.85
"""Let n be the number of assignments of a step, and m the number of assignments after outlining. The step is
outlined only if m < WORTH n.

The ratio m/n is between 0.23 and 0.5 for ``cg:cg5``, ``vcg:gauss3`` and ``rkmk(4):butcher6`` on dipole, and
for ``vcg:gauss4`` on heavy_top.
"""

AGREE = 1e-9
"""The tolerance in the comparison of the values of a step with and without outlining.

The tolerance is relative to the largest absolute value, or absolute if all values are below 1.
"""

ATTEMPTS, DIGITS = 8, 60
"""The verification tries ATTEMPTS test points in double precision.

If no point gives finite values, the verification tries ATTEMPTS further points with DIGITS decimal digits.
"""

Shape = tuple[Key, tuple[int, ...]]
"""A pair (key, indices) that describes a tree. All trees with the same pair become calls of one function.

A tree is a group of assignments (:class:`Tree`). The last assignment computes the results of the tree.

- The key describes the operations of the tree.
- The indices denote those results of the tree that are read outside the tree.
"""


@dataclass
class Outline:
    """Replaces repeated expressions of a program by calls of functions."""

    program: Program
    scene: Problem
    domain: ExprDomain
    outlined: list[Function] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.trees = Trees(self.program, self.domain)

    def run(self, roots: Sequence[Expr], owners: Mapping[str, int]) -> list[Expr] | None:
        """Replace repeated parts of the expressions ``roots`` by calls of functions, and return the new
        expressions.

        The functions are added to ``outlined``. If nothing is repeated, the result is None. ``owners`` maps
        each unknown of the implicit equations to the index of its block of equations.
        """
        # If a value depends on unknowns of several blocks, its level is the largest index of these blocks.
        self._levels(roots, owners)
        trees = [t for t in self.trees.joined() if self.trees.useful(t)]
        while True:
            chosen = self._chosen(roots, trees)
            if not chosen:
                return None
            rewritten_roots, shapes = self._called(roots, chosen)
            # The new calls can read a symbol x that ``roots`` does not contain. For example, simplification
            # replaces x - x by 0 in ``roots``, but x can still be an input of a call. Emitted code might not
            # define x, so trees whose calls read such a symbol are removed from ``trees``. The list becomes
            # shorter in each repetition, so the loop ends.
            added = _symbols(rewritten_roots) - _symbols(roots)
            if added:
                trees = [
                    tree
                    for function, key in zip(self.outlined, shapes.values(), strict=True)
                    if added.isdisjoint(function.inputs)
                    for tree in chosen[key]
                    if added.isdisjoint(_symbols(self.trees.inputs(tree)))
                ]
                continue
            # Simplification may have removed some of the new calls, so the remaining calls are counted.
            calls: dict[str, int] = {}
            for node in walk(rewritten_roots):
                # A call has one node for each result. Only the node of result 0 is counted.
                if node.op == "call" and node.payload.endswith(".0"):
                    calls[node.payload[:-2]] = calls.get(node.payload[:-2], 0) + 1
            # A function with fewer than two calls saves nothing.
            if all(calls.get(name, 0) > 1 for name in shapes):
                self._verify(roots, rewritten_roots)
                return rewritten_roots
            kept = [key for name, key in shapes.items() if calls.get(name, 0) > 1]
            trees = [tree for key in kept for tree in chosen[key]]

    def _called(
        self, roots: Sequence[Expr], chosen: Mapping[Shape, list[Tree]]
    ) -> tuple[list[Expr], dict[str, Shape]]:
        """Create one function for each entry of ``chosen``.

        In the expressions ``roots``, replace the trees in ``chosen`` by calls of these functions. Return the
        new expressions, and the shape of each function.
        """
        # Functions from an earlier call of this method are discarded.
        self.outlined.clear()
        calls: dict[int, tuple[str, int, list[Expr]]] = {}
        shapes: dict[str, Shape] = {}
        for key, trees in chosen.items():
            name = f"piece_{1 + len(self.outlined)}"
            shapes[name] = key
            inputs = [self.trees.inputs(tree) for tree in trees]
            # If all calls pass the same constant for an input, this constant becomes part of the function.
            fixed = [
                x if x.op == "const" and all(x is y for y in others) else None
                for x, *others in zip(*inputs, strict=True)
            ]
            # The trees in ``trees`` have the same operations, so any of them gives the same function.
            outlined, places, parameters = function(name, self.trees, trees[0], self.scene, key[1], fixed)
            self.outlined.append(outlined)
            constant = [self.domain.space.sym(x) for x in parameters]
            for tree, flat in zip(trees, inputs, strict=True):
                results = self.trees.results(tree)
                for k, out in enumerate(key[1]):
                    # If several trees have the same result, the call for the first of these trees is used.
                    calls.setdefault(results[out].id, (name, k, [*(flat[p] for p in places), *constant]))
        return rewritten(roots, calls, self.domain.space), shapes

    def _levels(self, roots: Sequence[Expr], owners: Mapping[str, int]) -> None:
        # Some arguments and results in ``executions`` do not occur in ``roots``.
        results = [x for m in self.trees.executions for value in (*m.results, *m.args) for x in value]
        self._level: dict[int, int] = {}
        for node in walk([*roots, *results]):
            # The level -1 means that a value depends on no unknowns.
            own = owners.get(node.payload, -1) if node.op == "sym" else -1
            self._level[node.id] = max([own, *(self._level[a.id] for a in node.args)])

    def _chosen(self, roots: Sequence[Expr], trees: list[Tree]) -> dict[Shape, list[Tree]]:
        # Each removal of a tree may change ``read`` for the remaining trees.
        while True:
            read = self._read(roots, trees)
            groups: dict[Shape, list[int]] = {}
            # Trees are visited in the order of the program, so functions are numbered in the order of their
            # first calls.
            for t in sorted(read):
                if self._even(trees[t], read[t]):
                    groups.setdefault((self.trees.key(trees[t]), tuple(sorted(read[t]))), []).append(t)
            kept = {key: alike for key, alike in groups.items() if len(alike) > 1}
            # All trees of one shape become calls of one function. If only one tree has a given shape, the
            # function would have one call and would save nothing. Therefore this tree is removed.
            left = [t for alike in kept.values() for t in alike]
            # If no tree was removed from ``trees``, one more round would find the same groups.
            if len(left) == len(trees):
                return {key: [trees[t] for t in alike] for key, alike in kept.items()}
            trees = [trees[t] for t in sorted(left)]

    def _read(self, roots: Sequence[Expr], trees: Sequence[Tree]) -> dict[int, set[int]]:
        """For each tree, return the indices of those results that are read outside the tree.

        A tree is a group of assignments. The results of the last assignment are the results of the tree. The
        keys of the returned dictionary are the indices of the trees in ``trees``.
        """
        ends: dict[int, tuple[int, int]] = {}
        for t, tree in enumerate(trees):
            for k, x in enumerate(self.trees.results(tree)):
                # Results that are symbols, numbers or their negatives need no function.
                if x.args and not (x.op == "neg" and not x.args[0].args):
                    ends.setdefault(x.id, (t, k))
        read: dict[int, set[int]] = {}
        seen: set[int] = set()
        entered: set[int] = set()

        def ends_here(node: Expr) -> bool:
            return node.id in ends or node.id in seen

        waiting = list(roots)
        while waiting:
            # A function call can replace each tree, so the operations inside the trees are not visited:
            # ``walk`` stops at the results of the trees (the keys of ``ends`` are the ids of these results),
            # and the search continues at the inputs of the trees.
            for node in walk(waiting, ends_here):
                if node.id in ends and node.id not in seen:
                    t, k = ends[node.id]
                    read.setdefault(t, set()).add(k)
                seen.add(node.id)
            # The trees are sorted, because every compilation must visit the nodes in the same order.
            fresh = sorted(set(read) - entered)
            entered |= set(fresh)
            waiting = [x for t in fresh for x in self.trees.inputs(trees[t])]
        return read

    def _even(self, tree: Tree, read: set[int]) -> bool:
        """Return True if one function call can compute all needed results of ``tree``.

        ``read`` contains the indices of the needed results. The function returns True if both conditions are
        satisfied:

        - All needed results are computed in the loop that would contain the call.
        - No input of the call can depend on a needed result.
        """
        results, inputs = self.trees.results(tree), self.trees.inputs(tree)
        # The loop of block ``deepest`` contains the function call. Results that do not depend on the unknowns
        # of this block stay outside the loop.
        deepest = max(self._level.get(x.id, -1) for x in inputs)
        # An expression has a larger id than its operands. Therefore an expression can depend only on
        # expressions with smaller ids. If all inputs have smaller ids than a result, no input depends on this
        # result. Inputs without operands are symbols or numbers, and depend on no result.
        youngest = max((x.id for x in inputs if x.args), default=-1)
        return all(self._level[results[k].id] == deepest and results[k].id > youngest for k in read)

    def _verify(self, before: Sequence[Expr], after: Sequence[Expr]) -> None:
        """Raise :class:`codegen.ir.verify.IllFormed` if the expressions ``after`` have other values than
        ``before``. Raise MethodError if no test point gives finite values of ``before``.
        """
        # The names are sorted, so every verification of a step uses the same test points.
        names = sorted({n.payload for n in walk(before) if n.op == "sym"})
        for attempt in range(1, 1 + 2 * ATTEMPTS):
            # The sine gives irregular values between 0.1 and 0.5 without a random generator.
            values = {x: 0.3 + 0.2 * math.sin(7.0 * k + attempt) for k, x in enumerate(names)}
            # The step size is halved for each new test point, because a smaller step gives finite values more
            # often.
            values |= {x: 0.5**attempt for x in names if x == "h"}
            domain: FloatDomain | PreciseDomain = FloatDomain(0.1)
            # After ATTEMPTS failures in double precision, numbers with a larger range are used.
            if attempt > ATTEMPTS:
                domain = precise = PreciseDomain(0.1, DIGITS)
                values = {x: precise.context.mpf(v) for x, v in values.items()}
            try:
                old = evaluate(before, domain, values)
                new = evaluate(after, WithFunctions(domain, self.outlined), values)
            # If an evaluation fails, for example by a division by zero, ``old`` and ``new`` cannot be
            # compared, and the next test point is tried.
            except (ArithmeticError, ValueError):
                continue
            # The comparison is false for infinities and for NaN.
            if not all(abs(x) < math.inf for x in old):
                continue
            # The largest value is the scale, because cancellation makes the relative errors of small values
            # large.
            scale = max(1.0, *map(abs, old))
            if not all(abs(a - b) <= AGREE * scale for a, b in zip(old, new, strict=True)):
                raise IllFormed(f"outlining changed the results of {self.program.name}")
            return
        raise MethodError(
            f"the step of {self.program.name} computed an infinity or a NaN at every test point",
            expected="coefficients and parameters of moderate size",
        )


def _symbols(roots: Sequence[Expr]) -> set[str]:
    return {node.payload for node in walk(roots) if node.op == "sym"}
