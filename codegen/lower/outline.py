"""Outlining: what a step computes in several places alike becomes one function that is called there.

Operations of a program are joined into trees, the pair that saves most first: a value that one operation
alone uses is computed with it. Trees of one shape, whose sums have other coefficients and whose operands are
others, are one function of those. Where a part of a result alone is read, only that is computed, and what it
does not depend on is no argument. It is done where a step is long: what is shared between operations
otherwise, such as sine and cosine of one angle, is not shared across calls.

The rewriting is exact. It is verified: the outlined expressions are evaluated at a point beside the others.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from codegen.ir.domain import ExprDomain, FloatDomain
from codegen.ir.expr import Expr, Space, evaluate, walk
from codegen.ir.interpret import apply, flatten
from codegen.ir.kernel import Piece
from codegen.ir.program import Assign, Coefficient, Kind, Operation, Program, Var
from codegen.ir.verify import IllFormed
from codegen.lower.series_sums import SeriesSum
from codegen.setting import Setting

LONG = 700
"""A step of fewer assignments is left as it is."""

WORTH = 0.85
"""What part of its assignments a step may keep at most."""

NEVER = frozenset({"advance", "zero", "identity", "flow", "flowt", "flowfor", "flowtfor"})
"""Operations that are not outlined: hardly any work, or flows, whose steps are timed as a whole."""

LETTER = {Kind.REAL: "r", Kind.ALG: "x", Kind.DUAL: "m", Kind.GROUP: "g", Kind.POINT: "y"}

NODES = 3
"""About how many operations stand on a line."""

AGREE = 1e-9
"""Relative difference of values that are the same but for rounding."""

Values = tuple[Expr, ...]

Shape = tuple[Any, tuple[int, ...]]
"""What trees of one function have in common: their key, and the results that are read."""


@dataclass(frozen=True)
class _Made:
    """An assignment as it was executed: values of its arguments, its results, and where it stands."""

    assign: Assign
    args: tuple[Values, ...]
    results: tuple[Values, ...]
    place: int


@dataclass
class _Tree:
    """Assignments that are computed together, the last using what the others make, in order."""

    members: list[int]

    @property
    def root(self) -> int:
        """The assignment whose results are the tree's."""
        return self.members[-1]


