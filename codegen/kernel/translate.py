"""From step program to kernel: symbolic execution over expressions, then a schedule of scalar assignments.

Every value becomes a tuple of expressions; hash-consing shares what is equal. A block becomes a loop: what
depends on its unknowns and is needed for its images goes inside, what does not depend on them goes before,
and body values needed later are read where the last sweep left them. What only the starting values of loops
need stands apart, for a step that follows others begins from their solutions.

Of a block solved by Newton's method the matrix 1 - g' is taken from the very expressions of its images g.
After it the unknowns stand for their images, and what follows is computed from them anew where that is less
than half a sweep.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any

from codegen.errors import SceneError
from codegen.ir.collect_constants import gathered
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, Space, walk
from codegen.ir.interpret import flatten
from codegen.ir.kernel import (
    CHORD,
    ELAPSED,
    FIXED_POINT,
    LEAD,
    NEWTON,
    VARIATION,
    VARIED,
    Estimate,
    Field,
    Function,
    Kernel,
    Let,
    Loop,
    Newton,
    Sample,
    Start,
)
from codegen.ir.linearise import FirstOrder, NotLinearised
from codegen.ir.normal_form import NormalForms
from codegen.ir.operations import BodyForce
from codegen.ir.program import EMBEDDED, Assign, Program, Solve
from codegen.ir.tangent import tangents
from codegen.ir.values import Kind, Var
from codegen.kernel import critical_path, newton
from codegen.kernel.carried_momentum import Frames
from codegen.kernel.outlining import LONG, LONG_EXPLICIT, WORTH, Outline
from codegen.kernel.shared_angles import SharedArguments
from codegen.kernel.variations import Variations
from codegen.passes.rewrite import uses
from codegen.passes.series_sums import SeriesSums
from codegen.scene.problem import TIME, Problem

INLINE = 10
"""Largest number of operations spelled in one assignment: longer expressions get names on the way."""

MANY = 12
"""With more unknowns than this, entries of Newton's matrix keep as it is what does not move in a step."""

LONGEST_MATRIX = 1500
"""How many operations an exact matrix of Newton's method may take: a longer one is made to first order."""

WEIGHT = {"call": 10, "div": 4, "neg": 0}
"""What operations cost, in additions or products; those that are not named cost one."""


@dataclass(frozen=True)
class _Block:
    """A loop before scheduling: names of the unknowns, expressions of starts, images and Newton's matrix."""

    label: str
    unknowns: tuple[str, ...]
    starts: tuple[Expr, ...]
    images: tuple[Expr, ...]
    matrix: tuple[tuple[Expr, ...], ...] = ()
    leading: bool = False
    inverted: bool = False
    changes: tuple[str, ...] = ()
    kept: tuple[tuple[str, Expr], ...] = ()

    def targets(self) -> tuple[Expr, ...]:
        """What a sweep computes."""
        return (*self.images, *(x for _, x in self.kept))


AS_WRITTEN, COMBINED, ORDERED, SHORTENED = range(4)
"""What is done about long chains: nothing, steps and constants are multiplied first, assignments stand in
order, all of :mod:`codegen.kernel.critical_path`."""


