"""Scalar expressions. An expression is an immutable node of a :class:`Space`.

In a space, equal expressions are the same object. Local rules simplify new nodes. For example, x - x
becomes 0.

The operations of nodes are ``const`` (a constant :class:`Number`), ``sym`` (a symbol with a name), ``add``,
``sub``, ``mul``, ``div``, ``neg``, ``pow`` (integer exponent >= 2), and ``call``. A ``call`` is the value of
a scalar function, or one result of a vector function. The scalar functions are the functions in
:data:`FUNCTIONS` and the piecewise polynomials (:mod:`codegen.ir.table`).
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

from codegen.ir.elementary import ANGLE, MATHEMATICAL
from codegen.ir.number import Number
from codegen.ir.selection import ABSOLUTE, CHOOSE, SELECTING
from codegen.ir.table import PiecewisePolynomial
from codegen.ir.vector_calls import component, named

if TYPE_CHECKING:
    from codegen.ir.domain import Domain, Scalar

Payload: TypeAlias = Any
"""The payload of a node is the number of a ``const``, the name of a ``sym``, the exponent of a ``pow``, or
the function (a name or a :class:`PiecewisePolynomial`) of a ``call``. All other nodes have the payload None.
"""

FUNCTIONS = (
    *MATHEMATICAL,
    ANGLE,
    *SELECTING,
    # Stumpff functions c_k(z) = sum_j (-z)^j/(2j+k)! for z >= 0.
    "stumpff0",
    "stumpff1",
    "stumpff2",
    "stumpff3",
    # Stumpff functions c_k(z) for all real z.
    "signed_stumpff0",
    "signed_stumpff1",
    "signed_stumpff2",
    "signed_stumpff3",
    # derivatives of stumpff2 and stumpff3: c_2' = (2 c_4 - c_3)/2 and c_3' = (3 c_5 - c_4)/2
    "slope2",
    "slope3",
    # second derivatives of stumpff2 and stumpff3
    "curvature2",
    "curvature3",
    # derivatives of signed_stumpff1, signed_stumpff2 and signed_stumpff3
    "signed_slope1",
    "signed_slope2",
    "signed_slope3",
    # The function quotient(a, b) is a/b for b != 0, and 0 for b = 0.
    "quotient",
)


class Expr:
    """One node of an expression. Only the methods of a :class:`Space` create nodes."""

    # Equal expressions of one space are the same object, so the default ``==`` and ``hash`` are sufficient.
    __slots__ = ("args", "id", "op", "payload", "space")

    def __init__(self, space: Space, id: int, op: str, args: tuple[Expr, ...], payload: Payload) -> None:
        self.space, self.id, self.op, self.args, self.payload = space, id, op, args, payload

    def __repr__(self) -> str:
        return text(self)

    def __add__(self, other: Expr | int) -> Expr:
        return self.space.add(self, self.space.coerce(other))

    def __radd__(self, other: int) -> Expr:
        return self.space.add(self.space.coerce(other), self)

    def __sub__(self, other: Expr | int) -> Expr:
        return self.space.sub(self, self.space.coerce(other))

    def __rsub__(self, other: int) -> Expr:
        return self.space.sub(self.space.coerce(other), self)

    def __mul__(self, other: Expr | int) -> Expr:
        return self.space.mul(self, self.space.coerce(other))

    def __rmul__(self, other: int) -> Expr:
        return self.space.mul(self.space.coerce(other), self)

    def __truediv__(self, other: Expr | int) -> Expr:
        return self.space.div(self, self.space.coerce(other))

    def __rtruediv__(self, other: int) -> Expr:
        return self.space.div(self.space.coerce(other), self)

    def __neg__(self) -> Expr:
        return self.space.neg(self)

    def __pow__(self, n: int) -> Expr:
        return self.space.pow(self, n)

    @property
    def is_zero(self) -> bool:
        """True if this node is the constant 0."""
        return self is self.space.zero


class Space:
    """A table of expressions that contains each expression only once.

    >>> s = Space(); x, y = s.sym("x"), s.sym("y")
    >>> (x + y) * 2 is (y + x) * 2
    True
    >>> x * 0 - (y - y)
    0
    """

    def __init__(self) -> None:
        # Nodes are never removed, because the length of the table is the number of the next node.
        self._table: dict[tuple[object, ...], Expr] = {}
        self.derivatives: dict[tuple[object, ...], tuple[Expr, ...]] = {}
        """A cache for the derivatives of vector functions (see :func:`codegen.ir.vector_calls.partial`)."""
        self.zero = self.const(Number.rational(0))
        self.one = self.const(Number.rational(1))

    def _make(self, op: str, args: tuple[Expr, ...] = (), payload: Payload = None) -> Expr:
        # The arguments of a node are created before the node, so nodes sorted by number are in topological
        # order.
        key = (op, tuple(a.id for a in args), payload)
        node = self._table.get(key)
        if node is None:
            node = self._table[key] = Expr(self, len(self._table), op, args, payload)
        return node

    def coerce(self, value: Expr | int | Number) -> Expr:
        """Return ``value`` as a node of this space. A number becomes a constant node."""
        if isinstance(value, Expr):
            if value.space is not self:
                # A node number identifies a node only within one space.
                raise ValueError("expressions of two different spaces cannot be combined")
            return value
        return self.const(value if isinstance(value, Number) else Number.rational(value))

    def const(self, value: Number) -> Expr:
        """Return a constant node."""
        return self._make("const", (), value)

    def sym(self, name: str) -> Expr:
        """Return the symbol with the name ``name``."""
        return self._make("sym", (), name)

    def neg(self, a: Expr) -> Expr:
        """Return -a."""
        if a.op == "const":
            return self.const(-a.payload)
        if a.op == "neg":
            return a.args[0]
        # In floating-point arithmetic, -(a - b) and b - a give the same value, except for the sign of zero.
        if a.op == "sub":
            return self._make("sub", (a.args[1], a.args[0]))
        return self._make("neg", (a,))

    def add(self, a: Expr, b: Expr) -> Expr:
        """Return a + b."""
        if a is self.zero:
            return b
        if b is self.zero:
            return a
        if a.op == b.op == "const" and _joinable(a, b):
            return self.const(a.payload + b.payload)
        # The expressions a + (-x) and a - x have the same floating-point value.
        if b.op == "neg":
            return self.sub(a, b.args[0])
        if a.op == "neg":
            return self.sub(b, a.args[0])
        # The sum a + a and the product 2 a have the same floating-point value.
        if a is b:
            return self.mul(self.const(Number.rational(2)), a)
        # Floating-point addition is commutative, so a + b and b + a are one node. Floating-point addition is
        # not associative, so the terms of (a + b) + c are not regrouped.
        return self._make("add", (a, b) if a.id < b.id else (b, a))

    def sub(self, a: Expr, b: Expr) -> Expr:
        """Return a - b."""
        if a is b:
            return self.zero
        if b is self.zero:
            return a
        if a is self.zero:
            return self.neg(b)
        if a.op == b.op == "const" and _joinable(a, b):
            return self.const(a.payload - b.payload)
        if b.op == "neg":
            return self.add(a, b.args[0])
        if a.op == "neg":
            # The difference (-x) - b becomes -(x + b). A later sum y + (-(x + b)) becomes y - (x + b).
            return self.neg(self.add(a.args[0], b))
        return self._make("sub", (a, b))

    def mul(self, a: Expr, b: Expr) -> Expr:
        """Return the product a b. If one factor is a constant, it is the first argument of the node."""
        if b.op == "const":
            a, b = b, a
        # 0 x = 0 for finite x, and x is assumed to be finite.
        if a is self.zero or b is self.zero:
            return self.zero
        if a.op == "const":
            if a.payload.is_one:
                return b
            if a.payload.is_minus_one:
                return self.neg(b)
            if b.op == "const" and _joinable(a, b):
                return self.const(a.payload * b.payload)
            # The product of two constants is exact, because constants are rounded only when they are printed.
            if b.op == "mul" and b.args[0].op == "const" and _joinable(a, b.args[0]):
                return self.mul(self.const(a.payload * b.args[0].payload), b.args[1])
        # The product (-x) y becomes -(x y), because a sum z + (-(x y)) then becomes the difference z - x y.
        if a.op == "neg":
            return self.neg(self.mul(a.args[0], b))
        if b.op == "neg":
            # The product a (-y) becomes -(a y), or (-a) y for a constant a.
            return self.mul(self.neg(a), b.args[0]) if a.op == "const" else self.neg(self.mul(a, b.args[0]))
        if a is b:
            return self.pow(a, 2)
        # The factors are sorted, so a b and b a are one node. A constant factor remains the first argument,
        # because compiler passes expect it there.
        if a.op != "const" and b.id < a.id:
            a, b = b, a
        return self._make("mul", (a, b))

    def div(self, a: Expr, b: Expr) -> Expr:
        """Return a/b. If b is a constant, the result is the product of a and the constant 1/b."""
        if b is self.zero:
            raise ZeroDivisionError("division by the constant 0")
        if a is self.zero:
            return self.zero
        if b.op == "const":
            # A multiplication by 1/b is several times faster than a division by b.
            return self.mul(self.const(Number.rational(1) / b.payload), a)
        # a/a becomes 1, because a divisor is always assumed to be non-zero.
        if a is b:
            return self.one
        if a.op == "neg":
            return self.neg(self.div(a.args[0], b))
        if b.op == "neg":
            return self.neg(self.div(a, b.args[0]))
        return self._make("div", (a, b))

    def pow(self, a: Expr, n: int) -> Expr:
        """Return a**n for an integer n."""
        if n < 0:
            return self.div(self.one, self.pow(a, -n))
        if n == 0:
            return self.one
        if n == 1:
            return a
        if a.op == "const":
            # Repeated multiplication is fast enough, because exponents in formulas are small.
            value = a.payload
            for _ in range(n - 1):
                value = value * a.payload
            return self.const(value)
        if a.op == "neg":
            power = self.pow(a.args[0], n)
            return self.neg(power) if n % 2 else power
        # (sqrt x)^(2m) is x^m, because formulas are evaluated only where the arguments of their square roots
        # are not negative.
        if a.op == "call" and a.payload == "sqrt" and n % 2 == 0:
            return self.pow(a.args[0], n // 2)
        return self._make("pow", (a,), n)

    def call(self, function: str, *args: Expr) -> Expr:
        """Return the value of ``function`` at the arguments ``args``, simplified if possible.

        ``function`` is a name in :data:`FUNCTIONS`, a :class:`PiecewisePolynomial`, or the name of one result
        of a vector function. For example, ``inverse5.7`` is the result of ``inverse5`` with the index 7.
        """
        known = _folded(function, args)
        if known is not None:
            return known
        # ``FUNCTIONS`` does not contain piecewise polynomials.
        table = isinstance(function, PiecewisePolynomial)
        if function not in FUNCTIONS and not table and component(function) is None:
            # Without this test, an unknown name would cause an error only when the expression is printed.
            message = f"unknown scalar function {function}"
            raise ValueError(message)
        return self._make("call", args, function)

    def vector(self, function: str, args: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return one call node for each result of a vector function (:mod:`codegen.ir.vector_function`)."""
        # All these nodes have the same arguments, so the emitter can compute all results in one call.
        given, size = tuple(args), named(function).size
        return tuple(self._make("call", given, f"{function}.{k}") for k in range(size))


