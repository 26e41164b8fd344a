"""Build the statements that load the inputs of a kernel, evaluate the kernel, and store its outputs."""

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
    """Return the statements of a kernel. The statements ``after_loops`` are inserted after the last loop.

    If ``counting`` is True, the emitted code counts the sweeps of the loops.
    """
    sequence: list[Statement] = []
    statements = plan.arrangement.statements
    # After the last loop, all unknowns have their final values. A kernel without loops has no unknowns, and
    # ``after_loops`` is not used.
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
    """Return the statements that assign entry i of an array to ``symbols[i]``.

    Only symbols in ``read`` are assigned.
    """
    # Entries that are not read are not loaded, because C compilers warn about unused variables.
    wanted = frozenset(read)
    return [Assign(own(s), array[i]) for i, s in enumerate(symbols) if s in wanted]


def outputs(arrangement: Arrangement, symbols: Sequence[str]) -> tuple[list[Statement], list[Term]]:
    """Return two lists: the statements that assign the outputs of a kernel to names, and the names."""
    sequence: list[Statement] = []
    named: list[Term] = []
    for symbol, output in zip(symbols, arrangement.outputs, strict=True):
        # An output that is a local variable needs no new name. A symbol of the state needs one, because its
        # variable may receive a new value before the output is read.
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
    """Return the statements that compute the run-time inputs at all times at which the kernel needs them."""
    sequence: list[Statement] = []
    # An input function may be slow, and all sweeps must use equal values, so inputs are sampled before all
    # sweeps.
    read, n = plan.arrangement.symbols(), len(plan.kernel.inputs)
    for number, sample in enumerate(plan.kernel.samples, 1):
        values = real(f"inputs_{number}", n)
        sequence += [Array(values), Call("sample", (inputs, value(sample.time)), (values,))]
        # Each sample has its own symbols, because the inputs differ from one time to the next.
        sequence += loaded(sample.symbols, values, read)
    return sequence


def outlined(function: Outlined, arrangement: Arrangement) -> Function:
    """Return the emitted function for an outlined part of a kernel.

    A single result is returned. Several results are written to an array.
    """
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