def to_kernel(
    program: Program,
    scene: Problem,
    solvers: Mapping[str, str] = MappingProxyType({}),
    variations: Variations | None = None,
    chains: int = AS_WRITTEN,
    whole: bool = False,
) -> Kernel:
    """Return the kernel of a program in its problem (:func:`codegen.lower.problem`).

    ``solvers`` maps labels of blocks to :data:`codegen.ir.kernel.NEWTON` or CHORD, the others are iterated.
    With ``variations`` it is the kernel that carries one of the state along (``Kernel.vary``). ``chains``
    other than :data:`AS_WRITTEN` is for programs without blocks. A ``whole`` step begins and ends with the
    state's own momentum (:mod:`codegen.kernel.carried_momentum`), and so does one with variations.
    :class:`codegen.errors.SceneError` where an operation of the group has no closed form,
    :class:`codegen.ir.differentiate.NotDifferentiable` where Newton's method has no matrix, ZeroDivisionError
    where it has none to first order.
    """
    domain = SharedArguments()
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

    outline, inside = Outline(program, scene, domain), False
    sums = SeriesSums(program, scene)

    def run(assign: Assign) -> None:
        args = tuple(env[a] for a in assign.args)
        try:
            nested = sums.value(domain, assign, env)
            results = (nested,) if nested is not None else assign.operation.evaluate(scene, domain, args)
        except ArithmeticError as error:
            raise SceneError(
                f"{assign.operation.name} on {scene.group.name}: {error}",
                where=scene.name,
                expected="a group whose operations have closed forms",
                hint="this group serves exact series and interpretation",
            ) from error
        if isinstance(assign.operation, BodyForce):
            known = [x for v in assign.args for x in flatten(v.kind, env[v])]
            results = tuple(gathered(x, known) for x in results)
        reads = bool(scene.inputs) and any(v.kind is Kind.REAL for v in assign.args)  # signals at a time
        outline.trees.note(
            assign, args, results, len(blocks) if inside else -1, joined=nested is None and not reads
        )
        for target, value in zip(assign.targets, results, strict=True):
            env[target] = value
            remember(target)

    state = tuple(map(space.sym, scene.symbols))
    frames = Frames(scene, program, whole or variations is not None)
    given = start = frames.begin(domain, state)
    starts: dict[str, tuple[Expr, ...]] = {}
    for block in scene.state:
        starts[block.name], given = given[: len(block.symbols)], given[len(block.symbols) :]
    for var in program.inputs:
        env[var] = starts[var.name] if var.name in starts else space.sym(var.name)
    for statement in program.body:
        if isinstance(statement, Assign):
            run(statement)
            continue
        inside = True
        entered = _enter(statement, env, domain, name, run)
        inside = False
        corrected = solvers.get(statement.label, FIXED_POINT) != FIXED_POINT
        comparing = corrected and solvers[statement.label] == NEWTON and variations is None
        compared = _compared(statement, entered, env, name, program) if comparing else None
        if compared is not None:
            entered = compared
        elif corrected:
            entered = _with_matrix(entered, solvers[statement.label])
            solved = _Solved(entered)
            for var in env:
                env[var] = solved.value(env[var])
                remember(var)
        blocks.append(entered)
    outputs = tuple(x for n, var in program.outputs if n != EMBEDDED for x in flatten(var.kind, env[var]))
    lower = tuple(x for n, var in program.outputs if n == EMBEDDED for x in flatten(var.kind, env[var]))
    outputs, lower = (frames.end(domain, state, start, new) for new in (outputs, lower))
    if chains in (COMBINED, SHORTENED):
        outputs = critical_path.run(
            outputs, frozenset({"h", LEAD, ELAPSED, *scene.runtime}), spread=chains == SHORTENED
        )
    if variations is not None:
        seeds = variations.seeds(domain)
        blocks = [b for block in blocks for b in (block, _varied(block, seeds, space, name))]
        outputs = variations.ends(domain, outputs, tangents(outputs, seeds))
        lower = ()
    errors = tuple(x - y for x, y in zip(outputs, lower, strict=True)) if lower else ()
    before = frozenset(taken)
    schedule = _Schedule(blocks, (*outputs, *errors), hints, name, variations is None)
    fields = frames.fields()
    if variations is not None:
        fields = (*fields, Field(VARIATION, variations.names, variations.text()))
    durations = [v.name for v in program.inputs if v.name in (LEAD, ELAPSED)]
    scalars = (TIME, "h", *scene.runtime, *durations)
    body = schedule.run()
    outlined: tuple[Function, ...] = ()
    if (
        variations is None
        and chains in (AS_WRITTEN, ORDERED)
        and _count(body) > (LONG if blocks else LONG_EXPLICIT)
    ):
        taken.clear()
        taken.update(before)
        shorter, outlined = _outlined(outline, blocks, (*outputs, *errors), hints, name)
        if shorter is not None and _count(shorter.body) + _count(outlined) < WORTH * _count(body):
            schedule, body = shorter, tuple(shorter.body)
        else:
            outlined = ()
    if chains in (ORDERED, SHORTENED):
        body = critical_path.ordered([let for let in body if isinstance(let, Let)])
    made = Kernel(
        *(program.name, fields, scalars, body, schedule.outputs[: len(outputs)]),
        substeps=program.substeps,
        outlined=outlined,
        carried=frames.carried(domain),
    )
    if errors:
        made = replace(made, estimate=Estimate(schedule.outputs[len(outputs) :], 0))
    return _sampled(made, scene, domain)


def is_long(body: Iterable[Let | Start | Loop]) -> bool:
    """Whether a step has so many assignments that what it repeats is looked for."""
    return _count(body) > LONG


