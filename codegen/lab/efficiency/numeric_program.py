"""Replaces the operations in the program of a step by Python functions, to make the interpreter faster.

Each operation, except a linear combination, is evaluated once with symbols. The resulting expressions are
converted to one Python function of doubles. The interpreter then runs about ten times faster.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial

from codegen.ir.domain import Domain, ExprDomain, FloatDomain, Values
from codegen.ir.expr import Expr
from codegen.ir.ieee import ieee
from codegen.ir.interpret import flatten
from codegen.ir.operations import Linear, Operation
from codegen.ir.operations import Problem as Evaluated
from codegen.ir.program import Assign, Program, Statement
from codegen.ir.values import Kind, Var
from codegen.ir.vector_calls import vector_function
from codegen.lab.number_types import Evaluate, Scalar
from codegen.lab.straight_line_field import straight_line
from codegen.scene.problem import Problem

Shape = tuple[tuple[str, int], ...]
"""Pairs (kind, width) that describe the arguments of an operation, or the results of an operation.

The width is the number of components.
"""


@dataclass(frozen=True)
class Symbolic:
    """An operation that was evaluated on symbols.

    - ``expressions``: the components of all results, as expressions in the symbols.
    - ``widths``: the width (number of components) of each result.
    - ``symbols``: the names of the components of the arguments, followed by the name of the step size.
    """

    expressions: tuple[Expr, ...]
    widths: tuple[int, ...]
    symbols: tuple[str, ...]

    def function(self) -> Evaluate:
        """Return a Python function that maps the values of the symbols to the values of the expressions."""
        code = straight_line("operation", self.symbols, self.expressions)
        return code.python(float, {name: _called(name) for name in code.functions})


def symbolic(assign: Assign, problem: Problem, shape: Shape) -> Symbolic:
    """Evaluate the operation of an assignment on symbols, and return its results as expressions.

    ``shape`` contains the kind and the width of each argument.
    """
    domain = ExprDomain(problem.roots[0].space)
    names: list[str] = []
    values: list[object] = []
    for k, (kind, width) in enumerate(shape):
        own = [f"{k}.{i}" for i in range(width)]
        names += own
        symbols = tuple(map(domain.space.sym, own))
        values.append(symbols[0] if kind == Kind.REAL.value else symbols)
    results = assign.operation.evaluate(problem, domain, tuple(values))
    flat = [flatten(v.kind, x) for v, x in zip(assign.targets, results, strict=True)]
    return Symbolic(tuple(x for part in flat for x in part), tuple(map(len, flat)), (*names, "h"))


def _called(name: str) -> Callable[..., float | tuple[float, ...]]:
    """Return a Python function that evaluates the function ``name`` in doubles.

    The results equal those of :meth:`FloatDomain.vector` for a vector function, and those of
    :meth:`FloatDomain.call` for other functions.
    """
    domain = FloatDomain(0.0)
    # This is faster than ``domain.call``, which compares the name with the names of other functions.
    if hasattr(math, name):
        return partial(ieee, name)
    if vector_function(name) is not None:
        return lambda *args: domain.vector(name, args)
    return lambda *args: domain.call(name, *args)


@dataclass(frozen=True)
class Numeric(Operation):
    """An operation that calls a Python function of doubles.

    ``parts`` contains the kind and the width (number of components) of each result. ``function`` is the
    Python function. In the program of a step, this operation replaces a slower operation with the same
    results. ``label`` is the name of the slower operation.
    """

    function: Evaluate
    parts: Shape
    label: str

    @property
    def name(self) -> str:
        """The name of the operation that this object replaces."""
        return self.label

    def evaluate(self, problem: Evaluated, domain: Domain, args: Values) -> Values:
        """Call the Python function with the components of ``args`` and the step size ``domain.h``.

        Return one entry for each result: a number if the kind of the result is REAL, and otherwise a vector.
        """
        flat: list[Scalar] = []
        for x in args:
            if isinstance(x, tuple):
                flat.extend(x)
            else:
                flat.append(x)
        flat.append(domain.h)
        values = self.function(flat, 0.0)
        results, at = [], 0
        for kind, width in self.parts:
            results.append(values[at] if kind == Kind.REAL.value else values[at : at + width])
            at += width
        return tuple(results)


@dataclass(frozen=True)
class NumericLinear(Operation):
    """A linear combination of doubles.

    Each coefficient is a number c times a power h^k of the step size h. ``coefficients`` contains the pairs
    (c, k).
    """

    coefficients: tuple[tuple[float, int], ...]
    name = "lin"

    def evaluate(self, problem: Evaluated, domain: Domain, args: Values) -> Values:
        """Return the linear combination of ``args`` with the coefficients of this operation."""
        h = domain.h
        factors = [c * h**power for c, power in self.coefficients]
        if len(factors) == 1:
            factor = factors[0]
            return (tuple([factor * x for x in args[0]]),)
        return (tuple([sum(map(float.__mul__, factors, xs)) for xs in zip(*args, strict=True)]),)


@dataclass
class NumericPrograms:
    """Replaces each operation of a :class:`Program` by a Python function.

    If two programs contain the same operation, both programs use the same function.
    """

    functions: dict[object, Evaluate] = field(default_factory=dict)

    def of(self, program: Program, problem: Problem, widths: dict[Var, int]) -> Program:
        """Return the program of a step after replacing each operation by a Python function.

        ``widths`` contains the number of components of each variable.
        """

        def replaced(assign: Assign) -> Assign:
            return replace(assign, operation=self._numeric(assign, problem, widths))

        body: list[Statement] = []
        for statement in program.body:
            if isinstance(statement, Assign):
                body.append(replaced(statement))
            else:
                body.append(replace(statement, body=tuple(map(replaced, statement.body))))
        return replace(program, body=tuple(body))

    def _numeric(self, assign: Assign, problem: Problem, widths: dict[Var, int]) -> Operation:
        operation = assign.operation
        if isinstance(operation, Linear):
            return NumericLinear(tuple((float(c.value), c.power) for c in operation.coefficients))
        shape = tuple((a.kind.value, widths[a]) for a in assign.args)
        key = problem.group.name, len(problem.roots), operation, shape
        if key not in self.functions:
            self.functions[key] = symbolic(assign, problem, shape).function()
        parts = tuple((v.kind.value, widths[v]) for v in assign.targets)
        return Numeric(self.functions[key], parts, operation.name)
