"""Translate the assignments and calls in a kernel to statements of the run representation."""

from __future__ import annotations

from collections.abc import Sequence

from codegen.ir.expr import Expr
from codegen.kernel.schedule import Assignment, Invocation, Simple, result_of
from codegen.run.language import Array, Assign, Call, Statement
from codegen.run.terms import Term, own, value


def simple(statement: Simple) -> list[Statement]:
    """Translate one assignment or one call in a kernel to statements of the run representation."""
    if isinstance(statement, Assignment):
        return [Assign(own(statement.name), value(statement.value))]
    if isinstance(statement, Invocation):
        given = tuple(map(value, statement.arguments))
        if statement.arrays:
            return _in_arrays(statement)
        # A single result is returned as a value. An array with one entry would need a store and a load.
        if statement.results == 1:
            return [Call(statement.function, given, (own(statement.names[0]),))]
        results = own(statement.name, statement.results)
        return [Array(results), Call(statement.function, (*given, results))]
    # All Stumpff functions of an argument need the same square root, sine and cosine. Therefore one call
    # computes all Stumpff functions of the argument.
    names = tuple(map(own, statement.names))
    return [Call(statement.function, (value(statement.argument),), names)]


def _in_arrays(statement: Invocation) -> list[Statement]:
    """Return the statements for the call of a function whose arguments and results are arrays."""
    declared: list[Statement] = []
    given: list[Term] = []
    first = 0
    for number, size in enumerate(statement.arrays):
        arguments = statement.arguments[first : first + size]
        first += size
        array = _part(arguments)
        if array is None:
            # This name contains spaces, so it differs from the names of all kernel variables.
            array = own(f"{statement.name} given {number}", size)
            declared.append(Array(array, tuple(map(value, arguments))))
        given.append(array)
    results = own(statement.name, statement.results)
    return [*declared, Array(results), Call(statement.function, (*given, results))]


def _part(arguments: Sequence[Expr]) -> Term | None:
    """Return ``arguments`` as a slice of the array that contains the results of an earlier call.

    If no such slice exists, return None.
    """
    results = [result_of(x.payload) if x.op == "sym" else None for x in arguments]
    # The lists ``results`` and ``arguments`` have the same length. If this length is 1, None is returned,
    # because the only argument may be stored in a scalar variable. A scalar variable has no slices.
    if results[0] is None or len(results) == 1:
        return None
    name, start = results[0]
    # The arguments must be consecutive entries of the same array.
    if any(x != (name, start + k) for k, x in enumerate(results)):
        return None
    return Term("part", (own(name, 0),), number=start, shape=(len(arguments),))
