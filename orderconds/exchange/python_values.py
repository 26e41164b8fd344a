"""Evaluate the expressions of a parsed Python file. A value is a coefficient, an array or a text."""

from __future__ import annotations

import ast
import json
from collections.abc import Collection, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import count

from orderconds.errors import TableauError
from orderconds.exchange.arrays import coefficient
from orderconds.exchange.nested import Cells
from orderconds.tableau.grammar import (
    MAX_TEXT,
    ZERO,
    Chain,
    Constant,
    Expression,
    Name,
    Power,
    parse,
    spell,
)

ARRAY_CALLS = ("array", "asarray", "Matrix", "ImmutableMatrix", "matrix", "list", "tuple")
NUMBER_CALLS = ("Integer", "S", "sympify", "float", "float64", "int", "Decimal", "Fraction", "Rational")
ROUNDED_CALLS = ("Float", "mpf")
TYPED_CALLS = ("array", "asarray", "matrix")
"""Constructors of arrays whose entries have one common type. In an array of integers, for example, no entry
can be 1/2."""
NARROW = ("16", "32", "complex", "int", "bool")
"""If the name of a type contains one of these texts, an array of this type becomes an unknown value
(:class:`Computed`). For example, ``float32`` contains ``32``, and ``int64`` contains ``int``."""
COPYING_CALLS = ("array", "Matrix", "ImmutableMatrix", "matrix")
"""Constructors of arrays that copy their argument and its rows. ``list`` and ``tuple`` do not copy the
rows. ``asarray`` may return its argument without a copy."""
QUOTIENT_CALLS = ("Fraction", "Rational")
ROOTS = {"sqrt": 2, "cbrt": 3}
LIBRARIES = ("fractions", "decimal", "math", "numpy", "sympy", "mpmath", "jax", "cupy", "autograd")
"""Modules whose functions, such as ``sqrt`` or ``Fraction``, may occur in expressions."""
OPERATORS: dict[type[ast.operator], str] = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}
MAX_ENTRIES = 50_000
MAX_OPERATIONS = 5_000
"""The largest number of operations in one sum or in one product."""


@dataclass
class Array:
    """A list, a tuple or an array of values. If ``integral`` is true, the array has an integer type and can
    store only integers."""

    items: list[Value]
    integral: bool = False
    memory: int = field(default_factory=count().__next__, compare=False)
    """If two arrays have equal values of ``memory``, a change of one array may change the other array."""

    def parts(self) -> set[int]:
        """Return a set of integers: the attribute ``memory`` of this array, and the attribute ``memory`` of
        each nested array, for example of each row."""
        return {self.memory}.union(*(x.parts() for x in self.items if isinstance(x, Array)))


@dataclass(frozen=True)
class Computed:
    """A placeholder for an unknown value. ``reason`` describes what prevents the evaluation, for example a
    call of an unknown function. ``line`` is the line number of the cause."""

    reason: str
    line: int


Value = Expression | Array | Computed | str
"""The value of an expression: a coefficient, an array, a text, or an unknown value."""


class _NotLiteral(Exception):
    """The error for an expression that cannot be evaluated."""

    def __init__(self, node: ast.AST, reason: str) -> None:
        super().__init__(reason)
        self.computed = Computed(reason, getattr(node, "lineno", 0))


