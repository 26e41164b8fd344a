"""The interpreter of step programs (:mod:`codegen.ir.program`).

The interpreter computes one step with the scalars of any domain, for example doubles, numbers with many
digits, or power series. Tests compare the results of emitted code with the results of the interpreter.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from copy import copy
from dataclasses import replace
from typing import SupportsFloat, cast

from codegen.ir.domain import Differenced, Domain, FloatDomain, NotConverged, Scalar, Value
from codegen.ir.operations import Adjoint, Problem
from codegen.ir.program import BODY, SPACE, Assign, Program, Solve
from codegen.ir.values import Kind, Var

Env = dict[Var, Value]
"""A table from the variables of a program to their values."""

State = dict[str, Value]
"""A table from the names of inputs or outputs of a program (for example ``q``) to values."""

# ``TO_BODY`` converts the space momentum mu to the body momentum Ad*_q mu, where q is the configuration.
TO_BODY = Adjoint(dual=True)
TO_SPACE = TO_BODY.opposite()


def flatten(kind: Kind, value: Value) -> tuple[Scalar, ...]:
    """Return the scalars of a value of kind ``kind`` as a tuple. The entries of a matrix are in the order of
    its rows.
    """
    return (value,) if kind is Kind.REAL else tuple(value)


def interpret(
    program: Program,
    problem: Problem,
    domain: Domain,
    inputs: Mapping[str, Value],
    *,
    limit: int = 400,
    newton: bool = True,
    solutions: Env | None = None,
    near: list[list[Scalar]] | None = None,
) -> State:
    """Return the new state after one step, as a table from names such as ``q`` and ``mu`` to values.

    - ``inputs`` contains a value for each input: a scalar of ``domain`` for a real number, otherwise a flat
      tuple of scalars. A matrix is stored row by row.
    - ``limit`` is the largest number of iterations (sweeps) for each block. A block is a system of equations.
    - ``newton`` is true if Newton's method may be used after a slow or failed fixed-point iteration.
    - ``solutions`` is a table from unknowns to the first values of the fixed-point iteration. After the step
      the table contains the solutions of all blocks. Composition methods ignore this table.
    - ``near`` contains one list of scalars for each block. If ``near`` is given, only Newton's method is
      used, and it begins at these scalars. After the step ``near`` contains the solutions.

    If ``domain`` has a method ``computed``, each value x that a statement assigns to a variable is replaced
    by ``computed(name, x)``. Here ``name`` is the name of the variable.

    :class:`NotConverged` is raised if the iteration of a block does not converge.
    """
    if program.frame == BODY:
        # ``core`` has the same statements as ``program``, but no conversions of mu.
        core, start = replace(program, frame=SPACE), {**inputs, "mu": inward(problem, domain, inputs)}
        options: State = {"limit": limit, "newton": newton, "solutions": solutions, "near": near}
        end = interpret(core, problem, domain, start, **options)
        return end | {"mu": outward(problem, domain, inputs, start, end)}
    if program.substeps:
        return _composed(program, problem, domain, inputs, limit, newton, near)
    expected = {} if solutions is None else solutions
    # Each sweep (iteration) of a block overwrites the results of the previous sweep in ``env``.
    env: Env = {v: inputs[v.name] for v in program.inputs}
    computed = getattr(domain, "computed", None)
    if isinstance(domain, FloatDomain):
        domain.size = _size(program, inputs)

    def run(assign: Assign) -> None:
        results = assign.operation.evaluate(problem, domain, tuple(env[a] for a in assign.args))
        if computed is not None:
            results = tuple(computed(v.name, x) for v, x in zip(assign.targets, results, strict=True))
        env.update(zip(assign.targets, results, strict=True))

    for statement in program.body:
        if isinstance(statement, Assign):
            run(statement)
        elif near is not None:
            # The first list in the queue ``near`` contains the initial values for this block.
            near.append(_correct(statement, env, _differenced(domain), run, limit, near.pop(0)))
        else:
            # Fixed-point iteration is tried first, because Newton's method needs expensive difference
            # quotients.
            _fixed_point_first(statement, env, domain, run, limit, expected, newton)
            expected.update((unknown, env[unknown]) for unknown in statement.unknowns)
    return {name: env[var] for name, var in program.outputs}


def _size(program: Program, inputs: Mapping[str, Value]) -> float:
    """Return the largest absolute value of a coordinate of the state."""
    # The time is no coordinate of the state.
    state = (x for v in program.inputs if v.name != "t" for x in flatten(v.kind, inputs[v.name]))
    return max(map(abs, state), default=1.0)


def _fixed_point_first(
    block: Solve,
    env: Env,
    domain: Domain,
    run: Callable[[Assign], None],
    limit: int,
    expected: Env,
    newton: bool,
) -> None:
    """Solve the equations of ``block`` by fixed-point iteration. If it fails and ``newton`` is true, Newton's
    method is used.
    """
    # Newton's method begins after at most ``patience`` sweeps of the fixed-point iteration.
    patience = getattr(domain, "patience", limit) if newton else limit
    try:
        _iterate(block, env, domain, run, min(limit, patience), expected)
    # Divergent iterates may cause an overflow, a division by zero, or the root of a negative number.
    except (ArithmeticError, ValueError):
        if not newton or not hasattr(domain, "increment"):
            raise
        _correct(block, env, _differenced(domain), run, limit)


def inward(problem: Problem, domain: Domain, state: Mapping[str, Value]) -> tuple[Scalar, ...]:
    """Return Ad*_q mu, the momentum in the body frame. ``state`` contains the configuration q and the
    momentum mu in the space frame.
    """
    (m,) = TO_BODY.evaluate(problem, domain, (state["q"], state["mu"]))
    return tuple(m)


def outward(
    problem: Problem, domain: Domain, state: Mapping[str, Value], *ends: Mapping[str, Value]
) -> tuple[Scalar, ...]:
    """Return the space momentum after a step. The step itself computes body momenta.

    ``state`` contains the space momentum mu before the step. ``ends`` are two states with body momenta: the
    state before the step and the state after the step. Both body momenta are converted to the space frame.
    The result is mu plus the difference of the converted momenta. The errors of the two conversions nearly
    cancel.
    """
    before, after = (TO_SPACE.evaluate(problem, domain, (x["q"], x["mu"]))[0] for x in ends)
    return tuple(mu + (b - a) for mu, a, b in zip(state["mu"], before, after, strict=True))


def _composed(
    program: Program,
    problem: Problem,
    domain: Domain,
    inputs: Mapping[str, Value],
    limit: int,
    newton: bool,
    near: list[list[Scalar]] | None,
) -> State:
    """Return the state after all substeps of a composition method."""
    # ``substep`` is the program of a single substep.
    substep, state = replace(program, substeps=()), dict(inputs)
    for step in program.substeps:
        # A substep has a different step size h, so it uses a copy of the domain.
        shorter = copy(domain)
        shorter.h = domain.number(step.fraction) * domain.h
        if "t" in inputs:
            # A repeated addition of the lengths of the substeps would accumulate rounding errors.
            state["t"] = inputs["t"] + domain.number(step.offset) * domain.h
        state |= interpret(substep, problem, shorter, state, limit=limit, newton=newton, near=near)
    return {name: state[name] for name, _ in program.outputs}


def _iterate(
    block: Solve,
    env: Env,
    domain: Domain,
    run: Callable[[Assign], None],
    limit: int,
    expected: Mapping[Var, Value],
) -> None:
    for unknown, start in zip(block.unknowns, block.starts, strict=True):
        env[unknown] = expected.get(unknown, env[start])
    # ``size`` is the size of the last change of the unknowns, or None before the first change.
    size: Scalar = None
    for _ in range(limit):
        for assign in block.body:
            run(assign)
        old = [x for u in block.unknowns for x in flatten(u.kind, env[u])]
        new = [x for v in block.images for x in flatten(v.kind, env[v])]
        # If ``done`` is true, the unknowns keep their old values.
        done, size = domain.settled(old, new, size)
        if done:
            return
        for unknown, image in zip(block.unknowns, block.images, strict=True):
            env[unknown] = env[image]
    raise NotConverged(_unsettled(block, limit, size))


def _differenced(domain: Domain) -> Differenced:
    # The Newton iteration calls ``domain.increment``. The class of ``domain`` does not matter.
    assert hasattr(domain, "increment")
    return cast("Differenced", domain)


def _correct(
    block: Solve,
    env: Env,
    domain: Differenced,
    run: Callable[[Assign], None],
    limit: int,
    near: Sequence[Scalar] | None = None,
) -> list[Scalar]:
    """Solve the equations u = g(u) of ``block`` by Newton's method with difference quotients.

    The iteration begins at the values ``near``. If ``near`` is None, the iteration begins at the values of
    ``block.starts``. The result is the list of all scalars of the solution u.
    """
    kinds = [u.kind for u in block.unknowns]
    # ``widths`` contains the number of scalars of each unknown.
    widths = [len(flatten(s.kind, env[s])) for s in block.starts]

    def images(numbers: list[Scalar]) -> list[Scalar]:
        place = 0
        for unknown, kind, width in zip(block.unknowns, kinds, widths, strict=True):
            part = tuple(numbers[place : place + width])
            env[unknown] = part[0] if kind is Kind.REAL else part
            place += width
        for assign in block.body:
            run(assign)
        return rounded([x for v in block.images for x in flatten(v.kind, env[v])])

    rounded = getattr(domain, "rounded", list)
    now = [x for s in block.starts for x in flatten(s.kind, env[s])] if near is None else list(near)
    # After convergence, ``sharp`` is true, and one more Newton step is computed.
    size, sharp = None, False
    for _ in range(limit):
        values = images(now)
        residual = [g - u for g, u in zip(values, now, strict=True)]
        columns = []
        for j, u in enumerate(now):
            step = domain.increment(u, now)
            # For the difference quotient, ``step`` is added to unknown j, and the images are computed again.
            moved = images([*now[:j], u + step, *now[j + 1 :]])
            # ``slopes`` is column j of g'(u).
            slopes = [(a - b) / step for a, b in zip(moved, values, strict=True)]
            columns.append([(i == j) - x for i, x in enumerate(slopes)])
        # For the equations u = g(u), the correction d of u solves (1 - g'(u)) d = g(u) - u.
        new = [u + d for u, d in zip(now, _solved(columns, residual), strict=True)]
        done, size = domain.settled(now, new, size)
        if near is not None:
            # If no change exceeds ``increment``, one more Newton step is enough (quadratic convergence).
            done = all(abs(a - b) <= domain.increment(a, now) for a, b in zip(now, new, strict=True))
        now = new
        if done or sharp:
            # This call updates the unknowns and all other variables of ``block`` in ``env``.
            images(now)
            if sharp:
                return now
            sharp = True  # the next Newton step is the last one
    raise NotConverged(_unsettled(block, limit, size))


def _unsettled(block: Solve, limit: int, change: Scalar) -> str:
    """Return the message of :class:`NotConverged` for ``block``.

    ``change`` is the last change of the unknowns.
    """
    # The message shows only two digits, so the change is converted to a double.
    last = f"{float(change):.1e}" if isinstance(change, SupportsFloat) else str(change)
    return f"{block.label} did not converge in {limit} sweeps; the last change was {last}"


def _solved(columns: list[list[Scalar]], right: list[Scalar]) -> list[Scalar]:
    """Solve the linear system with the matrix columns ``columns`` and the right-hand side ``right``."""
    n = len(right)
    rows = [[column[i] for column in columns] + [right[i]] for i in range(n)]
    for k in range(n):
        # Row exchanges avoid small pivots.
        pivot = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        # The pivot has the largest absolute value of all entries in the rows k, ..., n - 1 of column k. If
        # the pivot is zero, all these entries are zero, so the matrix is singular. A division by an infinite
        # pivot would give the change zero, as if the iteration had converged.
        if not rows[k][k] or not abs(rows[k][k]) < math.inf:
            raise NotConverged("the matrix of Newton's method is singular or not finite")
        for i in range(k + 1, n):
            # The entries below the pivot become zero up to rounding, and are not read again.
            factor = rows[i][k] / rows[k][k]
            rows[i] = [x - factor * y for x, y in zip(rows[i], rows[k], strict=True)]
    solution: list[Scalar] = []
    for k in reversed(range(n)):
        total = rows[k][n]
        # Back substitution computes the last unknown first, so ``solution`` is in reverse order.
        for x, y in zip(rows[k][k + 1 : n], reversed(solution), strict=True):
            total = total - x * y
        solution.append(total / rows[k][k])
    return solution[::-1]