@dataclass
class Outline:
    """Collects what a program's execution makes, and rewrites expressions by calls."""

    program: Program
    scene: Setting
    domain: ExprDomain
    made: list[_Made] = field(default_factory=list)
    pieces: list[Piece] = field(default_factory=list)

    def __post_init__(self) -> None:
        self._users: dict[Var, list[int | None]] = {}
        self._lines: dict[Any, int] = {}
        self._multiples: dict[Var, tuple[Coefficient, Var, Any]] = {}

    def note(
        self,
        assign: Assign,
        args: Sequence[Any],
        results: Sequence[Any],
        place: int,
        within: Collection[Var] = (),
    ) -> None:
        """Take note of an assignment in the block that is number ``place``, -1 between blocks.

        What makes variables that are computed ``within`` it is forgotten.
        """
        if within:
            self.made = [m for m in self.made if m.assign.targets[0] not in within]
        assign, args = self._from_the_whole(assign, args)
        self.made.append(
            _Made(
                assign,
                tuple(flatten(v.kind, x) for v, x in zip(assign.args, args, strict=True)),
                tuple(flatten(v.kind, x) for v, x in zip(assign.targets, results, strict=True)),
                place,
            )
        )

    def _from_the_whole(self, assign: Assign, args: Sequence[Any]) -> tuple[Assign, Sequence[Any]]:
        """Return a multiple of a multiple as one of that, so that the first is not read twice."""
        if assign.operation.name != "lin" or len(assign.args) != 1:
            return assign, args
        (c,), (v,), (target,) = assign.operation.coefficients, assign.args, assign.targets
        if v in self._multiples:
            d, v, value = self._multiples[v]
            c, args = Coefficient(c.value * d.value, c.power + d.power), (value,)
            assign = Assign((target,), Operation("lin", (c,)), (v,))
        self._multiples[target] = c, v, args[0]
        return assign, args

    def run(self, roots: Sequence[Expr], owners: Mapping[str, int]) -> list[Expr] | None:
        """Return the roots with calls of ``pieces``; None where nothing is repeated.

        ``owners`` maps the unknowns of blocks to the number of their block.
        """
        self._levels(roots, owners)
        trees = [t for t in self._trees() if self._useful(t)]
        while True:
            chosen = self._chosen(roots, trees)
            if not chosen:
                return None
            rewritten, shapes = self._called(roots, chosen)
            calls: dict[str, int] = {}
            for node in walk(rewritten):
                if node.op == "call" and node.payload.endswith(".0"):
                    calls[node.payload[:-2]] = calls.get(node.payload[:-2], 0) + 1
            if all(calls.get(name, 0) > 1 for name in shapes):
                self._verify(roots, rewritten)
                return rewritten
            kept = [key for name, key in shapes.items() if calls.get(name, 0) > 1]
            trees = [tree for key in kept for tree in chosen[key]]

    def _called(
        self, roots: Sequence[Expr], chosen: Mapping[Shape, list[_Tree]]
    ) -> tuple[list[Expr], dict[str, Shape]]:
        """Make the pieces, and return the roots with calls of them, and the shape that each piece is of."""
        self.pieces.clear()
        calls: dict[int, tuple[str, int, list[Expr]]] = {}
        shapes: dict[str, Shape] = {}
        for key, trees in chosen.items():
            name = f"piece_{1 + len(self.pieces)}"
            shapes[name] = key
            inputs = [self._inputs(tree) for tree in trees]
            fixed = [
                x if x.op == "const" and all(x is y for y in others) else None
                for x, *others in zip(*inputs, strict=True)
            ]
            places = self._piece(name, trees[0], key[1], fixed)
            for tree, flat in zip(trees, inputs, strict=True):
                results = self._results(tree)
                for k, out in enumerate(key[1]):
                    calls.setdefault(results[out].id, (name, k, [flat[p] for p in places]))
        return _rewritten(roots, calls, self.domain.space), shapes

    # Trees ------------------------------------------------------------------------------------------------

    def _trees(self) -> list[_Tree]:
        """Return the assignments joined into trees, as long as that saves lines."""
        self._find_users()
        trees = {i: _Tree([i]) for i, m in enumerate(self.made) if m.assign.operation.name not in NEVER}
        owner = {i: i for i in trees}
        while True:
            pairs: dict[Any, list[tuple[int, int]]] = {}
            keys = {i: self._key(t) for i, t in trees.items()}
            count: dict[Any, int] = {}
            for key in keys.values():
                count[key] = count.get(key, 0) + 1
            for i in trees:
                user = self._only_user(i)
                if user is not None and user in owner and owner[user] != i:
                    j = owner[user]
                    joined = self._key(self._join(trees[i], trees[j]))
                    pairs.setdefault((keys[i], keys[j], joined), []).append((i, j))
            best, saved = None, 0
            for key, found in pairs.items():
                gain = self._gain(key, found, count)
                if gain > saved:
                    best, saved = key, gain
            if best is None:
                return list(trees.values())
            used: set[int] = set()
            for i, j in pairs[best]:
                if i in used or j in used:
                    continue
                used |= {i, j}
                trees[j] = self._join(trees[i], trees[j])
                for member in trees.pop(i).members:
                    owner[member] = j

    def _gain(self, key: Any, found: list[tuple[int, int]], count: Mapping[Any, int]) -> int:
        """Return about how many lines joining pairs of trees saves."""
        first, second, _ = key
        k = len(found)
        if k < 2:
            return 0
        i, j = found[0]
        copies = self._size(i) * (count[first] > k) + self._size(j) * (count[second] > k)
        return k * 3 - copies

    def _size(self, i: int) -> int:
        """Return about how many lines the operation that ends a tree takes."""
        name = self.made[i].assign.operation.name
        if name not in self._lines:
            results = [x for value in self.made[i].results for x in value]
            stop = {x.id for value in self.made[i].args for x in value}
            nodes = sum(1 for n in walk(results, lambda n: n.id in stop) if n.args and n.id not in stop)
            self._lines[name] = 1 + nodes // NODES
        return self._lines[name]

    def _join(self, a: _Tree, b: _Tree) -> _Tree:
        return _Tree(sorted([*a.members, *b.members]))

    def _find_users(self) -> None:
        for i, m in enumerate(self.made):
            for v in m.assign.args:
                self._users.setdefault(v, []).append(i)
        for statement in self.program.body:
            if not isinstance(statement, Assign):
                for v in (*statement.starts, *statement.images, *statement.residuals):
                    self._users.setdefault(v, []).append(None)
        for _, v in self.program.outputs:
            self._users.setdefault(v, []).append(None)

    def _only_user(self, i: int) -> int | None:
        """Return the one assignment that uses what the assignment makes, if it stands in the same place."""
        users = {u for v in self.made[i].assign.targets for u in self._users.get(v, [])}
        if len(users) != 1:
            return None
        (user,) = users
        return user if user is not None and self.made[user].place == self.made[i].place else None

    def _wiring(self, tree: _Tree) -> tuple[list[Var], list[tuple[int, ...]]]:
        """Return the variables that a tree is given, in order, and for each member where its arguments are.

        An argument is the place of such a variable, or less than zero: minus the number of a member's result.
        """
        targets: dict[Var, int] = {}
        given: dict[Var, int] = {}
        wires = []
        for i in tree.members:
            places = []
            for v in self.made[i].assign.args:
                if v in targets:
                    places.append(-targets[v])
                else:
                    places.append(given.setdefault(v, len(given)))
            wires.append(tuple(places))
            for v in self.made[i].assign.targets:
                targets[v] = 1 + len(targets)
        return list(given), wires

    def _key(self, tree: _Tree) -> Any:
        """Return what trees of one shape have in common; coefficients differ, but those equal stay so."""
        _, wires = self._wiring(tree)
        shape = []
        for i, places in zip(tree.members, wires, strict=True):
            assign = self.made[i].assign
            operation = assign.operation
            own = _pattern(operation.coefficients)
            words: Any = operation.word
            if isinstance(operation, SeriesSum):
                words = operation.words, operation.of, operation.dual
            shape.append((operation.name, operation.order, words, own, places, assign.targets[0].kind))
        return tuple(shape)

    # Choice -----------------------------------------------------------------------------------------------

    def _levels(self, roots: Sequence[Expr], owners: Mapping[str, int]) -> None:
        results = [x for m in self.made for value in (*m.results, *m.args) for x in value]
        self._level: dict[int, int] = {}
        for node in walk([*roots, *results]):
            own = owners.get(node.payload, -1) if node.op == "sym" else -1
            self._level[node.id] = max([own, *(self._level[a.id] for a in node.args)])

    def _useful(self, tree: _Tree) -> bool:
        """Whether a tree does enough for a call."""
        results = self._results(tree)
        stop = {x.id for x in self._inputs(tree)}
        nodes = sum(1 for n in walk(results, lambda n: n.id in stop) if n.args and n.id not in stop)
        return nodes > 4 * NODES

    def _chosen(self, roots: Sequence[Expr], trees: list[_Tree]) -> dict[Shape, list[_Tree]]:
        """Return the trees that are made functions, by shape and the results that are read."""
        while True:
            read = self._read(roots, trees)
            groups: dict[Shape, list[int]] = {}
            for t in sorted(read):
                if self._even(trees[t], read[t]):
                    groups.setdefault((self._key(trees[t]), tuple(sorted(read[t]))), []).append(t)
            kept = {key: found for key, found in groups.items() if len(found) > 1}
            left = [t for found in kept.values() for t in found]
            if len(left) == len(trees):
                return {key: [trees[t] for t in found] for key, found in kept.items()}
            trees = [trees[t] for t in sorted(left)]

    def _read(self, roots: Sequence[Expr], trees: Sequence[_Tree]) -> dict[int, set[int]]:
        """Return which results of which trees are read, by number, where all trees are called."""
        ends: dict[int, tuple[int, int]] = {}
        for t, tree in enumerate(trees):
            for k, x in enumerate(self._results(tree)):
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
            waiting = [x for t in fresh for x in self._inputs(trees[t])]
        return read

    def _even(self, tree: _Tree, read: set[int]) -> bool:
        """Whether what is read of a tree depends on the same blocks as all that it is given.

        And is younger, as what is computed from it must be: an older one is the result of something else.
        """
        results, inputs = self._results(tree), self._inputs(tree)
        deepest = max(self._level.get(x.id, -1) for x in inputs)
        youngest = max((x.id for x in inputs if x.args), default=-1)
        return all(self._level[results[k].id] == deepest and results[k].id > youngest for k in read)

    def _results(self, tree: _Tree) -> Values:
        return tuple(x for value in self.made[tree.root].results for x in value)

    def _inputs(self, tree: _Tree) -> list[Expr]:
        """Return all numbers that a tree is given: values of variables, then coefficients of its sums."""
        given, _ = self._wiring(tree)
        found: dict[Var, Values] = {}
        for i in tree.members:
            made = self.made[i]
            found |= {v: x for v, x in zip(made.assign.args, made.args, strict=True) if v in given}
        flat = [x for v in given for x in found[v]]
        scales = [c for i in tree.members for c in _distinct(self.made[i].assign)]
        flat += [self.domain.number(c.value) for c in scales]
        return [*flat, self.domain.h] if any(c.power for c in scales) else flat

    # Functions --------------------------------------------------------------------------------------------

    def _piece(self, name: str, tree: _Tree, read: Sequence[int], fixed: Sequence[Expr | None]) -> list[int]:
        """Make the function of a tree's shape, and return which of a tree's inputs it takes.

        ``fixed`` are inputs that are the same constant wherever it is called.
        """
        space = self.domain.space
        given, wires = self._wiring(tree)
        symbols: list[Expr] = []

        def fresh(words: Sequence[str]) -> Values:
            """Return a symbol, or the constant that it always is, for each of the next inputs."""
            made = []
            for word in words:
                constant = fixed[len(symbols)]
                made.append(space.sym(f"{name}.{word}") if constant is None else constant)
                symbols.append(made[-1])
            return tuple(made)

        values: list[Any] = []
        words: list[str] = []
        numbers: dict[str, int] = {}
        for v in given:
            letter = LETTER[v.kind]
            numbers[letter] = numbers.get(letter, 0) + 1
            words.append(f"{letter}{numbers[letter]}")
            own = fresh([f"{words[-1]}_{k}" for k in range(self._width(tree, v))])
            values.append(own if v.kind is not Kind.REAL else own[0])
        results: list[Any] = []
        spelled: list[str] = []
        scales, step = 0, self.domain.h
        coefficients = [c for i in tree.members for c in _distinct(self.made[i].assign)]
        numbered = fresh([f"c{k + 1}" for k in range(len(coefficients))])
        if any(c.power for c in coefficients):
            (step,) = fresh(["h"])
        for i, places in zip(tree.members, wires, strict=True):
            assign = self.made[i].assign
            args = tuple(values[p] if p >= 0 else results[-p - 1] for p in places)
            text = [words[p] if p >= 0 else spelled[-p - 1] for p in places]
            operation = assign.operation
            if _scaled(operation):
                distinct = _distinct(assign)
                own = numbered[scales : scales + len(distinct)]
                scales += len(distinct)
                scaled = tuple(
                    x * step**c.power if c.power else x for c, x in zip(distinct, own, strict=True)
                )
                symbol = dict(zip(distinct, scaled, strict=True))
                if isinstance(operation, SeriesSum):
                    factors = [symbol.get(c, space.one) for c in operation.coefficients]
                    made: tuple[Any, ...] = (operation.value(self.scene, self.domain, factors, args),)
                else:
                    made = (_sum(operation.coefficients, symbol, args),)
                names = {
                    c: (x.payload.removeprefix(f"{name}.") if x.op == "sym" else c.value.text())
                    + " h" * c.power
                    for c, x in zip(distinct, own, strict=True)
                }
                own_text = operation.spelled(text) if isinstance(operation, SeriesSum) else text
                pairs = zip(operation.coefficients, own_text, strict=True)
                terms = [x if c.is_one else f"{names[c]} {x}" for c, x in pairs]
                said = [f"({' + '.join(terms)})" if len(terms) > 1 else terms[0]]
            else:
                made = apply(self.scene, self.domain, assign, args)
                said = [f"{assign.operation.text()}({', '.join(text)})"] * len(made)
            results += made
            spelled += said
        root = self.made[tree.root].assign
        ends = [
            x
            for v, y in zip(root.targets, results[-len(root.targets) :], strict=True)
            for x in flatten(v.kind, y)
        ]
        outputs = [ends[k] for k in read]
        needed = {n.payload for n in walk(outputs) if n.op == "sym"}
        places_ = [p for p, s in enumerate(symbols) if s.op == "sym" and s.payload in needed]
        own_names = tuple(symbols[p].payload for p in places_)
        self.pieces.append(Piece(name, own_names, (), tuple(outputs), spelled[-1]))
        return places_

    def _width(self, tree: _Tree, var: Var) -> int:
        for i in tree.members:
            for v, x in zip(self.made[i].assign.args, self.made[i].args, strict=True):
                if v == var:
                    return len(x)
        raise AssertionError(var.name)

    # Verification -----------------------------------------------------------------------------------------

    def _verify(self, before: Sequence[Expr], after: Sequence[Expr]) -> None:
        """Raise :class:`codegen.ir.verify.IllFormed` where the calls give other values."""
        names = sorted({n.payload for n in walk(before) if n.op == "sym"})
        for attempt in range(1, 6):
            values = {x: 0.3 + 0.2 * math.sin(7.0 * k + attempt) for k, x in enumerate(names)}
            try:
                old = evaluate(before, FloatDomain(0.1), values)
                new = evaluate(after, WithPieces(FloatDomain(0.1), self.pieces), values)
            except (ArithmeticError, ValueError):
                continue
            scale = max(1.0, *map(abs, old))
            if not all(abs(a - b) <= AGREE * scale for a, b in zip(old, new, strict=True)):
                raise IllFormed(f"outlining changed the meaning of {self.program.name}")
            return
        raise IllFormed(f"outlining of {self.program.name} could not be verified")


