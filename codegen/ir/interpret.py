"""The interpreter, which evaluates a step program over any domain. Tests compare the results of emitted code
with the results of the interpreter.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from copy import copy
from dataclasses import replace
from typing import SupportsFloat, cast

from codegen.ir.domain import Differenced, Domain, NotConverged, Scalar, Value
from codegen.ir.operations import Adjoint, Problem
from codegen.ir.program import BODY, SPACE, Assign, Program, Solve
from codegen.ir.values import Kind, Var

Env = dict[Var, Value]
"""The values of a program's variables."""

State = dict[str, Value]
"""The values of inputs or outputs by name."""

# The momentum in the body frame is Ad*_q mu. The opposite map returns to the space frame.
TO_BODY = Adjoint(dual=True)
TO_SPACE = TO_BODY.opposite()


def flatten(kind: Kind, value: Value) -> tuple[Scalar, ...]:
    """Return the scalars of a value. A Real is one scalar, and all other values are flat tuples (matrices row
    by row).
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
    """Return the new state after one step, as a table from the names of its parts (such as q) to values.

    - ``inputs`` has a value for each input: a scalar of the domain for a Real, else a flat tuple of scalars
      (group elements row by row).
    - ``limit`` is the largest number of sweeps for a block, that is, for a system of equations.
    - ``newton`` permits Newton's method if fixed-point iteration is slow or fails.
    - ``solutions`` contains the first values of the unknowns, and receives their new values.
    - ``near`` contains a list of first values for each block. If ``near`` is given, Newton's method is used
      from the first sweep, and the solution of a block replaces the list of the block.

    If the domain has a method ``computed``, this method receives the name and the value of each result and
    returns a new value. :class:`NotConverged` is raised with the label of a block that does not converge.
    """
    if program.frame == BODY:
        # The statements of a step in the body frame are those of a step in the space frame. Only the momentum
        # before and after the step is converted.
        core, start = replace(program, frame=SPACE), {**inputs, "mu": inward(problem, domain, inputs)}
        options: State = {"limit": limit, "newton": newton, "solutions": solutions, "near": near}
        end = interpret(core, problem, domain, start, **options)
        return end | {"mu": outward(problem, domain, inputs, start, end)}
    if program.substeps:
        return _composed(program, problem, domain, inputs, limit, newton, near)
    expected = {} if solutions is None else solutions
    # Every statement adds its results to this table. In a block, each sweep replaces the results of the
    # previous sweep.
    env: Env = {v: inputs[v.name] for v in program.inputs}
    computed = getattr(domain, "computed", None)

    def run(assign: Assign) -> None:
        results = assign.operation.evaluate(problem, domain, tuple(env[a] for a in assign.args))
        if computed is not None:
            results = tuple(computed(v.name, x) for v, x in zip(assign.targets, results, strict=True))
        env.update(zip(assign.targets, results, strict=True))

    for statement in program.body:
        if isinstance(statement, Assign):
            run(statement)
        elif near is not None:
            # The first entry of ``near`` belongs to this block. The solution is appended, so the order of the
            # blocks is kept.
            near.append(_correct(statement, env, _differenced(domain), run, limit, near.pop(0)))
        else:
            _fixed_point_first(statement, env, domain, run, limit, expected, newton)
            expected.update((unknown, env[unknown]) for unknown in statement.unknowns)
    return {name: env[var] for name, var in program.outputs}


def _fixed_point_first(
    block: Solve,
    env: Env,
    domain: Domain,
    run: Callable[[Assign], None],
    limit: int,
    expected: Env,
    newton: bool,
) -> None:
    """Solve a system of equations by fixed-point iteration, or by Newton's method if the fixed-point
    iteration fails and ``newton`` is true.

    The fixed-point iteration comes first, because it needs no difference quotients.
    """
    # Without Newton's method, slow fixed-point iteration may use all sweeps.
    patience = getattr(domain, "patience", limit) if newton else limit
    try:
        _iterate(block, env, domain, run, min(limit, patience), expected)
    # Divergent iterates may overflow, divide by zero or leave the domain of a root.
    except (ArithmeticError, ValueError):
        if not newton or not hasattr(domain, "increment"):
            raise
        _correct(block, env, _differenced(domain), run, limit)


def inward(problem: Problem, domain: Domain, state: Mapping[str, Value]) -> tuple[Scalar, ...]:
    """Return Ad*_q mu, the momentum in the body frame."""
    (m,) = TO_BODY.evaluate(problem, domain, (state["q"], state["mu"]))
    return tuple(m)


def outward(
    problem: Problem, domain: Domain, state: Mapping[str, Value], *ends: Mapping[str, Value]
) -> tuple[Scalar, ...]:
    """Return the space momentum after a step that was computed with the body momentum.

    ``state`` contains the space momentum mu before the step. ``ends`` are the states before and after the
    step, with the body momentum. The result is mu plus the change of the space momentum, because the error of
    a slightly non-orthogonal q nearly cancels in this change.
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
    """Return the state after all substeps of the program."""
    substep, state = replace(program, substeps=()), dict(inputs)
    for step in program.substeps:
        # A substep needs a domain with another h. The domain of the caller is copied and not changed.
        shorter = copy(domain)
        shorter.h = domain.number(step.fraction) * domain.h
        if "t" in inputs:
            # Times are computed from the beginning of the whole step, so that rounding errors of the substeps
            # do not accumulate.
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
        # The first value of an unknown is its solution in an earlier step, if ``expected`` contains this
        # solution. Otherwise the first value is the value of the corresponding variable in ``block.starts``.
        env[unknown] = expected.get(unknown, env[start])
    # In the first sweep no earlier change is known.
    size: Scalar = None
    for _ in range(limit):
        for assign in block.body:
            run(assign)
        old = [x for u in block.unknowns for x in flatten(u.kind, env[u])]
        new = [x for v in block.images for x in flatten(v.kind, env[v])]
        # The test for convergence comes before the update of the unknowns, so that after convergence all
        # values in ``env`` were computed from the returned unknowns.
        done, size = domain.settled(old, new, size)
        if done:
            return
        for unknown, image in zip(block.unknowns, block.images, strict=True):
            env[unknown] = env[image]
    raise NotConverged(_unsettled(block, limit, size))


