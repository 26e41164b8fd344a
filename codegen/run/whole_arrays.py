"""Find long arrays that emitted code can handle as a whole, instead of entry by entry.

For large matrix groups, states and products of matrices are long arrays. Without this module, emitted code
would list all entries of such an array in each call, test and assignment.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from codegen.ir.expr import Expr, walk
from codegen.kernel.schedule import result_of
from codegen.run.language import Array, Call, Statement, terms
from codegen.run.terms import Term, own

SHORTEST = 25
"""Arrays with at least this number of entries are passed, copied and tested for finiteness as a whole.

The entries of a shorter array are scalar variables, which a compiler can keep in registers.
"""


def whole_result(outputs: Sequence[Expr]) -> Term | None:
    """Return the array with the entries ``outputs``, if the outputs are the results of one call.

    None is returned if the outputs are not the results of one call, or if they are fewer than SHORTEST.
    """
    if len(outputs) < SHORTEST:
        return None
    results = [result_of(x.payload) if x.op == "sym" else None for x in outputs]
    # ``results`` contains None for each output that is not the result of a call.
    if results[0] is None:
        return None
    name = results[0][0]
    # Output k must be result k of the call ``name``.
    if any(x != (name, k) for k, x in enumerate(results)):
        return None
    return own(name, len(outputs))


def in_state(sequence: Iterable[Statement], symbols: Sequence[str], state: Term) -> list[Statement]:
    """Return ``sequence`` without the statements that copy long parts of the array ``state``.

    An ``Array`` statement is removed if it copies at least SHORTEST consecutive entries of ``state``.
    ``symbols`` are the names of the entries of ``state``.
    """
    places = {s: k for k, s in enumerate(symbols)}
    parts: dict[str, Term] = {}
    result: list[Statement] = []
    for statement in sequence:
        if isinstance(statement, Array) and len(statement.values) >= SHORTEST:
            # ``read`` contains the index in ``state`` for each value, or None for a value not in ``state``.
            read = [places.get(x.text) if x.op == "name" else None for x in statement.values]
            first = read[0]
            if first is not None and read == list(range(first, first + len(read))):
                # ``statement`` copies a part of ``state`` to a new array. This statement is omitted. If a
                # later ``Call`` has the new array as an argument, the part of ``state`` replaces this
                # argument.
                parts[statement.name.text] = state.part(first, len(read))
                continue
        if isinstance(statement, Call):
            given = statement.arguments
            replaced = tuple(parts.get(a.text, a) if a.op == "name" else a for a in given)
            statement = replace(statement, arguments=replaced)
        result.append(statement)
    return result


def names_in(body: Iterable[Statement]) -> frozenset[str]:
    """Return the names of all variables that the statements contain."""
    names = set()
    # Expressions share subexpressions. A single walk over all expressions visits each subexpression once.
    values = []
    for term in terms(body):
        if term.op == "name":
            names.add(term.text)
        elif term.value is not None:
            values.append(term.value)
    return frozenset(names | {n.payload for n in walk(values) if n.op == "sym"})
