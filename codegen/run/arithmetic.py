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
    """Return the statements that evaluate the kernel of ``plan``.

    The statements ``after_loops`` are inserted after the last loop that solves equations. If ``counting`` is
    True, the emitted code counts the sweeps (iterations) of each loop.
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
    """Return the statements that assign entry i of ``array`` to the variable ``symbols[i]``.

    Symbols that are not in ``read`` are omitted.
    """
    # A variable that is never read would cause a warning of the C compiler.
    wanted = frozenset(read)
    return [Assign(own(s), array[i]) for i, s in enumerate(symbols) if s in wanted]


def outputs(arrangement: Arrangement, symbols: Sequence[str]) -> tuple[list[Statement], list[Term]]:
    """Return the statements that compute the outputs, and the variables that contain the outputs.

    Output k is the new value of ``symbols[k]``.
    """
    sequence: list[Statement] = []
    named: list[Term] = []
    for symbol, output in zip(symbols, arrangement.outputs, strict=True):
        # If an output is a variable outside ``symbols``, no assignment is needed.
        if output.op == "sym" and output.payload not in symbols:
            named.append(own(output.payload))
            continue
        # The old value of ``symbol`` is kept, because the formulas of other outputs may read it.
        named.append(own(f"new {symbol}"))
        sequence.append(Assign(named[-1], value(output)))
    return sequence, named


def stored(array: Term, values: Sequence[Term]) -> list[Statement]:
    """Return the statements that assign ``values[k]`` to entry k of an array."""
    return [Assign(array[k], x) for k, x in enumerate(values)]


def sampled(plan: Plan, inputs: Term = INPUTS) -> list[Statement]:
    """Return the statements that evaluate the run-time inputs at all sample times.

    The sample times of a method are, for example, t and t + h/2.
    """
    sequence: list[Statement] = []
    # Run-time inputs depend only on time, not on the unknowns of a solver loop. Therefore the inputs are
    # evaluated once, before the first solver loop.
    read, n = plan.arrangement.symbols(), len(plan.kernel.inputs)
    for number, sample in enumerate(plan.kernel.samples, 1):
        values = real(f"inputs_{number}", n)
        sequence += [Array(values), Call("sample", (inputs, value(sample.time)), (values,))]
        # ``values`` contains the values of all inputs at this sample time. The value of input i is assigned
        # to the variable ``sample.symbols[i]``.
        sequence += loaded(sample.symbols, values, read)
    return sequence


def outlined(function: Outlined, arrangement: Arrangement) -> Function:
    """Return the emitted function for an outlined part of a kernel.

    An outlined part is a group of formulas that the kernel uses in several places. A single result is the
    value of the emitted function. Several results are written to an array argument.
    """
    body: list[Statement] = []
    for statement in arrangement.statements:
        # An outlined part solves no equations, so it contains only simple statements.
        assert isinstance(statement, Simple)
        body += simple(statement)
    parameters = tuple(map(own, function.inputs))
    # A single result is returned as a scalar, so a compiler can keep it in a register.
    if len(arrangement.outputs) == 1:
        body.append(Return(value(arrangement.outputs[0])))
        return Function(function.name, function.about, parameters, tuple(body), Kind.REAL)
    result = real("result", len(arrangement.outputs))
    body += stored(result, [value(x) for x in arrangement.outputs])
    return Function(function.name, function.about, (*parameters, result), tuple(body))


def filling(plan: Plan, name: str, about: str, result: Term) -> Function:
    """Return an emitted function that evaluates the kernel of ``plan`` at a state.

    The function writes the outputs of the kernel to the array ``result``. ``name`` and ``about`` are the name
    and the comment of the function.
    """
    arrangement = plan.arrangement
    state = plan.state()
    body = loaded(plan.symbols, state, arrangement.symbols())
    body += computed(plan)
    body += stored(result, [value(x) for x in arrangement.outputs])
    # After an arithmetic error, the emitted function fills ``result`` with NaNs (RAISES_NAN).
    return Function(name, about, (state, result), tuple(body), guard=RAISES_NAN, often=True)