class WithPieces:
    """A domain in which a kernel's pieces can be called."""

    def __init__(self, domain: Any, pieces: Sequence[Piece]) -> None:
        self.domain, self.pieces = domain, {piece.name: piece for piece in pieces}

    def __getattr__(self, name: str) -> Any:
        return getattr(self.domain, name)

    def call(self, function: str, *args: Any) -> Any:
        """Return one result of a piece, or a function's value."""
        name, dot, k = function.partition(".")
        if not dot:
            return self.domain.call(function, *args)
        piece = self.pieces[name]
        values = dict(zip(piece.inputs, args, strict=True))
        for let in piece.body:
            (values[let.name],) = evaluate([let.value], self, values)
        (value,) = evaluate([piece.outputs[int(k)]], self, values)
        return value


def _pattern(coefficients: Sequence[Coefficient]) -> tuple[tuple[int, int], ...]:
    """Return which coefficients are alike: 0 for one, else numbers in order; and their powers of h."""
    seen: dict[Coefficient, int] = {}
    return tuple((0, 0) if c.is_one else (seen.setdefault(c, 1 + len(seen)), c.power) for c in coefficients)


def _distinct(assign: Assign) -> list[Coefficient]:
    """Return the coefficients of a sum, each once, without those that are one."""
    if not _scaled(assign.operation):
        return []
    return list(dict.fromkeys(c for c in assign.operation.coefficients if not c.is_one))


