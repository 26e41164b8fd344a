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
    # ``last`` is the index of the last loop. After this loop all unknowns have their final values, so
    # ``after_loops`` is inserted there. Without loops, ``last`` is -1, and nothing is inserted.
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
    """Return the statements that assign entry i of an array to the variable ``symbols[i]``.

    A symbol gets a value only if it is in ``read``.
    """
    # A variable that is never read would cause a warning of the C compiler.
    wanted = frozenset(read)
    return [Assign(own(s), array[i]) for i, s in enumerate(symbols) if s in wanted]


def outputs(arrangement: Arrangement, symbols: Sequence[str]) -> tuple[list[Statement], list[Term]]:
    """Return two lists: the statements that compute the outputs, and the variables with the outputs.

    Output k is the new value of the component ``symbols[k]``.
    """
    sequence: list[Statement] = []
    named: list[Term] = []
    for symbol, output in zip(symbols, arrangement.outputs, strict=True):
        # A local variable of the kernel is returned as it is. All other outputs are assigned to new
        # variables.
        if output.op == "sym" and output.payload not in symbols:
            named.append(own(output.payload))
            continue
        # The variable ``symbol`` must keep its old value, because the formulas of later outputs may read it.
        named.append(own(f"new {symbol}"))
        sequence.append(Assign(named[-1], value(output)))
    return sequence, named


def stored(array: Term, values: Sequence[Term]) -> list[Statement]:
    """Return the statements that assign ``values[k]`` to entry k of an array."""
    return [Assign(array[k], x) for k, x in enumerate(values)]


def sampled(plan: Plan, inputs: Term = INPUTS) -> list[Statement]:
    """Return the statements that evaluate the run-time inputs at all sample times of the kernel.

    The sample times of a method are, for example, t and t + h/2.
    """
    sequence: list[Statement] = []
    # These statements come before the first loop, so the inputs are not computed again in each sweep.
    read, n = plan.arrangement.symbols(), len(plan.kernel.inputs)
    for number, sample in enumerate(plan.kernel.samples, 1):
        values = real(f"inputs_{number}", n)
        sequence += [Array(values), Call("sample", (inputs, value(sample.time)), (values,))]
        # An input has different values at different sample times, so each value has its own variable.
        sequence += loaded(sample.symbols, values, read)
    return sequence


def outlined(function: Outlined, arrangement: Arrangement) -> Function:
    """Return the emitted function for an outlined part of a kernel.

    An outlined part consists of formulas that are computed in a function of their own.
    A single result is returned as a value. Several results are written to an array argument.
    """
    body: list[Statement] = []
    for statement in arrangement.statements:
        # An outlined function solves no equations, so it contains only simple statements.
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
    """Return a function that evaluates the kernel of ``plan`` at a state and writes its outputs to an array.

    ``name`` and ``about`` are the name and the comment of the function. ``result`` is the array.
    """
    arrangement = plan.arrangement
    state = plan.state()
    body = loaded(plan.symbols, state, arrangement.symbols())
    body += computed(plan)
    body += stored(result, [value(x) for x in arrangement.outputs])
    # The function does not test its result for NaNs. The functions that call it test the state later.
    return Function(name, about, (state, result), tuple(body), guard=RAISES_NAN, often=True)
