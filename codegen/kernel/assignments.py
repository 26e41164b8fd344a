"""Converts expressions to ordered statements: assignments and loops.

Shared and long expressions become assignments, and blocks of implicit equations become loops. A sweep is one
execution of the body of a loop. A loop contains the expressions that depend on its unknowns.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

from codegen.ir.expr import Expr, walk
from codegen.ir.kernel import Let, Loop, Newton, Start
from codegen.kernel.equations import WEIGHT, Block

INLINE = 10
"""An expression with at least this number of operations gets a name.

The method vcg:triple_jump on the scene heavy_top has 265 assignments for ``INLINE`` = 5, 199 for 10, and 187
for 20.
"""


def unique_name(base: str, taken: set[str]) -> str:
    """Append underscores to ``base`` until the name is new. The new name is added to ``taken``.

    >>> taken = {"x"}
    >>> unique_name("x", taken), unique_name("x", taken)
    ('x_', 'x__')
    """
    while base in taken:
        base += "_"
    taken.add(base)
    return base


@dataclass
class Assignments:
    """Converts expressions to ordered assignments and loops.

    - ``roots`` are the expressions of the outputs.
    - ``hints`` maps the ids of expressions to preferred names, and ``name`` makes a name unique.
    - ``remembers`` is true if a step can use the solutions of earlier steps as initial guesses.
    """

    blocks: Sequence[Block]
    roots: Sequence[Expr]
    hints: dict[int, str]
    name: Callable[[str], str]
    remembers: bool = True
    body: list[Let | Start | Loop] = field(default_factory=list)
    outputs: tuple[Expr, ...] = ()
    count: int = 0

    def run(self) -> tuple[Let | Start | Loop, ...]:
        """Return the body of the kernel, and store the output expressions in ``self.outputs``."""
        # ``_prepare`` counts how often each value is used in the whole step.
        self._prepare()
        if self.blocks and self.remembers:
            self.body.append(self._start())
        for k, block in enumerate(self.blocks):
            # Values that depend on the unknowns of loop k are collected in ``inside``, all others in
            # ``self.body``.
            inside: list[Let] = []
            # If ``remembers`` is true, the ``Start`` statement sets the initial values of all loops.
            # Otherwise, each loop sets its own initial values.
            own = () if self.remembers else block.starts
            starts = tuple(self._place(x, self.body, [], -1) for x in own)
            # If ``block.leading`` is true, Newton's matrix is computed before the first sweep.
            before = self._newton(block) if block.leading else None
            images = tuple(self._place(x, self.body, inside, k) for x in block.images)
            # A value of ``block.kept`` is assigned only if a later expression reads it.
            read = {n.payload for n in walk([*self.roots, *self._later(k)]) if n.op == "sym"}
            for name, x in block.kept:
                if name in read:
                    value = self._place(x, self.body, inside, k)
                    inside.append(Let(name, value))
            matrix = self._newton(block) if block.matrix and not block.leading else before
            # If ``recomputed`` is true, the code after the loop computes the values of the loop body again,
            # from the final unknowns.
            recomputed = matrix is not None and (matrix.residuals or self._is_short(k))
            if recomputed:
                self._forget(k)
            loop = Loop(
                block.label,
                block.unknowns,
                starts,
                tuple(inside),
                images,
                newton=matrix,
                only_unknowns_read=recomputed,
            )
            self.body.append(loop)
        # The outputs may use values from every loop, so they are placed after all loops.
        self.outputs = tuple(self._place(x, self.body, [], -1) for x in self.roots)
        return tuple(self.body)

    def _prepare(self) -> None:
        """Count the uses of each node (subexpression), and compute the level of the node.

        The level is the largest k for which the node contains unknowns of ``blocks[k]``. Without unknowns,
        the level is -1.
        """
        owner = {u: k for k, block in enumerate(self.blocks) for u in block.unknowns}
        entries = [x for b in self.blocks for row in b.matrix for x in row]
        # The uses of a node are its occurrences as an argument and its occurrences in ``roots``.
        roots = [x for b in self.blocks for x in (*b.starts, *b.targets())] + entries + list(self.roots)
        self.uses: dict[int, int] = {}
        self.level: dict[int, int] = {}
        # ``done`` maps a node to the expression that replaces it, and ``size`` counts the operations of this
        # expression.
        self.done: dict[int, Expr] = {}
        self.size: dict[int, int] = {}
        for root in roots:
            self.uses[root.id] = self.uses.get(root.id, 0) + 1
        # ``walk`` yields the arguments of a node before the node, so the levels of the arguments are known.
        for node in walk(roots):
            for arg in node.args:
                self.uses[arg.id] = self.uses.get(arg.id, 0) + 1
            levels = [self.level[a.id] for a in node.args]
            own = owner.get(node.payload, -1) if node.op == "sym" else -1
            self.level[node.id] = max([own, *levels])

    def _start(self) -> Start:
        """Return the statement that sets the first values of all unknowns."""
        # ``later`` contains the subexpressions that the loops and the outputs use.
        later = {n.id: n for n in walk([*(x for b in self.blocks for x in b.targets()), *self.roots])}
        values = [x for block in self.blocks for x in block.starts]
        # This statement precedes all loops, so ``values`` must not depend on unknowns.
        if any(self.level[x.id] >= 0 for x in values):
            raise AssertionError("the initial guess of an iteration depends on unknowns")
        for node in walk(values):
            # A step may skip the ``Start`` statement, but the loops and the outputs still read the nodes in
            # ``later``. Therefore these nodes are assigned before the ``Start`` statement.
            if node.id in later and node.args:
                self._place(node, self.body, [], -1)
        own: list[Let] = []
        placed = tuple(self._place(x, own, [], -1) for x in values)
        # A step may skip the assignments in ``own``, so other statements must not read the variables that
        # ``own`` assigns. The next line removes these variables from ``self.done``. The nodes in ``later``
        # remain, because the loop above assigned them before the ``Start`` statement.
        self.done = {n: x for n, x in self.done.items() if n in later}
        return Start(tuple(u for b in self.blocks for u in b.unknowns), tuple(own), placed)

    def _newton(self, block: Block) -> Newton:
        """Return the matrix of Newton's method for ``block``, and the assignments that compute it."""
        # Other statements must not read the variables that are assigned in ``own``. ``_place`` adds these
        # variables to ``done``, so the old ``done`` is restored below.
        before, own = dict(self.done), list[Let]()
        rows = tuple(tuple(self._place(x, own, [], -1) for x in row) for row in block.matrix)
        self.done = before
        compared = bool(block.changes)
        return Newton(tuple(own), rows, block.leading, block.inverted, compared, block.changes)

    def _later(self, k: int) -> list[Expr]:
        return [x for b in self.blocks[k + 1 :] for x in b.targets()]

    def _is_short(self, k: int) -> bool:
        """Return True if it is cheap to compute values of loop k again after the loop.

        Later loops and the outputs read some values of loop k. The computation of these values is cheap if
        its cost is less than half the cost of one iteration of loop k.
        """
        rest = [*self._later(k), *self.roots]
        return self._work(rest, k) < self._work(self.blocks[k].images, k) / 2

    def _work(self, roots: Iterable[Expr], k: int) -> int:
        """Return the cost of the operations in ``roots`` that depend on the unknowns of loop k.

        Operations that also depend on the unknowns of a later loop are not counted.
        """
        nodes = (n for n in walk(roots) if self.level[n.id] == k and n.args)
        return sum(WEIGHT.get(n.op, 1) for n in nodes)

    def _forget(self, k: int) -> None:
        """Delete the values of loop k from ``done``."""
        nodes = walk([x for b in self.blocks for x in b.targets()] + list(self.roots))
        for node in nodes:
            # If ``node`` is a symbol or a number, ``node.args`` is empty, and the entry of ``node`` in
            # ``done`` is kept.
            if self.level[node.id] == k and node.args:
                self.done.pop(node.id, None)

    def _place(self, root: Expr, outer: list[Any], inner: list[Let], loop: int) -> Expr:
        """Return ``root`` with names in place of long subexpressions and of repeated subexpressions.

        New assignments that depend on the unknowns of loop ``loop`` are appended to ``inner``, all others to
        ``outer``.
        """
        # The traversal is not recursive, because expressions may be nested deeply.
        for node in walk([root], stop=lambda n: n.id in self.done):
            if node.id in self.done:
                continue
            # Only values that depend on the unknowns are computed in the loop (loop-invariant code motion).
            target = inner if loop >= 0 and self.level[node.id] == loop else outer
            args = tuple(self.done[a.id] for a in node.args)
            # ``_make`` does not simplify, because a simplified formula could have different rounding errors.
            rebuilt = node.space._make(node.op, args, node.payload) if node.args else node
            # An argument that is only a name adds no operations to ``size``.
            size = 1 + sum(self.size.get(a.id, 0) for a in args) if node.args else 0
            # A value that is computed before the loop and read inside gets a name.
            crosses = loop >= 0 and target is outer
            shared = self.uses[node.id] > 1 or size >= INLINE or crosses
            # The negative of a symbol costs nothing in all target languages, so it gets no name.
            trivial = not node.args or (node.op == "neg" and not args[0].args)
            if shared and not trivial:
                # A symbol contains no operations, so it needs no entry in ``size``.
                symbol = self._let(node, rebuilt, target)
                self.done[node.id] = symbol
            else:
                self.done[node.id] = rebuilt
                self.size[rebuilt.id] = size
        return self.done[root.id]

    def _let(self, node: Expr, value: Expr, target: list[Any]) -> Expr:
        hint = self.hints.get(node.id)
        # Only values without a preferred name get the names w1, w2, ....
        self.count += hint is None
        name = self.name(hint or f"w{self.count}")
        target.append(Let(name, value))
        return node.space.sym(name)