def _count(body: Iterable[Let | Start | Loop | Function]) -> int:
    """Return how many assignments a body holds, those in loops and of Newton's matrices included."""
    total = 0
    for statement in body:
        if isinstance(statement, Let):
            total += 1
            continue
        total += len(statement.body)
        if isinstance(statement, Loop) and statement.newton is not None:
            total += len(statement.newton.body)
    return total


def _outlined(
    outline: Outline,
    blocks: Sequence[_Block],
    roots: Sequence[Expr],
    hints: dict[int, str],
    name: Callable[[str], str],
) -> tuple[_Schedule | None, tuple[Function, ...]]:
    """Return the schedule of a step that calls functions, and these; None where nothing is repeated."""
    flat = list(roots)
    for block in blocks:
        flat += [*block.starts, *block.images, *(x for row in block.matrix for x in row)]
    read = {n.payload for n in walk(flat) if n.op == "sym"}
    blocks = [replace(b, kept=tuple(pair for pair in b.kept if pair[0] in read)) for b in blocks]
    flat += [x for block in blocks for _, x in block.kept]
    owners = {u: k for k, block in enumerate(blocks) for u in block.unknowns}
    found = outline.run(flat, owners)
    if found is None:
        return None, ()
    new = iter(found)

    def take(n: int) -> tuple[Expr, ...]:
        return tuple(next(new) for _ in range(n))

    ends = take(len(roots))
    changed = []
    for block in blocks:
        starts, images = take(len(block.starts)), take(len(block.images))
        matrix = tuple(take(len(row)) for row in block.matrix)
        changed.append(replace(block, starts=starts, images=images, matrix=matrix))
    changed = [replace(b, kept=tuple((key, next(new)) for key, _ in b.kept)) for b in changed]
    for old, made in zip(flat, found, strict=True):
        if old.id in hints:
            hints.setdefault(made.id, hints[old.id])
    schedule = _Schedule(changed, ends, hints, name)
    schedule.run()
    functions = []
    for function in outline.outlined:
        own = _Schedule((), function.outputs, {}, name)
        lets = own.run()
        functions.append(
            replace(function, body=tuple(x for x in lets if isinstance(x, Let)), outputs=own.outputs)
        )
    return schedule, tuple(functions)


def _varied(block: _Block, seeds: dict[str, Expr], space: Space, name: Callable[[str], str]) -> _Block:
    """Return the linear equations for the variations of a block's unknowns, which ``seeds`` receives."""
    own = [name(f"d_{u}") for u in block.unknowns]
    seeds |= {u: space.sym(d) for u, d in zip(block.unknowns, own, strict=True)}
    starts = (space.zero,) * len(own)
    return _Block(f"{VARIED}{block.label}", tuple(own), starts, tangents(block.images, seeds))


def _sampled(kernel: Kernel, scene: Problem, domain: ExprDomain) -> Kernel:
    """Return the kernel with the samples of run-time inputs that it reads."""
    read = {n.payload for n in walk(kernel.expressions()) if n.op == "sym"}
    found = [
        Sample(t, tuple(symbols[name].payload for name in scene.inputs))
        for t, symbols in domain.samples.values()
    ]
    samples = tuple(sample for sample in found if read.intersection(sample.symbols))
    return replace(kernel, inputs=scene.inputs if samples else (), samples=samples)


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


def _compared(
    block: Solve, entered: _Block, env: dict[Var, Any], name: Callable[[str], str], program: Program
) -> _Block | None:
    """Return the block with its residuals for images and their derivative to first order in h for a matrix.

    None where there are no residuals, or no such derivative. What the last sweep has computed is corrected,
    where it is read later, by its own derivative to first order in h times the last change, if that takes
    fewer operations than computing it anew from the unknowns.
    """
    residuals = tuple(x for v in block.residuals for x in flatten(v.kind, env[v]))
    if not residuals:
        return None
    space = residuals[0].space
    inside = {v for assign in block.body for v in assign.targets}
    known = [
        x
        for v, value in env.items()
        if v not in inside
        for x in flatten(v.kind, value)
        if x.op in ("add", "sub")
    ]
    # Few unknowns: what is kept takes registers that sweeps need. Many: what is expanded takes lines.
    many = len(entered.unknowns) > MANY
    later = _read_after(block, program) if many else frozenset()
    free = _independent(known, entered.unknowns) if many else []
    normal, linear = NormalForms(space, whole=free), FirstOrder(entered.unknowns)
    try:
        rows = linear.jacobian(residuals)
    except NotLinearised:
        return None
    changes = tuple(name(f"d_{u}") for u in entered.unknowns)
    kept: list[tuple[str, Expr]] = []
    for var in (target for assign in block.body for target in assign.targets):
        if var.kind not in (Kind.ALG, Kind.DUAL) or (many and var not in later):
            continue
        try:
            slopes = linear.jacobian(env[var])
        except NotLinearised:
            continue
        symbols = tuple(space.sym(name(f"{var.name}_{k}_seen")) for k in range(len(env[var])))
        moved = []
        for symbol, row in zip(symbols, slopes, strict=True):
            total = symbol
            for slope, change in zip(row, changes, strict=True):
                total = total + normal(slope) * space.sym(change)
            moved.append(total)
        if 2 * _operations(moved) < _operations(env[var]):
            kept += [(s.payload, x) for s, x in zip(symbols, env[var], strict=True)]
            env[var] = tuple(moved)
    matrix = tuple(tuple(-normal(x) for x in row) for row in rows)
    inverted = len(matrix) <= newton.SMALL
    return replace(
        entered,
        images=residuals,
        matrix=newton.inverse(matrix) if inverted else matrix,
        inverted=inverted,
        changes=changes,
        kept=tuple(kept),
    )