@dataclass
class Values:
    """The names that a module has assigned so far, with their values.

    ``text`` is the source of the module. A comment ``# numbers: {...}`` can define numbers. ``named``
    contains the names of these numbers.

    >>> values = Values("x = 2*(1 - sqrt(2))", ())
    >>> values.assign("x", values.value(ast.parse(values.text).body[0].value))
    >>> texts(values.known["x"], "m.py")
    '2*(1 - sqrt(2))'
    """

    text: str
    named: Collection[str]
    known: dict[str, Value] = field(default_factory=dict)
    functions: dict[str, str] = field(default_factory=dict)
    """A map from the imported name of a function to its original name."""
    sources: dict[str, tuple[frozenset[str], frozenset[int]]] = field(default_factory=dict)
    active: set[str] = field(default_factory=set)
    """Names of functions, classes and instances. The use of such a name may execute code of the module."""
    _lines: list[bytes] = field(default_factory=list)
    _entries: int = 0

    def value(self, node: ast.expr) -> Value:
        """Return the value of an expression. If the expression cannot be evaluated, return a placeholder of
        type :class:`Computed` that contains the reason."""
        try:
            return self._value(node)
        except _NotLiteral as problem:
            return problem.computed
        except TableauError as problem:
            return Computed(f"{problem.found}", node.lineno)

    def assign(self, name: str, value: Value, mentioned: Collection[str] = ()) -> None:
        """Assign a value to the variable ``name``.

        If a comment ``# numbers: {...}`` in the module defines a number with this name, do nothing.

        ``mentioned`` lists the variables on which the value may depend, for example the variables on the
        right-hand side of an assignment. If the value is not a :class:`Computed`, ``mentioned`` is ignored.
        """
        if name not in self.named:
            traced = self._traced(mentioned) if isinstance(value, Computed) else (frozenset(), frozenset())
            self.known[name], self.sources[name] = value, traced

    def change(self, names: Collection[str], mentioned: Collection[str], line: int) -> None:
        """Mark the variables ``names`` as unknown after a statement that may change them.

        ``mentioned`` lists all variables in the statement.
        """
        traced = self._traced({*names, *mentioned})
        self.forget(names, line)
        for name in {*names}.difference(self.named):
            self.known[name] = Computed("another statement may change the value", line)
            self.sources[name] = traced

    def _traced(self, names: Collection[str]) -> tuple[frozenset[str], frozenset[int]]:
        reached, memories = set(names), set[int]()
        for name in names:
            more, shared = self.sources.get(name, (frozenset(), frozenset()))
            reached |= more
            memories |= shared
        for value in map(self.known.get, reached):
            memories |= value.parts() if isinstance(value, Array) else set()
        return frozenset(reached), frozenset(memories)

    def assign_entry(self, name: str, place: Sequence[int], value: Value, line: int) -> bool:
        """Assign a value to the entry with the indices ``place``. Return True on success, and False
        otherwise."""
        target = self.known.get(name)
        for k, index in enumerate(place):
            if not isinstance(target, Array) or not -len(target.items) <= index < len(target.items):
                return False
            if k == len(place) - 1:
                if target.integral and not _is_integral(value):
                    return False
                target.items[index] = value
                self._forget_others(target, line)
                return not isinstance(value, Array)
            target = target.items[index]
        return False

    def _forget_others(self, changed: Array, line: int) -> None:
        for name, other in self.known.items():
            if isinstance(other, Array) and changed.memory in other.parts() and not _contains(other, changed):
                self.known[name] = Computed("another statement may change the value", line)

    def forget(self, names: Collection[str], line: int) -> None:
        """Mark the variables ``names`` as unknown.

        If another variable may share an array with one of ``names``, the other variable also becomes unknown.
        """
        doubtful, before = frozenset(names), frozenset[str]()
        while doubtful != before:
            before = doubtful
            doubtful, memories = self._traced(before)
            doubtful |= {
                name
                for name, value in self.known.items()
                if isinstance(value, Array) and value.parts() & memories
            }
        for name in doubtful & self.known.keys():
            self.known[name] = Computed("another statement may change the value", line)

    def _value(self, node: ast.expr) -> Value:
        if isinstance(node, ast.List | ast.Tuple):
            self._entries += len(node.elts)
            if self._entries > MAX_ENTRIES:
                raise _NotLiteral(node, f"more than {MAX_ENTRIES} entries")
            return Array([self._value(x) for x in node.elts])
        if isinstance(node, ast.Constant):
            return self._constant(node)
        if isinstance(node, ast.Name):
            return self._name(node)
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub | ast.UAdd):
            operand = self._number(node.operand)
            return Chain(("-",), (ZERO, operand)) if isinstance(node.op, ast.USub) else operand
        if isinstance(node, ast.BinOp):
            return self._operation(node)
        if isinstance(node, ast.Call):
            return self._call(node)
        if isinstance(node, ast.Dict):
            return _table(node)
        raise _NotLiteral(node, f"an expression of kind {type(node).__name__}")

    def _number(self, node: ast.expr) -> Expression:
        value = self._value(node)
        if isinstance(value, str):
            return parse(value)
        if isinstance(value, Array | Computed):
            raise _NotLiteral(node, "arithmetic with arrays" if isinstance(value, Array) else value.reason)
        return value

    def _constant(self, node: ast.Constant) -> Value:
        if isinstance(node.value, str):
            return node.value
        if type(node.value) is int:
            return Constant(Fraction(node.value))
        if isinstance(node.value, float):
            return parse(coefficient(self._source(node).replace("_", "")))
        raise _NotLiteral(node, f"the value {str(node.value)[:40]}")

    def _source(self, node: ast.expr) -> str:
        """Return the source text of a decimal. The syntax tree contains only the nearest double."""
        if not self._lines:
            self._lines = self.text.encode().splitlines(keepends=True)
        line = self._lines[node.lineno - 1] if node.lineno <= len(self._lines) else b""
        return line[node.col_offset : node.end_col_offset].decode(errors="replace")

    def _name(self, node: ast.Name) -> Value:
        if node.id in self.named:
            return Name(node.id)
        value = self.known.get(node.id)
        if value is None:
            raise _NotLiteral(node, f"the name {node.id!r}")
        return value

    def _operation(self, node: ast.BinOp) -> Expression:
        if isinstance(node.op, ast.Pow):
            exponent = rational(self._number(node.right))
            if exponent is None or abs(exponent.numerator) > 64 or exponent.denominator > 24:
                raise _NotLiteral(
                    node,
                    "an exponent that is not a simple fraction (numerator up to 64, denominator up to 24)",
                )
            return Power(self._number(node.left), exponent)
        # A loop replaces recursion, because a long sum or product could exceed Python's recursion limit.
        signs: list[str] = []
        operands: list[ast.expr] = []
        first: ast.expr = node
        while isinstance(first, ast.BinOp) and _class(first.op) == _class(node.op) != "":
            signs.append(OPERATORS[type(first.op)])
            operands.append(first.right)
            first = first.left
        if not signs:
            raise _NotLiteral(node, f"the operation {type(node.op).__name__}")
        if len(operands) > MAX_OPERATIONS:
            raise _NotLiteral(node, f"an expression with more than {MAX_OPERATIONS} operations")
        terms = (first, *operands[::-1])
        if any(isinstance(x, ast.Constant) and isinstance(x.value, str) for x in terms):
            raise _NotLiteral(node, "arithmetic with strings")
        values = [self._number(x) for x in terms]
        return Chain(tuple(signs[::-1]), tuple(values))

    def _call(self, node: ast.Call) -> Value:
        function = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
        arguments = node.args
        if (root := root_of(node.func)) in self.known:
            raise _NotLiteral(
                node,
                f"a call of {root} is not evaluated, because {root} is defined in the file or imported from "
                "an unsupported library",
            )
        if isinstance(node.func, ast.Name):
            function = self.functions.get(function, function)
        if any(keyword.arg not in ("dtype", "precision", "dps") for keyword in node.keywords):
            raise _NotLiteral(node, f"a keyword argument of {function}")
        if function in ARRAY_CALLS and len(arguments) == 1:
            _require_doubles(node)
            return _array(function, self._value(arguments[0]))
        if function == "zeros" and len(arguments) == 1:
            _require_doubles(node)
            return _zeros(self._value(arguments[0]), node)
        if function in ROOTS and len(arguments) == 1 and not node.keywords:
            return Power(self._number(arguments[0]), Fraction(1, ROOTS[function]))
        if function in QUOTIENT_CALLS and len(arguments) == 2 and not node.keywords:
            return Chain(("/",), (self._number(arguments[0]), self._number(arguments[1])))
        if function in NUMBER_CALLS and len(arguments) == 1 and not node.keywords:
            return self._converted(function, arguments[0])
        if function in ROUNDED_CALLS and 1 <= len(arguments) <= 2:
            _require_digits(node)
            return self._converted(function, arguments[0])
        raise _NotLiteral(node, f"a call of {function or 'a function'}")

    def _converted(self, function: str, argument: ast.expr) -> Expression:
        """Return a number from a call such as ``Fraction("1/3")`` or ``Float('0.577')``."""
        text = argument.value if isinstance(argument, ast.Constant) else None
        if function == "int" and not (isinstance(text, int | str)):
            raise _NotLiteral(argument, "a call of int")
        if function in ROUNDED_CALLS and isinstance(text, str):
            return parse(f"{text}~" if "." in text else text)
        return self._number(argument)