def _folded(function: str, args: tuple[Expr, ...]) -> Expr | None:
    """Return a simpler expression for a call of ``choose`` or ``fabs``, or None if no rule applies.

    ``choose(x, a, b)`` equals ``a`` for x > 0, and ``b`` for x <= 0.
    """
    # ``choose(x, a, a)`` equals ``a`` for every x.
    if function == CHOOSE and args[1] is args[2]:
        return args[1]
    if function == CHOOSE and args[0].op == "call" and args[0].payload == CHOOSE:
        test, *values = args[0].args
        # ``choose(choose(x, 1, -1), a, b)`` equals ``choose(x, a, b)``.
        if [v.payload.text() if v.op == "const" else "" for v in values] == ["1", "-1"]:
            return test.space.call(CHOOSE, test, *args[1:])
    if function not in SELECTING or args[0].op != "const" or not args[0].payload.is_rational:
        return None
    value = args[0].payload.fraction()
    if function == ABSOLUTE:
        return -args[0] if value < 0 else args[0]
    return args[1] if value > 0 else args[2]


def _joinable(a: Expr, b: Expr) -> bool:
    """Return True if the sum and the product of two constants can be computed exactly in a common ring."""
    # Every ring contains the rational numbers.
    x, y = a.payload, b.payload
    return x.ring is y.ring or x.is_rational or y.is_rational