def _differenced(domain: Domain) -> Differenced:
    # isinstance would be false for a domain that wraps another domain and forwards attributes by __getattr__.
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

    The iteration begins at the values ``near``, or at ``block.starts`` if ``near`` is None. The result is the
    list of the values of the unknowns u. If the domain has a method ``rounded``, this method rounds the
    values g(u).
    """
    kinds = [u.kind for u in block.unknowns]
    # All unknowns form one vector, because their equations depend on one another.
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
    # ``sharp`` is true after the corrections have converged. One further correction is then computed.
    size, sharp = None, False
    for _ in range(limit):
        values = images(now)
        residual = [g - u for g, u in zip(values, now, strict=True)]
        columns = []
        for j, u in enumerate(now):
            step = domain.increment(u)
            # One unknown is displaced, and all others keep their values.
            moved = images([*now[:j], u + step, *now[j + 1 :]])
            # ``slopes`` is column j of g'(u). The matrix of Newton's method is 1 - g'(u).
            slopes = [(a - b) / step for a, b in zip(moved, values, strict=True)]
            columns.append([(i == j) - x for i, x in enumerate(slopes)])
        # The correction d solves (1 - g') d = g(u) - u.
        new = [u + d for u, d in zip(now, _solved(columns, residual), strict=True)]
        done, size = domain.settled(now, new, size)
        if near is not None:
            # One further correction approximately squares the error, so a change below the increment of the
            # difference quotients is small enough here.
            done = all(abs(a - b) <= domain.increment(a) for a, b in zip(now, new, strict=True))
        now = new
        if done or sharp:
            # The last evaluation was at a displaced point, so the body is evaluated once more at the
            # solution.
            images(now)
            if sharp:
                return now
            sharp = True  # one further correction removes rounding errors that remain after slow convergence
    raise NotConverged(_unsettled(block, limit, size))


def _unsettled(block: Solve, limit: int, change: Scalar) -> str:
    """Return a message about an iteration that did not converge. ``change`` is the last change of the
    unknowns.
    """
    # The change is converted to a double, because two digits are enough for the message.
    last = f"{float(change):.1e}" if isinstance(change, SupportsFloat) else str(change)
    return f"{block.label} did not converge in {limit} sweeps; the last change was {last}"


def _solved(columns: list[list[Scalar]], right: list[Scalar]) -> list[Scalar]:
    """Solve a linear system by elimination with row exchanges.

    ``columns`` are the columns of the matrix, and ``right`` is the right-hand side.
    """
    n = len(right)
    rows = [[column[i] for column in columns] + [right[i]] for i in range(n)]
    for k in range(n):
        # Partial pivoting is needed, because for large h the matrix is not close to the identity.
        pivot = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        if not rows[k][k]:
            raise NotConverged("Newton's matrix is singular")
        for i in range(k + 1, n):
            # The entries below the pivot are not used after this step, so they are not set to zero.
            factor = rows[i][k] / rows[k][k]
            rows[i] = [x - factor * y for x, y in zip(rows[i], rows[k], strict=True)]
    solution: list[Scalar] = []
    for k in reversed(range(n)):
        total = rows[k][n]
        # Back substitution goes from the last unknown to the first.
        for x, y in zip(rows[k][k + 1 : n], reversed(solution), strict=True):
            total = total - x * y
        solution.append(total / rows[k][k])
    return solution[::-1]
