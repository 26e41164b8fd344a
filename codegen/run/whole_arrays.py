"""Arrays that a step passes, tests and copies as a whole, instead of entry by entry.

The state of a large matrix group is one array, and so is the result of a product of matrices. Without this
module, each call, the test of the result and the assignment of the new state would list all entries.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from codegen.ir.expr import Expr, walk
from codegen.kernel.schedule import result_of
from codegen.run.language import Array, Call, Statement, terms
from codegen.run.terms import Term, own

SHORTEST = 25
"""The least number of entries of an array that is treated as a whole: a matrix with five rows. Shorter
results stay in registers."""


def whole_result(outputs: Sequence[Expr]) -> Term | None:
    """Return the array of the results of a call, if the outputs are the entries 0, 1, 2, ... of this array in
    this order; else None."""
    if len(outputs) < SHORTEST:
        return None
    results = [result_of(x.payload) if x.op == "sym" else None for x in outputs]
    if results[0] is None:
        return None
    name = results[0][0]
    if any(x != (name, k) for k, x in enumerate(results)):
        return None
    return own(name, len(outputs))


def in_state(sequence: Iterable[Statement], symbols: Sequence[str], state: Term) -> list[Statement]:
    """Return the statements without unnecessary copies: an array that contains consecutive entries of the
    state is removed, and calls get a part of the array ``state`` in its place. ``symbols`` are the names of
    the entries of the state."""
    places = {s: k for k, s in enumerate(symbols)}
    parts: dict[str, Term] = {}
    result: list[Statement] = []
    for statement in sequence:
        if isinstance(statement, Array) and len(statement.values) >= SHORTEST:
            read = [places.get(x.text) if x.op == "name" else None for x in statement.values]
            first = read[0]
            if first is not None and read == list(range(first, first + len(read))):
                parts[statement.name.text] = state.part(first, len(read))
                continue
        if isinstance(statement, Call):
            given = statement.arguments
            replaced = tuple(parts.get(a.text, a) if a.op == "name" else a for a in given)
            statement = replace(statement, arguments=replaced)
        result.append(statement)
    return result


def names_in(body: Iterable[Statement]) -> frozenset[str]:
    """Return the names that the statements contain."""
    names = set()
    values = []
    for term in terms(body):
        if term.op == "name":
            names.add(term.text)
        elif term.value is not None:
            values.append(term.value)
    return frozenset(names | {n.payload for n in walk(values) if n.op == "sym"})
