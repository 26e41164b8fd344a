"""Outlining: what a step computes in several places alike becomes one function that is called there.

Operations of a program are joined into trees (:mod:`codegen.kernel.repeated_trees`). Those of one shape,
whose sums have other coefficients and whose operands are others, are one function of those
(:mod:`codegen.kernel.outlined_functions`). Where a part of a result alone is read, only that is computed,
and what it does not depend on is no argument. It is done where a step is long: what is shared between
operations otherwise, such as sine and cosine of one angle, is not shared across calls.

The rewriting is exact. It is verified: the outlined expressions are evaluated at a point beside the others.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from codegen.ir.domain import ExprDomain, FloatDomain
from codegen.ir.expr import Expr, evaluate, walk
from codegen.ir.kernel import Function
from codegen.ir.program import Program
from codegen.ir.verify import IllFormed
from codegen.kernel.outlined_functions import WithFunctions, function, rewritten
from codegen.kernel.repeated_trees import Key, Tree, Trees
from codegen.scene.problem import Problem

LONG, LONG_EXPLICIT = 700, 500
"""A step of fewer assignments is left as it is: one that solves equations, and one that does not.

What an explicit step repeats stands in no loop: it outgrows the cache of instructions sooner."""

WORTH = 0.85
"""What part of its assignments a step may keep at most."""

AGREE = 1e-9
"""Relative difference of values that are the same but for rounding."""

Shape = tuple[Key, tuple[int, ...]]
"""What trees of one function have in common: their key, and the results that are read."""


@dataclass
class Outline:
    """Collects what a program's execution makes, and rewrites expressions by calls."""

    program: Program
    scene: Problem
    domain: ExprDomain
    outlined: list[Function] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.trees = Trees(self.program, self.domain)

    def run(self, roots: Sequence[Expr], owners: Mapping[str, int]) -> list[Expr] | None:
        """Return the roots with calls of ``outlined``; None where nothing is repeated.

        ``owners`` maps the unknowns of blocks to the number of their block.
        """
        self._levels(roots, owners)
        trees = [t for t in self.trees.joined() if self.trees.useful(t)]
        while True:
            chosen = self._chosen(roots, trees)
            if not chosen:
                return None
            found, shapes = self._called(roots, chosen)
            calls: dict[str, int] = {}
            for node in walk(found):
                if node.op == "call" and node.payload.endswith(".0"):
                    calls[node.payload[:-2]] = calls.get(node.payload[:-2], 0) + 1
            if all(calls.get(name, 0) > 1 for name in shapes):
                self._verify(roots, found)
                return found
            kept = [key for name, key in shapes.items() if calls.get(name, 0) > 1]
            trees = [tree for key in kept for tree in chosen[key]]

    def _called(
        self, roots: Sequence[Expr], chosen: Mapping[Shape, list[Tree]]
    ) -> tuple[list[Expr], dict[str, Shape]]:
        """Make the functions; return the roots with calls of them, and the shape of each function."""
        self.outlined.clear()
        calls: dict[int, tuple[str, int, list[Expr]]] = {}
        shapes: dict[str, Shape] = {}
        for key, trees in chosen.items():
            name = f"piece_{1 + len(self.outlined)}"
            shapes[name] = key
            inputs = [self.trees.inputs(tree) for tree in trees]
            fixed = [
                x if x.op == "const" and all(x is y for y in others) else None
                for x, *others in zip(*inputs, strict=True)
            ]
            made, places = function(name, self.trees, trees[0], self.scene, key[1], fixed)
            self.outlined.append(made)
            for tree, flat in zip(trees, inputs, strict=True):
                results = self.trees.results(tree)
                for k, out in enumerate(key[1]):
                    calls.setdefault(results[out].id, (name, k, [flat[p] for p in places]))
        return rewritten(roots, calls, self.domain.space), shapes

    def _levels(self, roots: Sequence[Expr], owners: Mapping[str, int]) -> None:
        results = [x for m in self.trees.made for value in (*m.results, *m.args) for x in value]
        self._level: dict[int, int] = {}
        for node in walk([*roots, *results]):
            own = owners.get(node.payload, -1) if node.op == "sym" else -1
            self._level[node.id] = max([own, *(self._level[a.id] for a in node.args)])

    def _chosen(self, roots: Sequence[Expr], trees: list[Tree]) -> dict[Shape, list[Tree]]:
        """Return the trees that are made functions, by shape and the results that are read."""
        while True:
            read = self._read(roots, trees)
            groups: dict[Shape, list[int]] = {}
            for t in sorted(read):
                if self._even(trees[t], read[t]):
                    groups.setdefault((self.trees.key(trees[t]), tuple(sorted(read[t]))), []).append(t)
            kept = {key: found for key, found in groups.items() if len(found) > 1}
            left = [t for found in kept.values() for t in found]
            if len(left) == len(trees):
                return {key: [trees[t] for t in found] for key, found in kept.items()}
            trees = [trees[t] for t in sorted(left)]

    def _read(self, roots: Sequence[Expr], trees: Sequence[Tree]) -> dict[int, set[int]]:
        """Return which results of which trees are read, by number, where all trees are called."""
        ends: dict[int, tuple[int, int]] = {}
        for t, tree in enumerate(trees):
            for k, x in enumerate(self.trees.results(tree)):
                if x.args and not (x.op == "neg" and not x.args[0].args):
                    ends.setdefault(x.id, (t, k))
        read: dict[int, set[int]] = {}
        seen: set[int] = set()
        entered: set[int] = set()

        def ends_here(node: Expr) -> bool:
            return node.id in ends or node.id in seen

        waiting = list(roots)
        while waiting:
            for node in walk(waiting, ends_here):
                if node.id in ends and node.id not in seen:
                    t, k = ends[node.id]
                    read.setdefault(t, set()).add(k)
                seen.add(node.id)
            fresh = sorted(set(read) - entered)
            entered |= set(fresh)
            waiting = [x for t in fresh for x in self.trees.inputs(trees[t])]
        return read

    def _even(self, tree: Tree, read: set[int]) -> bool:
        """Whether what is read of a tree depends on the same blocks as all that it is given.

        And is younger, as what is computed from it must be: an older one is the result of something else.
        """
        results, inputs = self.trees.results(tree), self.trees.inputs(tree)
        deepest = max(self._level.get(x.id, -1) for x in inputs)
        youngest = max((x.id for x in inputs if x.args), default=-1)
        return all(self._level[results[k].id] == deepest and results[k].id > youngest for k in read)

    def _verify(self, before: Sequence[Expr], after: Sequence[Expr]) -> None:
        """Raise :class:`codegen.ir.verify.IllFormed` where the calls give other values."""
        names = sorted({n.payload for n in walk(before) if n.op == "sym"})
        for attempt in range(1, 9):
            values = {x: 0.3 + 0.2 * math.sin(7.0 * k + attempt) for k, x in enumerate(names)}
            values |= {x: 0.5**attempt for x in names if x == "h"}  # long steps overflow
            try:
                old = evaluate(before, FloatDomain(0.1), values)
                new = evaluate(after, WithFunctions(FloatDomain(0.1), self.outlined), values)
            except (ArithmeticError, ValueError):
                continue
            if not all(map(math.isfinite, old)):
                continue
            scale = max(1.0, *map(abs, old))
            if not all(abs(a - b) <= AGREE * scale for a, b in zip(old, new, strict=True)):
                raise IllFormed(f"outlining changed the meaning of {self.program.name}")
            return
        raise IllFormed(f"outlining of {self.program.name} could not be verified")
