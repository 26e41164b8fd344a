"""Arrays that an emitted step passes to functions and copies as a whole, instead of entry by entry.

The state of a large matrix group is one array, and so is the result of a product of matrices. Without this
module, emitted code would list all entries wherever such an array is passed, tested or assigned.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from codegen.ir.expr import Expr, walk
from codegen.kernel.schedule import result_of
from codegen.run.language import Array, Call, Statement, terms
from codegen.run.terms import Term, own

SHORTEST = 25
"""The least number of entries of an array that is treated as a whole: the entries of a 5 x 5 matrix.

Each entry of a shorter array is a scalar variable, which compilers can keep in a register."""


def whole_result(outputs: Sequence[Expr]) -> Term | None:
    """Return the array of the results of a call, if ``outputs`` lists the entries of this array in order.

    Return None for all other outputs, and for fewer than SHORTEST outputs.
    """
    if len(outputs) < SHORTEST:
        return None
    results = [result_of(x.payload) if x.op == "sym" else None for x in outputs]
    # ``results`` contains None for an output that is no result of a call.
    if results[0] is None:
        return None
    name = results[0][0]
    # All outputs must be results of the same call, in their order.
    if any(x != (name, k) for k, x in enumerate(results)):
        return None
    return own(name, len(outputs))


def in_state(sequence: Iterable[Statement], symbols: Sequence[str], state: Term) -> list[Statement]:
    """Return the statements without unnecessary copies of the array ``state``.

    A copy is unnecessary if it consists of at least SHORTEST consecutive entries of the state. The copy is
    removed, and calls get a part of ``state`` in its place. ``symbols`` are the names of the entries of the
    state.
    """
    places = {s: k for k, s in enumerate(symbols)}
    parts: dict[str, Term] = {}
    result: list[Statement] = []
    for statement in sequence:
        if isinstance(statement, Array) and len(statement.values) >= SHORTEST:
            # ``read`` contains the places in the state, and None for a value that is no entry of the state.
            read = [places.get(x.text) if x.op == "name" else None for x in statement.values]
            first = read[0]
            if first is not None and read == list(range(first, first + len(read))):
                # The declaration of the copy is left out. Later calls use the part of the state instead.
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
    # Expressions share subexpressions, so all expressions are visited in a single walk.
    values = []
    for term in terms(body):
        if term.op == "name":
            names.add(term.text)
        elif term.value is not None:
            values.append(term.value)
    return frozenset(names | {n.payload for n in walk(values) if n.op == "sym"})