def _read_after(block: Solve, program: Program) -> frozenset[Var]:
    """Return the variables that a program reads after a block."""
    rest = program.body[program.body.index(block) + 1 :]
    return frozenset(uses(replace(program, body=rest)))


def _independent(values: Sequence[Expr], unknowns: Sequence[str]) -> list[Expr]:
    """Return those values that depend neither on unknowns nor on h: they stand still in an expansion."""
    moving = {*unknowns, "h"}
    depends: dict[int, bool] = {}
    for node in walk(values):
        own = node.op == "sym" and node.payload in moving
        depends[node.id] = own or any(depends[a.id] for a in node.args)
    return [x for x in values if not depends[x.id]]


def _operations(roots: Iterable[Expr]) -> int:
    return sum(WEIGHT.get(n.op, 1) for n in walk(roots) if n.args)


def _with_matrix(block: _Block, solver: str) -> _Block:
    """Return the block with the matrix of Newton's method, or of chords."""
    leading = solver == CHORD
    rows = (newton.leading_matrix if leading else newton.matrix)(block.images, block.unknowns)
    if not leading and _own(rows, block.images) > LONGEST_MATRIX:
        rows = newton.leading_matrix(block.images, block.unknowns)
    inverted = len(rows) <= newton.SMALL
    return replace(
        block, matrix=newton.inverse(rows) if inverted else rows, leading=leading, inverted=inverted
    )


def _own(rows: Iterable[Iterable[Expr]], images: Sequence[Expr]) -> int:
    """Return how many operations a matrix takes beside those of the images."""
    shared = {n.id for n in walk(images)}
    return sum(1 for n in walk([x for row in rows for x in row]) if n.args and n.id not in shared)


class _Solved:
    """Rewrites expressions for what stands after a block: there its images are its unknowns."""

    def __init__(self, block: _Block) -> None:
        self.space: Space = block.images[0].space
        self.known: dict[int, Expr] = {}
        for name, image in zip(block.unknowns, block.images, strict=True):
            if image.args:
                self.known[image.id] = self.space.sym(name)

    def value(self, value: Any) -> Any:
        """Return the value of a variable, rewritten."""
        return tuple(map(self._one, value)) if isinstance(value, tuple) else self._one(value)

    def _one(self, root: Expr) -> Expr:
        for node in walk([root], stop=lambda n: n.id in self.known):
            if node.id not in self.known:
                args = tuple(self.known[a.id] for a in node.args)
                same = all(a is b for a, b in zip(args, node.args, strict=True))
                self.known[node.id] = node if same else self._made(node, args)
        return self.known[root.id]

    def _made(self, node: Expr, args: tuple[Expr, ...]) -> Expr:
        match node.op:
            case "pow":
                return self.space.pow(args[0], node.payload)
            case "call":
                return self.space.call(node.payload, *args)
            case op:
                made: Expr = getattr(self.space, op)(*args)
                return made


@dataclass
class _Schedule:
    """Orders expressions into assignments and loops, naming what is shared or long."""

    blocks: Sequence[_Block]
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
            made = self._newton(block) if block.matrix and not block.leading else before
            anew = made is not None and (made.residuals or self._is_short(k))
            if anew:
                self._forget(k)
            loop = Loop(
                block.label, block.unknowns, starts, tuple(inside), images, newton=made, read_anew=anew
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

    def _newton(self, block: _Block) -> Newton:
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
