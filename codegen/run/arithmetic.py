"""Statements of the run representation that evaluate a kernel, and load and store its state and inputs."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from codegen.ir.kernel import Function as Outlined
from codegen.kernel.schedule import (
    Arrangement,
    Beginning,
    Iteration,
    Simple,
)
from codegen.run.language import RAISES_NAN, Array, Assign, Call, Function, Return, Statement
from codegen.run.plan import INPUTS, Plan
from codegen.run.sweeps import sweeps
from codegen.run.terms import Kind, Term, own, real, value
from codegen.run.values import simple
from codegen.run.warm_start import begun


def computed(plan: Plan, after_loops: Sequence[Statement] = (), *, counting: bool = True) -> list[Statement]:
    """Return the statements of a kernel, in order, with ``after_loops`` after the last loop.

    If ``counting`` is True, the sweeps of loops are counted.
    """
    sequence: list[Statement] = []
    statements = plan.arrangement.statements
    # After the last loop, all unknowns have their final values.
    last = max((k for k, s in enumerate(statements) if isinstance(s, Iteration)), default=-1)
    for place, statement in enumerate(statements):
        if isinstance(statement, Iteration):
            sequence += sweeps(plan, statement, counting)
            sequence += after_loops if place == last else ()
        elif isinstance(statement, Beginning):
            sequence.append(begun(plan, statement))
        else:
            sequence += simple(statement)
    return sequence


def loaded(symbols: Sequence[str], array: Term, read: Iterable[str]) -> list[Statement]:
    """Return the statements that assign entry i of an array to ``symbols[i]``, for the symbols in
    ``read``."""
    # Entries that are not read are not loaded, because C compilers warn about unused variables.
    wanted = frozenset(read)
    return [Assign(own(s), array[i]) for i, s in enumerate(symbols) if s in wanted]


def outputs(arrangement: Arrangement, symbols: Sequence[str]) -> tuple[list[Statement], list[Term]]:
    """Return the statements that assign a kernel's outputs to names, and these names."""
    sequence: list[Statement] = []
    named: list[Term] = []
    for symbol, output in zip(symbols, arrangement.outputs, strict=True):
        if output.op == "sym" and output.payload not in symbols:
            named.append(own(output.payload))
            continue
        # The formulas of other outputs may still read the old entries of the state, so the outputs get new
        # names.
        named.append(own(f"new {symbol}"))
        sequence.append(Assign(named[-1], value(output)))
    return sequence, named


def stored(array: Term, values: Sequence[Term]) -> list[Statement]:
    """Return the statements that store values in an array, value k in entry k."""
    return [Assign(array[k], x) for k, x in enumerate(values)]


def sampled(plan: Plan, inputs: Term = INPUTS) -> list[Statement]:
    """Return the statements that sample run-time inputs at each time and load the inputs that are read."""
    sequence: list[Statement] = []
    # An input function may be slow, and all sweeps must use equal values, so inputs are sampled before all
    # sweeps.
    read, n = plan.arrangement.symbols(), len(plan.kernel.inputs)
    for number, sample in enumerate(plan.kernel.samples, 1):
        values = real(f"inputs_{number}", n)
        sequence += [Array(values), Call("sample", (inputs, value(sample.time)), (values,))]
        sequence += loaded(sample.symbols, values, read)
    return sequence


def outlined(function: Outlined, arrangement: Arrangement) -> Function:
    """Return an outlined function of a kernel. It returns a single result, or fills an array with several
    results."""
    body: list[Statement] = []
    for statement in arrangement.statements:
        # An outlined function only evaluates formulas of its inputs.
        assert isinstance(statement, Simple)
        body += simple(statement)
    parameters = tuple(map(own, function.inputs))
    # A single result is returned as a scalar, which stays in a register.
    if len(arrangement.outputs) == 1:
        body.append(Return(value(arrangement.outputs[0])))
        return Function(function.name, function.about, parameters, tuple(body), Kind.REAL)
    result = real("result", len(arrangement.outputs))
    body += stored(result, [value(x) for x in arrangement.outputs])
    return Function(function.name, function.about, (*parameters, result), tuple(body))


def filling(plan: Plan, name: str, about: str, result: Term) -> Function:
    """Return a function that evaluates a kernel on the state and writes the outputs to an array."""
    arrangement = plan.arrangement
    state = plan.state()
    body = loaded(plan.symbols, state, arrangement.symbols())
    body += computed(plan)
    body += stored(result, [value(x) for x in arrangement.outputs])
    # A NaN in the result is found later, when the complete state is tested.
    return Function(name, about, (state, result), tuple(body), guard=RAISES_NAN, often=True)
