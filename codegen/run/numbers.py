"""Compute an upper bound of the number of scalars on the stack during a call of an emitted function."""

from __future__ import annotations

from math import prod

from codegen.run.identifiers import Identifiers, identify
from codegen.run.language import Array, Call, Function, Unit, assigned, statements
from codegen.run.terms import Kind, Term

REGISTERS = 8
"""The number of arguments that a call can pass in registers."""


def numbers_held(unit: Unit) -> int:
    """Return an upper bound of the number of scalars on the stack during a call of a public function."""
    identifiers = identify(unit, ())
    held = {f.name: _held(unit, f, identifiers[f.name]) for f in unit.functions}
    calls = {f.name: {s.function for s in statements(f.body) if isinstance(s, Call)} for f in unit.functions}
    # ``called`` contains the names of all functions that private functions call.
    called = {name for f in unit.functions if not f.public for name in calls[f.name]}
    public = {f.name for f in unit.functions if f.public and f.name not in called}

    def together(name: str) -> int:
        # A public function may call another public function, for example ``step`` calls ``run``.
        return held[name] + max(map(together, sorted(calls[name] & public)), default=0)

    # A program calls only one function of ``public`` at a time, so a maximum over these functions is enough.
    # A compiler may inline all functions outside ``public`` into the called function. Therefore the scalars
    # of all functions outside ``public`` are added to the maximum.
    return sum(held.values()) - sum(held[name] for name in public) + max(map(together, public))


def _held(unit: Unit, function: Function, identifiers: Identifiers) -> int:
    arrays, passed, scalars = 0, 0, set()
    for statement in statements(function.body):
        if isinstance(statement, Call):
            # Without optimisation, a compiler may give each call its own stack space for arguments.
            arguments = len(statement.arguments) + len(statement.results)
            passed += arguments if arguments > REGISTERS else 0
        if isinstance(statement, Array):
            # Two arrays with the same name, for example in two loops, may have different addresses, so both
            # arrays are counted.
            arrays += prod(statement.name.shape) * _size(unit, statement.name)
            continue
        # A scalar that is assigned several times has one place on the stack, so it counts once.
        scalars |= {identifiers.of(t) for t in assigned(statement) if t.op == "name" and not t.shape}
    return arrays + passed + len(scalars) + len(function.parameters)


def _size(unit: Unit, name: Term) -> int:
    """Return the number of scalars in one entry of an array."""
    if name.kind is not Kind.RECORD:
        return 1
    # A field with an empty shape is a single number, and the product of an empty shape is 1.
    return sum(prod(field.shape) for field, _ in unit.record(name.record).fields)