def walk(roots: Iterable[Expr], stop: Callable[[Expr], bool] | None = None) -> Iterator[Expr]:
    """Yield each node of the expressions once, after the arguments of the node.

    If ``stop`` is true for a node, the walk does not continue to the arguments of the node.
    """
    # An explicit stack replaces recursion, because expressions may be nested more deeply than Python's
    # recursion limit allows.
    seen: set[Expr] = set()
    users: list[tuple[Expr, Iterator[Expr]]] = []
    for root in roots:
        if root in seen:
            continue
        seen.add(root)
        if not root.args or (stop is not None and stop(root)):
            yield root
            continue
        node, args = root, iter(root.args)
        while True:
            for arg in args:
                if arg in seen:
                    continue
                seen.add(arg)
                if arg.args and (stop is None or not stop(arg)):
                    # The arguments of ``arg`` are visited before the remaining arguments of ``node``.
                    users.append((node, args))
                    node, args = arg, iter(arg.args)
                    break
                yield arg
            else:
                yield node
                if not users:
                    break
                node, args = users.pop()


_BINARY: dict[str, Callable[[Any, Any], Any]] = {
    "add": operator.add,
    "sub": operator.sub,
    "mul": operator.mul,
    "div": operator.truediv,
}


def evaluate(roots: Iterable[Expr], domain: Domain, values: Mapping[str, Scalar]) -> list[Scalar]:
    """Return the values of the expressions ``roots`` in an arithmetic ``domain`` (:mod:`codegen.ir.domain`).

    ``values`` contains the value of each symbol.
    """
    # ``roots`` is used twice below, but an iterator can be read only once.
    roots = list(roots)
    result: dict[Expr, Scalar] = {}
    # A key of ``vectors`` consists of the name of a vector function and the ids of its arguments.
    vectors: dict[tuple[str, tuple[int, ...]], tuple[Scalar, ...]] = {}
    for node in walk(roots):
        # ``walk`` yields the arguments of a node before the node, so the arguments already have values.
        args = node.args
        if node.op in _BINARY:
            value = _BINARY[node.op](result[args[0]], result[args[1]])
        elif node.op == "const":
            value = domain.number(node.payload)
        elif node.op == "sym":
            value = values[node.payload]
        elif node.op == "neg":
            value = -result[args[0]]
        elif node.op == "pow":
            value = power(result[args[0]], node.payload)
        elif (result_of := component(node.payload)) is not None:
            function, index = result_of
            key = function.name, tuple(a.id for a in args)
            # The key does not contain ``index``, so one evaluation supplies all results of a call.
            if key not in vectors:
                vectors[key] = domain.vector(function.name, [result[a] for a in args])
            value = vectors[key][index]
        else:
            value = domain.call(node.payload, *(result[a] for a in args))
        # Each node is evaluated only once, even if several of the expressions contain it.
        result[node] = value
    return [result[r] for r in roots]


def power(x: Scalar, n: int) -> Scalar:
    """Return x**n for n >= 1 by repeated squaring.

    Emitted code computes a power by the same sequence of products.
    """
    result = x
    # The loop skips "0b" and the leading bit, because ``result`` starts at x.
    for bit in bin(n)[3:]:
        result = result * result
        if bit == "1":
            result = result * x
    return result


def text(root: Expr) -> str:
    """Return an expression as readable text, fully parenthesised."""
    # ``walk`` yields the arguments of a node before the node, so their texts are already in ``parts``.
    parts: dict[int, str] = {}
    infix = {"add": "+", "sub": "-", "mul": "*", "div": "/"}
    for node in walk([root]):
        args = [parts[a.id] for a in node.args]
        match node.op:
            case "const":
                parts[node.id] = node.payload.text()
            case "sym":
                parts[node.id] = node.payload
            case "neg":
                parts[node.id] = f"-({args[0]})"
            case "pow":
                parts[node.id] = f"({args[0]})^{node.payload}"
            case "call":
                parts[node.id] = f"{node.payload}({', '.join(args)})"
            case _:
                parts[node.id] = f"({args[0]} {infix[node.op]} {args[1]})"
    return parts[root.id]
