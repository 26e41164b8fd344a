"""An interpreter for emitted programs. It computes with many kinds of numbers (:mod:`codegen.ir.domain`).

The programs consist of the statements in :mod:`codegen.run.language`. The statements compare numbers, so the
numbers must have an order.

>>> from codegen.ir.domain import FloatDomain
>>> from codegen.run.language import Assign, Function, Return, Unit, While
>>> from codegen.run.terms import Kind, count, real, whole
>>> x, n, root = real("x"), count("n"), real("root")
>>> halve = While(n < 6, (Assign(root, 0.5 * (root + x / root)), Assign(n, n + 1)))
>>> body = (Assign(root, x), Assign(n, whole(0)), halve, Return(root))
>>> heron = Function("heron", "", (x,), body, Kind.REAL)
>>> Machine(Unit((), (), (), (heron,)), FloatDomain(0.0)).call("heron", 2.0)
1.414213562373095
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from itertools import chain
from types import SimpleNamespace
from typing import Any

from codegen.ir.domain import Domain, FloatDomain
from codegen.ir.expr import Expr, power
from codegen.ir.ieee import divided
from codegen.ir.vector_calls import vector_function
from codegen.run.elimination import inverted
from codegen.run.identifiers import Identifiers, identify
from codegen.run.language import (
    LANGUAGE,
    RAISES_STATUS,
    Array,
    Assign,
    Body,
    Call,
    For,
    Function,
    If,
    Note,
    Return,
    Statement,
    Unit,
    While,
)
from codegen.run.terms import NOT_FINITE, STATUSES, Kind, Term
from codegen.run.writes import written

Environment = dict[str, Any]
Value = Callable[[Environment], Any]
Action = Callable[[Environment], bool]
"""An action executes a statement and returns True if the statement ended the function."""

RESULT = "result of the function"
"""The key of a function's result in an ``Environment``. It contains spaces, so it is not an identifier."""

_BINARY: Mapping[str, Callable[[Any, Any], Any]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
    "//": operator.floordiv,
    "%": operator.mod,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
    "==": operator.eq,
    "!=": operator.ne,
}


class Machine:
    """Executes the functions of a unit (one emitted program) with the numbers of ``domain``.

    - Arrays are lists, and arrays of rows are lists of lists.
    - If a function returns a value through an argument, this argument is a list of one entry.
    - The value of an absent argument is None.
    - Run-time inputs are passed as a function of time, which returns the values of all inputs.
    """

    def __init__(self, unit: Unit, domain: Domain) -> None:
        self.unit, self.domain = unit, domain
        self.tables: Environment = {}
        for table in unit.tables:
            # The numbers in the tables are converted here, because a conversion at each access would be slow.
            rows = [[self.number(x) for x in row] for row in table.rows]
            self.tables[table.name.text] = rows if len(table.name.shape) > 1 else rows[0]
        # Here the identifiers are only keys of dictionaries, so an identifier may be a Python keyword.
        identifiers = identify(unit, ())
        self.compiled = {f.name: _Compiler(self, identifiers[f.name]).body(f.body) for f in unit.functions}
        self.parameters = {f.name: [identifiers[f.name].of(p) for p in f.parameters] for f in unit.functions}

    def number(self, x: float) -> Any:
        """Convert a float to a number of the domain. An infinity or a NaN is returned unchanged."""
        if not math.isfinite(x):
            return x
        fraction = Fraction(x)
        return self.domain.rational(fraction.numerator, fraction.denominator)

    def record(self, name: str) -> Any:
        """Return a record whose fields are all zero."""
        # The compiled functions read the fields of a record with ``getattr``, so the fields must be
        # attributes.
        record = SimpleNamespace()
        self.clear(record, name)
        return record

    def clear(self, record: Any, name: str) -> None:
        """Set every field of a record to zero."""
        for term, _ in self.unit.record(name).fields:
            setattr(record, term.text, self.zero(term.shape, term.kind))

    def zero(self, shape: Sequence[int], kind: Kind, record: str = "") -> Any:
        """Return zero for the kind ``kind``, or an array of zeros if ``shape`` is not empty."""
        if shape:
            return [self.zero(shape[1:], kind, record) for _ in range(shape[0])]
        if kind is Kind.RECORD:
            return self.record(record)
        # Counts and flags are Python integers, not numbers of the domain.
        return self.number(0.0) if kind in (Kind.REAL, Kind.WIDE) else 0

    def call(self, name: str, *arguments: Any) -> Any:
        """Execute the function ``name`` and return its result. Arguments may be changed in place."""
        function = self.unit.parts[name]
        # Arrays are passed by reference, as in C.
        environment = dict(zip(self.parameters[name], arguments, strict=True)) | self.tables
        if not function.guard:
            self.compiled[name](environment)
            return environment.get(RESULT)
        try:
            self.compiled[name](environment)
        except (ArithmeticError, ValueError):
            return self.guarded(function, arguments)
        return environment.get(RESULT)

    def guarded(self, function: Function, arguments: Sequence[Any]) -> Any:
        """Return a replacement for the result of ``function`` after an arithmetic error in ``function``.

        If the function returns a status, the replacement is NOT_FINITE. Otherwise the replacement is NaN, and
        all output arrays are filled with NaNs.
        """
        # Where Python raises an exception, for example for a division by zero, IEEE arithmetic gives an
        # infinity or a NaN. The status NOT_FINITE reports such values.
        if function.guard == RAISES_STATUS:
            return STATUSES.index(NOT_FINITE)
        changed = written(self.unit, function)
        for parameter, argument in zip(function.parameters, arguments, strict=True):
            if parameter.text in changed:
                # The caller reads this list after the call, so the list is changed in place.
                argument[:] = [math.nan] * len(argument)
        return math.nan