def root_of(node: ast.expr) -> str:
    """Return the first name of an expression such as ``np.linalg.norm``, or '' if there is none.

    >>> root_of(ast.parse("np.linalg.norm", mode="eval").body)
    'np'
    """
    while isinstance(node, ast.Attribute | ast.Subscript | ast.Starred):
        node = node.value
    return node.id if isinstance(node, ast.Name) else ""


def _class(operator: ast.operator) -> str:
    """Return ``sum`` for + and -, ``product`` for * and /, and an empty text for other operators."""
    return {"+": "sum", "-": "sum", "*": "product", "/": "product"}.get(OPERATORS.get(type(operator), ""), "")


def _require_doubles(node: ast.Call) -> None:
    """Raise an error if a call has a ``dtype`` such as ``float32`` (:data:`NARROW`)."""
    for keyword in node.keywords:
        if keyword.arg == "dtype" and any(x in ast.dump(keyword.value) for x in NARROW):
            raise _NotLiteral(node, "a dtype other than float64")


def _require_digits(node: ast.Call) -> None:
    """Raise an error if the precision in a call such as ``Float('0.577', 2)`` is too low for the digits of
    the number. In this example, the precision is two digits."""
    text = node.args[0].value if isinstance(node.args[0], ast.Constant) else None
    digits = sum(x.isdigit() for x in text) if isinstance(text, str) else 17
    # One bit corresponds to log10(2) = 0.30103 digits.
    allowed = [(x, 1.0, 0) for x in node.args[1:]]
    allowed += [(k.value, 0.30103, 2) if k.arg == "precision" else (k.value, 1.0, 0) for k in node.keywords]
    for given, factor, more in allowed:
        size = given.value if isinstance(given, ast.Constant) else None
        if type(size) is not int or factor * size < digits - more:
            raise _NotLiteral(node, "a precision that may drop digits of the number")


