"""Single assignments of a kernel, and its calls, as statements of the run representation."""

from __future__ import annotations

from codegen.kernel.schedule import Assignment, Invocation, Simple
from codegen.run.language import Array, Assign, Call, Statement
from codegen.run.terms import own, value


def simple(statement: Simple) -> list[Statement]:
    """Return the statements of an assignment, a call of Stumpff functions, or of an outlined function."""
    if isinstance(statement, Assignment):
        return [Assign(own(statement.name), value(statement.value))]
    if isinstance(statement, Invocation):
        given = tuple(map(value, statement.arguments))
        if statement.in_array:
            # No name of the kernel contains a space, so the name of the array differs from all names of the
            # kernel.
            array = own(f"{statement.name} given", len(given))
            outputs = own(statement.name, statement.results)
            return [Array(array, given), Array(outputs), Call(statement.function, (array, outputs))]
        # A single result is returned by value, because an array of one entry would cost a store and a load.
        if statement.results == 1:
            return [Call(statement.function, given, (own(statement.names[0]),))]
        results = own(statement.name, statement.results)
        return [Array(results), Call(statement.function, (*given, results))]
    # One call computes all Stumpff functions of an argument, because they share a square root, a sine and a
    # cosine.
    names = tuple(map(own, statement.names))
    return [Call(statement.function, (value(statement.argument),), names)]
