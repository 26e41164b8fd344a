"""Expressions in order: assignments for what is shared or long, loops for blocks of equations.

What depends on the unknowns of a block and is needed for its images goes inside its loop, what does not
depend on them before it. Values of a loop's body that are needed later are those of its last sweep. What only
the starting values of loops need stands apart, for a step that follows others begins from their solutions.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

from codegen.ir.expr import Expr, walk
from codegen.ir.kernel import Let, Loop, Newton, Start
from codegen.kernel.equations import WEIGHT, Block

INLINE = 10
"""Largest number of operations spelled in one assignment: longer expressions get names on the way."""


@dataclass
class Assignments:
    """Orders expressions into assignments and loops, naming what is shared or long."""

    blocks: Sequence[Block]
    roots: Sequence[Expr]
    hints: dict[int, str]
    name: Callable[[str], str]
    remembers: bool = True
    body: list[Let | Start | Loop] = field(default_factory=list)
    outputs: tuple[Expr, ...] = ()
    count: int = 0

    def run(self) -> tuple[Let | Start | Loop, ...]:
        """Return the kernel's body and set ``outputs``."""
        self._prepare()
        if self.blocks and self.remembers:
            self.body.append(self._start())
        for k, block in enumerate(self.blocks):
            inside: list[Let] = []
            own = () if self.remembers else block.starts
            starts = tuple(self._place(x, self.body, [], -1) for x in own)
            before = self._newton(block) if block.leading else None
            images = tuple(self._place(x, self.body, inside, k) for x in block.images)
            read = {n.payload for n in walk([*self.roots, *self._later(k)]) if n.op == "sym"}
            for name, x in block.kept:
                if name in read:
                    value = self._place(x, self.body, inside, k)
                    inside.append(Let(name, value))
            matrix = self._newton(block) if block.matrix and not block.leading else before
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
                read_anew=recomputed,
            )
            self.body.append(loop)
        self.outputs = tuple(self._place(x, self.body, [], -1) for x in self.roots)
        return tuple(self.body)

    def _prepare(self) -> None:
        """Find for each node how often it is used and the last block whose unknowns it depends on."""
        owner = {u: k for k, block in enumerate(self.blocks) for u in block.unknowns}
        entries = [x for b in self.blocks for row in b.matrix for x in row]
        roots = [x for b in self.blocks for x in (*b.starts, *b.targets())] + entries + list(self.roots)
        self.uses: dict[int, int] = {}
        self.level: dict[int, int] = {}
        self.done: dict[int, Expr] = {}
        self.size: dict[int, int] = {}
        for root in roots:
            self.uses[root.id] = self.uses.get(root.id, 0) + 1
        for node in walk(roots):
            for arg in node.args:
                self.uses[arg.id] = self.uses.get(arg.id, 0) + 1
            levels = [self.level[a.id] for a in node.args]
            own = owner.get(node.payload, -1) if node.op == "sym" else -1
            self.level[node.id] = max([own, *levels])

    def _start(self) -> Start:
        """Return the starting values of all blocks; what others need too is assigned before."""
        later = {n.id: n for n in walk([*(x for b in self.blocks for x in b.targets()), *self.roots])}
        values = [x for block in self.blocks for x in block.starts]
        if any(self.level[x.id] >= 0 for x in values):
            raise AssertionError("a block starts from the unknowns of another")
        for node in walk(values):
            if node.id in later and node.args:
                self._place(node, self.body, [], -1)
        own: list[Let] = []
        placed = tuple(self._place(x, own, [], -1) for x in values)
        self.done = {n: x for n, x in self.done.items() if n in later}
        return Start(tuple(u for b in self.blocks for u in b.unknowns), tuple(own), placed)

    def _newton(self, block: Block) -> Newton:
        """Return Newton's matrix; what is not assigned yet is assigned where it is made."""
        before, own = dict(self.done), list[Let]()
        rows = tuple(tuple(self._place(x, own, [], -1) for x in row) for row in block.matrix)
        self.done = before
        compared = bool(block.changes)
        return Newton(tuple(own), rows, block.leading, block.inverted, compared, block.changes)

    def _later(self, k: int) -> list[Expr]:
        return [x for b in self.blocks[k + 1 :] for x in b.targets()]

    def _is_short(self, k: int) -> bool:
        """Whether what is read of block k after it costs less than half of a sweep."""
        rest = [*self._later(k), *self.roots]
        return self._work(rest, k) < self._work(self.blocks[k].images, k) / 2

    def _work(self, roots: Iterable[Expr], k: int) -> int:
        """Return the weight of the nodes below roots that depend on the unknowns of block k and no later."""
        nodes = (n for n in walk(roots) if self.level[n.id] == k and n.args)
        return sum(WEIGHT.get(n.op, 1) for n in nodes)

    def _forget(self, k: int) -> None:
        """Let nothing after block k read what its sweeps compute."""
        nodes = walk([x for b in self.blocks for x in b.targets()] + list(self.roots))
        for node in nodes:
            if self.level[node.id] == k and node.args:
                self.done.pop(node.id, None)

    def _place(self, root: Expr, outer: list[Any], inner: list[Let], loop: int) -> Expr:
        """Return root with every named part replaced by its symbol, appending the assignments it needs."""
        for node in walk([root], stop=lambda n: n.id in self.done):
            if node.id in self.done:
                continue
            target = inner if loop >= 0 and self.level[node.id] == loop else outer
            args = tuple(self.done[a.id] for a in node.args)
            rebuilt = node.space._make(node.op, args, node.payload) if node.args else node
            size = 1 + sum(self.size.get(a.id, 0) for a in args) if node.args else 0
            crosses = loop >= 0 and target is outer
            shared = self.uses[node.id] > 1 or size >= INLINE or crosses
            trivial = not node.args or (node.op == "neg" and not args[0].args)
            if shared and not trivial:
                symbol = self._let(node, rebuilt, target)
                self.done[node.id] = symbol
            else:
                self.done[node.id] = rebuilt
                self.size[rebuilt.id] = size
        return self.done[root.id]

    def _let(self, node: Expr, value: Expr, target: list[Any]) -> Expr:
        hint = self.hints.get(node.id)
        self.count += hint is None
        name = self.name(hint or f"w{self.count}")
        target.append(Let(name, value))
        return node.space.sym(name)