def _is_integral(value: Value) -> bool:
    """Return True if a value is an integer, or an array of integers."""
    if isinstance(value, Array):
        return all(map(_is_integral, value.items))
    if isinstance(value, Chain) and value.operators == ("-",) and value.operands[0] == ZERO:
        value = value.operands[1]
    return isinstance(value, Constant) and value.value.denominator == 1 and not value.unit


def _array(function: str, given: Value) -> Value:
    """Return the array that a constructor of :data:`ARRAY_CALLS` makes from a value."""
    integral = function in TYPED_CALLS and _is_integral(given)
    if function in COPYING_CALLS or not isinstance(given, Array):
        return _copy(given, integral)
    if function == "asarray":
        return _twin(given, integral)
    return Array(list(given.items))


def _copy(value: Value, integral: bool) -> Value:
    """Copy an array and its rows. The copies have the attribute ``integral`` with the given value. Return
    other values unchanged."""
    return Array([_copy(x, integral) for x in value.items], integral) if isinstance(value, Array) else value


def _twin(value: Array, integral: bool) -> Array:
    """Return the array that ``asarray`` makes from ``value``.

    The result has the attribute ``memory`` of ``value``, because ``asarray`` may return its argument without
    a copy.
    """
    items = [_twin(x, integral) if isinstance(x, Array) else x for x in value.items]
    return Array(items, integral, value.memory)


def _contains(array: Array, part: Array) -> bool:
    """Return True if ``part`` is the array or one of its rows."""
    return array is part or any(isinstance(x, Array) and _contains(x, part) for x in array.items)


def _zeros(shape: Value, node: ast.Call) -> Array:
    sizes = shape.items if isinstance(shape, Array) else [shape]
    lengths = [x.value for x in sizes if isinstance(x, Constant) and x.value.denominator == 1]
    if len(lengths) != len(sizes) or len(sizes) not in (1, 2) or not all(1 <= n <= 200 for n in lengths):
        raise _NotLiteral(
            node,
            "a call of zeros with an unsupported shape; write zeros(n) or zeros((m, n)), with "
            "integers from 1 to 200",
        )
    if len(lengths) == 1:
        return Array([ZERO] * int(lengths[0]))
    return Array([Array([ZERO] * int(lengths[1])) for _ in range(int(lengths[0]))])


def _table(node: ast.Dict) -> str:
    """Return a dictionary of constants as JSON."""
    try:
        return json.dumps(ast.literal_eval(node))
    except (ValueError, TypeError, RecursionError, MemoryError):
        raise _NotLiteral(node, "a dictionary that does not consist of constants") from None


def rational(x: Expression) -> Fraction | None:
    """Return the fraction that an expression such as 1/3 or -0.5 represents. Return None for roots,
    rounded decimals and all other expressions.

    >>> rational(parse("1/3")), rational(parse("-0.5")), rational(parse("sqrt(2)"))
    (Fraction(1, 3), Fraction(-1, 2), None)
    """
    if isinstance(x, Constant) and not x.unit:
        return x.value
    if isinstance(x, Chain) and x.operators in (("-",), ("/",)):
        left, right = (rational(operand) for operand in x.operands)
        if left is None or right is None or (x.operators == ("/",) and not right):
            return None
        return left - right if x.operators == ("-",) else left / right
    return None


def texts(value: Value, where: str) -> Cells:
    """Return the text of a number, or nested lists of texts for an array.

    Raise TableauError for an expression that could not be evaluated.

    >>> texts(Array([Constant(Fraction(1, 2)), ZERO]), "m.py")
    ['0.5', '0']
    """
    if isinstance(value, Array):
        return [texts(x, where) for x in value.items]
    if isinstance(value, Computed):
        raise TableauError(
            f"the value is not known without executing the file: {value.reason}",
            where=f"{where}: line {value.line}",
            expected="a number",
            hint="write the values as numbers, or execute the file with 'orderconds check --execute'",
        )
    if isinstance(value, str):
        return value
    text = spell(value, MAX_TEXT)
    if len(text) > MAX_TEXT:
        raise TableauError(
            "a coefficient that is too long", where=where, expected=f"at most {MAX_TEXT} characters"
        )
    return text
