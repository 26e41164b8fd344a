"""From step program to kernel: symbolic execution over expressions, then a schedule of scalar assignments.

Every value becomes a tuple of expressions; hash-consing shares what is equal. A block becomes a loop: what
depends on its unknowns and is needed for its images goes inside, what does not depend on them goes before,
and body values needed later are read where the last sweep left them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from codegen.errors import SceneError
from codegen.groups.actions import LeftMultiplication
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, walk
from codegen.ir.interpret import apply, flatten
from codegen.ir.kernel import ELAPSED, LEAD, Estimate, Field, Kernel, Let, Loop, Sample
from codegen.ir.program import EMBEDDED, FLOWS, FLOWS_FOR, Assign, Kind, Program, Solve, Var
from codegen.lower import late
from codegen.scene import TIME, Setting

INLINE = 10
"""Largest number of operations spelled in one assignment: longer expressions get names on the way."""


@dataclass(frozen=True)
class _Block:
    """A loop before scheduling: names of the unknowns, expressions of starts and images."""

    label: str
    unknowns: tuple[str, ...]
    starts: tuple[Expr, ...]
    images: tuple[Expr, ...]


def to_kernel(program: Program, scene: Setting) -> Kernel:
    """Return the kernel of a program in its setting (:func:`codegen.lower.setting`).

    :class:`codegen.errors.SceneError` where an operation of the group has no closed form.
    """
    domain = ExprDomain()
    space = domain.space
    env: dict[Var, Any] = {}
    hints: dict[int, str] = {}
    blocks: list[_Block] = []
    taken = {*scene.symbols, *scene.runtime, *scene.inputs, "h", TIME, LEAD, ELAPSED}

    def name(base: str) -> str:
        candidate = base if base not in taken else base + "_"
        while candidate in taken:
            candidate += "_"
        taken.add(candidate)
        return candidate

    def remember(var: Var) -> None:
        for k, x in enumerate(flatten(var.kind, env[var])):
            hints.setdefault(x.id, f"{var.name}_{k}" if var.kind is not Kind.REAL else var.name)

    def run(assign: Assign) -> None:
        try:
            results = apply(scene, domain, assign, tuple(env[a] for a in assign.args))
        except ArithmeticError as error:
            raise SceneError(
                f"{assign.operation.name} on {scene.group.name}: {error}",
                where=scene.name,
                expected="a group whose operations have closed forms",
                hint="this group serves exact series and interpretation",
            ) from error
        for target, value in zip(assign.targets, results, strict=True):
            env[target] = value
            remember(target)

    given = tuple(space.sym(s) for s in scene.symbols)
    if scene.body_group is not None:
        given = _framed(scene, given, lambda q, mu: scene.body_group.Adtinv(domain, q, mu))
    starts: dict[str, tuple[Expr, ...]] = {}
    for block in scene.state:
        starts[block.name], given = given[: len(block.symbols)], given[len(block.symbols) :]
    for var in program.inputs:
        env[var] = starts[var.name] if var.name in starts else space.sym(var.name)
    for statement in program.body:
        if isinstance(statement, Assign):
            run(statement)
        else:
            blocks.append(_enter(statement, env, domain, name, run))
    outputs = tuple(x for n, var in program.outputs if n != EMBEDDED for x in flatten(var.kind, env[var]))
    lower = tuple(x for n, var in program.outputs if n == EMBEDDED for x in flatten(var.kind, env[var]))
    if scene.body_group is not None:
        outputs = _framed(scene, outputs, lambda q, mu: scene.body_group.Adt(domain, q, mu))
        lower = lower and _framed(scene, lower, lambda q, mu: scene.body_group.Adt(domain, q, mu))
    composed = any(name in FLOWS | FLOWS_FOR for name in program.counts())
    if composed:
        outputs = late.run(outputs, frozenset({"h", *scene.runtime}))
    errors = tuple(x - y for x, y in zip(outputs, lower, strict=True)) if lower else ()
    schedule = _Schedule(blocks, (*outputs, *errors), hints, name)
    state = tuple(Field(b.name, b.symbols, _meaning(b.kind, scene)) for b in scene.state)
    if scene.body_group is not None:
        state = _body_fields(scene)
    durations = [v.name for v in program.inputs if v.name in (LEAD, ELAPSED)]
    scalars = (TIME, "h", *scene.runtime, *durations)
    body = schedule.run()
    if composed:
        body = late.ordered([let for let in body if isinstance(let, Let)])
    made = Kernel(program.name, state, scalars, body, outputs=schedule.outputs[: len(outputs)])
    if errors:
        made = replace(made, estimate=Estimate(schedule.outputs[len(outputs) :], 0))
    return _sampled(made, scene, domain)


def _sampled(kernel: Kernel, scene: Setting, domain: ExprDomain) -> Kernel:
    """Return the kernel with the samples of run-time inputs that it reads."""
    read = {n.payload for n in walk(kernel.expressions()) if n.op == "sym"}
    found = [
        Sample(t, tuple(symbols[name].payload for name in scene.inputs))
        for t, symbols in domain.samples.values()
    ]
    samples = tuple(sample for sample in found if read.intersection(sample.symbols))
    return replace(kernel, inputs=scene.inputs if samples else (), samples=samples)


def _framed(
    scene: Setting, state: tuple[Expr, ...], change: Callable[[Any, Any], tuple[Expr, ...]]
) -> tuple[Expr, ...]:
    """Return the coordinates of a state (q, mu) with the momentum changed to that of another frame."""
    q = state[: scene.body_group.size]
    return q + tuple(change(q, state[scene.body_group.size :]))


def _body_fields(scene: Setting) -> tuple[Field, Field]:
    """Return the fields of a state whose momentum is that of the body."""
    group, symbols = scene.body_group, scene.symbols
    return (
        Field("q", symbols[: group.size], f"element of {group.name}{group.layout}"),
        Field(
            "mu",
            symbols[group.size :],
            f"left-trivialised momentum, that of the body, in the dual algebra of {group.name}",
        ),
    )


def _meaning(kind: Kind, scene: Setting) -> str:
    group, action = scene.group, scene.action
    if kind is Kind.DUAL:
        return f"right-trivialised momentum in the dual algebra of {group.name}"
    if kind is Kind.POINT and not isinstance(action, LeftMultiplication):
        return f"point that {group.name} acts on by {action.name}"
    return f"element of {group.name}{group.layout}"


def _enter(
    block: Solve,
    env: dict[Var, Any],
    domain: ExprDomain,
    name: Callable[[str], str],
    run: Callable[[Assign], None],
) -> _Block:
    """Give the unknowns symbols, run the body on them, and return the block."""
    names: list[str] = []
    starts: list[Expr] = []
    for unknown, start in zip(block.unknowns, block.starts, strict=True):
        width = len(flatten(start.kind, env[start]))
        own = [name(f"{unknown.name}_{k}") for k in range(width)]
        symbols = tuple(domain.space.sym(s) for s in own)
        env[unknown] = symbols if unknown.kind is not Kind.REAL else symbols[0]
        names += own
        starts += flatten(start.kind, env[start])
    for assign in block.body:
        run(assign)
    images = [x for v in block.images for x in flatten(v.kind, env[v])]
    return _Block(block.label, tuple(names), tuple(starts), tuple(images))


@dataclass
class _Schedule:
    """Orders expressions into assignments and loops, naming what is shared or long."""

    blocks: Sequence[_Block]
    roots: Sequence[Expr]
    hints: dict[int, str]
    name: Callable[[str], str]
    body: list[Let | Loop] = field(default_factory=list)
    outputs: tuple[Expr, ...] = ()
    count: int = 0

    def run(self) -> tuple[Let | Loop, ...]:
        """Return the kernel's body and set ``outputs``."""
        self._prepare()
        for k, block in enumerate(self.blocks):
            inside: list[Let] = []
            starts = tuple(self._place(x, self.body, [], -1) for x in block.starts)
            images = tuple(self._place(x, self.body, inside, k) for x in block.images)
            self.body.append(Loop(block.label, block.unknowns, starts, tuple(inside), images))
        self.outputs = tuple(self._place(x, self.body, [], -1) for x in self.roots)
        return tuple(self.body)

    def _prepare(self) -> None:
        """Find for each node how often it is used and the last block whose unknowns it depends on."""
        owner = {u: k for k, block in enumerate(self.blocks) for u in block.unknowns}
        roots = [x for b in self.blocks for x in (*b.starts, *b.images)] + list(self.roots)
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
