"""Converts a kernel to statements that can be printed.

All required Stumpff functions c_k of an argument are computed by one call. Powers become products.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, field

from codegen.ir.expr import Expr, walk
from codegen.ir.kernel import FIXED_POINT, NEWTON, SIMPLIFIED_NEWTON, Function, Kernel, Let, Loop, Start
from codegen.ir.vector_calls import component, vector_function

METHODS = {
    FIXED_POINT: "fixed point",
    NEWTON: "Newton's method",
    SIMPLIFIED_NEWTON: "Newton's method with the Jacobian to first order in h",
}
"""Maps each solver of implicit equations to its name in the headers of emitted files."""

# Maps the name of a function in expressions to the index k of the Stumpff function c_k.
STUMPFF = {f"stumpff{k}": k for k in range(4)}


@dataclass(frozen=True)
class Assignment:
    """The statement ``name = value``, executed once."""

    name: str
    value: Expr


@dataclass(frozen=True)
class SharedCall:
    """One call that computes several Stumpff functions c_k of ``argument``.

    The variable ``names[i]`` gets the value of c_k for k = ``orders[i]``.
    """

    names: tuple[str, ...]
    orders: tuple[int, ...]
    argument: Expr

    @property
    def function(self) -> str:
        """The name of the called function: ``stumpff_``, followed by the numbers in ``orders``.

        For example, ``stumpff_12`` computes the Stumpff functions c_1 and c_2.
        """
        return "stumpff_" + "".join(map(str, self.orders))


@dataclass(frozen=True)
class Invocation:
    """The statement ``name = function(arguments)``. The call returns ``results`` numbers.

    The function is an outlined function or a vector function. The arguments of a vector function are passed
    as arrays.
    """

    name: str
    results: int
    function: str
    arguments: tuple[Expr, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """The symbols that denote the results of the call in expressions: ``name.0``, ``name.1``, ..."""
        return tuple(f"{self.name}.{k}" for k in range(self.results))

    @property
    def arrays(self) -> tuple[int, ...]:
        """The lengths of the argument arrays of a vector function, or () for any other function."""
        function = vector_function(self.function)
        return () if function is None else function.arrays


# The pattern matches symbols such as ``v_12.3``. This symbol denotes the result with index 3 of the call
# ``v_12``.
_RESULT = re.compile(r"(v_\d+)\.(\d+)")


def result_of(symbol: str) -> tuple[str, int] | None:
    """Split a symbol ``name.index`` that denotes a result of a function call. Return the name of the call,
    and the index of the result as an integer. For all other symbols, return None.

    >>> result_of("v_12.3"), result_of("vary.3")
    (('v_12', 3), None)
    """
    match = _RESULT.fullmatch(symbol)
    return None if match is None else (match[1], int(match[2]))


Simple = Assignment | SharedCall | Invocation


@dataclass(frozen=True)
class Beginning:
    """The statement that sets the starting values of the unknowns of all implicit equations.

    ``body`` contains the assignments that compute ``values``. If no solution of an earlier step is stored,
    the starting values are ``values``. Otherwise the starting values are extrapolated from the stored
    solutions (:class:`codegen.ir.kernel.Start`).
    """

    start: Start
    body: tuple[Simple, ...]
    values: tuple[Expr, ...]


@dataclass(frozen=True)
class Iteration:
    """A loop that solves implicit equations, ready to print (see :class:`codegen.ir.kernel.Loop`).

    - ``kept`` contains the names that are assigned in the body and read after the loop.
    - ``matrix`` contains the entries of Newton's matrix, row by row.
    - ``newton`` contains the statements that compute this matrix.
    """

    loop: Loop
    number: int
    starts: tuple[Expr, ...]
    body: tuple[Simple, ...]
    images: tuple[Expr, ...]
    kept: tuple[str, ...]
    newton: tuple[Simple, ...] = ()
    matrix: tuple[Expr, ...] = ()


Statement = Simple | Beginning | Iteration


@dataclass(frozen=True)
class Arrangement:
    """The statements and outputs of a step, ready to print.

    A step of a composition method executes all statements once in each substep. ``repeated`` is the number
    of substeps.
    """

    statements: tuple[Statement, ...]
    outputs: tuple[Expr, ...]
    errors: tuple[Expr, ...] = ()
    repeated: int = 1
    outlined: tuple[tuple[Function, Arrangement], ...] = ()

    def functions(self) -> tuple[str, ...]:
        """Return the names of all library functions that the step calls, sorted."""
        called = {s.function for s in self._simple() if isinstance(s, SharedCall)}
        outlined = {function.name for function, _ in self.outlined}
        names = {n.payload for n in walk(self.expressions()) if n.op == "call"}
        # The kernel itself defines the outlined functions, so they are not library functions.
        called |= {name for name in names if name.partition(".")[0] not in outlined}
        # An outlined function may itself call library functions.
        for _, inner in self.outlined:
            called |= set(inner.functions())
        return tuple(sorted(called))

    def _simple(self) -> Iterable[Simple]:
        for statement in self.statements:
            if isinstance(statement, Beginning | Iteration):
                yield from statement.body
                yield from statement.newton if isinstance(statement, Iteration) else ()
            else:
                yield statement

    def expressions(self) -> Iterable[Expr]:
        """Yield every expression to print."""
        for simple in self._simple():
            yield from _values(simple)
        for statement in self.statements:
            if isinstance(statement, Iteration):
                yield from (*statement.starts, *statement.images, *statement.matrix)
            elif isinstance(statement, Beginning):
                yield from statement.values
        yield from self.outputs
        yield from self.errors

    def symbols(self) -> frozenset[str]:
        """Return the set of all symbols that the expressions read."""
        return frozenset(n.payload for n in walk(self.expressions()) if n.op == "sym")


def arrange(kernel: Kernel) -> Arrangement:
    """Return the statements of a kernel in printable form.

    The arithmetic operations keep their order, so rounding errors do not change.
    """
    # In some target languages a loop has no scope, so names in different loops must differ.
    scope = _Scope(
        _taken(kernel), outlined={function.name: len(function.outputs) for function in kernel.outlined}
    )
    # Outputs and error estimates can share calls, so one list contains both.
    ends = [*kernel.outputs, *(kernel.estimate.errors if kernel.estimate is not None else ())]
    # All required Stumpff functions c_k of an argument are computed by one call.
    scope.expect([*(e for s in kernel.body for e in _outside(s)), *ends])
    statements: list[Statement] = []
    loops = 0
    for position, statement in enumerate(kernel.body):
        if isinstance(statement, Let):
            statements += scope.assign(statement, False)
            continue
        if isinstance(statement, Start):
            body, values = scope.nested(statement.body, statement.values)
            statements.append(Beginning(statement, body, values))
            continue
        # Starting values are computed before the loop.
        starts = tuple(scope.rewrite(e) for e in statement.starts)
        statements += scope.take()
        # Later statements may read values from the body of the loop.
        later = _read_later(kernel, position)
        loops += 1
        statements.append(_iteration(statement, loops, starts, scope, later))
    rewritten = tuple(scope.rewrite(e) for e in ends)
    statements += scope.take()
    # ``rewritten`` contains the outputs first and then the error estimates.
    states = len(kernel.outputs)
    # A kernel without substeps executes its statements once in each step.
    repeated = max(1, len(kernel.substeps))
    # The body of each function is arranged separately. The body of a function cannot use names that are
    # assigned outside of the function.
    functions = tuple((function, arrange(_alone(function))) for function in kernel.outlined)
    return Arrangement(tuple(statements), rewritten[:states], rewritten[states:], repeated, functions)


def _alone(function: Function) -> Kernel:
    """Return a kernel with the inputs, the body and the outputs of a function."""
    return Kernel(function.name, (), function.inputs, function.body, function.outputs)


def _outside(statement: Let | Start | Loop) -> Sequence[Expr]:
    if isinstance(statement, Let):
        return [statement.value]
    # If ``statement`` is a :class:`Loop`, the result contains the starting values of the unknowns, because
    # every step computes these values before the loop. If ``statement`` is a :class:`Start`, the result is
    # empty, because only some steps compute the expressions of a :class:`Start`.
    return statement.starts if isinstance(statement, Loop) else []


def _iteration(
    loop: Loop, number: int, starts: tuple[Expr, ...], scope: _Scope, later: Collection[str]
) -> Iteration:
    # The Stumpff functions in the body depend on the unknowns, so their calls belong to the body.
    inner = scope.inside([*(let.value for let in loop.body), *loop.images])
    body = [s for let in loop.body for s in inner.assign(let, let.name in later)]
    images = tuple(inner.rewrite(e) for e in loop.images)
    body += inner.take()
    kept = tuple(let.name for let in loop.body if let.name in later)
    entering: tuple[Simple, ...] = ()
    matrix: tuple[Expr, ...] = ()
    if loop.newton is not None:
        entries = tuple(x for row in loop.newton.matrix for x in row)
        entering, matrix = (scope if loop.newton.leading else inner).nested(loop.newton.body, entries)
    return Iteration(loop, number, starts, tuple(body), images, kept, entering, matrix)


def _values(statement: Simple) -> tuple[Expr, ...]:
    if isinstance(statement, Invocation):
        return statement.arguments
    return (statement.argument if isinstance(statement, SharedCall) else statement.value,)


def _taken(kernel: Kernel) -> dict[str, int]:
    """Return a dictionary whose keys are the names in the kernel. The values have no meaning."""
    names = [s for f in kernel.state for s in f.symbols] + list(kernel.scalars)
    names += [s for sample in kernel.samples for s in sample.symbols]
    names += [let.name for let in kernel.lets()]
    names += [u for loop in kernel.loops for u in loop.unknowns]
    names += [c for loop in kernel.loops if loop.newton is not None for c in loop.newton.changes]
    return dict.fromkeys(names, 1)


def _read_later(kernel: Kernel, position: int) -> frozenset[str]:
    after = kernel.body[position + 1 :]
    # The kernel ``rest`` consists of the later statements, so its expressions contain all names read later.
    rest = Kernel(kernel.name, (), (), after, kernel.outputs, estimate=kernel.estimate)
    return frozenset(n.payload for n in walk(rest.expressions()) if n.op == "sym")


@dataclass
class _Scope:
    """Rewrites the expressions of one block of statements, for example the body of a loop.

    - ``known`` maps the id of each node to the expression that replaces the node.
    - ``orders`` maps the id of an argument to the sorted indices k of the Stumpff functions c_k with this
      argument.
    - ``pending`` contains new statements, to be placed before the next statement.
    """

    taken: dict[str, int]
    known: dict[int, Expr] = field(default_factory=dict)
    orders: dict[int, tuple[int, ...]] = field(default_factory=dict)
    pending: list[Simple] = field(default_factory=list)
    results: dict[str, int] = field(default_factory=dict)
    outlined: dict[str, int] = field(default_factory=dict)

    def nested(
        self, lets: Sequence[Let], values: Sequence[Expr]
    ) -> tuple[tuple[Simple, ...], tuple[Expr, ...]]:
        """Return the statements and the results of a nested block, ready to print.

        ``lets`` contains the assignments of the block, and ``values`` contains its results. Powers become
        products, and one call computes all required Stumpff functions of an argument.
        """
        # If a step skips the block, the values of the block are not computed. Therefore the block has a scope
        # of its own, and later statements cannot read these values.
        inner = self.inside([*(let.value for let in lets), *values])
        body = [s for let in lets for s in inner.assign(let, False)]
        rewritten = tuple(inner.rewrite(e) for e in values)
        return (*body, *inner.take()), rewritten

    def inside(self, expressions: list[Expr]) -> _Scope:
        """Return the scope of a nested block. The block can read all names that are defined before it."""
        # ``known`` is copied, because statements outside the block must not read names of the block. All
        # scopes share ``taken``, because all names of a kernel must differ.
        inner = _Scope(self.taken, dict(self.known), outlined=self.outlined)
        inner.expect(expressions)
        return inner

    def expect(self, expressions: list[Expr]) -> None:
        """Record the indices of the Stumpff functions that occur in ``expressions``, grouped by argument."""
        needed: dict[int, list[int]] = {}
        for node in walk(expressions):
            if node.op == "call" and node.payload in STUMPFF and node.id not in self.known:
                needed.setdefault(node.args[0].id, []).append(STUMPFF[node.payload])
        # The indices are sorted, so that the function for c_1 and c_2 is always ``stumpff_12``, and never
        # ``stumpff_21``.
        self.orders = {argument: tuple(sorted(set(ks))) for argument, ks in needed.items()}

    def assign(self, let: Let, kept: bool) -> list[Simple]:
        """Return the statements for the assignment ``let``.

        The last statement assigns ``let.name``, with one exception. If ``kept`` is false and the value is a
        result of a function call, no statement assigns ``let.name``. In this case, :meth:`rewrite` replaces
        ``let.name`` by the name of the result.
        """
        value = self.rewrite(let.value)
        before = self.take()
        # If ``value`` is the symbol of a result of a function call, no assignment is needed, because later
        # expressions can read this symbol in place of ``let.name``.
        if value.op == "sym" and value.payload in self.results and not kept:
            self.known[value.space.sym(let.name).id] = value
            return before
        return [*before, Assignment(let.name, value)]

    def take(self) -> list[Simple]:
        """Return and remove the pending statements."""
        pending, self.pending = self.pending, []
        return pending

    def rewrite(self, root: Expr) -> Expr:
        """Return an expression that is equal to ``root``, and that may contain results of new statements.

        The new statements are added to ``pending``.
        """
        space = root.space
        for node in walk([root], lambda n: n.id in self.known):
            if node.id in self.known:
                continue
            # The operations and their order do not change, so the rounding errors do not change either.
            args = [self.known[a.id] for a in node.args]
            match node.op:
                case "pow":
                    self.known[node.id] = self._power(args[0], node.payload)
                case "call" if node.payload in STUMPFF:
                    self._shared_call(node, args[0])
                case "call" if self._results(node) is not None:
                    self._invoke(node, args)
                case "call":
                    self.known[node.id] = space.call(node.payload, *args)
                case "const" | "sym":
                    self.known[node.id] = node
                case op:
                    self.known[node.id] = getattr(space, op)(*args)
        return self.known[root.id]

    def _shared_call(self, node: Expr, argument: Expr) -> None:
        # The keys of ``self.orders`` are the ids of arguments before rewriting. Therefore the key is the id
        # of ``node.args[0]``, and not the id of the rewritten expression ``argument``.
        orders = self.orders[node.args[0].id]
        # One call returns the Stumpff functions c_k for all k in ``orders``. Each result gets a name.
        names = tuple(self._fresh(f"c{k}") for k in orders)
        self.pending.append(SharedCall(names, orders, argument))
        for k, name in zip(orders, names, strict=True):
            self.results[name] = k
            # Later expressions contain ``name`` in place of ``call``.
            call = node.space.call(f"stumpff{k}", node.args[0])
            self.known[call.id] = node.space.sym(name)

    def _results(self, node: Expr) -> int | None:
        """Return the number of results of the function that ``node`` calls.

        If the function is neither a vector function nor in ``self.outlined``, the result is None.
        """
        vector = component(node.payload)
        return self.outlined.get(node.payload.partition(".")[0]) if vector is None else vector[0].size

    def _invoke(self, node: Expr, args: list[Expr]) -> None:
        function = node.payload.partition(".")[0]
        results = self._results(node)
        assert results is not None
        call = Invocation(self._fresh("v"), results, function, tuple(args))
        self.pending.append(call)
        for k, name in enumerate(call.names):
            self.results[name] = k
            # Equal expressions have one id, so ``name`` replaces every expression equal to ``whole``.
            whole = node.space._make("call", node.args, f"{function}.{k}")
            self.known[whole.id] = node.space.sym(name)

    def _power(self, base: Expr, n: int) -> Expr:
        space = base.space
        # The base occurs several times in the product, so the base gets a name.
        base = self._named(base)
        # If n is at most 3, the power remains one node. In the emitted code, this node becomes a product such
        # as ``x * x * x``.
        if n <= 3:
            return space.pow(base, n)
        # The leading bit of n is 1, so the product starts with the base.
        result = base
        # Binary powering: at most 2 log2(n) products.
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
            # The key contains a space, so it is never a name.
            self.taken[f"{stem} count"] = self.taken.get(f"{stem} count", 0) + 1
            name = f"{stem}_{self.taken[f'{stem} count']}"
            if name not in self.taken:
                return name
