"""Kernel to printable statements: Stumpff functions of one argument computed together, powers as products.

A target's template sees three kinds of statement: :class:`Assignment`, :class:`Joint` (one call, several
results) and :class:`Iteration`. What a loop computes on the way is not reused after it.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from codegen.ir.expr import Expr, walk
from codegen.ir.kernel import Kernel, Let, Loop

STUMPFF = {f"stumpff{k}": k for k in range(4)}


@dataclass(frozen=True)
class Assignment:
    """name = value, once."""

    name: str
    value: Expr


@dataclass(frozen=True)
class Joint:
    """names[i] = c_(orders[i])(argument), all from one call."""

    names: tuple[str, ...]
    orders: tuple[int, ...]
    argument: Expr

    @property
    def function(self) -> str:
        """The snippet that computes this set, such as ``stumpff_12``."""
        return "stumpff_" + "".join(map(str, self.orders))


@dataclass(frozen=True)
class Iteration:
    """A fixed-point loop (see :class:`codegen.ir.kernel.Loop`); ``kept`` are body names read after it."""

    loop: Loop
    number: int
    starts: tuple[Expr, ...]
    body: tuple[Assignment | Joint, ...]
    images: tuple[Expr, ...]
    kept: tuple[str, ...]


Statement = Assignment | Joint | Iteration


@dataclass(frozen=True)
class Arrangement:
    """The statements of a step and its outputs, ready to be spelled."""

    statements: tuple[Statement, ...]
    outputs: tuple[Expr, ...]
    errors: tuple[Expr, ...] = ()

    def functions(self) -> tuple[str, ...]:
        """Return the functions called, sorted: scalar ones and sets of Stumpff functions."""
        called = {s.function for s in self._simple() if isinstance(s, Joint)}
        called |= {n.payload for n in walk(self.expressions()) if n.op == "call"}
        return tuple(sorted(called))

    def _simple(self) -> Iterable[Assignment | Joint]:
        for statement in self.statements:
            if isinstance(statement, Iteration):
                yield from statement.body
            else:
                yield statement

    def expressions(self) -> Iterable[Expr]:
        """Yield every expression to be spelled."""
        for simple in self._simple():
            yield simple.value if isinstance(simple, Assignment) else simple.argument
        for statement in self.statements:
            if isinstance(statement, Iteration):
                yield from (*statement.starts, *statement.images)
        yield from self.outputs
        yield from self.errors

    def symbols(self) -> frozenset[str]:
        """Return every symbol that some expression reads; for membership only."""
        return frozenset(n.payload for n in walk(self.expressions()) if n.op == "sym")


def arrange(kernel: Kernel) -> Arrangement:
    """Return the printable statements of a kernel, in its order and with its roundings."""
    scope = _Scope(_taken(kernel))
    outer = [e for s in kernel.body for e in ([s.value] if isinstance(s, Let) else s.starts)]
    ends = [*kernel.outputs, *(kernel.estimate.errors if kernel.estimate is not None else ())]
    scope.expect([*outer, *ends])
    statements: list[Statement] = []
    loops = 0
    for position, statement in enumerate(kernel.body):
        if isinstance(statement, Let):
            statements += scope.assign(statement, False)
            continue
        starts = tuple(scope.rewrite(e) for e in statement.starts)
        statements += scope.take()
        inner = scope.inside([*(let.value for let in statement.body), *statement.images])
        body: list[Assignment | Joint] = []
        later = _read_later(kernel, position)
        for let in statement.body:
            body += inner.assign(let, let.name in later)
        images = tuple(inner.rewrite(e) for e in statement.images)
        body += inner.take()
        kept = tuple(let.name for let in statement.body if let.name in later)
        loops += 1
        statements.append(Iteration(statement, loops, starts, tuple(body), images, kept))
    rewritten = tuple(scope.rewrite(e) for e in ends)
    statements += scope.take()
    states = len(kernel.outputs)
    return Arrangement(tuple(statements), rewritten[:states], rewritten[states:])


def _taken(kernel: Kernel) -> dict[str, int]:
    """Return a counter of fresh names that starts with every name of the kernel used."""
    names = [s for f in kernel.state for s in f.symbols] + list(kernel.scalars)
    names += [s for sample in kernel.samples for s in sample.symbols]
    names += [let.name for let in kernel.lets()]
    names += [u for s in kernel.body if isinstance(s, Loop) for u in s.unknowns]
    return dict.fromkeys(names, 1)


def _read_later(kernel: Kernel, position: int) -> frozenset[str]:
    after = kernel.body[position + 1 :]
    rest = Kernel(kernel.name, (), (), after, kernel.outputs, estimate=kernel.estimate)
    return frozenset(n.payload for n in walk(rest.expressions()) if n.op == "sym")


@dataclass
class _Scope:
    """Rewrites the expressions of one block; what must come first is pending until taken."""

    taken: dict[str, int]
    known: dict[int, Expr] = field(default_factory=dict)
    orders: dict[int, tuple[int, ...]] = field(default_factory=dict)
    pending: list[Assignment | Joint] = field(default_factory=list)
    results: dict[str, int] = field(default_factory=dict)

    def inside(self, expressions: list[Expr]) -> _Scope:
        """Return the scope of a loop body: it sees what stands before the loop."""
        inner = _Scope(self.taken, dict(self.known))
        inner.expect(expressions)
        return inner

    def expect(self, expressions: list[Expr]) -> None:
        """Note which Stumpff functions these expressions need of each argument."""
        needed: dict[int, list[int]] = {}
        for node in walk(expressions):
            if node.op == "call" and node.payload in STUMPFF and node.id not in self.known:
                needed.setdefault(node.args[0].id, []).append(STUMPFF[node.payload])
        self.orders = {argument: tuple(sorted(set(ks))) for argument, ks in needed.items()}

    def assign(self, let: Let, kept: bool) -> list[Assignment | Joint]:
        """Return the statements of an assignment: none of its own where a joint call made its value."""
        value = self.rewrite(let.value)
        before = self.take()
        if value.op == "sym" and value.payload in self.results and not kept:
            self.known[value.space.sym(let.name).id] = value
            return before
        return [*before, Assignment(let.name, value)]

    def take(self) -> list[Assignment | Joint]:
        """Return and forget the statements that must stand before the next one."""
        pending, self.pending = self.pending, []
        return pending

    def rewrite(self, root: Expr) -> Expr:
        """Return root with Stumpff calls and awkward powers replaced by names."""
        space = root.space
        for node in walk([root], lambda n: n.id in self.known):
            if node.id in self.known:
                continue
            args = [self.known[a.id] for a in node.args]
            match node.op:
                case "pow":
                    self.known[node.id] = self._power(args[0], node.payload)
                case "call" if node.payload in STUMPFF:
                    self._joint(node, args[0])
                case "call":
                    self.known[node.id] = space.call(node.payload, *args)
                case "const" | "sym":
                    self.known[node.id] = node
                case op:
                    self.known[node.id] = getattr(space, op)(*args)
        return self.known[root.id]

    def _joint(self, node: Expr, argument: Expr) -> None:
        orders = self.orders[node.args[0].id]
        names = tuple(self._fresh(f"c{k}") for k in orders)
        self.pending.append(Joint(names, orders, argument))
        for k, name in zip(orders, names, strict=True):
            self.results[name] = k
            call = node.space.call(f"stumpff{k}", node.args[0])
            self.known[call.id] = node.space.sym(name)

    def _power(self, base: Expr, n: int) -> Expr:
        space = base.space
        base = self._named(base)
        if n <= 3:
            return space.pow(base, n)
        result = base
        for bit in bin(n)[3:]:
            result = space.pow(self._named(result), 2)
            if bit == "1":
                result = space.mul(result, base)
        return result

    def _named(self, value: Expr) -> Expr:
        if value.op == "sym":
            return value
        name = self._fresh("p")
        self.pending.append(Assignment(name, value))
        return value.space.sym(name)

    def _fresh(self, stem: str) -> str:
        while True:
            self.taken[f"{stem} count"] = self.taken.get(f"{stem} count", 0) + 1
            name = f"{stem}_{self.taken[f'{stem} count']}"
            if name not in self.taken:
                return name