def is_number(x: Any) -> bool:
    """Return True if the number ``x`` is neither infinite nor NaN."""
    # In every domain, ``x - x`` is NaN if x is an infinity or a NaN.
    return bool(x - x == 0)


class _Compiler:
    """Compiles the body of one function to Python closures."""

    def __init__(self, machine: Machine, identifiers: Identifiers) -> None:
        self.machine, self.identifiers = machine, identifiers

    def body(self, body: Body) -> Action:
        """Return the action that executes a sequence of statements."""
        actions = [self.statement(s) for s in body if not isinstance(s, Note)]

        def run(env: Environment) -> bool:
            # ``any`` stops at the first action that ends the function.
            return any(action(env) for action in actions)

        return run

    def statement(self, statement: Statement) -> Action:
        """Return the action that executes a statement."""
        match statement:
            case Assign(target, value):
                return self.assign(target, value)
            case Array(name, values, _):
                return self.array(name, values)
            case For():
                return self.counted(statement)
            case While():
                return self.repeated(statement)
            case If(test, body, orelse):
                return self.branch(self.term(test), self.body(body), self.body(orelse))
            case Call(function, arguments, results):
                return self.call(function, arguments, results)
            case Return(value):
                return self.returned(self.term(value))
            case Note():
                raise AssertionError(statement)

    def returned(self, value: Value) -> Action:
        def run(env: Environment) -> bool:
            env[RESULT] = value(env)
            return True

        return run

    def branch(self, test: Value, yes: Action, no: Action) -> Action:
        return lambda env: yes(env) if test(env) else no(env)

    def counted(self, loop: For) -> Action:
        index, number, body = self.identifiers.of(loop.index), self.term(loop.count), self.body(loop.body)

        def run(env: Environment) -> bool:
            # The number of iterations is evaluated once, because the body of the loop does not change it.
            places = range(number(env))
            for k in reversed(places) if loop.reverse else places:
                env[index] = k
                if body(env):
                    return True
            return False

        return run

    def repeated(self, loop: While) -> Action:
        test, body = self.term(loop.test), self.body(loop.body)

        def run(env: Environment) -> bool:
            # With ``at_least_once``, the body is executed before the first test.
            again = loop.at_least_once or test(env)
            while again:
                if body(env):
                    return True
                again = test(env)
            return False

        return run if loop.guard is None else self.caught(run, self.store(loop.guard))

    def caught(self, loop: Action, store: Callable[[Environment, Any], None]) -> Action:
        """Return an action that runs ``loop``. After an arithmetic error, the action stores NOT_FINITE."""

        def run(env: Environment) -> bool:
            try:
                return loop(env)
            except (ArithmeticError, ValueError):
                store(env, STATUSES.index(NOT_FINITE))
                return False

        return run

    def array(self, name: Term, values: Sequence[Term]) -> Action:
        identifier, listed = self.identifiers.of(name), [self.term(v) for v in values]
        machine = self.machine

        def run(env: Environment) -> bool:
            env[identifier] = (
                [value(env) for value in listed]
                if listed
                else machine.zero(name.shape, name.kind, name.record)
            )
            return False

        return run

    def assign(self, target: Term, value: Term) -> Action:
        """Return the action that assigns a value, for example to a variable or to an entry of an array."""
        if value.op == "fresh":
            # Other functions may refer to this record, so the fields of the record are cleared in place.
            record, machine = self.term(target), self.machine

            def clear(env: Environment) -> bool:
                machine.clear(record(env), value.record)
                return False

            return clear
        if target.shape:
            return self.copied(target, self.term(value))
        store, given = self.store(target), self.term(value)

        def run(env: Environment) -> bool:
            store(env, given(env))
            return False

        return run

    def copied(self, target: Term, value: Value) -> Action:
        """Return the action that copies an array."""
        start = int(target.number) if target.op == "part" else 0
        array, n = self.term(target.args[0] if target.op == "part" else target), target.shape[0]

        def run(env: Environment) -> bool:
            # The assignment to a slice copies the entries, so the target and the value remain separate lists.
            array(env)[start : start + n] = value(env)
            return False

        return run

    def store(self, target: Term) -> Callable[[Environment, Any], None]:
        """Return the closure that assigns a value to an entry, a field or a scalar variable."""
        if target.op == "item":
            array, index = self.term(target.args[0]), self.term(target.args[1])

            def entry(env: Environment, x: Any) -> None:
                array(env)[index(env)] = x

            return entry
        if target.op == "field":
            record, name = self.term(target.args[0]), target.text
            return lambda env, x: setattr(record(env), name, x)
        identifier = self.identifiers.of(target)
        return lambda env, x: env.__setitem__(identifier, x)

    def call(self, function: str, arguments: Sequence[Term], results: Sequence[Term]) -> Action:
        given = [self.term(a) for a in arguments]
        stores = [self.store(r) for r in results if not r.shape]
        machine = self.machine
        if function in LANGUAGE:
            callback, *passed_on = given
            array = self.identifiers.of(results[0])

            def sample(env: Environment) -> bool:
                env[array] = list(callback(env)(*(value(env) for value in passed_on)))
                return False

            return sample
        # The library function is looked up only once, because a search at each call would be slow.
        library = _library(function, machine.domain)

        def run(env: Environment) -> bool:
            passed = [value(env) for value in given]
            results = library(*passed) if library is not None else [machine.call(function, *passed)]
            # If the call has no results, ``stores`` is empty, and nothing is stored.
            for store, x in zip(stores, results, strict=False):
                store(env, x)
            return False

        return run

    def term(self, term: Term) -> Value:
        """Return the closure that evaluates a term."""
        if term.op in _BINARY:
            left, right, binary = self.term(term.args[0]), self.term(term.args[1]), _BINARY[term.op]
            return lambda env: binary(left(env), right(env))
        match term.op:
            case "name":
                return self.name(self.identifiers.of(term))
            case "value":
                assert term.value is not None
                return self.expression(term.value)
            case "number" | "status" | "none" | "infinity":
                return self.constant(term)
            case "and" | "or" | "not" | "select":
                return self.logical(term.op, [self.term(a) for a in term.args])
            case _:
                return self.access(term, [self.term(a) for a in term.args])

    def name(self, identifier: str) -> Value:
        base, bracket, index = identifier.partition("[")
        if bracket:
            place = int(index.removesuffix("]"))
            return lambda env: env[base][place]
        return lambda env: env[identifier]

    def constant(self, term: Term) -> Value:
        """Return the closure that evaluates a constant term."""
        value: Any = None
        if term.op == "status":
            value = STATUSES.index(term.text)
        elif term.op == "infinity":
            value = math.inf
        elif term.op == "number":
            value = self.machine.number(term.number) if term.kind is Kind.REAL else int(term.number)
        return lambda env: value

    def logical(self, op: str, args: Sequence[Value]) -> Value:
        if op == "not":
            (x,) = args
            return lambda env: not x(env)
        if op == "select":
            test, yes, no = args
            return lambda env: yes(env) if test(env) else no(env)
        a, b = args
        if op == "and":
            return lambda env: a(env) and b(env)
        return lambda env: a(env) or b(env)

    def access(self, term: Term, args: Sequence[Value]) -> Value:
        """Return the closure that evaluates ``term``, for example an array entry or a record field."""
        first = args[0]
        match term.op:
            case "item":
                index = args[1]
                return lambda env: first(env)[index(env)]
            case "part":
                start, n = int(term.number), term.shape[0]
                return lambda env: first(env)[start : start + n]
            case "field":
                field = term.text
                return lambda env: getattr(first(env), field)
            case "neg":
                return lambda env: -first(env)
            # All numbers of a domain have the same precision, so a conversion changes nothing.
            case "wide" | "narrow":
                return first
            case "given":
                return lambda env: first(env) is not None
            case "holding":
                return lambda env: lambda t: first(env)
            case "finite" if term.args[0].shape:
                return lambda env: all(map(is_number, first(env)))
            case "finite":
                return lambda env: all(is_number(value(env)) for value in args)
            case _:
                return self.function(term.text, args)

    def function(self, name: str, args: Sequence[Value]) -> Value:
        """Return the closure that computes a mathematical function, for example the square root."""
        domain, first = self.machine.domain, args[0]
        match name:
            case "abs":
                return lambda env: abs(first(env))
            case "greatest":
                return lambda env: max(value(env) for value in args)
            case "largest":
                return lambda env: max(map(abs, first(env)))
            case "isfinite":
                return lambda env: is_number(first(env))
            case "sqrt":
                return lambda env: domain.call("sqrt", first(env))
            case "copysign":
                second = args[1]
                # Exact numbers have no negative zero, so a zero counts as positive.
                return lambda env: abs(first(env)) if second(env) >= 0 else -abs(first(env))
            case _:
                assert name == "power"
                exponent = args[1]
                return lambda env: _power(first(env), exponent(env))

    def expression(self, root: Expr) -> Value:
        """Return the closure that evaluates ``root``, an expression of the kernel."""
        domain = self.machine.domain
        args = [self.expression(a) for a in root.args]
        match root.op:
            case "const":
                constant = domain.number(root.payload)
                return lambda env: constant
            case "sym":
                return self.name(self.identifiers.by_name.get(root.payload, root.payload))
            case "add" | "sub" | "mul" | "div":
                left, right = args
                binary = _BINARY[{"add": "+", "sub": "-", "mul": "*", "div": "/"}[root.op]]
                # In C, 1 / (1 + 1 / x) is 0 for x = 0. Python's ``/`` raises an exception for 1 / x, so
                # ``divided`` replaces ``/`` for doubles.
                if root.op == "div" and isinstance(domain, FloatDomain):
                    binary = divided
                return lambda env: binary(left(env), right(env))
            case "neg":
                (x,) = args
                return lambda env: -x(env)
            case "pow":
                (base,), exponent = args, root.payload
                return lambda env: power(base(env), exponent)
            case _:
                name = root.payload
                return lambda env: domain.call(name, *(value(env) for value in args))


def _power(x: Any, exponent: Any) -> Any:
    """Return a power of ``x``. As in C, a negative power of 0 is infinite."""
    if not x and exponent != 0:
        return math.inf if exponent < 0 else x
    return x**exponent


def _library(function: str, domain: Domain) -> Callable[..., Sequence[Any]] | None:
    """Return a Python version of ``function`` if it is a library function, otherwise None."""
    if function == "invert":
        return lambda n, matrix: [inverted(n, matrix)]
    if vector_function(function) is not None:
        # The method ``domain.vector`` is faster than the execution of the emitted statements.
        return lambda *x: x[-1].__setitem__(slice(None), domain.vector(function, [*chain(*x[:-1])])) or ()
    if function.startswith("stumpff_"):
        orders = [int(k) for k in function.removeprefix("stumpff_")]
        together = getattr(domain, "together", None)
        if together is not None:
            return lambda z: together(orders, z)
        return lambda z: [domain.call(f"stumpff{k}", z) for k in orders]
    return None