def _scaled(operation: Operation) -> bool:
    """Whether an operation is a sum, whose coefficients may differ from call to call."""
    return operation.name == "lin" or isinstance(operation, SeriesSum)


def _sum(
    coefficients: Sequence[Coefficient], symbol: Mapping[Coefficient, Expr], args: Sequence[Values]
) -> Values:
    """Return a sum with symbols for its coefficients; terms with equal ones are added first."""
    groups: dict[Coefficient, Values] = {}
    for c, x in zip(coefficients, args, strict=True):
        groups[c] = tuple(a + b for a, b in zip(groups[c], x, strict=True)) if c in groups else x
    parts = [x if c.is_one else tuple(symbol[c] * a for a in x) for c, x in groups.items()]
    total = parts[0]
    for part in parts[1:]:
        total = tuple(a + b for a, b in zip(total, part, strict=True))
    return total


def _rewritten(
    roots: Sequence[Expr], calls: Mapping[int, tuple[str, int, list[Expr]]], space: Space
) -> list[Expr]:
    """Return the roots with nodes replaced by results of calls, whose arguments are rewritten as well."""
    new: dict[int, Expr] = {}
    for root in roots:
        waiting = [root]
        while waiting:
            node = waiting[-1]
            if node.id in new:
                waiting.pop()
                continue
            call = calls.get(node.id)
            below = node.args if call is None else call[2]
            missing = [a for a in below if a.id not in new]
            if missing:
                waiting += missing
                continue
            waiting.pop()
            args = tuple(new[a.id] for a in below)
            if call is not None:
                new[node.id] = space._make("call", args, f"{call[0]}.{call[1]}")
            elif all(a is b for a, b in zip(args, node.args, strict=True)):
                new[node.id] = node
            else:
                new[node.id] = _made(space, node, args)
    return [new[root.id] for root in roots]


def _made(space: Space, node: Expr, args: Values) -> Expr:
    match node.op:
        case "pow":
            return space.pow(args[0], node.payload)
        case "call":
            return space._make("call", args, node.payload)
        case op:
            made: Expr = getattr(space, op)(*args)
            return made
