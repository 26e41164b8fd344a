"""Outlined functions: if a step contains a tree of operations repeatedly, the tree becomes a function.

The arguments of the function are the inputs of the tree and the coefficients of its linear combinations.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from codegen.ir.domain import Value
from codegen.ir.expr import Expr, Space, evaluate, walk
from codegen.ir.interpret import flatten
from codegen.ir.kernel import Function, Kernel
from codegen.ir.values import Coefficient, Kind
from codegen.kernel.repeated_trees import Tree, Trees, Values, distinct
from codegen.scene.problem import Problem

# Maps the kind of a function input to the first letter of its name, for example x in ``x1``.
LETTER = {Kind.REAL: "r", Kind.ALG: "x", Kind.DUAL: "m", Kind.GROUP: "g", Kind.POINT: "y"}


class _Inputs:
    """The inputs of an outlined function.

    If all calls pass the same constant for an input, this constant replaces the input.
    """

    def __init__(self, name: str, space: Space, fixed: Sequence[Expr | None]) -> None:
        self.name, self.space, self.fixed = name, space, fixed
        self.symbols: list[Expr] = []

    def take(self, words: Sequence[str]) -> Values:
        """Create an input of the function for each name in ``words``, and return these inputs."""
        first = len(self.symbols)
        # ``fixed[first:]`` may be longer than ``words``.
        for word, constant in zip(words, self.fixed[first:], strict=False):
            self.symbols.append(self.space.sym(f"{self.name}.{word}") if constant is None else constant)
        return tuple(self.symbols[first:])

    def text_of(self, x: Expr, c: Coefficient) -> str:
        """Return the text of the coefficient ``c``, for example ``c1 h``.

        ``c`` is the product of a number and a power of h. ``x`` is a symbol or a constant with the value of
        this number.
        """
        # The name of the symbol ``x`` is the name of the function, a dot, and the name of the argument. The
        # text contains only the name of the argument.
        value = x.payload.removeprefix(f"{self.name}.") if x.op == "sym" else c.value.text()
        return (f"({value})" if " " in value else value) + " h" * c.power

    def read(self, outputs: Sequence[Expr]) -> list[int]:
        """Return the positions of the inputs on which the expressions ``outputs`` depend."""
        needed = {n.payload for n in walk(outputs) if n.op == "sym"}
        return [p for p, s in enumerate(self.symbols) if s.op == "sym" and s.payload in needed]


def function(
    name: str, trees: Trees, tree: Tree, scene: Problem, read: Sequence[int], fixed: Sequence[Expr | None]
) -> tuple[Function, list[int], list[str]]:
    """Return an outlined function that executes the assignments of ``tree``, and two lists.

    The outlined function returns those results of the tree whose indices are in ``read``. The first list
    contains the indices of the tree inputs that the outlined function needs. The second list contains the
    names of the scene parameters that the outlined function needs. ``fixed`` has one entry for each input of
    the tree: the constant that all calls pass for this input, or None.
    """
    domain = trees.domain
    inputs = _Inputs(name, domain.space, fixed)
    # The function must be correct for the inputs of all calls. Therefore each input is a symbol, unless all
    # calls pass the same constant for this input.
    given, wires = trees.wiring(tree)
    words = _words([v.kind for v in given])
    values: list[Value] = []
    for v, word in zip(given, words, strict=True):
        own = inputs.take([f"{word}_{k}" for k in range(trees.width(tree, v))])
        values.append(own[0] if v.kind is Kind.REAL else own)
    coefficients = [c for i in tree.members for c in distinct(trees.executions[i].assign)]
    numbers = inputs.take([f"c{k + 1}" for k in range(len(coefficients))])
    # h is an argument if a coefficient contains a power of h.
    (step,) = inputs.take(["h"]) if any(c.power for c in coefficients) else (domain.h,)
    results: list[Value] = []
    texts: list[str] = []
    first = 0
    for i, places in zip(tree.members, wires, strict=True):
        assign = trees.executions[i].assign
        # A negative position p denotes the entry -p - 1 of ``results``.
        args = tuple(values[p] if p >= 0 else results[-p - 1] for p in places)
        names = [words[p] if p >= 0 else texts[-p - 1] for p in places]
        if assign.terms:
            # Equal coefficients of a sum share one argument.
            own_terms = distinct(assign)
            # In ``numbers``, the coefficients of the current sum begin at the index ``first``.
            symbol = dict(zip(own_terms, numbers[first:], strict=False))
            first += len(own_terms)
            # ``x`` is the coefficient ``c`` without its power of h.
            scaled = {c: x * step**c.power if c.power else x for c, x in symbol.items()}
            results.append(_sum([c for c, _ in assign.terms], scaled, args))
            terms = [
                x if c.is_one else f"{inputs.text_of(symbol[c], c)} {x}"
                for (c, _), x in zip(assign.terms, names, strict=True)
            ]
            texts.append(f"({' + '.join(terms)})" if len(terms) > 1 else terms[0])
        else:
            own = assign.operation.evaluate(scene, domain, args)
            results += own
            # ``texts`` needs one entry for each result. All results of one operation have the same text.
            texts += [f"{assign.operation.text()}({', '.join(names)})"] * len(own)
    targets = trees.executions[tree.root].assign.targets
    ends = [x for v, y in zip(targets, results[-len(targets) :], strict=True) for x in flatten(v.kind, y)]
    outputs = tuple(ends[k] for k in read)
    # An argument is dropped if no returned result depends on it.
    taken = inputs.read(outputs)
    own_inputs = [inputs.symbols[p].payload for p in taken]
    # Operations may read parameters of the scene.
    parameters = sorted({n.payload for n in walk(outputs) if n.op == "sym"} - set(own_inputs))
    return Function(name, (*own_inputs, *parameters), (), outputs, texts[-1]), taken, parameters


def _words(kinds: Sequence[Kind]) -> list[str]:
    """Return names for inputs of the given kinds.

    >>> _words([Kind.ALG, Kind.DUAL, Kind.ALG])
    ['x1', 'm1', 'x2']
    """
    return [f"{LETTER[kind]}{1 + kinds[:k].count(kind)}" for k, kind in enumerate(kinds)]


def calls(kernel: Kernel) -> dict[str, int]:
    """Return the number of calls of each outlined function, in the order of the functions of the kernel."""
    places = {function.name: dict[tuple[int, ...], None]() for function in kernel.outlined}
    for node in walk(kernel.expressions()):
        name = node.payload.partition(".")[0] if node.op == "call" else ""
        if name in places:
            # All nodes with equal arguments belong to one call.
            places[name][tuple(a.id for a in node.args)] = None
    return {name: len(calls_of_it) for name, calls_of_it in places.items()}


class WithFunctions:
    """A number domain that also evaluates calls of outlined functions."""

    def __init__(self, domain: Value, functions: Sequence[Function]) -> None:
        self.domain, self.functions = domain, {function.name: function for function in functions}

    def __getattr__(self, name: str) -> Value:
        return getattr(self.domain, name)

    def call(self, callee: str, *args: Value) -> Value:
        """Return the value of a function call.

        ``callee`` is the name of a library function, or ``name.k`` for result k of the outlined function
        ``name``.
        """
        # The name of a library function contains no dot.
        name, dot, k = callee.partition(".")
        if not dot:
            return self.domain.call(callee, *args)
        function = self.functions[name]
        values = dict(zip(function.inputs, args, strict=True))
        for let in function.body:
            # The body of a function may call other outlined functions.
            (values[let.name],) = evaluate([let.value], self, values)
        (value,) = evaluate([function.outputs[int(k)]], self, values)
        return value


def _sum(
    coefficients: Sequence[Coefficient], symbol: Mapping[Coefficient, Expr], args: Sequence[Values]
) -> Values:
    """Return a linear combination of vectors. ``symbol[c]`` is the value of the coefficient c."""
    # c x + c y = c (x + y), so equal coefficients cost one product for each component.
    groups: dict[Coefficient, Values] = {}
    for c, x in zip(coefficients, args, strict=True):
        groups[c] = tuple(a + b for a, b in zip(groups[c], x, strict=True)) if c in groups else x
    parts = [x if c.is_one else tuple(symbol[c] * a for a in x) for c, x in groups.items()]
    # The sum starts with its first term, because adding to zero would create an extra operation.
    total = parts[0]
    for part in parts[1:]:
        total = tuple(a + b for a, b in zip(total, part, strict=True))
    return total


def rewritten(
    roots: Sequence[Expr], calls: Mapping[int, tuple[str, int, list[Expr]]], space: Space
) -> list[Expr]:
    """Return the expressions ``roots`` with calls in place of some nodes.

    ``calls`` maps the id of a replaced node to the name of a function, the index of a result, and the
    arguments.
    """
    new: dict[int, Expr] = {}
    for root in roots:
        # A stack replaces recursion, because expressions may be nested deeply.
        waiting = [root]
        while waiting:
            node = waiting[-1]
            if node.id in new:
                waiting.pop()
                continue
            call = calls.get(node.id)
            # If a call replaces ``node``, the arguments of the call are used instead of ``node.args``.
            below = node.args if call is None else call[2]
            missing = [a for a in below if a.id not in new]
            if missing:
                waiting += missing
                continue
            waiting.pop()
            args = tuple(new[a.id] for a in below)
            if call is not None:
                new[node.id] = space._make("call", args, f"{call[0]}.{call[1]}")
            # An unchanged node is kept, because a rebuilt node might be simplified differently.
            elif all(a is b for a, b in zip(args, node.args, strict=True)):
                new[node.id] = node
            else:
                new[node.id] = _rebuilt(space, node, args)
    return [new[root.id] for root in roots]


def _rebuilt(space: Space, node: Expr, args: Values) -> Expr:
    match node.op:
        case "pow":
            return space.pow(args[0], node.payload)
        case "call":
            return space._make("call", args, node.payload)
        case op:
            rebuilt: Expr = getattr(space, op)(*args)
            return rebuilt
